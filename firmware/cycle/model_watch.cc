#include "firmware/cycle/model_watch.h"

#include <algorithm>
#include <cmath>

namespace godobject::firmware {
namespace {

/// Returns the part of r that combinations of a and b do not explain (least squares).
JointVector without(const JointVector& r, const JointVector& a, const JointVector& b) noexcept {
  constexpr double kParallel = 1e-6;  // of the product of the squares
  const double aa = a.squaredNorm();
  const double bb = b.squaredNorm();
  const double ab = a.dot(b);
  const double determinant = aa * bb - ab * ab;
  if (determinant <= kParallel * aa * bb) return aa > 0.0 ? JointVector(r - r.dot(a) / aa * a) : r;
  const double of_a = (bb * r.dot(a) - ab * r.dot(b)) / determinant;
  const double of_b = (aa * r.dot(b) - ab * r.dot(a)) / determinant;
  return r - of_a * a - of_b * b;
}

}  // namespace

ModelWatch::ModelWatch(const ArmModel& arm, double period) noexcept
    : arm_(arm),
      observer_(kBandwidth, period),
      torque_cycles_(cycles_in(1e-3 * kTorque_ms, period, kTorqueCycles)),
      drift_cycles_(cycles_in(1e-3 * kDrift_ms, period)),
      early_drift_cycles_(cycles_in(1e-3 * kEarlyDrift_ms, period)),
      settle_cycles_(cycles_in(1e-3 * kSettle_ms, period)) {}

void ModelWatch::reset() noexcept {
  observer_.reset();
  drifts_ = drifts_early_ = drifting_ = false;
  to_settle_ = 0;
  lowest_.setZero();
  highest_.setZero();
  wrong_.fill(0);
  wrong_torque_joint_ = -1;
}

void ModelWatch::update(const ArmKinematics& kinematics, const JointVector& qd, const hal::JointReading& reading,
                        const JointVector& sent, bool free, std::uint32_t periods) noexcept {
  observer_.update(arm_, kinematics, qd, sent, periods);
  follow_drift(kinematics, qd, free, periods);
  compare_torques(reading, sent);
}

/// True if the external torque is that of wrong masses: a load at the tool, or all weights wrong by one factor.
bool ModelWatch::is_weight(const ArmKinematics& kinematics) const noexcept {
  JointVector load = JointVector::Zero();  // torques of a kilogram at the tool
  const Vector3 p_R = kinematics.H_RM * arm_.payload.com;
  for (int i = 0; i < arm_.joint_count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    load[i] = kinematics.axis_R[k].dot((p_R - kinematics.H_RL[k].translation).cross(arm_.gravity_R));
  }
  const JointVector& r = external_torque();
  const double size = r.norm();
  return size > 0.0 && size >= kLeastLoad * load.norm() &&
         without(r, load, gravity_torque(arm_, kinematics)).norm() <= kUnexplained * size;
}

void ModelWatch::follow_drift(const ArmKinematics& kinematics, const JointVector& qd, bool free,
                              std::uint32_t periods) noexcept {
  cycles_ += periods;
  if (periods > 1) to_settle_ = settle_cycles_;
  if (to_settle_ > 0) {  // the drift neither ends nor begins
    --to_settle_;
    drifts_ = drifts_early_ = false;
    return;
  }
  const double size = external_torque().norm();
  const bool pushes = free && external_torque().dot(qd) > 0.0 && is_weight(kinematics);
  const bool goes_on = drifting_ && pushes && std::abs(size - steady_) <= kSteady * steady_;
  if (!goes_on) {
    drifting_ = pushes;
    cycles_ = 0;
    steady_ = size;
    begin_R_ = kinematics.H_RM.translation;
  }
  const double way = goes_on ? (kinematics.H_RM.translation - begin_R_).norm() : 0.0;
  drifts_ = way > kDrift && cycles_ >= drift_cycles_;
  drifts_early_ = way > kEarlyDrift && cycles_ >= early_drift_cycles_;
}

/// Torques lately sent: the range forgets slowly, so that a drive may answer some cycles late.
void ModelWatch::compare_torques(const hal::JointReading& reading, const JointVector& sent) noexcept {
  wrong_torque_joint_ = -1;
  const double forget = 2.0 / torque_cycles_;
  for (int i = 0; i < arm_.joint_count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    lowest_[i] = std::min(sent[i], lowest_[i] + forget * (sent[i] - lowest_[i]));
    highest_[i] = std::max(sent[i], highest_[i] + forget * (sent[i] - highest_[i]));
    if (reading.limited[k] || reading.age[k] > 0) continue;
    const double error = kTorqueError * arm_.joints[k].torque;
    const bool wrong = reading.torque[i] < lowest_[i] - error || reading.torque[i] > highest_[i] + error;
    wrong_[k] = wrong ? wrong_[k] + 1 : 0;
    if (wrong_[k] >= torque_cycles_) wrong_torque_joint_ = i;
  }
}

}  // namespace godobject::firmware
