#pragma once

#include "toolchain/scene_compiler/mesh/triangle_mesh.h"

namespace godobject::report {

/// A trapezoidal thread about z. [m, rad]
struct Thread {
  double pitch = 6e-3;
  double flank_angle = 0.5235987755982988;
  double root = 9e-3;    ///< radius of the bolt's root
  double crest = 11e-3;  ///< and of its crest
  double crest_width = 8e-4;
  double axial_play = 2e-4;     ///< of the nut, from flank to flank
  double radial_play = 1.4e-3;  ///< between root and crest of nut and bolt
  int around = 48;              ///< steps of a turn
};

/// Returns a bolt from z = 0 to `length`.
scene_compiler::TriangleMesh bolt_mesh(const Thread& thread, double length);

/// Returns a nut with the outer radius, from z = `low` to `high`, that fits the bolt in place.
scene_compiler::TriangleMesh nut_mesh(const Thread& thread, double outer_radius, double low, double high);

}  // namespace godobject::report
