#include "core/pipeline/god_object.h"

#include <cassert>

#include "core/pipeline/contact/ball_cycle.h"
#include "core/pipeline/cycle/workspace_limit.h"

namespace godobject {
namespace {

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

/// The moving body's field in a build without the second direction. Known in this file only: so the compiler sees that
/// there is none, and drops what would look at it.
struct NoField : Voxelmap {};

template <class Memory>
Status cycle_of_ball(const Scene& scene, const Parameters& q, const CycleInput& input, Memory&, State& state,
                     CycleReport& report, StepTimes* times) noexcept {
  return ball_cycle(scene.voxelmap, q, input, state, report, times);
}

}  // namespace

/// The pipelines, all with one signature, with and without friction.
struct GodObject::Paper {
  template <bool kFriction>
  static Status cycle(const Scene& scene, const Parameters& q, const CycleInput& input, Memory&, State& state,
                      CycleReport& report, StepTimes* times) noexcept {
    return paper_cycle<kFriction>(scene.voxelmap, scene.pointshell, q, input, state, report, times);
  }
};

struct GodObject::Corrected {
  template <bool kFriction>
  static Status cycle(const Scene& scene, const Parameters& q, const CycleInput& input, Memory&, State& state,
                      CycleReport& report, StepTimes* times) noexcept {
    return corrected_cycle<kFriction>(scene.voxelmap, scene.pointshell, q, input, state, report, times);
  }
};

struct GodObject::Contact {
  using BodyField = std::conditional_t<kSceneTraits.features, Voxelmap, NoField>;

  /// Calls `work` with the second direction, or null where there is none.
  template <class Work>
  static auto with_features(const Scene& scene, const Parameters& q, Work&& work) noexcept {
    using Features = FeatureContacts<BodyField>;
    if constexpr (kSceneTraits.features) {
      const Features features{scene.body_map, scene.features, scene.features_origin,
                              scene.body_map.surface_radius(q.mass.sphere.center)};
      return work(scene.has_features() ? &features : nullptr);
    } else {
      return work(static_cast<const Features*>(nullptr));
    }
  }

  template <bool kFriction>
  static Status cycle(const Scene& scene, const Parameters& q, const CycleInput& input, ContactMemory& memory,
                      State& state, CycleReport& report, StepTimes* times) noexcept {
    return with_features(scene, q, [&](const auto* features) noexcept {
      return contact_cycle<kFriction>(scene.voxelmap, scene.pointshell, features, q, input, memory.search, state,
                                      memory.workspace, report, times);
    });
  }

  static void start(const Scene&, const Parameters&, std::span<std::uint32_t>, NoMemory&) noexcept {}

  static void start(const Scene& scene, const Parameters& q, std::span<std::uint32_t> words,
                    ContactMemory& memory) noexcept {
    with_features(scene, q, [&](const auto* features) noexcept {
      memory.search.start(scene.voxelmap, scene.pointshell, features, ContactLengths::make(q), words);
    });
  }
};

template <class Pipeline>
GodObject::Cycle GodObject::cycle_of(bool friction) noexcept {
  if constexpr (kSceneTraits.friction) {
    if (friction) return &Pipeline::template cycle<true>;
  }
  return &Pipeline::template cycle<false>;
}

GodObject::Cycle GodObject::cycle_of(Solver solver, bool friction) noexcept {
  switch (solver) {
    case Solver::kPaper:
      if constexpr (kSceneTraits.paper) return cycle_of<Paper>(friction);
      break;
    case Solver::kCorrected:
      if constexpr (kSceneTraits.corrected) return cycle_of<Corrected>(friction);
      break;
    case Solver::kContact:
      if constexpr (kHasSearch) return cycle_of<Contact>(friction);
      break;
  }
  return nullptr;
}

Status GodObject::start(const Scene& scene, Solver solver, bool friction, std::span<std::uint32_t> memory) noexcept {
  if (!scene.holds(solver) || (friction && scene.settings.friction == 0)) return Status::kNotInImage;
  if (missing_part(scene, solver, friction) != Part::kNone) return Status::kNotInBuild;
  cycle_ = cycle_of(solver, friction);
  scene_ = &scene;
  H_MB_ = scene.H_MB;
  H_BM_ = scene.H_MB.inverse();
  parameters_ = Parameters::make(scene);
  if constexpr (kSceneTraits.contact) {
    if (solver == Solver::kContact && !friction && is_ball(scene)) cycle_ = &cycle_of_ball<Memory>;
  }
  if (solver == Solver::kContact) {
    const std::size_t wanted = GodObject::memory(scene);
    Contact::start(scene, parameters_, memory.first(memory.size() < wanted ? 0 : wanted), memory_);
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
  CycleInput cycle_input{H_WM * H_MB_, input.velocity_W};
  if (parameters_.workspace.limited) {
    const Vector3 device = cycle_input.H_WD.translation;
    cycle_input.H_WD.translation = parameters_.workspace.nearest(device);
    const Vector3 back_W = cycle_input.H_WD.translation - device;
    if (!back_W.isZero(0.0)) {
      if (state_.started) return run_pushed(cycle_input, back_W, report, times);
      const Status status = follow(H_WM, report);
      report.outside = status == Status::kOk;
      return status;
    }
  }
  return run(cycle_input, report, times);
}

/// The device's origin is in the workspace.
Status GodObject::run(const CycleInput& input, CycleReport& report, StepTimes* times) noexcept {
  const Pose held = state_.H_WS;
  if (!state_.started) {
    state_.H_WS = input.H_WD;
    state_.inside = smallest_distance(scene_->voxelmap, scene_->pointshell, state_.H_WS) < 0.0;
  }
  const Status status = cycle_(*scene_, parameters_, input, memory_, state_, report, times);
  if (status != Status::kOk) {
    state_.H_WS = held;
    return refuse(status, state_, report);
  }
  report.outside = false;
  return Status::kOk;
}

/// It was moved there by `back_W`, of which the push is the coupling's share: the spring is linear in translations.
Status GodObject::run_pushed(const CycleInput& input, const Vector3& back_W, CycleReport& report,
                             StepTimes* times) noexcept {
  const DeviceForce push = workspace_push(back_W, input.velocity_W.translation, parameters_);
  const State before = state_;
  if (const Status status = run(input, report, times); status != Status::kOk) return status;
  report.force.spring_W.force += push.spring_W.force;
  report.force.total_W.force += push.total_W.force;
  report.outside = true;
  if (report.force.spring_W.force.allFinite() && report.force.total_W.force.allFinite()) return Status::kOk;
  state_ = before;
  return refuse(Status::kNotFinite, state_, report);
}

}  // namespace godobject
