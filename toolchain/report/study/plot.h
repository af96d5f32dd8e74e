#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace godobject::report {

/// Points (x, y) of one curve.
struct Curve {
  std::string title;
  std::string look;  ///< of gnuplot: "lines lw 2 lc 1", "points pt 7 lc 1"
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

/// A program for gnuplot, data included, that writes `png`. What is not finite is left out.
std::string gnuplot_text(const Plot& plot, const std::filesystem::path& png);

/// Colours that the colour-blind can tell apart, by number from 0 on, as gnuplot takes them: "lc rgb '#...'".
std::string color(std::size_t i);

}  // namespace godobject::report
