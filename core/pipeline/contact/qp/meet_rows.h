#pragma once

#include <cstdint>

#include "core/pipeline/contact/qp/contact_set.h"

namespace godobject::detail {

/// The result of adding half spaces to the active set.
enum class Additions : std::uint8_t {
  kMet,            ///< no inequality is violated
  kExhausted,      ///< the additions are used up; inequalities may be violated
  kContradictory,  ///< no motion meets all of them
};

/// Adds the row violated most, again and again, until all rows are met; without friction. Cost: at most
/// kMostRowAdditions additions. Derived from tests: random problems take up to 60 (least_constraint_test). Real-time
/// safe.
inline constexpr int kMostRowAdditions = 100;
Additions meet_rows(ContactSet& set) noexcept;

}  // namespace godobject::detail
