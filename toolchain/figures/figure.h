#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "toolchain/figures/gnuplot.h"
#include "toolchain/figures/replay_log.h"

namespace godobject::figures {

/// The paper's Figure 8 made anew, all solvers in each panel, a colour each: one below the other force, torque,
/// penetration of the god object (with the voxel edge), points in contact, and time of step #1 and of #2-#7.
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

/// The picture as a program for gnuplot, data included, that writes `png`.
std::string gnuplot_text(const Figure& figure, const std::filesystem::path& png);

/// Draws it. Throws Failure if gnuplot is not installed or fails, or the file cannot be written.
void draw(const Figure& figure, const std::filesystem::path& png);

}  // namespace godobject::figures
