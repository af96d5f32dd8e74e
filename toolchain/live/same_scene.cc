#include "toolchain/live/same_scene.h"

#include <algorithm>
#include <cstddef>

namespace godobject::live {
namespace {

constexpr double kShare = 0.05;

/// A shell's surface is thickened, so its box is larger than the mesh's.
bool fills_box(const scene_compiler::TriangleMesh& mesh, const format::Grid& grid) {
  Vector3 low = mesh.vertices.front();
  Vector3 high = low;
  for (const Vector3& vertex : mesh.vertices) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  const Vector3 stored_low(grid.surface_min[0], grid.surface_min[1], grid.surface_min[2]);
  const Vector3 stored_high(grid.surface_max[0], grid.surface_max[1], grid.surface_max[2]);
  const double allowed = kShare * (high - low).norm() + 2.0 * grid.voxel_size;
  return (low - stored_low).norm() <= allowed && (high - stored_high).norm() <= allowed;
}

/// A ball has its centre alone, and a workspace leaves out points that can touch nothing.
bool reaches_points(const scene_compiler::TriangleMesh& mesh, const SceneView& scene) {
  const Pose H_BM = scene.H_MB.inverse();
  double farthest = 0.0;
  for (const Vector3& vertex : mesh.vertices) farthest = std::max(farthest, (H_BM * vertex).norm());
  double stored = 0.0;
  for (std::size_t i = 0; i < scene.pointshell.size; ++i) stored = std::max(stored, scene.pointshell.point(i).norm());
  const bool has_all = scene.pointshell.size > 1 && !scene.workspace.limited;
  return stored <= (1.0 + kShare) * farthest && (!has_all || stored >= (1.0 - kShare) * farthest);
}

}  // namespace

bool is_same_scene(const viewer::SceneBodies& bodies, const SceneView& scene) {
  return fills_box(bodies.still, scene.grid) && reaches_points(bodies.moving, scene);
}

}  // namespace godobject::live
