#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "toolchain/figures/arm_run.h"
#include "toolchain/figures/gnuplot.h"

namespace godobject::figures {

/// The whole of a run, from boot to end, one below the other: force and torque at the hand, distance of the god object
/// from the device, depth of the god object, torque of each joint against its limit, work of the hand, and mode of the
/// supervisor.
struct ArmFigure {
  std::string title;
  std::string facts;  ///< of the scene, for the page
  std::vector<Marker> markers;
  ArmLog log;
};

/// The picture as a program for gnuplot, data included, that writes `png`.
std::string gnuplot_text(const ArmFigure& figure, const std::filesystem::path& png);

/// Draws it. Throws Failure if gnuplot is not installed or fails, or the file cannot be written.
void draw(const ArmFigure& figure, const std::filesystem::path& png);

}  // namespace godobject::figures
