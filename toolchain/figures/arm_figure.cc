#include "toolchain/figures/arm_figure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>

#include <fmt/format.h>

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

/// Returns a gnuplot data block with t, force, torque, distance [mm], depth [um], mode and joint torques [% of the
/// limit]. Distance and depth are nan in a cycle without rendering.
std::string cycle_block(const ArmLog& log, const std::vector<std::string>& names) {
  std::string text = "$cycles << END\n";
  auto out = std::back_inserter(text);
  for (const TelemetryRow& row : log.cycles) {
    const ReplayRow& c = row.cycle;
    const auto mode = std::find(names.begin(), names.end(), row.mode) - names.begin();
    fmt::format_to(out, "{:.4f} {:.6g} {:.6g}", c.t, c.wrench.force.norm(), c.wrench.torque.norm());
    if (row.share > 0.0) {
      fmt::format_to(out, " {:.6g} {:.6g}", 1e3 * (c.H_WS.translation - c.H_WD.translation).norm(),
                     std::max(1e6 * c.depth, kDeepest_um));
    } else {
      text += " nan nan";
    }
    fmt::format_to(out, " {}", mode);
    for (std::size_t i = 0; i < row.torque.size(); ++i)
      fmt::format_to(out, " {:.5g}", 1e2 * row.torque[i] / log.torque_limits[i]);
    text += "\n";
  }
  return text + "END\n";
}

std::string hand_block(const ArmLog& log) {
  std::string text = "$hand << END\n";
  for (const HandWork& row : log.hand) fmt::format_to(std::back_inserter(text), "{:.4f} {:.6g}\n", row.t, row.work);
  return text + "END\n";
}

std::string curve(int column, const char* block = "$cycles") {
  return fmt::format("plot {} using 1:{} with lines lw 1.3 lc rgb '#222222' notitle\n", block, column);
}

std::string joint_curves(std::size_t joints) {
  std::string text = "set yrange [*:*]\nplot ";
  for (std::size_t i = 0; i < joints; ++i) {
    text += fmt::format("{}$cycles using 1:{} with lines lw 1.3 lc rgb '{}' notitle", i == 0 ? "" : ", ", i + 7,
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

std::string gnuplot_text(const ArmFigure& figure, const std::filesystem::path& png) {
  const ArmLog& log = figure.log;
  const std::vector<std::string> names = modes(log.cycles);
  const std::size_t joints = log.torque_limits.size();
  std::string force = curve(2);
  force.insert(force.size() - 1, joint_keys(joints));

  std::string text = cycle_block(log, names) + hand_block(log);
  text += sheet_head({.title = figure.title,
                      .panels = kArmPanels,
                      .height = 1700,
                      .begin = log.cycles.front().cycle.t,
                      .end = log.cycles.back().cycle.t},
                     png);
  const std::string zero = fmt::format("set yrange [{}:20]\n", kDeepest_um) +
                           "plot 0 with lines dt 4 lw 1.2 lc rgb '#000000' notitle, " + curve(5).substr(5);
  text += "set offsets graph 0, graph 0, graph 0.06, graph 0\n";  // room above a curve that ends at a limit
  text += marker_text(figure.markers, true) + "set yrange [0:*]\nset ylabel 'force [N]'\n" + force + "unset key\n";
  text += marker_text(figure.markers, false);
  text += "set ylabel 'torque [Nm]'\n" + curve(3);
  text += "set ylabel 'distance [mm]'\n" + curve(4);
  text += "set ylabel 'depth [um]'\n" + zero;
  text += "set ylabel 'joints [% of limit]'\n" + joint_curves(joints);
  text += "set ylabel 'work of hand [J]'\n" + curve(2, "$hand");
  text += "set ylabel ''\n" + mode_tics(names) + kTimeAxis + curve(6);
  return text + "unset multiplot\nset output\n";
}

void draw(const ArmFigure& figure, const std::filesystem::path& png) {
  draw_with_gnuplot([&](const std::filesystem::path& file) { return gnuplot_text(figure, file); }, png);
}

}  // namespace godobject::figures
