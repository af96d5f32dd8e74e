#include "sim/operator_hand.h"

#include <algorithm>
#include <cmath>

namespace godobject::sim {
namespace {

/// The rotation vector from a to b, on the axes of R.
Vector3 rotation_between(const Pose& a, const Pose& b) noexcept {
  return log_rotation(b.rotation * a.rotation.conjugate());
}

/// Wrench of a spring and damper from `body` to `to`, on `body`.
Wrench pull(const BodyState& to, const BodyState& body, double stiffness, double damping, double rotation_stiffness,
            double rotation_damping) noexcept {
  return {stiffness * (to.pose.translation - body.pose.translation) +
              damping * (to.velocity.translation - body.velocity.translation),
          rotation_stiffness * rotation_between(body.pose, to.pose) +
              rotation_damping * (to.velocity.rotation - body.velocity.rotation)};
}

/// Energy of the springs between two poses [J].
double stored(const Pose& a, const Pose& b, double stiffness, double rotation_stiffness) noexcept {
  return 0.5 * stiffness * (a.translation - b.translation).squaredNorm() +
         0.5 * rotation_stiffness * rotation_between(a, b).squaredNorm();
}

}  // namespace

OperatorHand::OperatorHand(const HandParameters& parameters, std::span<const Pose> script,
                           std::int64_t start_ns) noexcept
    : parameters_(parameters), script_(script), start_(1e-9 * static_cast<double>(start_ns)) {}

BodyState OperatorHand::target(double time) const noexcept {
  if (steered_) return *steered_;
  BodyState target;
  if (script_.empty()) return target;
  const double rows = (time - start_) / kRow;
  const auto last = static_cast<std::ptrdiff_t>(script_.size()) - 1;
  if (!(rows > 0.0)) return {script_.front(), {}};
  if (rows >= static_cast<double>(last)) return {script_.back(), {}};

  const auto row = static_cast<std::ptrdiff_t>(rows);
  const double s = rows - static_cast<double>(row);
  const auto pose = [&](std::ptrdiff_t i) -> const Pose& {
    return script_[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i, 0, last))];
  };
  const Pose& here = pose(row);
  const Pose& next = pose(row + 1);
  // motion from `here`, in rows; slopes are central differences, zero at both ends of the script
  const Motion step = {next.translation - here.translation, rotation_between(here, next)};
  const auto slope = [&](std::ptrdiff_t i) -> Motion {
    if (i == 0 || i == last) return {};
    const Pose& a = pose(i - 1);
    const Pose& b = pose(i + 1);
    return {0.5 * (b.translation - a.translation), 0.5 * rotation_between(a, b)};
  };
  const Motion first = slope(row);
  const Motion second = slope(row + 1);
  const double h1 = s * s * (3.0 - 2.0 * s);
  const double h2 = s * (s - 1.0) * (s - 1.0);
  const double h3 = s * s * (s - 1.0);
  const double d1 = 6.0 * s * (1.0 - s) / kRow;
  const double d2 = ((3.0 * s - 4.0) * s + 1.0) / kRow;
  const double d3 = (3.0 * s - 2.0) * s / kRow;
  target.pose.translation = here.translation + h1 * step.translation + h2 * first.translation + h3 * second.translation;
  target.pose.rotation = exp_rotation(h1 * step.rotation + h2 * first.rotation + h3 * second.rotation) * here.rotation;
  target.velocity.translation = d1 * step.translation + d2 * first.translation + d3 * second.translation;
  target.velocity.rotation = d1 * step.rotation + d2 * first.rotation + d3 * second.rotation;
  return target;
}

HandWrenches OperatorHand::wrenches(const BodyState& target, const BodyState& hand,
                                    const BodyState& tool) const noexcept {
  const HandParameters& p = parameters_;
  if (p.grip == Grip::kNone) return {};
  const BodyState& held = p.grip == Grip::kRigid ? tool : hand;
  HandWrenches result;
  if (is_passive()) {
    result.F_H_R = {-p.damping * held.velocity.translation, -p.rotation_damping * held.velocity.rotation};
  } else {
    result.F_H_R = pull(target, held, p.stiffness, p.damping, p.rotation_stiffness, p.rotation_damping);
  }
  result.F_M_R = p.grip == Grip::kRigid ? result.F_H_R
                                        : pull(hand, tool, p.grip_stiffness, p.grip_damping, p.grip_rotation_stiffness,
                                               p.grip_rotation_damping);
  return result;
}

double OperatorHand::energy(const BodyState& target, const BodyState& hand, const BodyState& tool) const noexcept {
  const HandParameters& p = parameters_;
  if (p.grip == Grip::kNone) return 0.0;
  double energy = 0.0;
  if (p.grip == Grip::kSpring) {
    energy += 0.5 * p.mass * hand.velocity.translation.squaredNorm() +
              0.5 * p.inertia * hand.velocity.rotation.squaredNorm() +
              stored(hand.pose, tool.pose, p.grip_stiffness, p.grip_rotation_stiffness);
  }
  if (!is_passive()) {
    const Pose& held = p.grip == Grip::kRigid ? tool.pose : hand.pose;
    energy += stored(target.pose, held, p.stiffness, p.rotation_stiffness);
  }
  return energy;
}

}  // namespace godobject::sim
