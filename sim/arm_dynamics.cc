#include "sim/arm_dynamics.h"

#include <cassert>
#include <cmath>

#include "sim/index.h"

namespace godobject::sim {
namespace {

/// Inertia of a point mass at `r`, about the origin.
Matrix3 point_inertia(double mass, const Vector3& r) noexcept {
  return mass * (r.squaredNorm() * Matrix3::Identity() - r * r.transpose());
}

/// Inertia of a body about A, on the axes of R: R_RL inertia R_RL^T + point_inertia(mass, com_R), at half the cost
/// since both are symmetric. `com_R`: from A to the centre of mass.
void set_inertia(const Matrix3& R_RL, const LinkMass& body, const Vector3& com_R, Matrix3& inertia_R) noexcept {
  const Matrix3 turned = R_RL * body.inertia;
  const Vector3 moment = body.mass * com_R;
  const double trace = moment.dot(com_R);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j <= i; ++j) {
      inertia_R(i, j) = turned.row(i).dot(R_RL.row(j)) - moment[i] * com_R[j] + (i == j ? trace : 0.0);
      inertia_R(j, i) = inertia_R(i, j);
    }
  }
}

/// Two bodies as one. (R_AB, p_AB): pose of b's frame in a's frame.
LinkMass join(const LinkMass& a, const LinkMass& b, const Matrix3& R_AB, const Vector3& p_AB) noexcept {
  LinkMass both;
  both.mass = a.mass + b.mass;
  const Vector3 b_com = p_AB + R_AB * b.com;
  both.com = (a.mass * a.com + b.mass * b_com) / both.mass;
  both.inertia = a.inertia + point_inertia(a.mass, a.com - both.com) + R_AB * b.inertia * R_AB.transpose() +
                 point_inertia(b.mass, b_com - both.com);
  return both;
}

}  // namespace

ArmDynamics::ArmDynamics(const ArmModel& model) noexcept
    : joint_count_(model.joint_count),
      R_RA_(model.H_RA.rotation.normalized().toRotationMatrix()),
      p_RA_(model.H_RA.translation),
      R_FM_(model.H_FM.rotation.normalized().toRotationMatrix()),
      p_FM_(model.H_FM.translation),
      gravity_R_(model.gravity_R) {
  assert(validate(model) == Status::kOk);
  for (int i = 0; i < joint_count_; ++i) {
    const ArmJoint& joint = model.joints[at(i)];
    links_[at(i)] = {joint.a,     joint.d,   joint.offset, std::sin(joint.alpha), std::cos(joint.alpha),
                     joint.rotor, joint.link};
  }
  LinkMass& last = links_[at(joint_count_ - 1)].body;
  last = join(last, model.payload, R_FM_, p_FM_);
}

void ArmDynamics::set_posture(const JointVector& q, ArmPosture& posture) const noexcept {
  // Craig's eq (3.6) by columns: x and y of the link are x of the link before and u, rotated by theta
  Matrix3 R_RL = R_RA_;
  Vector3 p_AL_R = Vector3::Zero();
  for (int i = 0; i < joint_count_; ++i) {
    const Link& link = links_[at(i)];
    const Vector3 x = R_RL.col(0);
    const Vector3 u = link.cos_alpha * R_RL.col(1) + link.sin_alpha * R_RL.col(2);
    const Vector3 z = link.cos_alpha * R_RL.col(2) - link.sin_alpha * R_RL.col(1);
    const double c = std::cos(link.offset + q[i]);
    const double s = std::sin(link.offset + q[i]);
    p_AL_R += link.a * x + link.d * z;
    R_RL.col(0) = c * x + s * u;
    R_RL.col(1) = c * u - s * x;
    R_RL.col(2) = z;
    posture.axis_R[at(i)] = z;
    posture.moment_R[at(i)] = p_AL_R.cross(z);
    const Vector3 com = p_AL_R + R_RL * link.body.com;
    posture.mass_moment_R[at(i)] = link.body.mass * com;
    set_inertia(R_RL, link.body, com, posture.inertia_R[at(i)]);
  }
  posture.R_RM = R_RL * R_FM_;
  posture.p_AM_R = p_AL_R + R_RL * p_FM_;

  posture.mass.setZero();
  double mass = 0.0;
  Vector3 mass_moment = Vector3::Zero();
  Matrix3 inertia = Matrix3::Zero();
  for (int j = joint_count_ - 1; j >= 0; --j) {
    mass += links_[at(j)].body.mass;
    mass_moment += posture.mass_moment_R[at(j)];
    inertia += posture.inertia_R[at(j)];
    // momentum of the bodies beyond joint j at unit speed of joint j
    const Vector3& z = posture.axis_R[at(j)];
    const Vector3& m = posture.moment_R[at(j)];
    const Vector3 linear = mass * m + z.cross(mass_moment);
    const Vector3 angular = inertia * z + mass_moment.cross(m);
    for (int i = 0; i <= j; ++i) {
      const double entry = posture.axis_R[at(i)].dot(angular) + posture.moment_R[at(i)].dot(linear);
      posture.mass(i, j) = entry;
      posture.mass(j, i) = entry;
    }
    posture.mass(j, j) += links_[at(j)].rotor;
  }
}

