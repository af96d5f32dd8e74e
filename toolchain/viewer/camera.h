#pragma once

#include <optional>
#include <vector>

#include "godobject/pose.h"
#include "toolchain/scene_compiler/mesh/triangle_mesh.h"

namespace godobject::viewer {

/// Where a picture is taken from. Vectors in W.
struct Camera {
  Vector3 eye = Vector3::Zero();       ///< [m]
  Vector3 target = Vector3::Zero();    ///< [m]
  Vector3 forward = Vector3::UnitX();  ///< unit
  Vector3 right = Vector3::UnitY();    ///< unit
  Vector3 up = Vector3::UnitZ();       ///< unit; right x up points back to the eye
};

/// Half of the angle of view across the smaller side of the picture [rad].
inline constexpr double kHalfView = 0.30;

/// Direction from the target to the eye, as a person gives it.
struct ViewDirection {
  double azimuth = 0.0;    ///< about `up` [rad]; 0 along the axis that follows `up` in x, y, z, x
  double elevation = 0.0;  ///< over the plane across `up` [rad]
};

/// Where the moving body is at a moment of a replay.
struct Placement {
  Pose H_WD;  ///< device
  Pose H_WS;  ///< god object
};

/// What a camera is to show.
struct View {
  const scene_compiler::TriangleMesh& still;
  const scene_compiler::TriangleMesh& moving;
  std::vector<Placement> placements;       ///< one or more; pictures to be compared take theirs from one camera
  int up_axis = 2;                         ///< 0 .. 2: x, y, z
  double zoom = 1.0;                       ///< 2: everything twice as large
  std::optional<ViewDirection> direction;  ///< chosen if not given
};

/// Frames the moving body in all poses and, of the first placement, where it is nearest to the still one. A direction
/// that is not given is the one of 72 around and three heights from which most of that place and of what is around it
/// is seen, and the gap between that placement's poses from the side.
Camera make_camera(const View& view);

}  // namespace godobject::viewer
