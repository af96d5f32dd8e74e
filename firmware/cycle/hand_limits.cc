#include "firmware/cycle/hand_limits.h"

#include <algorithm>

namespace godobject::firmware {
namespace {

struct Bounds {
  double size;
  double speed;
  double stop;
};

/// Limits a force by a velocity, or a torque by an angular velocity.
Vector3 limit(const Bounds& bounds, Vector3 force, const Vector3& velocity, LimitedWrench& report) noexcept {
  const double speed = velocity.norm();
  if (speed > bounds.speed) {
    const Vector3 along = velocity / speed;
    const double excess = std::min(1.0, (speed - bounds.speed) / (bounds.stop - bounds.speed));
    force -= (excess * std::max(0.0, force.dot(along)) + excess * bounds.size) * along;
    report.slowed = true;
    report.too_fast = report.too_fast || speed > bounds.stop;
  }
  const double size = force.norm();
  if (size > bounds.size) {
    force *= bounds.size / size;
    report.clipped = true;
  }
  return force;
}

}  // namespace

LimitedWrench limit_at_hand(const HandLimits& limits, const Wrench& F_G_R, const Motion& velocity_R) noexcept {
  LimitedWrench limited;
  limited.F_G_R.force =
      limit({limits.force, limits.speed, limits.speed_stop}, F_G_R.force, velocity_R.translation, limited);
  limited.F_G_R.torque =
      limit({limits.torque, limits.turn, limits.turn_stop}, F_G_R.torque, velocity_R.rotation, limited);
  return limited;
}

}  // namespace godobject::firmware
