#include "core/device/joint_torque.h"

#include <algorithm>
#include <cmath>

#include "core/device/dynamics.h"
#include "core/device/symmetric_eigen.h"

namespace godobject {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Largest share of the remaining torque that springs and damping take. The rest is left to the wrench, which so fades
/// towards a limit and never jumps to zero. Chosen: every value in 0 .. 1 fades; 0.9 leaves most of the torque to the
/// springs, and the wrench a tenth.
constexpr double kLargestShare = 0.9;

/// 0 up to a, 1 from b on, with continuous slope.
double smooth_step(double a, double b, double x) noexcept {
  const double t = std::clamp((x - a) / (b - a), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

JointVector torque_limits(const ArmModel& model) noexcept {
  JointVector limits = JointVector::Zero();
  for (int i = 0; i < model.joint_count; ++i) limits[i] = model.joints[static_cast<std::size_t>(i)].torque;
  return limits;
}

/// Singular value decomposition of the weighted Jacobian Z J = U S V^T.
struct SingularDirections {
  Jacobian weighted;
  Matrix6 directions;     // U
  Vector6 share;          // f(s)
  Vector6 inverse_share;  // f(s) / s^2
};

bool find_singular_directions(const JointTorqueParameters& parameters, const Jacobian& jacobian,
                              SingularDirections& found) noexcept {
  found.weighted = jacobian;
  found.weighted.bottomRows<3>() *= parameters.rotation_length;
  const Matrix6 gram = found.weighted * found.weighted.transpose();
  if (!gram.allFinite()) return false;
  SymmetricEigen<6> eigen;
  if (!symmetric_eigen<6>(gram, eigen)) return false;
  found.directions = eigen.vectors;
  for (int i = 0; i < 6; ++i) {
    const double squared = std::max(0.0, eigen.values[i]);
    found.share[i] = smooth_step(parameters.singular_none, parameters.singular_full, std::sqrt(squared));
    found.inverse_share[i] = found.share[i] > 0.0 ? found.share[i] / squared : 0.0;
  }
  return true;
}

/// P x: the part of joint motion x that leaves the tool at rest.
JointVector project_on_null_space(const SingularDirections& singular, const JointVector& x) noexcept {
  const Vector6 along = singular.directions.transpose() * (singular.weighted * x);
  return x - singular.weighted.transpose() * (singular.directions * singular.inverse_share.cwiseProduct(along));
}

struct LimitSprings {
  JointVector torque = JointVector::Zero();
  // share of the torque towards the lower and the upper limit: 1 outside the band, 0 at the limit
  JointVector down_share = JointVector::Ones();
  JointVector up_share = JointVector::Ones();
};

LimitSprings limit_springs(const ArmModel& model, const JointTorqueParameters& parameters,
                           const TorqueRequest& request) noexcept {
  LimitSprings springs;
  const double band = parameters.limit_band;
  for (int i = 0; i < model.joint_count; ++i) {
    const ArmJoint& joint = model.joints[static_cast<std::size_t>(i)];
    // torque away from a limit, for the depth in its band and the speed towards it
    const auto push = [&](double depth, double speed, double& share) {
      if (!(depth > 0.0)) return 0.0;
      const double towards_limit = std::min(1.0, depth / band);
      share = 1.0 - towards_limit;
      return parameters.limit_stiffness[i] * depth + parameters.limit_damping[i] * towards_limit * std::max(0.0, speed);
    };
    springs.torque[i] = push(joint.lower + band - request.q[i], -request.qd[i], springs.down_share[i]) -
                        push(request.q[i] - joint.upper + band, request.qd[i], springs.up_share[i]);
  }
  return springs;
}

/// Torque that each joint has left in both directions [Nm].
struct Room {
  JointVector down;
  JointVector up;

  Room(const JointVector& limits, const JointVector& used) noexcept
      : down((limits + used).cwiseMax(0.0)), up((limits - used).cwiseMax(0.0)) {}

  JointVector clip(const JointVector& torque, double share) const noexcept {
    return torque.cwiseMax(-share * down).cwiseMin(share * up);
  }

  /// The largest factor up to 1 with which all of `torque` is within this share of the room.
  double factor(const JointVector& torque, double share) const noexcept {
    double smallest = 1.0;
    for (int i = 0; i < kMaxJoints; ++i) {
      const double room = share * (torque[i] > 0.0 ? up[i] : down[i]);
      if (std::fabs(torque[i]) > room) smallest = std::min(smallest, room / std::fabs(torque[i]));
    }
    return smallest;
  }
};

/// Reduces the room of joints that are near a limit. `springs`: their applied torques. `most`: the largest torque that
/// a wrench of this size could give at each joint, over all directions. The fade is a share of `most` and not of the
/// torque limit, so that it begins gently where the band begins. At least kLargestShare of the spring remains as room:
/// otherwise the smallest push towards the limit would scale the whole wrench to nothing.
void fade_towards_limits(const LimitSprings& limits, const JointVector& springs, const JointVector& most,
                         Room& room) noexcept {
  const auto fade = [](double share, double spring, double largest, double& left) {
    if (share < 1.0)
      left = std::min(left, std::max(share * std::min(largest, left), kLargestShare * std::max(0.0, spring)));
  };
  for (int i = 0; i < kMaxJoints; ++i) {
    fade(limits.down_share[i], springs[i], most[i], room.down[i]);
    fade(limits.up_share[i], -springs[i], most[i], room.up[i]);
  }
}

bool is_finite(const TorqueRequest& request, int joint_count) noexcept {
  return request.q.head(joint_count).allFinite() && request.qd.head(joint_count).allFinite() &&
         request.F_P_R.force.allFinite() && request.F_P_R.torque.allFinite() && request.p_RP.allFinite();
}

}  // namespace

Status validate(const JointTorqueParameters& parameters, const ArmModel& model) noexcept {
  for (const double number :
       {parameters.rotation_length, parameters.singular_none, parameters.singular_full, parameters.limit_band}) {
    if (!std::isfinite(number)) return Status::kNotFinite;
  }
  if (!parameters.null_damping.allFinite() || !parameters.limit_stiffness.allFinite() ||
      !parameters.limit_damping.allFinite()) {
    return Status::kNotFinite;
  }
  if (!(parameters.rotation_length > 0.0) || !(parameters.limit_band > 0.0)) return Status::kArmControl;
  if (!(parameters.singular_none > 0.0) || !(parameters.singular_none < parameters.singular_full)) {
    return Status::kArmControl;
  }
  if (parameters.null_damping.minCoeff() < 0.0 || parameters.limit_stiffness.minCoeff() < 0.0 ||
      parameters.limit_damping.minCoeff() < 0.0) {
    return Status::kArmControl;
  }
  for (int i = 0; i < model.joint_count; ++i) {
    const ArmJoint& joint = model.joints[static_cast<std::size_t>(i)];
    if (2.0 * parameters.limit_band > joint.upper - joint.lower) return Status::kArmControl;
  }
  return Status::kOk;
}

Status joint_torque(const ArmModel& model, const JointTorqueParameters& parameters, const TorqueRequest& request,
                    JointTorque& result) noexcept {
  result = JointTorque();
  const JointVector limits = torque_limits(model);
  const JointVector gravity = gravity_torque(model, request.kinematics);
  result.gravity = gravity;
  if (!gravity.allFinite()) return Status::kNotFinite;
  result.gravity = gravity.cwiseMax(-limits).cwiseMin(limits);
  result.gravity_clipped = result.gravity != gravity;
  result.torque = result.gravity;
  SingularDirections singular;
  if (!is_finite(request, model.joint_count) ||
      !find_singular_directions(parameters, geometric_jacobian(request.kinematics, request.p_RP), singular)) {
    return Status::kNotFinite;
  }

  JointVector torque = result.gravity;
  const LimitSprings springs = limit_springs(model, parameters, request);
  const JointVector sprung = Room(limits, torque).clip(springs.torque, kLargestShare);
  torque += sprung;

  JointVector qd = JointVector::Zero();
  qd.head(model.joint_count) = request.qd.head(model.joint_count);
  const JointVector slowed = parameters.null_damping.cwiseProduct(project_on_null_space(singular, qd));
  const JointVector damping = -project_on_null_space(singular, slowed);
  const Room beside_springs(limits, torque);
  torque += beside_springs.factor(damping, kLargestShare) * damping;

  Vector6 wanted;  // Z^-1 F
  wanted << request.F_P_R.force, request.F_P_R.torque / parameters.rotation_length;
  const Vector6 along = singular.directions.transpose() * wanted;
  const Vector6 shown = singular.directions * singular.share.cwiseProduct(along);
  const JointVector rendered = singular.weighted.transpose() * shown;
  Room for_rendering(limits, torque);
  const double within_limits = for_rendering.factor(rendered, 1.0);
  const JointVector columns = singular.weighted.colwise().norm();
  fade_towards_limits(springs, sprung, within_limits * shown.stableNorm() * columns, for_rendering);
  const double scale = std::min(within_limits, for_rendering.factor(rendered, 1.0));
  torque += scale * rendered;
  if (!torque.allFinite() || !std::isfinite(scale) || !shown.allFinite()) return Status::kNotFinite;

  result.torque = torque.cwiseMax(-limits).cwiseMin(limits);  // removes rounding errors only
  result.rendered_P_R = {scale * shown.head<3>(), scale * parameters.rotation_length * shown.tail<3>()};
  result.scale = scale;
  const double wanted_length = wanted.stableNorm();
  result.left_out = wanted_length > 0.0 ? std::min(1.0, (wanted - shown).stableNorm() / wanted_length) : 0.0;
  return Status::kOk;
}

}  // namespace godobject
