#include "core/pipeline/contact/damping.h"

namespace godobject::detail {

Vector6 damping_change(const Vector6* rows, std::uint32_t count, const Vector6& load, const Vector6& damping) noexcept {
  struct NoTag {};
  using Cone = DualActiveSet<NoTag>;
  Cone cone;
  cone.start(damping - load);
  const double tolerance = 1e-12 * (damping.norm() + load.norm());  // derived: rounding of sums of such vectors
  for (int round = 0; round < 4 * Cone::kCapacity; ++round) {
    Cone::Inequality worst;
    double violation = tolerance;
    for (std::uint32_t j = 0; j < count; ++j) {
      const double here = -rows[j].dot(cone.z());
      if (!(here > violation)) continue;
      violation = here;
      worst.gradient = rows[j];
    }
    if (!(violation > tolerance) || !cone.add(worst)) break;
  }
  // -load projects to 0, and the residuals of two projections are no farther apart than the two points: so the change
  // is at most `damping`, and takes power from the velocity. Rows that contradict each other up to rounding carry loads
  // whose sum is only rounding; there the projection is not valid.
  constexpr double kRounding = 1e-9;  // derived: more than the projection's
  const Vector6 change = cone.z() - damping;
  if (!(change.norm() <= (1.0 + kRounding) * damping.norm())) return Vector6::Zero();
  if (!(change.dot(damping) <= kRounding * damping.squaredNorm())) return Vector6::Zero();
  return change;
}

}  // namespace godobject::detail
