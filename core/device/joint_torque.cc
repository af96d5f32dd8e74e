#include "core/device/joint_torque.h"

#include <algorithm>
#include <cmath>

#include "core/device/dynamics.h"
#include "core/device/symmetric_eigen.h"

namespace godobject {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// What comes first takes no more than this of what it finds, so that what comes after fades and does not jump to zero.
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

/// The weighted Jacobian W J, taken apart.
struct SingularDirections {
  Jacobian weighted;
  Matrix6 directions;     // U
  Vector6 share;          // f
  Vector6 inverse_share;  // f / s^2
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

/// P x
JointVector project_on_null_space(const SingularDirections& singular, const JointVector& x) noexcept {
  const Vector6 along = singular.directions.transpose() * (singular.weighted * x);
  return x - singular.weighted.transpose() * (singular.directions * singular.inverse_share.cwiseProduct(along));
}

struct LimitSprings {
  JointVector torque = JointVector::Zero();
  JointVector down_share = JointVector::Ones();  // of what pushes towards either limit, from 1 to 0 at it
  JointVector up_share = JointVector::Ones();
};

LimitSprings limit_springs(const ArmModel& model, const JointTorqueParameters& parameters,
                           const TorqueRequest& request) noexcept {
  LimitSprings springs;
  const double band = parameters.limit_band;
  for (int i = 0; i < model.joint_count; ++i) {
    const ArmJoint& joint = model.joints[static_cast<std::size_t>(i)];
    // depth in the band before a limit and speed towards it -> torque away from it
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

/// How far each joint's torque may still go down and up.
struct Room {
  JointVector down;
  JointVector up;

  Room(const JointVector& limits, const JointVector& used) noexcept
      : down((limits + used).cwiseMax(0.0)), up((limits - used).cwiseMax(0.0)) {}

  JointVector clip(const JointVector& torque, double share) const noexcept {
    return torque.cwiseMax(-share * down).cwiseMin(share * up);
  }

  /// The largest factor up to 1 that brings all of `torque` into this share of the room.
  double factor(const JointVector& torque, double share) const noexcept {
    double smallest = 1.0;
    for (int i = 0; i < kMaxJoints; ++i) {
      const double room = share * (torque[i] > 0.0 ? up[i] : down[i]);
      if (std::fabs(torque[i]) > room) smallest = std::min(smallest, room / std::fabs(torque[i]));
    }
    return smallest;
  }
};

/// Takes from the room of joints that are near a limit. `springs`: as applied; `most`: what a wrench of this size could
/// give at each joint, in whatever direction. The share of that, not of the torque limit, fades: so it begins with the
/// band, as gently as it can. A tenth less than the spring always remains, or the least push would take all of a
/// wrench.
void fade_towards_limits(const LimitSprings& limits, const JointVector& springs, const JointVector& most,
                         Room& room) noexcept {
  const auto fade = [](double share, double spring, double largest, double& way) {
    if (share < 1.0)
      way = std::min(way, std::max(share * std::min(largest, way), kLargestShare * std::max(0.0, spring)));
  };
  for (int i = 0; i < kMaxJoints; ++i) {
    fade(limits.down_share[i], springs[i], most[i], room.down[i]);
    fade(limits.up_share[i], -springs[i], most[i], room.up[i]);
  }
}

bool is_finite(const TorqueRequest& request, int joint_count) noexcept {
  return request.q.head(joint_count).allFinite() && request.qd.head(joint_count).allFinite() &&
         request.F_W.force.allFinite() && request.F_W.torque.allFinite() && request.p_W.allFinite();
}

}  // namespace

Status validate(const JointTorqueParameters& parameters, const ArmModel& model) noexcept {
  const double sum = parameters.rotation_length + parameters.singular_none + parameters.singular_full +
                     parameters.limit_band + parameters.null_damping.sum() + parameters.limit_stiffness.sum() +
                     parameters.limit_damping.sum();
  if (!std::isfinite(sum)) return Status::kNotFinite;
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
  if (!gravity.allFinite()) return Status::kNotFinite;
  result.gravity = gravity.cwiseMax(-limits).cwiseMin(limits);
  result.gravity_clipped = result.gravity != gravity;
  result.torque = result.gravity;
  SingularDirections singular;
  if (!is_finite(request, model.joint_count) ||
      !find_singular_directions(parameters, geometric_jacobian(request.kinematics, request.p_W), singular)) {
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

  Vector6 wanted;  // W^-1 F
  wanted << request.F_W.force, request.F_W.torque / parameters.rotation_length;
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

  result.torque = torque.cwiseMax(-limits).cwiseMin(limits);  // takes away only what rounding put on top
  result.rendered_W = {scale * shown.head<3>(), scale * parameters.rotation_length * shown.tail<3>()};
  result.scale = scale;
  const double wanted_length = wanted.stableNorm();
  result.left_out = wanted_length > 0.0 ? std::min(1.0, (wanted - shown).stableNorm() / wanted_length) : 0.0;
  return Status::kOk;
}

}  // namespace godobject
