#include "core/pipeline/contact/qp/combined_forces.h"

#include <Eigen/Geometry>

#include "core/pipeline/contact/qp/contact_forces.h"

namespace godobject::detail {
// Among the points z with c . z >= 0 for all generators c, the one nearest to minus the sum is zero, and its
// multipliers give the sum.
double store_sum(const Forces& all, double gyration, ConstrainedStep& step) noexcept {
  if (all.count <= step.forces.size()) {
    step.force_count = static_cast<std::uint32_t>(all.count);
    for (std::size_t j = 0; j < all.count; ++j) step.forces[j] = all.force[j];
    count_contacts(step);
    return 0.0;
  }
  using Basis = DualActiveSet<std::size_t>;
  constexpr int kMostAdditions = 8 * Basis::kCapacity;
  constexpr double kRounding = 1e-12;  // derived: rounding of a sum of 21 vectors, with room to spare
  std::array<Vector6, std::tuple_size_v<decltype(all.force)>> c;
  Vector6 sum = Vector6::Zero();
  for (std::size_t i = 0; i < all.count; ++i) {
    const ContactForce& force = all.force[i];
    const Vector3 drag = -force.ratio * force.slip;
    c[i] << force.normal + drag, (force.point.cross(force.normal) + force.grip.cross(drag)) / gyration;
    sum += force.multiplier * c[i];
  }
  Basis basis;
  basis.start(-sum);
  for (int additions = 0; additions < kMostAdditions; ++additions) {
    Basis::Inequality worst;
    const double limit = kRounding * sum.norm();
    double violation = limit;
    for (std::size_t i = 0; i < all.count; ++i) {
      const double here = -c[i].dot(basis.z());
      if (!(here > violation)) continue;
      violation = here;
      worst.gradient = c[i];
      worst.tag = i;
    }
    if (!(violation > limit) || !basis.add(worst)) break;
  }
  step.force_count = static_cast<std::uint32_t>(basis.size());
  for (int j = 0; j < basis.size(); ++j) {
    ContactForce& force = step.forces[static_cast<std::size_t>(j)];
    force = all.force[basis[j].tag];
    force.multiplier = basis[j].multiplier;
  }
  count_contacts(step);
  return basis.z().norm();
}

void add_forces(const ContactSet& set, ConstrainedStep& step) noexcept {
  Forces all;
  for (std::uint32_t j = 0; j < step.force_count; ++j) all.add(step.forces[j]);
  for (int j = 0; j < set.active().size(); ++j) all.add(force_of(set, j));
  store_sum(all, set.metric().gyration, step);
}

}  // namespace godobject::detail
