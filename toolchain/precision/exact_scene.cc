#include "toolchain/precision/exact_scene.h"

#include <algorithm>
#include <utility>

#include "core/pipeline/penalty/penalty_contacts.h"
#include "toolchain/precision/body_surface.h"
#include "toolchain/scene_compiler/points/sample_elimination.h"

namespace godobject::precision {
namespace {

using scene_compiler::OuterSurface;
using scene_compiler::SolidSurface;

constexpr std::uint32_t kLevels = 8;  // chosen: the tree of 6000 points grows by 2.6 from level to level

scene_compiler::MovingSampling sampled(const OuterSurface& outer, std::uint32_t points) {
  return scene_compiler::sample_moving_body(outer, points, std::min(kLevels, scene_compiler::most_levels(points)), {});
}

scene_compiler::MovingBody make_body(const SolidSurface& moving, std::uint32_t points) {
  const OuterSurface outer(moving);
  return scene_compiler::make_moving_body(outer, sampled(outer, points));
}

scene_compiler::StillFeatures make_features(const SolidSurface& still, std::uint32_t points) {
  const OuterSurface outer(still);
  const scene_compiler::MovingSampling sampling = sampled(outer, points);
  return scene_compiler::make_still_features(sampling.samples, sampling.area);
}

Pose body_pose(const format::Body& body) {
  const Eigen::Isometry3d X_MB = scene_compiler::body_pose(body);
  Pose H_MB;
  H_MB.rotation = Quaternion(X_MB.linear()).normalized();
  H_MB.translation = X_MB.translation();
  return H_MB;
}

SolidSurface in_frame(const SolidSurface& surface, const Pose& pose, scene_compiler::SurfaceKind kind) {
  scene_compiler::TriangleMesh mesh = surface.mesh();
  for (Eigen::Vector3d& vertex : mesh.vertices) vertex = pose * vertex;
  return {std::move(mesh), kind, surface.thickness()};
}

Pointshell shell_of(const std::vector<float>& values, const std::vector<format::Node>& nodes) {
  const std::size_t n = values.size() / 3;
  Pointshell shell;
  shell.size = n;
  shell.x = values.data();
  shell.y = shell.x + n;
  shell.z = shell.y + n;
  shell.nodes = nodes;
  return shell;
}

Parameters make_parameters(const scene_compiler::SceneConfig& config, const format::Body& body) {
  constexpr double kMargin = 1e-3;  // [voxels] a tenth of the default
  SceneView scene;
  scene.settings = config.settings;
  scene.grid.voxel_size = config.voxel_size;
  scene.body = body;
  Parameters parameters = Parameters::make(scene);
  parameters.margin = kMargin * config.voxel_size;
  return parameters;
}

}  // namespace

ExactScene::ExactScene(const scene_compiler::SceneConfig& config, std::uint32_t points)
    : still_(read_surface(config.still, config.thickness)),
      moving_(read_surface(config.moving, config.thickness)),
      still_box_(scene_compiler::Box::around(still_.mesh().vertices)),
      moving_box_(scene_compiler::Box::around(moving_.mesh().vertices)),
      body_(make_body(moving_, points)),
      features_(make_features(still_, points)),
      H_MB_(body_pose(body_.body)),
      body_surface_(in_frame(moving_, H_MB_.inverse(), config.moving.surface)),
      still_field_(still_, config.voxel_size),
      body_field_(body_surface_, config.voxel_size),
      points_(shell_of(body_.points, body_.nodes)),
      feature_points_(shell_of(features_.points, features_.nodes)),
      parameters_(make_parameters(config, body_.body)) {
  for (const Vector3& vertex : body_surface_.mesh().vertices) {
    body_radius_ = std::max(body_radius_, (vertex - parameters_.mass.sphere.center).norm());
  }
}

FeatureContacts<MeshField> ExactScene::feature_contacts() const {
  const double* origin = features_.header.origin;
  return {&body_field_, feature_points_, Vector3(origin[0], origin[1], origin[2]), body_radius_};
}

std::vector<TracedCycle> ExactScene::reference(const Paths& paths, bool friction) const {
  const ContactScene<MeshField, MeshField> scene(still_field_, points_, feature_contacts(), parameters_);
  std::vector<std::uint32_t> words(ContactSearch::memory(points_, feature_points_));
  const auto run = friction ? &contact_cycle<true, MeshField, MeshField> : &contact_cycle<false, MeshField, MeshField>;
  const Pose H_BM = H_MB_.inverse();
  std::vector<TracedCycle> cycles;
  for (const std::vector<Pose>& path : paths) {
    const auto memory = std::make_unique<ContactMemory>();
    memory->search.start(scene, words);
    ProxyState state;
    for (const Pose& H_WM : path) {
      CycleInput input;
      input.H_WD = H_WM * H_MB_;
      if (!state.started) {
        state.H_WS = input.H_WD;
        state.inside = penetration(H_WM) > 0.0;
      }
      CycleReport report;
      const Status status = run(scene, input, *memory, state, report, nullptr);
      cycles.push_back({state.H_WS * H_BM, status == Status::kOk ? report.force.spring_W : Wrench{}});
    }
  }
  return cycles;
}

double ExactScene::smallest(const Pose& H_WM, double cutoff) const {
  const auto look = [&](const MeshField& field, const Pointshell& shell, const Pose& pose) {
    visit_points_below(cutoff, field, shell, pose, [&](std::size_t, const Vector3& p) noexcept {
      cutoff = std::min(cutoff, field.distance(p));
      return cutoff;
    });
  };
  const Pose H_WB = H_WM * H_MB_;
  look(still_field_, points_, H_WB);
  Pose H_WF;
  H_WF.translation = feature_contacts().origin_W;
  look(body_field_, feature_points_, H_WB.inverse() * H_WF);
  return cutoff;
}

double ExactScene::penetration(const Pose& H_WM) const { return std::max(0.0, -smallest(H_WM, 0.0)); }

double ExactScene::clearance(const Pose& H_WM) const { return smallest(H_WM, still_field_.band()); }

}  // namespace godobject::precision
