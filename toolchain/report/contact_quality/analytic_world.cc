#include <memory>
#include <vector>

#include "core/pipeline/penalty/penalty_contacts.h"
#include "core/pipeline/session.h"
#include "toolchain/report/contact_quality/world.h"

namespace godobject::report {
namespace {

using Field = analytic::AnalyticField;
using FieldSession = Session<Field, NoBodyField>;

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

  /// One direction: the still body has no feature points here.
  Cycle start(Solver solver, bool friction) const override {
    struct Running {
      std::vector<std::uint32_t> words;
      FieldSession session;
    };
    const Pointshell& shell = body_.scene().pointshell;
    auto running = std::make_shared<Running>();
    running->words.resize(FieldSession::search_words(shell, {}));
    running->session.start(field_, shell, {}, q_, solver, friction, running->words);
    return [running](const Pose& H_WD, CycleReport& report, StepTimes& times) {
      CycleInput input;
      input.H_WD = H_WD;
      return running->session.update(input, report, &times);
    };
  }

  double distance(const Vector3& p_W) const override { return solid_.distance(p_W); }
  void pieces(const Vector3& p_W, std::vector<analytic::Piece>& out) const override { solid_.pieces(p_W, out); }
  double depth(const Pose& H_WS) const override { return -smallest_distance(field_, body_.scene().pointshell, H_WS); }
  double true_depth(const Pose& H_WS) const override { return depth(H_WS); }
  const Pose& H_MB() const override { return body_.scene().H_MB; }
  const std::vector<Vector3>& points_B() const override { return points_; }

 private:
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
