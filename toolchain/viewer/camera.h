#pragma once

#include <optional>
#include <vector>

#include "godobject/pose.h"
#include "toolchain/scene_compiler/mesh/triangle_mesh.h"

namespace godobject::viewer {

/// Pose of a camera. Vectors in W.
struct Camera {
  Vector3 eye = Vector3::Zero();       ///< [m]
  Vector3 target = Vector3::Zero();    ///< [m]
  Vector3 forward = Vector3::UnitX();  ///< unit
  Vector3 right = Vector3::UnitY();    ///< unit
  Vector3 up = Vector3::UnitZ();       ///< unit; right x up points from the target to the eye
};

/// Half of the angle of view across the smaller side of the picture [rad].
inline constexpr double kHalfView = 0.30;

/// Direction from the target to the eye as two angles.
struct ViewDirection {
  double azimuth = 0.0;    ///< about `up` [rad]; 0 along the axis that follows `up` in x, y, z, x
  double elevation = 0.0;  ///< over the plane across `up` [rad]
};

/// Poses of the moving body at a moment of a replay.
struct Placement {
  Pose H_WD;  ///< device
  Pose H_WS;  ///< god object
};

/// Input of make_camera.
struct View {
  const scene_compiler::TriangleMesh& still;
  const scene_compiler::TriangleMesh& moving;
  std::vector<Placement> placements;       ///< one or more; compare pictures from one camera
  int up_axis = 2;                         ///< 0 .. 2: x, y, z
  double zoom = 1.0;                       ///< 2 doubles all sizes
  std::optional<ViewDirection> direction;  ///< default: automatic
};

/// Returns a camera that shows the moving body in all poses, and the place where the first placement is nearest to the
/// still body. Without a given direction it tests 72 azimuths at three elevations. It takes the one from which most of
/// that place and its surroundings is visible, and which shows the gap between the poses of that placement from the
/// side.
Camera make_camera(const View& view);

}  // namespace godobject::viewer
