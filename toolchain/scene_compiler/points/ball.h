#pragma once

#include <optional>
#include <string>

#include <Eigen/Core>

#include "core/scene/scene.h"
#include "toolchain/scene_compiler/mesh/solid_surface.h"
#include "toolchain/scene_compiler/points/moving_body.h"

namespace godobject::scene_compiler {

/// A moving body that is a ball, rendered by its centre alone: the ball meets a still body K where the centre is nearer
/// to K than the radius r, which is where it is inside of K dilated by r. The field is that of the dilated body: the
/// distance to K less r. K must be convex: else walls that meet in a re-entrant edge hold the centre together, of which
/// the field's gradient tells one. No torque arises at the centre, and with friction none either.
struct Ball {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< in the moving mesh's frame M [m]
  double radius = 0.0;                               ///< r, of the smallest sphere about the mesh [m]
  double deviation = 0.0;                            ///< how far inside of that sphere the mesh's surface lies [m]
};

/// Largest deviation of a ball, of its radius.
inline constexpr double kBallTolerance = 0.02;

/// The ball that `surface` is: one closed solid, all of its surface within kBallTolerance of a sphere; else nothing.
std::optional<Ball> as_ball(const SolidSurface& surface);

/// Whether `surface` is one closed convex solid: no vertex stands above the plane of a face by more than 1e-5 of the
/// bounding box's diagonal and what rounding to single precision may turn that face by. Cost: faces times vertices.
bool is_convex(const SolidSurface& surface);

/// The ball of a scene that says that it has one. Throws Failure (kBadData) naming the cure where the moving mesh is
/// none, is smaller than a voxel, or the still mesh is not convex.
Ball require_ball(const SolidSurface& moving, const std::string& moving_name, const SolidSurface& still,
                  const std::string& still_name, double voxel_size);

/// One sample point, the ball's centre, and the mass of a ball.
MovingBody make_ball_body(const Ball& ball);

/// Radius by which an image's distances are lessened, as its provenance tells; 0 where its moving body is no ball [m].
double ball_radius(const Scene& scene);

}  // namespace godobject::scene_compiler
