#include "toolchain/figures/figure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "toolchain/command/external_program.h"
#include "toolchain/command/work_folder.h"

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

/// Single quotes are gnuplot's own escape.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
  return result + "'";
}

std::string data_block(std::size_t number, const ReplayLog& log) {
  std::string text = fmt::format("$data{} << END\n", number);
  for (const ReplayRow& row : log) {
    fmt::format_to(std::back_inserter(text), "{:.4f}", row.t);
    for (const Panel& panel : kPanels) fmt::format_to(std::back_inserter(text), " {:.6g}", panel.value(row));
    text += "\n";
  }
  return text + "END\n";
}

/// Upper end of an axis: the largest value of all solvers with a little room.
double top(const Figure& figure, const Panel& panel, double at_least) {
  double highest = at_least;
  for (const auto& series : figure.series) {
    for (const ReplayRow& row : series.log) highest = std::max(highest, panel.value(row));
  }
  return 1.06 * highest;
}

std::string marker_text(const std::vector<Marker>& markers, bool named) {
  std::string text = "unset arrow\nunset label\n";
  for (const Marker& marker : markers) {
    text += fmt::format("set arrow from {0},graph 0 to {0},graph 1 nohead dt 2 lc rgb '#555555'\n", marker.t);
    if (named) text += fmt::format("set label {} at {},graph 1.08 center\n", quoted(marker.name), marker.t);
  }
  return text;
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
  if (row + 1 == kPanels.size()) text += "set format x '%g'\nset xlabel 'time [s]'\n";
  text += "plot ";
  for (std::size_t i = 0; i < figure.series.size(); ++i) {
    text += fmt::format("{}$data{} using 1:{} with lines lw 1.3 lc rgb '{}' notitle", i == 0 ? "" : ", ", i, row + 2,
                        kColors[i % kColors.size()]);
  }
  if (depth) text += fmt::format(", {:.6g} with lines dt 4 lw 1.2 lc rgb '#000000' notitle", voxel_mm);
  if (row == 0) text += key_entries(figure) + "\nunset key";
  return text + "\n";
}

}  // namespace

std::string gnuplot_text(const Figure& figure, const std::filesystem::path& png) {
  std::string text;
  for (std::size_t i = 0; i < figure.series.size(); ++i) text += data_block(i, figure.series[i].log);
  const ReplayLog& first = figure.series.front().log;
  text += fmt::format(
      "set terminal pngcairo size 1300,1500 font 'DejaVu Sans,11' background rgb 'white' noenhanced\nset output {}\n",
      quoted(png.string()));
  text += fmt::format("set multiplot layout {},1 title {} margins 0.075,0.985,0.045,0.93 spacing 0.02,0.02\n",
                      kPanels.size(), quoted(figure.title));
  text += fmt::format(
      "set xrange [{}:{}]\nset grid lc rgb '#dddddd'\nset format x ''\nset tics nomirror\nset key at screen "
      "0.985,0.963 right horizontal samplen 3 width 1\n",
      first.front().t, first.back().t);
  for (std::size_t row = 0; row < kPanels.size(); ++row) text += panel_text(figure, row);
  return text + "unset multiplot\nset output\n";
}

void draw(const Figure& figure, const std::filesystem::path& png) {
  const command::WorkFolder folder(png);
  const auto program = folder.write("figure.gp", gnuplot_text(figure, folder.path() / "figure.png"));
  command::run_program({"gnuplot", program.string()}, "gnuplot-nox");
  folder.deliver("figure.png", png);
}

}  // namespace godobject::figures
