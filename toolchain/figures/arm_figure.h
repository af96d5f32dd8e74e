#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "toolchain/figures/arm_run.h"
#include "toolchain/figures/gnuplot.h"

namespace godobject::figures {

/// The figure of a whole run, from boot to end. Its panels are: force at the hand, torque at the hand, distance of the
/// god object from the device, depth of the god object, torque of each joint relative to its limit, work of the hand,
/// and mode of the supervisor.
struct ArmFigure {
  std::string title;
  std::string facts;  ///< of the scene, for the page
  std::vector<Marker> markers;
  ArmLog log;
};

/// Returns a gnuplot program, data included, that draws the figure into the SVG file `svg`.
std::string gnuplot_text(const ArmFigure& figure, const std::filesystem::path& svg);

/// Draws the figure. Throws Failure if gnuplot is not installed or fails, or the file cannot be written.
void draw(const ArmFigure& figure, const std::filesystem::path& svg);

}  // namespace godobject::figures
