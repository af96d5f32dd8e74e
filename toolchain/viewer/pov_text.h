#pragma once

#include <optional>
#include <string>

#include "godobject/pose.h"
#include "toolchain/scene_compiler/mesh/triangle_mesh.h"
#include "toolchain/viewer/camera.h"

namespace godobject::viewer {

/// A plane that cuts the still body; the part on the side of `normal` is not drawn.
struct Cut {
  Vector3 point;   ///< on the plane, in W [m]
  Vector3 normal;  ///< unit, in W
};

struct Picture {
  int width = 800;  ///< [pixels]
  int height = 600;
  Camera camera;
  Placement placement;     ///< the device's pose is drawn red and translucent, the god object's blue
  std::optional<Cut> cut;  ///< the still mesh must be closed
};

/// Returns a scene for POV-Ray 3.7 in millimetres: still body green, device pose red, god object blue. The red body is
/// drawn smaller by 1/500 of its diagonal, so that the blue one hides it if both poses agree.
std::string pov_text(const scene_compiler::TriangleMesh& still, const scene_compiler::TriangleMesh& moving,
                     const Picture& picture);

}  // namespace godobject::viewer
