#include "core/pipeline/contact_forces.h"

#include <Eigen/Geometry>

namespace godobject::detail {

void ContactForces::append(const ContactSet& set) noexcept {
  const ActiveSet& active = set.active();
  for (int j = 0; j < active.size(); ++j) {
    Generator& generator = forces_[count_++];
    generator.row = active[j].tag.row;
    ContactForce& force = generator.force;
    force.id = set.rows().id[generator.row];
    force.point = set.rows().point(generator.row);
    force.normal = set.rows().normal(generator.row);
    force.slip = active[j].tag.slip;
    force.ratio = set.contact_count() == 0 ? 0.0 : set.contact_of(j).ratio;
    force.multiplier = active[j].multiplier;
  }
}

void ContactForces::store(double gyration, ConstrainedStep& step) noexcept {
  if (count_ > step.forces.size()) reduce(gyration);
  step.force_count = static_cast<std::uint32_t>(count_);
  step.contact_count = 0;
  for (std::size_t j = 0; j < count_; ++j) {
    bool counted = false;
    for (std::size_t i = 0; i < j; ++i) counted |= forces_[i].row == forces_[j].row;
    step.contact_count += counted ? 0 : 1;
    step.forces[j] = forces_[j].force;
  }
}

/// The point nearest to minus the sum among those that no generator violates, c . z >= 0, is zero, and its multipliers
/// give the sum.
void ContactForces::reduce(double gyration) noexcept {
  using Basis = DualActiveSet<std::size_t>;
  constexpr int kMostExchanges = 4 * Basis::kCapacity;
  constexpr double kRounding = 1e-12;
  std::array<Vector6, kMost> c;
  Vector6 sum = Vector6::Zero();
  for (std::size_t i = 0; i < count_; ++i) {
    const ContactForce& force = forces_[i].force;
    const Vector3 push = force.normal - force.ratio * force.slip;
    c[i] << push, force.point.cross(push) / gyration;
    sum += force.multiplier * c[i];
  }
  Basis basis;
  basis.start(-sum);
  for (int exchange = 0; exchange < kMostExchanges; ++exchange) {
    Basis::Inequality worst;
    double violation = kRounding * sum.norm();
    for (std::size_t i = 0; i < count_; ++i) {
      const double here = -c[i].dot(basis.z());
      if (!(here > violation)) continue;
      violation = here;
      worst.gradient = c[i];
      worst.tag = i;
    }
    if (worst.gradient.isZero(0.0) || !basis.add(worst)) break;
  }
  const std::array<Generator, kMost> all = forces_;
  count_ = static_cast<std::size_t>(basis.size());
  for (std::size_t j = 0; j < count_; ++j) {
    const Basis::Inequality& chosen = basis[static_cast<int>(j)];
    forces_[j] = all[chosen.tag];
    forces_[j].force.multiplier = chosen.multiplier;
  }
}

}  // namespace godobject::detail
