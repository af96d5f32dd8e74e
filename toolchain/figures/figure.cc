#include "toolchain/figures/figure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <fmt/format.h>

#include "toolchain/figures/curve.h"

namespace godobject::figures {
namespace {

constexpr double kMicrosecond_ns = 1e3;

/// A quantity over time and its axis.
struct Panel {
  const char* label;
  double (*value)(const ReplayRow& row);
  double lowest = 0.0;  ///< of a logarithmic axis; 0: linear
};

constexpr std::array<Panel, 6> kPanels = {{
    {"force [N]", [](const ReplayRow& r) { return r.wrench.force.norm(); }},
    {"torque [Nm]", [](const ReplayRow& r) { return r.wrench.torque.norm(); }},
    {"penetration [mm]", [](const ReplayRow& r) { return 1e3 * std::max(r.depth, 0.0); }},
    {"points", [](const ReplayRow& r) { return r.contacts; }, 0.7},
    {"#1 [us]", [](const ReplayRow& r) { return r.step1_ns / kMicrosecond_ns; }, 0.1},
    {"#2-#7 [us]", [](const ReplayRow& r) { return r.solve_ns / kMicrosecond_ns; }, 0.1},
}};
constexpr std::size_t kPenetration = 2;

/// By the order of the series; easy to tell apart for the colour-blind.
constexpr std::array<const char*, 4> kColors = {"#e69f00", "#56b4e9", "#c2185b", "#222222"};

/// Returns the name of a curve's data block.
std::string block_name(std::size_t series, std::size_t panel) { return fmt::format("data{}_{}", series, panel); }

/// Returns the data blocks of a replay's curves, one for each panel.
std::string data_blocks(std::size_t series, const ReplayLog& log) {
  std::string text;
  for (std::size_t k = 0; k < kPanels.size(); ++k) {
    std::vector<Sample> curve;
    curve.reserve(log.size());
    for (const ReplayRow& row : log) curve.push_back({row.t, kPanels[k].value(row)});
    text += curve_block(block_name(series, k), curve);
  }
  return text;
}

/// Upper end of an axis: the largest value of all solvers with a little room.
double top(const Figure& figure, const Panel& panel, double at_least) {
  double highest = at_least;
  for (const auto& series : figure.series) {
    for (const ReplayRow& row : series.log) highest = std::max(highest, panel.value(row));
  }
  return 1.06 * highest;
}

/// Entries of the key of all panels, which stands above the first one.
std::string key_entries(const Figure& figure) {
  std::string text;
  for (std::size_t i = 0; i < figure.series.size(); ++i) {
    text += fmt::format(", keyentry with lines lw 3 lc rgb '{}' title {}", kColors[i % kColors.size()],
                        quoted("solver " + figure.series[i].solver));
  }
  return text + ", keyentry with lines dt 4 lw 1.2 lc rgb '#000000' title 'voxel edge'";
}

std::string panel_text(const Figure& figure, std::size_t row) {
  const Panel& panel = kPanels[row];
  const bool depth = row == kPenetration;
  const double voxel_mm = 1e3 * figure.voxel_size;
  std::string text = marker_text(figure.markers, row == 0);
  text += fmt::format("set ylabel '{}'\n", panel.label);
  const double highest = top(figure, panel, depth ? 1.1 * voxel_mm : 1e-3);
  if (panel.lowest > 0.0) {
    text += fmt::format("set logscale y\nset yrange [{}:{:.6g}]\n", panel.lowest, 2.0 * highest);
  } else {
    text += fmt::format("unset logscale y\nset yrange [0:{:.6g}]\n", highest);
  }
  if (row + 1 == kPanels.size()) text += kTimeAxis;
  text += "plot ";
  for (std::size_t i = 0; i < figure.series.size(); ++i) {
    text += fmt::format("{}${} using 1:2 with lines lw 1.3 lc rgb '{}' notitle", i == 0 ? "" : ", ", block_name(i, row),
                        kColors[i % kColors.size()]);
  }
  if (depth) text += fmt::format(", {:.6g} with lines dt 4 lw 1.2 lc rgb '#000000' notitle", voxel_mm);
  if (row == 0) text += key_entries(figure) + "\nunset key";
  return text + "\n";
}

}  // namespace

std::string gnuplot_text(const Figure& figure, const std::filesystem::path& svg) {
  std::string text;
  for (std::size_t i = 0; i < figure.series.size(); ++i) text += data_blocks(i, figure.series[i].log);
  const ReplayLog& first = figure.series.front().log;
  text += sheet_head({.title = figure.title, .panels = kPanels.size(), .begin = first.front().t, .end = first.back().t},
                     svg);
  for (std::size_t row = 0; row < kPanels.size(); ++row) text += panel_text(figure, row);
  return text + "unset multiplot\nset output\n";
}

void draw(const Figure& figure, const std::filesystem::path& svg) {
  draw_with_gnuplot([&](const std::filesystem::path& file) { return gnuplot_text(figure, file); }, svg);
}

}  // namespace godobject::figures