JointVector ArmDynamics::bias_torque(const ArmPosture& posture, const JointVector& qd) const noexcept {
  // twist of the link and its rate; an upward acceleration of the base replaces gravity
  Vector3 w = Vector3::Zero();
  Vector3 v = Vector3::Zero();
  Vector3 w_rate = Vector3::Zero();
  Vector3 v_rate = -gravity_R_;
  std::array<Vector3, kMaxJoints> force;
  std::array<Vector3, kMaxJoints> torque;
  for (int i = 0; i < joint_count_; ++i) {
    const Vector3 z = qd[i] * posture.axis_R[at(i)];
    const Vector3 m = qd[i] * posture.moment_R[at(i)];
    w_rate += w.cross(z);
    v_rate += w.cross(m) + v.cross(z);
    w += z;
    v += m;
    const double mass = links_[at(i)].body.mass;
    const Vector3& mass_moment = posture.mass_moment_R[at(i)];
    const Matrix3& inertia = posture.inertia_R[at(i)];
    const Vector3 linear = mass * v + w.cross(mass_moment);
    const Vector3 angular = inertia * w + mass_moment.cross(v);
    force[at(i)] = mass * v_rate + w_rate.cross(mass_moment) + w.cross(linear);
    torque[at(i)] = inertia * w_rate + mass_moment.cross(v_rate) + w.cross(angular) + v.cross(linear);
  }
  JointVector bias = JointVector::Zero();
  Vector3 force_sum = Vector3::Zero();
  Vector3 torque_sum = Vector3::Zero();
  for (int i = joint_count_ - 1; i >= 0; --i) {
    force_sum += force[at(i)];
    torque_sum += torque[at(i)];
    bias[i] = posture.axis_R[at(i)].dot(torque_sum) + posture.moment_R[at(i)].dot(force_sum);
  }
  return bias;
}

Pose ArmDynamics::tool_pose(const ArmPosture& posture) const noexcept {
  return {Quaternion(posture.R_RM), p_RA_ + posture.p_AM_R};
}

Motion ArmDynamics::tool_velocity(const ArmPosture& posture, const JointVector& qd) const noexcept {
  Motion velocity;
  for (int i = 0; i < joint_count_; ++i) {
    velocity.rotation += qd[i] * posture.axis_R[at(i)];
    velocity.translation += qd[i] * posture.moment_R[at(i)];
  }
  velocity.translation += velocity.rotation.cross(posture.p_AM_R);
  return velocity;
}

JointVector ArmDynamics::tool_torque(const ArmPosture& posture, const Wrench& F_M_R) const noexcept {
  const Vector3 torque = F_M_R.torque + posture.p_AM_R.cross(F_M_R.force);
  JointVector joints = JointVector::Zero();
  for (int i = 0; i < joint_count_; ++i) {
    joints[i] = posture.axis_R[at(i)].dot(torque) + posture.moment_R[at(i)].dot(F_M_R.force);
  }
  return joints;
}

double ArmDynamics::kinetic_energy(const ArmPosture& posture, const JointVector& qd) const noexcept {
  return 0.5 * qd.dot(posture.mass * qd);
}

double ArmDynamics::potential_energy(const ArmPosture& posture) const noexcept {
  Vector3 mass_moment = Vector3::Zero();
  for (int i = 0; i < joint_count_; ++i) mass_moment += posture.mass_moment_R[at(i)];
  return -gravity_R_.dot(mass_moment);
}

void MovingJoints::factor(const JointMatrix& mass, int joint_count, const std::array<bool, kMaxJoints>& held) noexcept {
  joint_count_ = joint_count;
  held_ = held;
  for (int j = 0; j < joint_count_; ++j) {
    if (held_[at(j)]) {
      lower_.row(j).head(j).setZero();
      inverse_[j] = 0.0;  // makes the column below zero
      continue;
    }
    double pivot = mass(j, j);
    std::array<double, kMaxJoints> scaled;  // row j of L times the diagonal
    for (int k = 0; k < j; ++k) {
      double entry = held_[at(k)] ? 0.0 : mass(j, k);
      for (int l = 0; l < k; ++l) entry -= scaled[at(l)] * lower_(k, l);
      scaled[at(k)] = entry;
      lower_(j, k) = entry * inverse_[k];
      pivot -= entry * lower_(j, k);
    }
    inverse_[j] = 1.0 / pivot;
  }
}

JointVector MovingJoints::solve(const JointVector& b) const noexcept {
  JointVector x = JointVector::Zero();
  for (int i = 0; i < joint_count_; ++i) {
    double sum = held_[at(i)] ? 0.0 : b[i];
    for (int k = 0; k < i; ++k) sum -= lower_(i, k) * x[k];
    x[i] = sum;
  }
  for (int i = joint_count_ - 1; i >= 0; --i) {
    x[i] *= inverse_[i];
    for (int k = i + 1; k < joint_count_; ++k) x[i] -= lower_(k, i) * x[k];
  }
  return x;
}

}  // namespace godobject::sim
