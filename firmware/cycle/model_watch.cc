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
    : arm_(arm), observer_(kBandwidth, period), torque_cycles_(cycles_in(1e-3 * kTorque_ms, period, 2)) {}

void ModelWatch::reset() noexcept {
  observer_.reset();
  pushed_joint_ = -1;
  is_weight_ = drifts_ = drifting_ = false;
  lowest_.setZero();
  highest_.setZero();
  wrong_.fill(0);
  wrong_torque_joint_ = -1;
}

void ModelWatch::update(const ArmKinematics& kinematics, const JointVector& qd, const hal::JointReading& reading,
                        const JointVector& sent, bool free) noexcept {
  observer_.update(arm_, kinematics, qd, sent);
  pushed_joint_ = -1;
  for (int i = 0; i < arm_.joint_count; ++i) {
    const double bound = kPush * arm_.joints[static_cast<std::size_t>(i)].torque;
    if (std::abs(external_torque()[i]) > bound) pushed_joint_ = i;
  }
  find_weight(kinematics);
  follow_drift(kinematics, qd, free);
  compare_torques(reading, sent);
}

/// Wrong masses: a load at the tool, or all weights wrong by one factor.
void ModelWatch::find_weight(const ArmKinematics& kinematics) noexcept {
  JointVector load = JointVector::Zero();  // torques of a kilogram at the tool
  const Vector3 p_R = kinematics.H_RM * arm_.payload.com;
  for (int i = 0; i < arm_.joint_count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    load[i] = kinematics.axis_R[k].dot((p_R - kinematics.H_RL[k].translation).cross(arm_.gravity_R));
  }
  const JointVector& r = external_torque();
  const double size = r.norm();
  is_weight_ = size > 0.0 && size >= kLeastLoad * load.norm() &&
               without(r, load, gravity_torque(arm_, kinematics)).norm() <= kUnexplained * size;
}

void ModelWatch::follow_drift(const ArmKinematics& kinematics, const JointVector& qd, bool free) noexcept {
  const double size = external_torque().norm();
  const bool pushes = free && is_weight_ && external_torque().dot(qd) > 0.0;
  const bool goes_on = drifting_ && pushes && std::abs(size - steady_) <= kSteady * steady_;
  if (!goes_on) {
    drifting_ = pushes;
    steady_ = size;
    begin_R_ = kinematics.H_RM.translation;
  }
  drifts_ = goes_on && (kinematics.H_RM.translation - begin_R_).norm() > kDrift;
}

/// Torques lately sent: the range forgets slowly, so that a drive may answer some cycles late.
void ModelWatch::compare_torques(const hal::JointReading& reading, const JointVector& sent) noexcept {
  wrong_torque_joint_ = -1;
  const double forget = 2.0 / torque_cycles_;
  for (int i = 0; i < arm_.joint_count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    lowest_[i] = std::min(sent[i], lowest_[i] + forget * (sent[i] - lowest_[i]));
    highest_[i] = std::max(sent[i], highest_[i] + forget * (sent[i] - highest_[i]));
    const double error = kTorqueError * arm_.joints[k].torque;
    const bool wrong = reading.torque[i] < lowest_[i] - error || reading.torque[i] > highest_[i] + error;
    wrong_[k] = wrong ? wrong_[k] + 1 : 0;
    if (wrong_[k] >= torque_cycles_) wrong_torque_joint_ = i;
  }
}

}  // namespace godobject::firmware
