#include "toolchain/report/stability/arm_work.h"

#include <cmath>
#include <deque>

#include "core/device/dynamics.h"
#include "sim/plant.h"

namespace godobject::report {
namespace {

constexpr int kStepsPerPeriod = 10;  // of the plant, in a sampling period
constexpr double kStep = 1e-9 * sim::Plant::kStep_ns;

/// Returns the torque of the coupling's spring, which pulls the tool to `target` [Nm].
JointVector spring_torque(const ArmModel& model, const JointVector& q, const Coupling& coupling, const Pose& target) {
  const ArmKinematics kinematics = forward_kinematics(model, q);
  Eigen::Matrix<double, 6, 1> wrench;
  wrench << -coupling.stiffness * (kinematics.H_RM.translation - target.translation),
      -coupling.rotation_stiffness * log_rotation(kinematics.H_RM.rotation * target.rotation.conjugate());
  return geometric_jacobian(kinematics, kinematics.H_RM.translation).transpose() * wrench;
}

/// A hand that leads all joints: a stiff continuous servo with the arm's inertia as its feedforward.
class LeadingHand {
 public:
  LeadingHand(const ArmModel& model, const JointVector& q, const JointVector& way)
      : mass_(mass_matrix(model, forward_kinematics(model, q))), middle_(q), way_(way) {}

  static constexpr int kPeriod = 500;  ///< of the motion [ms]
  static constexpr double kRate = 2e3 * M_PI / kPeriod;
  static constexpr double kAmplitude = 1e-3;  ///< [rad]; small against the geometry of the arm

  /// Returns the torque [Nm] at `time` [s].
  JointVector torque(double time, const sim::Plant& plant) const {
    constexpr double kServo = 2000.0;  // [1/s]: its natural frequency, far above that of the coupling
    const double angle = kRate * time;
    const JointVector q = middle_ + kAmplitude * std::sin(angle) * way_;
    const JointVector qd = kAmplitude * kRate * std::cos(angle) * way_;
    const JointVector qdd = -kAmplitude * kRate * kRate * std::sin(angle) * way_;
    return mass_ * (qdd + 2.0 * kServo * (qd - plant.velocities()) + kServo * kServo * (q - plant.positions()));
  }

 private:
  JointMatrix mass_;
  JointVector middle_;
  JointVector way_;
};

}  // namespace

double work_along(const ArmModel& model, const JointVector& q, const JointVector& way, const Coupling& coupling,
                  double delay) {
  const Pose target = forward_kinematics(model, q).H_RM;
  const LeadingHand hand(model, q, way);
  sim::Plant plant(model, q);
  plant.set_velocity(LeadingHand::kAmplitude * LeadingHand::kRate * way);
  // torques that have been sampled, one for each step of the plant; the first one acts now
  std::deque<JointVector> waiting(static_cast<std::size_t>(std::lround(delay / kStep)), JointVector::Zero());
  double work = 0.0;
  double square_motion = 0.0;
  JointVector sampled = JointVector::Zero();
  for (int step = 0; step < 2 * LeadingHand::kPeriod * kStepsPerPeriod; ++step) {
    if (step % kStepsPerPeriod == 0) sampled = spring_torque(model, plant.positions(), coupling, target);
    waiting.push_back(sampled);
    const JointVector by_hand = hand.torque(kStep * step, plant);
    const JointVector before = plant.positions();
    plant.step(sim::Plant::kStep_ns, {.motor = waiting.front() + by_hand});
    waiting.pop_front();
    if (step < LeadingHand::kPeriod * kStepsPerPeriod) continue;  // the servo settles
    const JointVector moved = plant.positions() - before;
    work += by_hand.dot(moved);
    square_motion += moved.squaredNorm() / kStep;
  }
  return work / square_motion;
}

}  // namespace godobject::report
