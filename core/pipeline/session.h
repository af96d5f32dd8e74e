#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "core/pipeline/contact/ball_cycle.h"
#include "core/pipeline/contact/contact_cycle.h"
#include "core/pipeline/contact/contact_memory.h"
#include "core/pipeline/contact/contact_scene.h"
#include "core/pipeline/contact/substep_path.h"
#include "core/pipeline/corrected/corrected_cycle.h"
#include "core/pipeline/cycle/parameters.h"
#include "core/pipeline/cycle/scene_traits.h"
#include "core/pipeline/cycle/state.h"
#include "core/pipeline/cycle/work.h"
#include "core/pipeline/paper/paper_cycle.h"
#include "core/pipeline/penalty/penalty_contacts.h"
#include "godobject/report.h"
#include "godobject/scene.h"
#include "godobject/status.h"

namespace godobject {

/// One solver on one pair of bodies: the constants of the session, the state carried from cycle to cycle, and the
/// workspace. `Field` is the still body's field (a Voxelmap, or an analytic world), `BodyField` the moving body's.
/// Poses are those of the body frame B. Put it into static storage or on the heap: its size is most of a mebibyte.
template <DistanceField Field, DistanceField BodyField>
class Session {
 public:
  Session() = default;
  Session(const Session&) = delete;  // the scene of `contact` refers to the parameters
  Session& operator=(const Session&) = delete;

  /// Returns the size of the memory for the search of `contact` [32-bit words].
  static std::size_t search_words(const Pointshell& shell, const Pointshell& features) noexcept {
    return kHasSearch ? ContactSearch::memory(shell, features) : 0;
  }

  /// Starts the session from the beginning, with a solver that this build has (missing_part). All references must
  /// outlive the session. `words`: at least search_words(...) of them, for this session alone. With none `contact`
  /// visits the sphere trees from their roots in every cycle and looks all near points up. A god object at rest then
  /// has the same pose, but one in motion may be some micrometres elsewhere.
  void start(const Field& field, const Pointshell& shell, const FeatureContacts<BodyField>& features,
             const Parameters& parameters, Solver solver, bool friction, std::span<std::uint32_t> words,
             const EdgeContacts& edges = {}) noexcept {
    field_ = &field;
    shell_ = &shell;
    parameters_ = parameters;
    cycle_ = cycle_of(solver, friction);
    searches_ = solver == Solver::kContact;
    contact_scene_ = {field, shell, features, parameters_, edges};
    if constexpr (kHasSearch) contact_.search.start(contact_scene_, words);
    reset();
  }

  /// Starts the session from the beginning, with `contact` for a ball without friction (is_ball).
  void start_ball(const Field& field, const Pointshell& shell, const Parameters& parameters) noexcept {
    static_assert(std::is_same_v<Field, Voxelmap>);
    field_ = &field;
    shell_ = &shell;
    parameters_ = parameters;
    cycle_ = &run_ball;
    searches_ = false;
    contact_scene_ = {field, shell, {}, parameters_};
    reset();
  }

  /// Forgets the god object: the next update starts with it at the device pose.
  void reset() noexcept {
    state_ = ProxyState{};
    projection_ = ProjectionState{};
    contact_.reset();
  }

  /// Forgets the god object and moves it to a pose without a look-up.
  void place(const Pose& H_WS) noexcept {
    reset();
    state_.H_WS = H_WS;
  }

  /// Runs one cycle, steps #1-#7. The first cycle begins with the god object at the device pose and tests whether it
  /// penetrates. Statuses as those of `commit`; if not kOk, the carried state is unchanged. Real-time safe.
  Status update(const CycleInput& input, CycleReport& report, StepTimes* times = nullptr) noexcept {
    if (state_.started) return cycle_(*this, input, state_, report, times);
    ProxyState first;
    first.H_WS = input.H_WD;
    // `contact` finds that out by its own search, which the budget of work bounds
    first.inside = !searches_ && smallest_distance(*field_, *shell_, first.H_WS) < 0.0;
    const Status status = cycle_(*this, input, first, report, times);
    if (status == Status::kOk) state_ = first;
    return status;
  }

  const Parameters& parameters() const noexcept { return parameters_; }
  const ProxyState& state() const noexcept { return state_; }
  /// Returns the sub-steps of the last cycle of `contact`; other solvers leave it as it is.
  const SubstepPath& path() const noexcept { return contact_.path; }
  /// Returns the work of the last cycle of `contact`; other solvers leave it as it is.
  const WorkMeter& work() const noexcept { return contact_.work; }
  /// Sets Parameters::work_budget from the next cycle on. Real-time safe.
  void set_work_budget(std::uint64_t units) noexcept { parameters_.work_budget = units; }
  const ContactScene<Field, BodyField>& contact_scene() const noexcept { return contact_scene_; }

 private:
  static constexpr bool kHasSearch = kSceneTraits.contact && kSceneTraits.points;
  /// The part of ContactMemory that a build for a ball alone keeps.
  struct BallMemory {
    SubstepPath path;
    WorkMeter work;
    void reset() noexcept { path.clear(); }
  };
  using Cycle = Status (*)(Session&, const CycleInput&, ProxyState&, CycleReport&, StepTimes*) noexcept;

  template <bool kFriction>
  static Status run_paper(Session& s, const CycleInput& input, ProxyState& state, CycleReport& report,
                          StepTimes* times) noexcept {
    return paper_cycle<kFriction>(*s.field_, *s.shell_, s.parameters_, input, state, report, times);
  }
  template <bool kFriction>
  static Status run_corrected(Session& s, const CycleInput& input, ProxyState& state, CycleReport& report,
                              StepTimes* times) noexcept {
    return corrected_cycle<kFriction>(*s.field_, *s.shell_, s.parameters_, input, s.projection_, state, report, times);
  }
  template <bool kFriction>
  static Status run_contact(Session& s, const CycleInput& input, ProxyState& state, CycleReport& report,
                            StepTimes* times) noexcept {
    return contact_cycle<kFriction>(s.contact_scene_, input, s.contact_, state, report, times);
  }
  static Status run_ball(Session& s, const CycleInput& input, ProxyState& state, CycleReport& report,
                         StepTimes* times) noexcept {
    return ball_cycle(*s.field_, s.parameters_, s.contact_scene_.lengths, input, s.contact_.path, s.contact_.work,
                      state, report, times);
  }

  template <bool kFriction>
  static Cycle cycle_of(Solver solver) noexcept {
    switch (solver) {
      case Solver::kPaper:
        if constexpr (kSceneTraits.paper) return &run_paper<kFriction>;
        break;
      case Solver::kCorrected:
        if constexpr (kSceneTraits.corrected) return &run_corrected<kFriction>;
        break;
      case Solver::kContact:
        if constexpr (kHasSearch) return &run_contact<kFriction>;
        break;
    }
    return nullptr;
  }
  static Cycle cycle_of(Solver solver, bool friction) noexcept {
    if constexpr (kSceneTraits.friction) {
      if (friction) return cycle_of<true>(solver);
    }
    return cycle_of<false>(solver);
  }

  // constants
  const Field* field_ = nullptr;
  const Pointshell* shell_ = nullptr;
  Parameters parameters_;
  Cycle cycle_ = nullptr;
  bool searches_ = false;  // the cycle finds out itself whether the first pose penetrates
  ContactScene<Field, BodyField> contact_scene_;

  // carried from cycle to cycle
  ProxyState state_;
  ProjectionState projection_;
  std::conditional_t<kHasSearch, ContactMemory, BallMemory> contact_;
};

}  // namespace godobject
