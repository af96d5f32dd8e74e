// The formula in joint_torque.h, computed joint by joint with a singular value decomposition, against joint_torque.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/device/dynamics.h"
#include "core/device/joint_torque.h"
#include "tests/support/arms.h"
#include "tests/support/decompositions.h"

namespace godobject {
namespace {

using test::Arm;
using test::Random;

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix7 = Eigen::Matrix<double, 7, 7>;

/// 0 up to `none`, 1 from `full` on, and between them the polynomial of third degree with level ends.
double rise(double none, double full, double s) {
  if (s <= none) return 0.0;
  if (s >= full) return 1.0;
  const double t = (s - none) / (full - none);
  return 3.0 * t * t - 2.0 * t * t * t;
}

/// The torque that each joint has left in both directions.
struct Left {
  int joint_count = 0;
  JointVector up = JointVector::Zero();
  JointVector down = JointVector::Zero();

  /// Returns the largest factor up to 1 that keeps a torque within this share of the room.
  double factor(const JointVector& torque, double share) const {
    double factor = 1.0;
    for (int i = 0; i < joint_count; ++i) {
      if (torque[i] > share * up[i]) factor = std::min(factor, share * up[i] / torque[i]);
      if (-torque[i] > share * down[i]) factor = std::min(factor, share * down[i] / -torque[i]);
    }
    return factor;
  }
};

struct Expected {
  JointVector torque = JointVector::Zero();
  JointVector gravity = JointVector::Zero();
  Vector6 rendered = Vector6::Zero();  // force, torque
  double scale = 1.0;
  double left_out = 0.0;
  bool gravity_clipped = false;
  bool is_faded = false;     // a spring took room from the wrench
  bool is_singular = false;  // a direction is rendered in part
};

struct Springs {
  JointVector torque = JointVector::Zero();
  JointVector down_share = JointVector::Ones();
  JointVector up_share = JointVector::Ones();
};

Springs springs_of(const Arm& arm, const TorqueRequest& request) {
  const JointTorqueParameters& p = arm.parameters;
  Springs springs;
  for (int i = 0; i < arm.model.joint_count; ++i) {
    const ArmJoint& joint = arm.model.joints.at(static_cast<std::size_t>(i));
    const double begin_down = joint.lower + p.limit_band;
    const double begin_up = joint.upper - p.limit_band;
    if (request.q[i] < begin_down) {
      const double t = std::min(1.0, (begin_down - request.q[i]) / p.limit_band);
      const double speed = request.qd[i] < 0.0 ? -request.qd[i] : 0.0;
      springs.torque[i] += p.limit_stiffness[i] * (begin_down - request.q[i]) + p.limit_damping[i] * t * speed;
      springs.down_share[i] = 1.0 - t;
    }
    if (request.q[i] > begin_up) {
      const double t = std::min(1.0, (request.q[i] - begin_up) / p.limit_band);
      const double speed = request.qd[i] > 0.0 ? request.qd[i] : 0.0;
      springs.torque[i] -= p.limit_stiffness[i] * (request.q[i] - begin_up) + p.limit_damping[i] * t * speed;
      springs.up_share[i] = 1.0 - t;
    }
  }
  return springs;
}

Expected expected(const Arm& arm, const TorqueRequest& request) {
  const int n = arm.model.joint_count;
  const JointTorqueParameters& p = arm.parameters;
  Expected out;
  Left left;
  left.joint_count = n;
  const auto add = [&](const JointVector& torque) {
    out.torque += torque;
    left.up -= torque;
    left.down += torque;
  };

  // gravity, as far as the joints can hold it
  const JointVector gravity = gravity_torque(arm.model, request.kinematics);
  for (int i = 0; i < n; ++i) {
    const double limit = arm.model.joints.at(static_cast<std::size_t>(i)).torque;
    left.up[i] = left.down[i] = limit;
    out.gravity[i] = std::clamp(gravity[i], -limit, limit);
    out.gravity_clipped = out.gravity_clipped || std::fabs(gravity[i]) > limit;
  }
  add(out.gravity);

  // springs: at most nine tenths of what is left
  const Springs springs = springs_of(arm, request);
  JointVector sprung;
  for (int i = 0; i < kMaxJoints; ++i) sprung[i] = std::clamp(springs.torque[i], -0.9 * left.down[i], 0.9 * left.up[i]);
  add(sprung);

  // -P D P qd
  Eigen::MatrixXd ZJ = geometric_jacobian(request.kinematics, request.p_RP);
  ZJ.bottomRows(3) *= p.rotation_length;
  const test::SingularValues svd = test::singular_values_of(ZJ);
  Vector6 f;
  for (int i = 0; i < 6; ++i) {
    f[i] = rise(p.singular_none, p.singular_full, svd.values[i]);
    out.is_singular = out.is_singular || (f[i] > 0.0 && f[i] < 1.0);
  }
  const Matrix7 P = Matrix7::Identity() - svd.V * f.asDiagonal() * svd.V.transpose();
  JointVector qd = JointVector::Zero();
  qd.head(n) = request.qd.head(n);
  const JointVector damping = -P * p.null_damping.asDiagonal() * P * qd;
  add(left.factor(damping, 0.9) * damping);

  // F' = Z U f U^T Z^-1 F
  Vector6 Z;
  Z << 1.0, 1.0, 1.0, p.rotation_length, p.rotation_length, p.rotation_length;
  Vector6 F;
  F << request.F_P_R.force, request.F_P_R.torque;
  const Vector6 wanted = F.cwiseQuotient(Z);
  const Vector6 shown = svd.U * f.asDiagonal() * svd.U.transpose() * wanted;
  const JointVector rendered = ZJ.transpose() * shown;
  const double within = left.factor(rendered, 1.0);
  Left reduced = left;
  for (int i = 0; i < n; ++i) {
    const double most = within * shown.norm() * ZJ.col(i).norm();  // over all directions of the wrench
    const auto fade = [&](double share, double spring, double& room) {
      if (share == 1.0) return;
      const double faded = std::max(share * std::min(most, room), 0.9 * std::max(0.0, spring));
      out.is_faded = out.is_faded || faded < room;
      room = std::min(room, faded);
    };
    fade(springs.down_share[i], sprung[i], reduced.down[i]);
    fade(springs.up_share[i], -sprung[i], reduced.up[i]);
  }
  out.scale = std::min(within, reduced.factor(rendered, 1.0));
  add(out.scale * rendered);
  out.rendered = out.scale * shown.cwiseProduct(Z);
  out.left_out = wanted.norm() > 0.0 ? (wanted - shown).norm() / wanted.norm() : 0.0;
  return out;
}

/// Returns a random arm, request and parameters. Now and then a joint is too weak, or near or beyond a limit.
Arm draw(Random& random, int joint_count, TorqueRequest& request) {
  Arm arm = test::random_arm(random, joint_count);
  JointTorqueParameters& p = arm.parameters;
  p.rotation_length = random.between(0.05, 0.5);
  p.singular_none = random.between(0.001, 0.05);
  p.singular_full = p.singular_none + random.between(0.01, 0.2);
  p.limit_band = random.between(0.02, 0.4);
  request = {};
  for (int i = 0; i < joint_count; ++i) {
    ArmJoint& joint = arm.model.joints.at(static_cast<std::size_t>(i));
    const int place = random.integer(0, 9);
    const double depth = random.between(-0.5, 1.5) * p.limit_band;
    request.q[i] = place == 0   ? joint.lower + depth
                   : place == 1 ? joint.upper - depth
                                : random.between(joint.lower + p.limit_band, joint.upper - p.limit_band);
    if (random.integer(0, 3) > 0) joint.torque *= 10.0;
    request.qd[i] = random.between(-3.0, 3.0);
  }
  request.kinematics = forward_kinematics(arm.model, request.q);
  request.p_RP = request.kinematics.H_RM.translation + random.in_cube(0.1);
  const double size = std::pow(10.0, random.between(-1.0, 3.0));
  request.F_P_R = {random.in_cube(size), random.in_cube(0.2 * size)};
  if (random.integer(0, 9) == 0) request.F_P_R = {};
  return arm;
}

TEST(JointTorque, IsTheFormulaForAnyArmAndRequest) {
  Random random(1);
  int clipped = 0;
  int faded = 0;
  int singular = 0;
  int scaled = 0;
  for (int i = 0; i < 8000; ++i) {
    TorqueRequest request;
    const Arm arm = draw(random, 1 + i % kMaxJoints, request);
    ASSERT_EQ(validate(arm.parameters, arm.model), Status::kOk) << i;
    const Expected wanted = expected(arm, request);
    JointTorque got;
    ASSERT_EQ(joint_torque(arm.model, arm.parameters, request, got), Status::kOk) << i;
    clipped += wanted.gravity_clipped ? 1 : 0;
    faded += wanted.is_faded ? 1 : 0;
    singular += wanted.is_singular ? 1 : 0;
    scaled += wanted.scale < 1.0 ? 1 : 0;
    // torques are at most some thousand Nm; the squares of small singular values lose half of the digits
    ASSERT_LT((got.torque - wanted.torque).norm(), 1e-8) << i;
    ASSERT_EQ(got.gravity, wanted.gravity) << i;
    ASSERT_EQ(got.gravity_clipped, wanted.gravity_clipped) << i;
    Vector6 rendered;
    rendered << got.rendered_P_R.force, got.rendered_P_R.torque;
    ASSERT_LT((rendered - wanted.rendered).norm(), 1e-8) << i;
    ASSERT_NEAR(got.scale, wanted.scale, 1e-10) << i;
    ASSERT_NEAR(got.left_out, wanted.left_out, 1e-10) << i;
  }
  // each case has to occur often
  EXPECT_GT(clipped, 500);
  EXPECT_GT(faded, 200);
  EXPECT_GT(singular, 2000);
  EXPECT_GT(scaled, 500);
}

/// A number beyond the arm's joints does not count: drives that the arm lacks.
TEST(JointTorque, DoesNotLookAtJointsThatTheArmLacks) {
  Random random(2);
  for (int n = 1; n < kMaxJoints; ++n) {
    TorqueRequest request;
    Arm arm = draw(random, n, request);
    JointTorque expected_torque;
    ASSERT_EQ(joint_torque(arm.model, arm.parameters, request, expected_torque), Status::kOk);
    for (int i = n; i < kMaxJoints; ++i) {
      request.q[i] = 7.0;
      request.qd[i] = -5.0;
      arm.parameters.null_damping[i] = arm.parameters.limit_damping[i] = arm.parameters.limit_stiffness[i] = 3.0;
      arm.model.joints.at(static_cast<std::size_t>(i)).torque = 10.0;
    }
    JointTorque got;
    ASSERT_EQ(joint_torque(arm.model, arm.parameters, request, got), Status::kOk);
    EXPECT_EQ(got.torque, expected_torque.torque) << n;
    for (int i = n; i < kMaxJoints; ++i) request.q[i] = request.qd[i] = std::nan("");
    ASSERT_EQ(joint_torque(arm.model, arm.parameters, request, got), Status::kOk);
    EXPECT_EQ(got.torque, expected_torque.torque) << n;
  }
}

}  // namespace
}  // namespace godobject
