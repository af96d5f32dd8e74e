#include "toolchain/figures/arm_figure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>

#include <fmt/format.h>

#include "toolchain/figures/curve.h"

namespace godobject::figures {
namespace {

constexpr std::size_t kArmPanels = 7;
constexpr double kDeepest_um = -100.0;  ///< lower end of the axis of depth; larger gaps are drawn here

/// Colours of the joints; colour-blind readers can distinguish them.
constexpr std::array<const char*, 8> kJointColors = {"#e69f00", "#56b4e9", "#009e73", "#c2185b",
                                                     "#0072b2", "#d55e00", "#888888", "#7b3fa0"};

/// Returns the names of the supervisor's modes in the order in which they occurred.
std::vector<std::string> modes(const TelemetryLog& log) {
  std::vector<std::string> names;
  for (const TelemetryRow& row : log) {
    if (std::find(names.begin(), names.end(), row.mode) == names.end()) names.push_back(row.mode);
  }
  return names;
}

/// The name of a curve's data block and its value in a cycle.
struct ArmCurve {
  std::string name;
  std::function<double(const TelemetryRow&)> value;
};

/// Returns the curves of a run: force [N], torque [Nm], distance [mm] and depth [um], which are NaN in a cycle without
/// rendering, the torque of each joint [% of its limit], and the mode's number.
std::vector<ArmCurve> curves_of(const ArmLog& log, const std::vector<std::string>& names) {
  const auto rendered = [](double value, const TelemetryRow& row) {
    return row.share > 0.0 ? value : std::numeric_limits<double>::quiet_NaN();
  };
  std::vector<ArmCurve> curves = {
      {"force", [](const TelemetryRow& row) { return row.cycle.wrench.force.norm(); }},
      {"torque", [](const TelemetryRow& row) { return row.cycle.wrench.torque.norm(); }},
      {"distance",
       [rendered](const TelemetryRow& row) {
         return rendered(1e3 * (row.cycle.H_WS.translation - row.cycle.H_WD.translation).norm(), row);
       }},
      {"depth",
       [rendered](const TelemetryRow& row) { return rendered(std::max(1e6 * row.cycle.depth, kDeepest_um), row); }},
      {"mode", [&names](const TelemetryRow& row) {
         return static_cast<double>(std::find(names.begin(), names.end(), row.mode) - names.begin());
       }}};
  for (std::size_t i = 0; i < log.torque_limits.size(); ++i) {
    curves.push_back({fmt::format("joint{}", i + 1), [i, limit = log.torque_limits[i]](const TelemetryRow& row) {
                        return 1e2 * row.torque[i] / limit;
                      }});
  }
  return curves;
}

/// Returns the data blocks of the run's curves and of the hand's work.
std::string data_blocks(const ArmLog& log, const std::vector<std::string>& names) {
  std::string text;
  for (const ArmCurve& curve : curves_of(log, names)) {
    std::vector<Sample> samples;
    samples.reserve(log.cycles.size());
    for (const TelemetryRow& row : log.cycles) samples.push_back({row.cycle.t, curve.value(row)});
    text += curve_block(curve.name, samples);
  }
  std::vector<Sample> work;
  for (const HandWork& row : log.hand) work.push_back({row.t, row.work});
  return text + curve_block("work", work);
}

std::string curve(const char* name) {
  return fmt::format("plot ${} using 1:2 with lines lw 1.3 lc rgb '#222222' notitle\n", name);
}

std::string joint_curves(std::size_t joints) {
  std::string text = "set yrange [*:*]\nplot ";
  for (std::size_t i = 0; i < joints; ++i) {
    text += fmt::format("{}$joint{} using 1:2 with lines lw 1.3 lc rgb '{}' notitle", i == 0 ? "" : ", ", i + 1,
                        kJointColors[i % kJointColors.size()]);
  }
  return text + "\n";
}

/// Returns the key of the joints' colours above the first panel.
std::string joint_keys(std::size_t joints) {
  std::string text;
  for (std::size_t i = 0; i < joints; ++i) {
    text += fmt::format(", keyentry with lines lw 3 lc rgb '{}' title 'joint {}'",
                        kJointColors[i % kJointColors.size()], i + 1);
  }
  return text;
}

std::string mode_tics(const std::vector<std::string>& names) {
  std::string tics;
  for (std::size_t i = 0; i < names.size(); ++i)
    tics += fmt::format("{}{} {}", i == 0 ? "" : ", ", quoted(names[i]), i);
  return fmt::format("set ytics ({}) font ',8'\nset yrange [-0.5:{}]\n", tics, static_cast<double>(names.size()) - 0.5);
}

}  // namespace

std::string gnuplot_text(const ArmFigure& figure, const std::filesystem::path& svg) {
  const ArmLog& log = figure.log;
  const std::vector<std::string> names = modes(log.cycles);
  const std::size_t joints = log.torque_limits.size();
  std::string force = curve("force");
  force.insert(force.size() - 1, joint_keys(joints));

  std::string text = data_blocks(log, names);
  text += sheet_head({.title = figure.title,
                      .panels = kArmPanels,
                      .height = 1700,
                      .begin = log.cycles.front().cycle.t,
                      .end = log.cycles.back().cycle.t},
                     svg);
  const std::string zero = fmt::format("set yrange [{}:20]\n", kDeepest_um) +
                           "plot 0 with lines dt 4 lw 1.2 lc rgb '#000000' notitle, " + curve("depth").substr(5);
  text += "set offsets graph 0, graph 0, graph 0.06, graph 0\n";  // room above a curve that ends at a limit
  text += marker_text(figure.markers, true) + "set yrange [0:*]\nset ylabel 'force [N]'\n" + force + "unset key\n";
  text += marker_text(figure.markers, false);
  text += "set ylabel 'torque [Nm]'\n" + curve("torque");
  text += "set ylabel 'distance [mm]'\n" + curve("distance");
  text += "set ylabel 'depth [um]'\n" + zero;
  text += "set ylabel 'joints [% of limit]'\n" + joint_curves(joints);
  text += "set ylabel 'work of hand [J]'\n" + curve("work");
  text += "set ylabel ''\n" + mode_tics(names) + kTimeAxis + curve("mode");
  return text + "unset multiplot\nset output\n";
}

void draw(const ArmFigure& figure, const std::filesystem::path& svg) {
  draw_with_gnuplot([&](const std::filesystem::path& file) { return gnuplot_text(figure, file); }, svg);
}

}  // namespace godobject::figures
