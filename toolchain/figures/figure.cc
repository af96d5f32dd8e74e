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

/// A quantity over time: its column in the data block and its axis.
struct Panel {
  const char* label;
  double (*value)(const ReplayRow& row);
  const char* color;
};

constexpr std::array<Panel, 4> kPanels = {{
    {"force [N]", [](const ReplayRow& r) { return r.wrench.force.norm(); }, "#1f4e9c"},
    {"torque [Nm]", [](const ReplayRow& r) { return r.wrench.torque.norm(); }, "#7a3b8f"},
    {"penetration [mm]", [](const ReplayRow& r) { return 1e3 * std::max(r.depth, 0.0); }, "#b3261e"},
    {"colliding points", [](const ReplayRow& r) { return r.contacts; }, "#2e7d32"},
}};
constexpr std::size_t kPenetration = 2;
constexpr double kMicrosecond_ns = 1e3;

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
    fmt::format_to(std::back_inserter(text), " {:.6g} {:.6g}\n", row.step1_ns / kMicrosecond_ns,
                   row.solve_ns / kMicrosecond_ns);
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
    if (named) text += fmt::format("set label {} at {},graph 1.10 center\n", quoted(marker.name), marker.t);
  }
  return text;
}

std::string panel_text(const Figure& figure, std::size_t column, std::size_t row) {
  const Panel& panel = kPanels[row];
  const bool depth = row == kPenetration;
  const double voxel_mm = 1e3 * figure.voxel_size;
  std::string text = marker_text(figure.markers, row == 0);
  text += row == 0 ? fmt::format("set title {} offset 0,0.6\n", quoted("solver " + figure.series[column].solver))
                   : "unset title\n";
  text += column == 0 ? fmt::format("set ylabel '{}'\n", panel.label) : "unset ylabel\n";
  text += fmt::format("set yrange [0:{:.6g}]\n", top(figure, panel, depth ? 1.1 * voxel_mm : 1e-3));
  text += fmt::format("plot $data{} using 1:{} with lines lw 1.4 lc rgb '{}' notitle", column, row + 2, panel.color);
  if (depth) text += fmt::format(", {:.6g} with lines dt 4 lw 1.2 lc rgb '#000000' title 'voxel edge'", voxel_mm);
  return text + "\n";
}

std::string time_panel_text(const Figure& figure, std::size_t column) {
  std::string text = marker_text(figure.markers, false);
  text +=
      "unset title\nset logscale y\nset yrange [0.05:50000]\nset format x '%g'\nset xlabel 'time [s]'\nset key top "
      "right horizontal\n";
  text += column == 0 ? "set ylabel 'run time [us]'\n" : "unset ylabel\n";
  text += fmt::format(
      "plot $data{0} using 1:6 with lines lw 1 lc rgb '#e08214' title '#1', $data{0} using 1:7 with lines lw 1 lc rgb "
      "'#1f4e9c' "
      "title '#2-#7', 1000 with lines dt 4 lw 1.2 lc rgb '#000000' title '1 ms'\n",
      column);
  return text + "unset logscale y\nset format x ''\nunset xlabel\nset key default\n";
}

}  // namespace

std::string gnuplot_text(const Figure& figure, const std::filesystem::path& png) {
  const std::size_t columns = figure.series.size();
  std::string text;
  for (std::size_t i = 0; i < columns; ++i) text += data_block(i, figure.series[i].log);
  const ReplayLog& first = figure.series.front().log;
  text += fmt::format(
      "set terminal pngcairo size {},1100 font 'DejaVu Sans,10' background rgb 'white' noenhanced\nset output {}\n",
      150 + 650 * columns, quoted(png.string()));
  text += fmt::format(
      "set multiplot layout {},{} columnsfirst title {} margins {:.4f},0.985,0.055,0.915 spacing {:.4f},0.022\n",
      kPanels.size() + 1, columns, quoted(figure.title), 90.0 / static_cast<double>(150 + 650 * columns),
      0.11 / static_cast<double>(columns));
  text += fmt::format("set xrange [{}:{}]\nset grid lc rgb '#dddddd'\nset format x ''\nset tics nomirror\n",
                      first.front().t, first.back().t);
  for (std::size_t column = 0; column < columns; ++column) {
    for (std::size_t row = 0; row < kPanels.size(); ++row) text += panel_text(figure, column, row);
    text += time_panel_text(figure, column);
  }
  return text + "unset multiplot\nset output\n";
}

void draw(const Figure& figure, const std::filesystem::path& png) {
  const command::WorkFolder folder(png);
  const auto program = folder.write("figure.gp", gnuplot_text(figure, folder.path() / "figure.png"));
  command::run_program({"gnuplot", program.string()}, "gnuplot-nox");
  folder.deliver("figure.png", png);
}

}  // namespace godobject::figures
