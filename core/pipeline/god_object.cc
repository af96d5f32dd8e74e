#include "core/pipeline/god_object.h"

#include <cassert>

namespace godobject {
namespace {

FeatureContacts<Voxelmap> feature_contacts(const Scene& scene) noexcept {
  return {scene.body_map, scene.features, scene.features_origin, scene.body_map.surface_radius()};
}

/// The pipelines, all with one signature.
template <bool kFriction>
Status run_paper(const Scene& scene, const Parameters& q, const CycleInput& input, ContactSearch&, State& state,
                 ContactWorkspace&, CycleReport& report, StepTimes* times) noexcept {
  return paper_cycle<kFriction>(scene.voxelmap, scene.pointshell, q, input, state, report, times);
}

template <bool kFriction>
Status run_corrected(const Scene& scene, const Parameters& q, const CycleInput& input, ContactSearch&, State& state,
                     ContactWorkspace&, CycleReport& report, StepTimes* times) noexcept {
  return corrected_cycle<kFriction>(scene.voxelmap, scene.pointshell, q, input, state, report, times);
}

template <bool kFriction>
Status run_contact(const Scene& scene, const Parameters& q, const CycleInput& input, ContactSearch& search,
                   State& state, ContactWorkspace& workspace, CycleReport& report, StepTimes* times) noexcept {
  const FeatureContacts<Voxelmap> features = feature_contacts(scene);
  return contact_cycle<kFriction>(scene.voxelmap, scene.pointshell, scene.has_features() ? &features : nullptr, q,
                                  input, search, state, workspace, report, times);
}

/// Refuses what is no pose; makes the rotation of one exactly unit.
Status make_unit(Pose& H_WM) noexcept {
  constexpr double kUnit = 1e-3;
  constexpr double kFarthest_m = 1e7;  // what a scene image may hold
  if (!H_WM.is_finite()) return Status::kNotFinite;
  const double length = H_WM.rotation.norm();
  if (!(length > 1.0 - kUnit && length < 1.0 + kUnit)) return Status::kNotUnit;
  if (H_WM.translation.cwiseAbs().maxCoeff() > kFarthest_m) return Status::kOutOfRange;
  H_WM.rotation.coeffs() /= length;
  return Status::kOk;
}

Status refuse(Status status, const State& state, CycleReport& report) noexcept {
  report = CycleReport{};
  report.H_WS = state.H_WS;
  report.outcome = Outcome::kBadInput;
  return status;
}

}  // namespace

Status GodObject::start(const Scene& scene, Solver solver, bool friction, std::span<std::uint32_t> memory) noexcept {
  if (!scene.holds(solver) || (friction && scene.settings.friction == 0)) return Status::kNotInImage;
  switch (solver) {
    case Solver::kPaper: cycle_ = friction ? &run_paper<true> : &run_paper<false>; break;
    case Solver::kCorrected: cycle_ = friction ? &run_corrected<true> : &run_corrected<false>; break;
    case Solver::kContact: cycle_ = friction ? &run_contact<true> : &run_contact<false>; break;
  }
  scene_ = &scene;
  H_MB_ = scene.H_MB;
  H_BM_ = scene.H_MB.inverse();
  parameters_ = Parameters::make(scene);
  if (solver == Solver::kContact) {
    const FeatureContacts<Voxelmap> features = feature_contacts(scene);
    const std::size_t wanted = GodObject::memory(scene);
    search_.start(scene.voxelmap, scene.pointshell, scene.has_features() ? &features : nullptr,
                  ContactLengths::make(parameters_), memory.first(memory.size() < wanted ? 0 : wanted));
  }
  reset();
  return Status::kOk;
}

Status GodObject::follow(const Pose& H_WM, CycleReport& report) noexcept {
  Pose unit = H_WM;
  if (const Status status = make_unit(unit); status != Status::kOk) return refuse(status, state_, report);
  reset();
  state_.H_WS = unit * H_MB_;
  report = CycleReport{};
  report.H_WS = state_.H_WS;
  return Status::kOk;
}

Status GodObject::update(const Input& input, CycleReport& report, StepTimes* times) noexcept {
  assert(cycle_ != nullptr && "start() comes first");
  if (!input.velocity_W.translation.allFinite() || !input.velocity_W.rotation.allFinite()) {
    return refuse(Status::kNotFinite, state_, report);
  }
  Pose H_WM = input.H_WM;
  if (const Status status = make_unit(H_WM); status != Status::kOk) return refuse(status, state_, report);
  const CycleInput cycle_input{H_WM * H_MB_, input.velocity_W};
  State next = state_;
  if (!next.started) {
    next.H_WS = cycle_input.H_WD;
    next.inside = smallest_distance(scene_->voxelmap, scene_->pointshell, next.H_WS) < 0.0;
  }
  const Status status = cycle_(*scene_, parameters_, cycle_input, search_, next, workspace_, report, times);
  if (status != Status::kOk) return refuse(status, state_, report);
  state_ = next;
  return Status::kOk;
}

}  // namespace godobject
