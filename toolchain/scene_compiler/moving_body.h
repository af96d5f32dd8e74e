#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <Eigen/Geometry>

#include "core/scene/format.h"
#include "toolchain/scene_compiler/solid_surface.h"

namespace godobject::scene_compiler {

/// What of the moving mesh goes into the image.
struct MovingBody {
  format::Body body{};
  std::vector<float> points;   ///< x[n], y[n], z[n] in the body frame B
  std::vector<float> normals;  ///< the same, unit, pointing into the body
  std::vector<format::Node> nodes;
  std::vector<std::uint32_t> level_sizes;  ///< samples of level 1 .. level_count; the last is n
  double spacing = 0.0;  ///< median distance of a point to the nearest one on its side of the body [m]
  double coverage =
      0.0;  ///< largest distance of the (outer) surface from its nearest sample point, on fresh samples [m]
};

/// Spreads `points` samples over the outer surface (Poisson disk by sample elimination), in `levels` nested levels,
/// with inward normals, sphere tree and mass properties. Deterministic. `progress` gets 0 .. 1; may be empty. Throws
/// std::runtime_error naming the cure.
MovingBody make_moving_body(const SolidSurface& surface, std::uint32_t points, std::uint32_t levels,
                            const std::function<void(double)>& progress);

/// Pose of the body frame B (centre of mass, principal axes) in the moving mesh's frame M, as the core reads it.
Eigen::Isometry3d body_pose(const format::Body& body);

}  // namespace godobject::scene_compiler
