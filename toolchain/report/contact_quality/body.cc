#include "toolchain/report/contact_quality/body.h"

#include "toolchain/report/contact_quality/compiled_scene.h"
#include "toolchain/report/contact_quality/meshes.h"

namespace godobject::report {

Body make_body(const std::string& name, const scene_compiler::TriangleMesh& mesh, std::uint32_t points,
               const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / (name + ".ply");
  write_ply(mesh, file);
  const Vector3 half = Vector3::Constant(0.01);
  // an image for `paper` has the requested sample points, and none added because of the still body
  const SceneText text{
      .still = {.mesh = box_mesh(-half, half)}, .body = file, .points = points, .only_solver = format::Solver::kPaper};
  return {file, points, compile(name + "-body", text, folder)};
}

std::vector<Vector3> points_B(const SceneView& scene) {
  std::vector<Vector3> points;
  for (std::size_t i = 0; i < scene.pointshell.size; ++i) points.push_back(scene.pointshell.point(i));
  return points;
}

}  // namespace godobject::report
