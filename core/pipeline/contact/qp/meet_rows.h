#pragma once

#include <cstdint>

#include "core/pipeline/contact/qp/contact_set.h"

namespace godobject::detail {

/// How adding half spaces to the active set ended.
enum class Additions : std::uint8_t {
  kMet,            ///< no inequality is violated
  kExhausted,      ///< the most additions are made; what is met has not been looked at
  kContradictory,  ///< no motion meets all of them
};

/// Without friction: adds the row that is violated most until all are met.
inline constexpr int kMostRowAdditions = 100;
Additions meet_rows(ContactSet& set) noexcept;

}  // namespace godobject::detail
