#include "core/pipeline/contact/qp/combined_forces.h"

#include <Eigen/Geometry>

#include "core/pipeline/contact/qp/contact_forces.h"

namespace godobject::detail {
namespace {

/// The forces of up to two active sets.
struct Forces {
  std::array<ContactForce, 2 * ActiveSet::kCapacity> force;
  std::size_t count = 0;
};

/// Replaces the forces of the step by at most six of `all` with the same sum. Among the points z with c . z >= 0 for
/// all generators c, the one nearest to minus the sum is zero, and its multipliers give the sum.
void store_sum(const Forces& all, double gyration, ConstrainedStep& step) noexcept {
  using Basis = DualActiveSet<std::size_t>;
  constexpr int kMostAdditions = 4 * Basis::kCapacity;
  constexpr double kRounding = 1e-12;  // derived: rounding of a sum of twelve vectors, with room to spare
  std::array<Vector6, 2 * ActiveSet::kCapacity> c;
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
}

}  // namespace

void add_forces(const ContactSet& set, ConstrainedStep& step) noexcept {
  Forces all;
  for (; all.count < step.force_count; ++all.count) all.force[all.count] = step.forces[all.count];
  for (int j = 0; j < set.active().size(); ++j) all.force[all.count++] = force_of(set, j);
  if (all.count > step.forces.size()) {
    store_sum(all, set.metric().gyration, step);
  } else {
    step.force_count = static_cast<std::uint32_t>(all.count);
    for (std::size_t j = 0; j < all.count; ++j) step.forces[j] = all.force[j];
  }
  count_contacts(step);
}

}  // namespace godobject::detail
