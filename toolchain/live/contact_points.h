#pragma once

#include <cstddef>
#include <vector>

#include "core/scene/scene_view.h"
#include "godobject/pose.h"

namespace godobject::live {

/// A place at which the bodies touch.
struct ContactPoint {
  Vector3 p_W = Vector3::Zero();       ///< [m]
  Vector3 normal_W = Vector3::Zero();  ///< unit, out of the still body
  double load = 0.0;                   ///< along the normal, on the moving body [N]
};

/// Largest number of points that `contact_points` returns: more cannot be told apart in a picture.
inline constexpr std::size_t kMostContactPoints = 64;

/// Returns places at which the god object at H_WS (pose of the body frame) touches: sample points of the moving body
/// and feature points of the still one that are not farther from the surface than the nearest point and the margin of
/// `contact`. Of places close to each other the nearest one stays, so that those that are returned stand for all.
/// Contacts of two edges are not among them. For pictures: cost up to a millisecond, allocates.
///
/// The loads explain `wrench_W`, the force on the moving body about its centre of mass, as well as pushing forces at
/// these points can; of all such loads they are nearly the smallest ones, so that an even pressure looks even.
std::vector<ContactPoint> contact_points(const SceneView& scene, const Pose& H_WS, const Wrench& wrench_W);

/// Sets the loads of `points` as above. `length`: lever at which a torque counts as a force [m], > 0; c_W: centre of
/// mass.
void set_loads(std::vector<ContactPoint>& points, const Vector3& c_W, const Wrench& wrench_W, double length);

}  // namespace godobject::live
