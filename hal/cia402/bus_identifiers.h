#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/cia402/bus_layout.h"

namespace godobject::hal {

/// The identifiers that the controller needs from one bus, for the filters of a socket: those of its drives and panel
/// in both directions, unused PDOs included, and those that only a master sends. With them it notices foreign frames,
/// too; all other frames cost nothing.
class BusIdentifiers {
 public:
  BusIdentifiers(const BusLayout& layout, int bus) noexcept;

  std::span<const std::uint16_t> all() const noexcept { return {identifiers_.data(), count_}; }

 private:
  static constexpr std::size_t kOfNode = 10;
  static constexpr std::size_t kOfBus = 5;

  void add(int identifier) noexcept { identifiers_[count_++] = static_cast<std::uint16_t>(identifier); }
  void add_node(int node) noexcept;

  std::array<std::uint16_t, kOfBus + kOfNode*(kMaxJoints + 1)> identifiers_{};
  std::size_t count_ = 0;
};

}  // namespace godobject::hal
