#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "toolchain/figures/gnuplot.h"
#include "toolchain/figures/replay_log.h"

namespace godobject::figures {

/// The paper's Figure 8 for our runs, with all solvers in each panel, one colour each. Its panels are: force, torque,
/// penetration of the god object (with the voxel edge), points in contact, time of step #1 and of steps #2-#7.
struct Figure {
  struct Series {
    std::string solver;
    ReplayLog log;
  };

  std::string title;
  std::string facts = {};   ///< of the scene, for the page
  double voxel_size = 0.0;  ///< [m]
  std::vector<Marker> markers;
  std::vector<Series> series;  ///< one or more; later ones are drawn over earlier ones
};

/// Returns a gnuplot program, data included, that draws the figure into the SVG file `svg`.
std::string gnuplot_text(const Figure& figure, const std::filesystem::path& svg);

/// Draws the figure. Throws Failure if gnuplot is not installed or fails, or the file cannot be written.
void draw(const Figure& figure, const std::filesystem::path& svg);

}  // namespace godobject::figures
