#pragma once

#include <algorithm>
#include <cmath>
#include <functional>

#include "tests/support/analytic_shapes.h"
#include "tests/support/scene_image_builder.h"

namespace godobject::test {

/// Returns the image of a ball of 20 mm radius about the moving mesh's origin and of the still body with this distance
/// in a box about the origin. Friction is 0.2 (static) and 0.18 (kinetic).
inline SceneImage ball_and(const std::function<double(const Vector3&)>& distance, const Vector3& half_edges,
                           double voxel_size = 0.002) {
  const SurfaceSamples ball = sample_ball(0.02, 500);
  SceneDescription description;
  description.distance = distance;
  description.surface_min = -half_edges;
  description.surface_max = half_edges;
  description.voxel_size = voxel_size;
  description.points = ball.points;
  description.normals = ball.normals;
  description.settings.friction = 1;
  description.settings.friction_static = 0.2;
  description.settings.friction_kinetic = 0.18;
  return build_scene_image(description);
}

/// Returns the ball over a plate of 100 x 100 mm with its top at z = `half_thickness`.
inline SceneImage ball_over_plate(double half_thickness = 0.01) {
  const Vector3 half_edges(0.05, 0.05, half_thickness);
  return ball_and([half_edges](const Vector3& p) { return box_distance(p, half_edges); }, half_edges);
}

/// Returns the ball over a block of 60 mm height with a hole along z, 1 mm wider than the ball on each side.
inline SceneImage ball_over_hole() {
  const Vector3 half_edges(0.05, 0.05, 0.03);
  return ball_and(
      [half_edges](const Vector3& p) {
        return std::max(box_distance(p, half_edges), 0.021 - std::hypot(p.x(), p.y()));
      },
      half_edges, 0.001);
}

}  // namespace godobject::test
