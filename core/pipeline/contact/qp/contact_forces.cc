#include "core/pipeline/contact/qp/contact_forces.h"

namespace godobject::detail {

ContactForce force_of(const ContactSet& set, int half_space) noexcept {
  const ContactTag& tag = set.active()[half_space].tag;
  ContactForce force;
  force.id = set.rows().id[tag.row];
  force.point = set.rows().point(tag.row);
  force.slip = tag.slip;
  const bool has_friction = set.contact_count() > 0;
  force.normal = has_friction ? set.contact_of(half_space).normal : set.rows().normal(tag.row);
  force.grip = has_friction ? set.contact_of(half_space).grip : force.point;
  force.ratio = has_friction ? set.contact_of(half_space).ratio : 0.0;
  force.multiplier = set.active()[half_space].multiplier;
  return force;
}

void count_contacts(ConstrainedStep& step) noexcept {
  step.contact_count = 0;
  for (std::uint32_t j = 0; j < step.force_count; ++j) {
    bool counted = false;
    for (std::uint32_t i = 0; i < j; ++i) {
      counted |= step.forces[i].id == step.forces[j].id && step.forces[i].normal == step.forces[j].normal;
    }
    step.contact_count += counted ? 0 : 1;
  }
}

void drop_forces(std::uint32_t id, ConstrainedStep& step) noexcept {
  std::uint32_t kept = 0;
  for (std::uint32_t j = 0; j < step.force_count; ++j) {
    if (step.forces[j].id != id) step.forces[kept++] = step.forces[j];
  }
  step.force_count = kept;
  count_contacts(step);
}

void take_forces(const ContactSet& set, ConstrainedStep& step) noexcept {
  step.force_count = static_cast<std::uint32_t>(set.active().size());
  for (std::uint32_t j = 0; j < step.force_count; ++j) step.forces[j] = force_of(set, static_cast<int>(j));
  count_contacts(step);
}

}  // namespace godobject::detail
