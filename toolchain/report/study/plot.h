#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace godobject::report {

/// Points (x, y) of one curve.
struct Curve {
  std::string title;
  std::string look;  ///< gnuplot's style: "lines lw 2 lc 1", "points pt 7 lc 1"
  std::vector<std::pair<double, double>> points;
};

struct Plot {
  std::string title;
  std::string x;
  std::string y;
  bool log_x = false;
  bool log_y = false;
  std::string settings = {};  ///< more lines for gnuplot
  std::vector<Curve> curves;
};

/// Returns a gnuplot program, data included, that draws the plot into `png`. Points that are not finite are omitted.
std::string gnuplot_text(const Plot& plot, const std::filesystem::path& png);

/// Returns the i-th colour for gnuplot: "lc rgb '#...'". Colour-blind readers can distinguish the colours.
std::string color(std::size_t i);

}  // namespace godobject::report
