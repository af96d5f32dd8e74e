#pragma once

#include <array>
#include <cassert>
#include <cstdint>
#include <span>

#include "hal/cia402/bus_layout.h"

namespace godobject::hal::cia402 {

/// One SDO exchange with a station.
struct ParameterStep {
  enum class Kind : std::uint8_t {
    kExpect,         ///< reads; size and value must match
    kWrite,          ///< writes; the station must accept it
    kExpectIfThere,  ///< as kExpect, if the station has the object
    kWriteIfThere,   ///< as kWrite, if the station has the object
  };

  Kind kind = Kind::kExpect;
  std::uint16_t index = 0;
  std::uint8_t subindex = 0;
  int size = 0;  ///< bytes
  std::uint32_t value = 0;
  std::uint32_t mask = 0xFFFFFFFF;  ///< compared bits of the value read
  std::uint32_t tolerance = 0;      ///< allowed difference of the value read
  bool or_more = false;             ///< the value read may be larger

  bool accepts(std::uint32_t found) const noexcept;
  bool is_of_same_object(const ParameterStep& other) const noexcept {
    return index == other.index && subindex == other.subindex;
  }
};

/// A sequence of steps.
class ParameterSteps {
 public:
  /// Derived: drive_steps adds 86 steps; asserted in `add` and counted by tests/hal/parameters_test.cc.
  static constexpr std::size_t kCapacity = 96;

  void add(const ParameterStep& step) noexcept {
    assert(count_ < kCapacity);
    steps_[count_++] = step;
  }
  std::span<const ParameterStep> all() const noexcept { return {steps_.data(), count_}; }

 private:
  std::array<ParameterStep, kCapacity> steps_{};
  std::size_t count_ = 0;
};

/// The steps that check and set up a drive before its start, in the order that CiA 301 requires:
/// - identity and abilities; torque limits of the drive (6072, 60E0, 60E1) not below the joint's, since silent
/// saturation
///   distorts the force; a quick-stop ramp (6085), without which there is no quick stop
/// - RPDO1 {6040, 6071} that acts at once, with the deadline; TPDO1 {6041, 6064, 6077} on each SYNC; TPDO2 {6061} on
///   change; no other TPDO
/// - heartbeats in both directions; cyclic synchronous torque mode
/// - reaction to a lost controller and to a quick stop: the joint comes to rest by the drive's own ramp, then without
/// power
/// - all written objects are read back.
void drive_steps(const BusLayout& layout, const DriveConfig& drive, ParameterSteps& steps) noexcept;

/// The steps for the operator's panel: no inverted inputs (6002), TPDO1 {6000:1} on each SYNC, heartbeats in both
/// directions; all written objects are read back.
void panel_steps(const BusLayout& layout, ParameterSteps& steps) noexcept;

inline constexpr int kWatchedCount = 6;

/// The parameters on which safety depends; they are read repeatedly while the drives may have power: deadline and type
/// of RPDO1, the watched heartbeat, the reactions to a lost controller and to a quick stop, the mode.
std::array<ParameterStep, kWatchedCount> watched_parameters(const BusLayout& layout) noexcept;

}  // namespace godobject::hal::cia402
