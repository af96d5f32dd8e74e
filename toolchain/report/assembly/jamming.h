#pragma once

#include <array>
#include <span>

#include <Eigen/Core>

namespace godobject::report {

using Vector2 = Eigen::Vector2d;

/// A place where a peg touches its hole, in the plane of its tilt (x to the side, z up).
struct PlaneContact {
  Vector2 point = Vector2::Zero();   ///< [m]
  Vector2 normal = Vector2::Zero();  ///< of unit length, into the peg
};

/// A load on the peg in that plane. Moments turn z towards x, about the origin.
struct PlaneLoad {
  Vector2 force = Vector2::Zero();  ///< [N]
  double moment = 0.0;              ///< [Nm]
};

/// Returns the smallest coefficient of friction with which forces at these places can balance the load (Coulomb), so
/// that the peg does not move; infinity if no coefficient below `most` does. Found from the cones of friction alone.
double holding_friction(std::span<const PlaneContact> contacts, const PlaneLoad& load, double most = 2.0);

/// Returns the coefficient of friction from which on the places can press against each other: the line through both
/// lies within both cones. Then they can hold any load (wedging), but need not: the load may also move the peg.
double wedging_friction(const std::array<PlaneContact, 2>& contacts);

/// Returns the coefficient on the upper right side of Whitney's jamming diagram (1982), for a slightly tilted peg of
/// diameter d that touches its hole at two places and is `depth` deep in it:
/// M / (r F_z) = lambda - mu (1 + lambda) F_x / F_z, lambda = depth / (mu d), r = d / 2. Moments are about the middle
/// of the tip. F_z pushes into the hole, F_x towards the wall that the tip touches; `force_ratio` = F_x / F_z, at least
/// 0, `moment_ratio` = M / (r F_z). Without F_x and with the moment of a push along the peg's side, moment_ratio = 1,
/// this is the condition of wedging, depth = mu d.
double whitney_friction(double depth, double diameter, double force_ratio, double moment_ratio);

}  // namespace godobject::report
