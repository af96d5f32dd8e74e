#include "core/pipeline/contact/qp/contact_set.h"

namespace godobject::detail {

ContactSet::ContactSet(ContactRows& rows, const Motion& wanted, const CouplingMetric& metric,
                       const ContactFriction* friction, const Motion& last, WorkMeter& work) noexcept
    : rows_(rows), metric_(metric), friction_(friction), last_(last), work_(work), space_(metric.gyration) {
  wanted_ << wanted.translation, metric.gyration * wanted.rotation;
  active_.start(target());
}

ActiveSet::Inequality ContactSet::row_half_space(std::uint32_t row) const noexcept {
  ActiveSet::Inequality half_space;
  half_space.gradient = space_.gradient(rows_.normal(row), rows_.point(row));
  half_space.rhs = static_cast<double>(rows_.required_gain[row]);
  half_space.tag.row = row;
  return half_space;
}

}  // namespace godobject::detail
