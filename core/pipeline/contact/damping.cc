#include "core/pipeline/contact/damping.h"

namespace godobject::detail {

Vector6 damping_change(const Vector6* rows, std::uint32_t count, const Vector6& load, const Vector6& asked) noexcept {
  struct NoTag {};
  using Cone = DualActiveSet<NoTag>;
  Cone cone;
  cone.start(asked - load);
  const double tolerance = 1e-12 * (asked.norm() + load.norm());
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
  // The loads alone are projected on 0, and the residuals of two projections are no farther apart than the two points.
  // Rows that contradict each other but for their rounding carry loads whose sum is rounding only; a projection from
  // there is none.
  constexpr double kRoundedUp = 1.0 + 1e-9;
  const Vector6 change = cone.z() - asked;
  if (!(change.norm() <= kRoundedUp * asked.norm())) return Vector6::Zero();
  return change;
}

}  // namespace godobject::detail
