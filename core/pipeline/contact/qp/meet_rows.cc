#include "core/pipeline/contact/qp/meet_rows.h"

namespace godobject::detail {
namespace {

bool is_active(const ActiveSet& active, std::uint32_t row) noexcept {
  for (int j = 0; j < active.size(); ++j) {
    if (active[j].tag.row == row) return true;
  }
  return false;
}

}  // namespace

Additions meet_rows(ContactSet& set) noexcept {
  for (int i = 0; i < kMostRowAdditions && !set.work().is_spent(); ++i) {
    const ContactRows::Violated worst = set.most_violated(set.motion());
    // an active row is violated only by rounding
    if (worst.row == ContactRows::kNone || is_active(set.active(), worst.row)) return Additions::kMet;
    if (!set.add(set.row_half_space(worst.row))) return Additions::kContradictory;
  }
  return Additions::kExhausted;
}

}  // namespace godobject::detail
