#include <algorithm>

#include "core/pipeline/contact/contact_cycle.h"
#include "core/pipeline/corrected/corrected_cycle.h"
#include "core/pipeline/paper/paper_cycle.h"
#include "core/pipeline/penalty/penalty_contacts.h"
#include "toolchain/report/contact_quality/world.h"

namespace godobject::report {
namespace {

using Field = analytic::AnalyticField<analytic::Solid>;
using ClosedForm = Status (*)(const Field&, const Pointshell&, const Parameters&, const CycleInput&, State&,
                              CycleReport&, StepTimes*) noexcept;
using Contact = Status (*)(const Field&, const Pointshell&, const FeatureContacts<Voxelmap>*, const Parameters&,
                           const CycleInput&, ContactSearch&, State&, ContactWorkspace&, CycleReport&,
                           StepTimes*) noexcept;

class AnalyticWorld : public World {
 public:
  AnalyticWorld(const analytic::Solid& solid, const Body& body, const WorldSettings& settings)
      : solid_(solid), field_(solid, settings.voxel_size), body_(body), points_(report::points_B(body.scene())) {
    q_.voxel_size = settings.voxel_size;
    q_.safety_distance = settings.safety_distance;
    q_.margin = settings.margin;
    q_.stiffness = settings.stiffness;
    q_.coupling_rotation = settings.coupling_rotation;
    q_.friction = {settings.friction_static, settings.friction_kinetic, 0.0};
    q_.paper_friction = {settings.friction_static, settings.friction_kinetic, settings.friction_static,
                         settings.friction_kinetic, 0.0};
    q_.mass = Parameters::make(body.scene()).mass;
  }

  Cycle start(Solver solver, bool friction) const override {
    switch (solver) {
      case Solver::kPaper: return closed_form(friction ? &paper_cycle<true, Field> : &paper_cycle<false, Field>);
      case Solver::kCorrected:
        return closed_form(friction ? &corrected_cycle<true, Field> : &corrected_cycle<false, Field>);
      case Solver::kContact:
        return contact(friction ? &contact_cycle<true, Field, Voxelmap> : &contact_cycle<false, Field, Voxelmap>);
    }
    return {};
  }

  double distance(const Vector3& p_W) const override { return solid_.distance(p_W); }
  void pieces(const Vector3& p_W, std::vector<analytic::Piece>& out) const override { solid_.pieces(p_W, out); }
  double depth(const Pose& H_WS) const override { return -smallest_distance(field_, body_.scene().pointshell, H_WS); }
  double true_depth(const Pose& H_WS) const override { return depth(H_WS); }
  const Pose& H_MB() const override { return body_.scene().H_MB; }
  const std::vector<Vector3>& points_B() const override { return points_; }

 private:
  void begin(State& state, const Pose& H_WD) const {
    if (state.started) return;
    state.H_WS = H_WD;
    state.inside = depth(H_WD) > 0.0;
  }

  Cycle closed_form(ClosedForm cycle) const {
    return [this, cycle, state = State{}](const Pose& H_WD, CycleReport& report, StepTimes& times) mutable {
      begin(state, H_WD);
      return cycle(field_, body_.scene().pointshell, q_, CycleInput{H_WD, {}}, state, report, &times);
    };
  }

  /// Returns a cycle of `contact` with one direction; analytic still bodies have no feature points.
  Cycle contact(Contact cycle) const {
    struct Memory {
      std::vector<std::uint32_t> values;
      ContactSearch search;
      ContactWorkspace workspace;
    };
    const Pointshell& shell = body_.scene().pointshell;
    const FeatureContacts<Voxelmap>* const none = nullptr;
    auto memory = std::make_shared<Memory>();
    memory->values.resize(ContactSearch::memory(shell, {}));
    memory->search.start(field_, shell, none, ContactLengths::make(q_), memory->values);
    return [this, &shell, cycle, memory, state = State{}](const Pose& H_WD, CycleReport& report,
                                                          StepTimes& times) mutable {
      begin(state, H_WD);
      return cycle(field_, shell, nullptr, q_, CycleInput{H_WD, {}}, memory->search, state, memory->workspace, report,
                   &times);
    };
  }

  analytic::Solid solid_;
  Field field_;
  const Body& body_;
  std::vector<Vector3> points_;
  Parameters q_;
};

}  // namespace

std::unique_ptr<World> make_analytic_world(const analytic::Solid& solid, const Body& body,
                                           const WorldSettings& settings) {
  return std::make_unique<AnalyticWorld>(solid, body, settings);
}

}  // namespace godobject::report
