#include <algorithm>
#include <utility>

#include "core/pipeline/penalty/penalty_contacts.h"
#include "toolchain/report/contact_quality/world.h"
#include "toolchain/scene_compiler/mesh/mesh_import.h"
#include "toolchain/scene_compiler/mesh/solid_surface.h"

namespace godobject::report {
namespace {

scene_compiler::SolidSurface read_surface(const std::filesystem::path& file, bool shell, double thickness) {
  scene_compiler::MeshReport report;
  return {scene_compiler::import_mesh(file, 1.0, report),
          shell ? scene_compiler::SurfaceKind::kShell : scene_compiler::SurfaceKind::kSolid, thickness};
}

class CompiledWorld : public World {
 public:
  CompiledWorld(files::SceneImage image, scene_compiler::SolidSurface surface)
      : image_(std::move(image)),
        surface_(std::move(surface)),
        H_BM_(image_.scene.H_MB.inverse()),
        points_(report::points_B(image_.scene)) {}

  Cycle start(Solver solver, bool friction) const override {
    auto god_object = std::make_shared<OwnedGodObject>();
    if (god_object->start(image_.scene, solver, friction) != Status::kOk) return {};
    return [god_object, H_BM = H_BM_](const Pose& H_WD, CycleReport& report, StepTimes& times) {
      return (*god_object)->update({H_WD * H_BM, Motion{}}, report, &times);
    };
  }

  double distance(const Vector3& p_W) const override { return image_.scene.voxelmap.sample(p_W).distance; }

  void pieces(const Vector3& p_W, std::vector<analytic::Piece>& out) const override {
    const FieldSample sample = image_.scene.voxelmap.sample(p_W);
    out.push_back({sample.distance, sample.gradient});
  }

  double depth(const Pose& H_WS) const override {
    return -smallest_distance(image_.scene.voxelmap, image_.scene.pointshell, H_WS);
  }

  double true_depth(const Pose& H_WS) const override {
    const SceneView& scene = image_.scene;
    const double near = 0.5 * scene.grid.voxel_size;  // largest error of interpolation at an edge
    double deepest = -near;
    visit_points_below(near, scene.voxelmap, scene.pointshell, H_WS, [&](std::size_t, const Vector3& p_W) {
      if (scene.voxelmap.sample(p_W).distance < near) deepest = std::max(deepest, -surface_.signed_distance(p_W));
      return near;
    });
    return deepest;
  }

  const Pose& H_MB() const override { return image_.scene.H_MB; }
  const std::vector<Vector3>& points_B() const override { return points_; }
  std::vector<watch::WatchedEdge> edges_B() const override { return watch::watched_edges(image_.scene.body_edges); }
  std::vector<watch::WatchedEdge> edges_W() const override { return watch::watched_edges(image_.scene.edges); }

 private:
  files::SceneImage image_;
  scene_compiler::SolidSurface surface_;
  Pose H_BM_;
  std::vector<Vector3> points_;
};

}  // namespace

std::unique_ptr<World> make_compiled_world(const std::string& name, const CompiledStill& still, const Body& body,
                                           const WorldSettings& settings, const std::filesystem::path& folder) {
  const SceneText text{.still = still, .body = body.file, .points = body.points, .settings = settings};
  files::SceneImage image = compile(name, text, folder);
  return std::make_unique<CompiledWorld>(
      std::move(image), read_surface(still_file(name, folder), still.shell, shell_thickness(settings)));
}

}  // namespace godobject::report
