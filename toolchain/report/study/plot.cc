#include "toolchain/report/study/plot.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "toolchain/figures/gnuplot.h"

namespace godobject::report {

using figures::quoted;

std::string color(std::size_t i) {
  constexpr std::array<const char*, 7> kColors = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                  "#e69f00", "#56b4e9", "#222222"};
  return fmt::format("lc rgb '{}'", kColors[i % kColors.size()]);
}

namespace {

constexpr int kBelowAxis = 4;  ///< lines for numbers, name and space

/// Returns the number of lines of the key, which has two columns.
std::ptrdiff_t lines_of_key(const Plot& plot) {
  const auto titles =
      std::count_if(plot.curves.begin(), plot.curves.end(), [](const Curve& it) { return !it.title.empty(); });
  return (titles + 1) / 2;
}

}  // namespace

std::string gnuplot_text(const Plot& plot, const std::filesystem::path& png) {
  std::string text;
  for (std::size_t i = 0; i < plot.curves.size(); ++i) {
    text += fmt::format("$data{} << END\n", i);
    for (const auto& [x, y] : plot.curves[i].points) {
      if (std::isfinite(x) && std::isfinite(y)) text += fmt::format("{:.9g} {:.9g}\n", x, y);
    }
    text += "END\n";
  }
  // a phone shows the picture half as wide, so the letters are large
  text += fmt::format(
      "set terminal pngcairo size 760,680 font 'DejaVu Sans,15' background rgb 'white'\nset output {}\n"
      "set title {} font ',13' noenhanced\nset xlabel {} offset 0,0.4 noenhanced\nset ylabel {} noenhanced\n"
      "set grid xtics ytics lt 1 lc rgb '#dddddd'\nset tics nomirror\n"
      "set key at screen 0.5,0.01 bottom center horizontal maxcols 2 reverse Left samplen 2 noenhanced\n"
      "set bmargin {}\n",
      quoted(png.string()), quoted(plot.title), quoted(plot.x), quoted(plot.y), kBelowAxis + lines_of_key(plot));
  if (plot.log_x) text += "set logscale x\nset format x '10^{%L}'\n";
  if (plot.log_y) text += "set logscale y\nset format y '10^{%L}'\n";
  text += plot.settings + "plot ";
  for (std::size_t i = 0; i < plot.curves.size(); ++i) {
    const Curve& curve = plot.curves[i];
    text += fmt::format("{}$data{} using 1:2 with {} {}", i == 0 ? "" : ", ", i, curve.look,
                        curve.title.empty() ? "notitle" : "title " + quoted(curve.title));
  }
  return text + "\nset output\n";
}

}  // namespace godobject::report
