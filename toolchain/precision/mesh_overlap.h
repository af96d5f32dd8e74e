#pragma once

#include "godobject/pose.h"
#include "toolchain/precision/triangle_boxes.h"
#include "toolchain/scene_compiler/mesh/solid_surface.h"
#include "toolchain/scene_compiler/scene_config.h"

namespace godobject::precision {

/// The depth at which the meshes of a scene overlap: the truth behind the distances at sample points, which see neither
/// edges nor faces between the points.
class MeshOverlap {
 public:
  /// Reads both meshes. `tolerance`: of the depth [m]. Throws Failure (kNoInput, kBadData) if a mesh cannot be used.
  explicit MeshOverlap(const scene_compiler::SceneConfig& config);
  MeshOverlap(scene_compiler::SolidSurface still, scene_compiler::SolidSurface moving, double tolerance);

  /// Returns the largest depth of any point of either mesh, on its faces and edges too, in the other body at a pose of
  /// the moving mesh's frame [m]; 0 if the meshes do not overlap. Too small by at most the tolerance or a hundredth,
  /// never too large. Of a shell, whose body is thick, the depth of the mesh itself counts. Cost: a millisecond, more
  /// where many triangles are near.
  double depth(const Pose& H_WM) const;

 private:
  struct Body {
    explicit Body(scene_compiler::SolidSurface of);

    scene_compiler::SolidSurface surface;
    TriangleBoxes triangles;
    bool has_shells = false;
  };
  friend class DeepestPoint;

  Body still_, moving_;
  double tolerance_;
};

}  // namespace godobject::precision
