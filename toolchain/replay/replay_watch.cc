#include "toolchain/replay/replay_watch.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "toolchain/scene_compiler/mesh/mesh_import.h"
#include "toolchain/scene_compiler/mesh/solid_surface.h"
#include "toolchain/scene_compiler/points/ball.h"
#include "toolchain/watch/mesh_surface.h"

namespace godobject::replay {

using scene_compiler::SceneConfig;
using scene_compiler::SolidSurface;

namespace {

/// A body of several components, open or overlapping, as the compiler understands it.
class ManyComponents final : public watch::Oracle {
 public:
  /// `H_MF`: the frame of the field in that of the mesh.
  ManyComponents(SolidSurface surface, const Pose& H_MF) : surface_(std::move(surface)), H_MF_(H_MF) {}

  double distance(const Vector3& p) const override { return surface_.signed_distance(H_MF_ * p); }
  Vector3 gradient(const Vector3& p) const override {
    constexpr double kStep = 1e-7;  // [m]
    Vector3 gradient;
    for (int i = 0; i < 3; ++i) {
      const Vector3 step = kStep * Vector3::Unit(i);
      gradient[i] = (distance(p + step) - distance(p - step)) / (2.0 * kStep);
    }
    return gradient;
  }
  double lipschitz() const override { return 1.0; }

 private:
  SolidSurface surface_;
  Pose H_MF_;
};

/// Returns the exact surface of a body in the frame F of its field. The watch's own distance serves where the nearest
/// triangle tells the side: for one closed component or one sheet.
std::unique_ptr<watch::Oracle> exact_surface(const SceneConfig::Mesh& file, double thickness, double grown_by,
                                             const Pose& H_MF) {
  scene_compiler::MeshReport report;
  SolidSurface surface(scene_compiler::import_mesh(file.file, file.scale, report), file.surface, thickness, grown_by);
  const auto& components = surface.components();
  const bool is_sheet = components.size() == 1 && components[0].shell;
  const bool is_solid = components.size() == 1 && !components[0].shell && !components[0].inside_out && surface.sealed();
  if (!is_sheet && !is_solid) return std::make_unique<ManyComponents>(std::move(surface), H_MF);
  const Pose H_FM = H_MF.inverse();
  std::vector<Vector3> vertices;
  for (const Vector3& v : surface.mesh().vertices) vertices.push_back(H_FM * v);
  return std::make_unique<watch::GrownSurface>(watch::MeshSurface(std::move(vertices), surface.mesh().triangles),
                                               is_sheet ? 0.5 * thickness + grown_by : grown_by, is_sheet);
}

}  // namespace

ReplayWatch::ReplayWatch(const files::SceneImage& image, const SceneConfig& config)
    : voxel_size_(config.voxel_size),
      farthest_(Eigen::Map<const Vector3>(image.scene.grid.origin).cwiseAbs().maxCoeff()),
      scene_(image.bytes.span(), image.scene),
      still_(exact_surface(config.still, config.thickness, scene_compiler::ball_radius(image.scene), Pose{})),
      moving_(exact_surface(config.moving, config.thickness, 0.0, image.scene.H_MB)),
      still_surface_{still_.get(), watch::kDepthBetween * config.surface_tolerance(config.voxel_size).inside},
      moving_surface_{moving_.get(), watch::kDepthBetween * config.moving_tolerance().inside +
                                         std::min(config.moving_tolerance().outside, 0.5 * config.body_voxel_size)} {}

void ReplayWatch::start(const watch::SessionChoice& choice) {
  constexpr double kSinglePrecision = 1e-7;  // of points and the grid's origin
  watch_ = std::make_unique<watch::Watch>(
      scene_.session(choice, still_surface_, moving_surface_, kSinglePrecision * (voxel_size_ + farthest_)));
}

std::string findings_text(const watch::Findings& findings) {
  std::string text;
  int judged = 0;
  int violated = 0;
  for (std::size_t i = 0; i < watch::kPropertyCount; ++i) {
    const watch::Tally& tally = findings.tallies[i];
    if (tally.judged == 0 && tally.violated == 0) continue;
    ++judged;
    if (tally.violated > 0) ++violated;
    text += fmt::format("watch: {}: {} of {}{}{}\n", watch::describe(static_cast<watch::Property>(i)), tally.violated,
                        tally.judged, tally.violated > 0 ? "; first: " : "", tally.first);
  }
  return text + fmt::format("watch: {} cycles, {} touching, {} of {} properties violated\n", findings.cycles,
                            findings.touching, violated, judged);
}

}  // namespace godobject::replay
