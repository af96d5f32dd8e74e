#include "core/pipeline/compiled_session.h"

#include "core/pipeline/cycle/workspace_limit.h"

namespace godobject {
namespace {

/// Normalises the rotation. Refuses an invalid pose.
Status make_unit(Pose& H_WM) noexcept {
  constexpr double kUnit = 1e-3;       // chosen: a quaternion of three decimals passes
  constexpr double kFarthest_m = 1e7;  // the largest coordinate of a scene image (valid_grid, valid_body)
  if (!H_WM.is_finite()) return Status::kNotFinite;
  const double length = H_WM.rotation.norm();
  if (!(length > 1.0 - kUnit && length < 1.0 + kUnit)) return Status::kNotUnit;
  if (H_WM.translation.cwiseAbs().maxCoeff() > kFarthest_m) return Status::kOutOfRange;
  H_WM.rotation.coeffs() /= length;
  return Status::kOk;
}

/// Returns the second direction of the scene; none where the image or this build leaves it out.
template <DistanceField BodyField>
FeatureContacts<BodyField> feature_contacts(const SceneView& scene, const Vector3& sphere_center) noexcept {
  FeatureContacts<BodyField> features;
  if constexpr (kHasSecondDirection<BodyField>) {
    if (scene.has_features()) {
      features = {&scene.body_map, scene.features, scene.features_origin, scene.body_map.surface_radius(sphere_center)};
    }
  }
  return features;
}

/// Returns the sharp edges of both bodies; none where the image or this build leaves them out.
EdgeContacts edge_contacts(const SceneView& scene) noexcept {
  if constexpr (kSceneTraits.edges) return {scene.body_edges, scene.edges};
  return {};
}

}  // namespace

void CompiledSession::start(const SceneView& scene, Solver solver, bool friction,
                            std::span<std::uint32_t> words) noexcept {
  scene_ = scene;
  H_MB_ = scene.H_MB;
  H_BM_ = scene.H_MB.inverse();
  const Parameters parameters = Parameters::make(scene);
  if constexpr (kSceneTraits.contact) {
    if (solver == Solver::kContact && !friction && is_ball(scene)) {
      return core_.start_ball(scene_.voxelmap, scene_.pointshell, parameters);
    }
  }
  core_.start(scene_.voxelmap, scene_.pointshell, feature_contacts<BodyField>(scene_, parameters.mass.sphere.center),
              parameters, solver, friction, words, edge_contacts(scene_));
}

Status CompiledSession::refuse(Status status, CycleReport& report) const noexcept {
  report = CycleReport{};
  report.H_WS = core_.state().H_WS;
  report.outcome = Outcome::kBadInput;
  return status;
}

Status CompiledSession::follow(const Pose& H_WM, CycleReport& report) noexcept {
  Pose unit = H_WM;
  if (const Status status = make_unit(unit); status != Status::kOk) return refuse(status, report);
  core_.place(unit * H_MB_);  // S: B as the god object has it
  report = CycleReport{};
  report.H_WS = core_.state().H_WS;
  return Status::kOk;
}

Status CompiledSession::update(const GodObject::Input& input, CycleReport& report, StepTimes* times) noexcept {
  if (!input.velocity_W.translation.allFinite() || !input.velocity_W.rotation.allFinite()) {
    return refuse(Status::kNotFinite, report);
  }
  Pose H_WM = input.H_WM;
  if (const Status status = make_unit(H_WM); status != Status::kOk) return refuse(status, report);
  // D: B as the device holds it
  const CycleInput cycle_input = input_within(H_WM * H_MB_, input.velocity_W, core_.parameters());
  if (cycle_input.outside && !core_.state().started) {
    const Status status = follow(H_WM, report);
    report.outside = status == Status::kOk;
    return status;
  }
  const Status status = core_.update(cycle_input, report, times);
  return status == Status::kOk ? status : refuse(status, report);
}

}  // namespace godobject
