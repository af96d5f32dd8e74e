#pragma once

#include <array>
#include <cstdint>

#include "core/pipeline/contact_set.h"
#include "core/pipeline/least_constraint.h"

namespace godobject::detail {

/// Forces that hold the god object back, gathered from up to two active sets.
class ContactForces {
 public:
  /// Takes those of the set's half spaces.
  void append(const ContactSet& set) noexcept;

  /// Puts them into `step`, and how many points they act at. More than six are replaced by six or fewer of the same
  /// sum: a vector in the cone of generators in six dimensions is a combination of six that are independent
  /// (Caratheodory).
  void store(double gyration, ConstrainedStep& step) noexcept;

 private:
  static constexpr std::size_t kMost = 2 * ActiveSet::kCapacity;

  struct Generator {
    std::uint32_t row;
    ContactForce force;
  };

  void reduce(double gyration) noexcept;

  std::array<Generator, kMost> forces_;
  std::size_t count_ = 0;
};

}  // namespace godobject::detail
