#include "toolchain/precision/body_surface.h"

#include "toolchain/scene_compiler/mesh/mesh_import.h"

namespace godobject::precision {

scene_compiler::SolidSurface read_surface(const scene_compiler::SceneConfig::Mesh& mesh, double thickness) {
  scene_compiler::MeshReport report;
  return {scene_compiler::import_mesh(mesh.file, mesh.scale, report), mesh.surface, thickness};
}

}  // namespace godobject::precision
