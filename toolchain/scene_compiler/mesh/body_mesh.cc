#include "toolchain/scene_compiler/mesh/body_mesh.h"

#include <algorithm>
#include <utility>

#include "toolchain/scene_compiler/mesh/box.h"
#include "toolchain/scene_compiler/mesh/mesh_normals.h"

namespace godobject::scene_compiler {
namespace {

TriangleMesh turned_outside_out(const SolidSurface& surface) {
  TriangleMesh mesh = surface.mesh();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!surface.components()[surface.component_of_triangle()[t]].inside_out) continue;
    std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
  }
  return mesh;
}

}  // namespace

BodyMesh::BodyMesh(const SolidSurface& surface)
    : mesh(turned_outside_out(surface)),
      edges(mesh),
      face_normals(scene_compiler::face_normals(mesh)),
      half_thickness(0.5 * surface.thickness()) {
  for (const std::uint32_t component : surface.component_of_triangle()) {
    in_shell.push_back(surface.components()[component].shell);
  }
  diagonal = Box::around(mesh.vertices).diagonal();
}

bool BodyMesh::encloses_volume() const {
  return edges.closed() && std::none_of(in_shell.begin(), in_shell.end(), [](bool shell) { return shell; });
}

}  // namespace godobject::scene_compiler
