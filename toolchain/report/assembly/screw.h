#pragma once

#include "toolchain/scene_compiler/mesh/triangle_mesh.h"

namespace godobject::report {

/// A nut on a bolt about z: measured from their meshes. [m, rad]
struct Screw {
  double pitch = 0.0;
  double flank_angle = 0.0;   ///< between flank and a plane across the axis, in a section through the axis
  double inner_radius = 0.0;  ///< of the nut's thread: the flanks overlap from here ...
  double outer_radius = 0.0;  ///< ... to here, the bolt's radius

  double mean_radius() const { return 0.5 * (inner_radius + outer_radius); }
};

/// Measures the threads by sections through the axis, between the heights `low` and `high` of the bolt. Throws Failure
/// (kBadData) if there are no threads.
Screw measure_screw(const scene_compiler::TriangleMesh& bolt, const scene_compiler::TriangleMesh& nut, double low,
                    double high);

/// Returns the coefficient of friction above which an axial force does not turn the nut: the tangent of the lead angle
/// at `radius` times the cosine of the flank angle. Exact with the angle in a section across the thread; with that of
/// `Screw`, in a section through the axis, too small by 0.1 % for a lead of 5 degrees.
double self_locking_friction(const Screw& screw, double radius);

/// Returns the torque that turns the nut against an axial force of 1 N (or, with a negative coefficient, lets it turn
/// with the force) with friction at `radius` [m]: the equation of the power screw.
double raising_torque(const Screw& screw, double radius, double friction);

}  // namespace godobject::report
