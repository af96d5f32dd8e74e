#pragma once

#include <optional>
#include <string>

#include <Eigen/Core>

#include "core/scene/scene_view.h"
#include "toolchain/scene_compiler/mesh/solid_surface.h"
#include "toolchain/scene_compiler/points/moving_body.h"

namespace godobject::scene_compiler {

/// A moving body that is a ball, rendered by its centre alone. The ball meets a still body K if its centre is nearer to
/// K than the radius r, that is, inside K dilated by r. The stored field is the distance to K less r. K must be convex:
/// otherwise two walls that meet in a re-entrant edge hold the centre together, and the field's gradient shows only one
/// of them. No torque arises at the centre, and with friction none either.
struct Ball {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< in the moving mesh's frame M [m]
  double radius = 0.0;                               ///< r, of the smallest sphere about the mesh [m]
  double deviation = 0.0;                            ///< largest depth of the mesh's surface inside that sphere [m]
};

/// Largest deviation of a ball, of its radius. It admits a sphere of 12 x 24 facets, which lie up to 1 - cos^2(7.5
/// degrees) = 0.017 inside.
inline constexpr double kBallTolerance = 0.02;

/// Returns the ball that `surface` represents: one closed solid with all of its surface within kBallTolerance of a
/// sphere. Otherwise nothing.
std::optional<Ball> as_ball(const SolidSurface& surface);

/// True if `surface` is one closed convex solid. No vertex may lie above the plane of a face by more than 1e-5 of the
/// bounding box's diagonal and the effect of single-precision rounding on that plane. Cost: faces times vertices.
bool is_convex(const SolidSurface& surface);

/// Returns the ball of a scene with moving.ball. Throws Failure (kBadData) naming the cure if the moving mesh is no
/// ball or smaller than a voxel, or if the still mesh is not convex.
Ball require_ball(const SolidSurface& moving, const std::string& moving_name, const SolidSurface& still,
                  const std::string& still_name, double voxel_size);

/// Returns a body with the mass of the ball and one sample point, its centre.
MovingBody make_ball_body(const Ball& ball);

/// Returns the radius by which an image's distances are reduced, from its provenance; 0 if its moving body is no ball
/// [m].
double ball_radius(const SceneView& scene);

}  // namespace godobject::scene_compiler
