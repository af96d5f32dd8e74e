#include "toolchain/report/assembly/backlash.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace godobject::report {
namespace {

using Eigen::Vector2d;

/// Calls `visit` with the angle, in (-pi, pi], from the point to each place where its circle about the origin meets the
/// side.
template <typename Visit>
void meet(const Vector2d& point, const Segment& side, Visit&& visit) {
  const Vector2d along = side[1] - side[0];
  const double a = along.squaredNorm();
  const double b = side[0].dot(along);
  const double c = side[0].squaredNorm() - point.squaredNorm();
  const double root = b * b - a * c;
  if (a == 0.0 || root < 0.0) return;
  for (const double sign : {-1.0, 1.0}) {
    const double share = (-b + sign * std::sqrt(root)) / a;
    if (share < 0.0 || share > 1.0) continue;
    const Vector2d at = side[0] + share * along;
    visit(std::atan2(point.x() * at.y() - point.y() * at.x(), point.dot(at)));
  }
}

}  // namespace

Backlash exact_backlash(const std::vector<Segment>& turning, const std::vector<Segment>& still) {
  Backlash play{std::numbers::pi, std::numbers::pi};
  const auto take = [&](double angle) {
    double& least = angle >= 0.0 ? play.forward : play.backward;
    least = std::min(least, std::abs(angle));
  };
  for (const Segment& own : turning) {
    for (const Segment& other : still) {
      meet(own[0], other, take);
      meet(own[1], other, take);
      meet(other[0], own, [&](double angle) { take(-angle); });
      meet(other[1], own, [&](double angle) { take(-angle); });
    }
  }
  return play;
}

}  // namespace godobject::report
