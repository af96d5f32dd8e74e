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
    kExpect,         ///< reads; size and value must be as said
    kWrite,          ///< writes; must be accepted
    kExpectIfThere,  ///< the same, of an object that a station may do without
    kWriteIfThere,   ///< writes; a station without this object may do without
  };

  Kind kind = Kind::kExpect;
  std::uint16_t index = 0;
  std::uint8_t subindex = 0;
  int size = 0;  ///< bytes
  std::uint32_t value = 0;
  std::uint32_t mask = 0xFFFFFFFF;  ///< which bits matter of what is read
  std::uint32_t tolerance = 0;      ///< by which what is read may differ
  bool or_more = false;             ///< what is read may be greater

  bool accepts(std::uint32_t found) const noexcept;
};

/// Steps in the order in which they are to be done.
class ParameterSteps {
 public:
  static constexpr std::size_t kCapacity = 112;

  void add(const ParameterStep& step) noexcept {
    assert(count_ < kCapacity);
    steps_[count_++] = step;
  }
  std::span<const ParameterStep> all() const noexcept { return {steps_.data(), count_}; }

 private:
  std::array<ParameterStep, kCapacity> steps_{};
  std::size_t count_ = 0;
};

/// What a drive must be and is set to before it is started, in the order that CiA 301 wants. Identity and abilities;
/// limits of its torque (6072, 60E0, 60E1) no lower than the joint's, which it would cut without a word; a quick-stop
/// ramp (6085), without which there is no quick stop;
/// RPDO1 {6040, 6071} applied at once, with the deadline; TPDO1 {6041, 6064, 6077} on each SYNC, TPDO2 {6061} when it
/// changes, no other TPDO; heartbeats both ways; cyclic synchronous torque; a lost controller or a quick stop brings
/// the joint to rest by the drive's own ramp and then takes power away. Ends with reading back what was written.
void drive_steps(const BusLayout& layout, const DriveConfig& drive, ParameterSteps& steps) noexcept;

/// The same for the operator's panel: inputs that are not turned round (6002), TPDO1 {6000:1} on each SYNC, heartbeats
/// both ways.
void panel_steps(const BusLayout& layout, ParameterSteps& steps) noexcept;

inline constexpr int kWatchedCount = 6;

/// What is read again and again while power may flow, since safety hangs on it: the deadline of the torques and that
/// they act at once, who is watched by its heartbeat, what a lost controller and a quick stop lead to, the mode.
std::array<ParameterStep, kWatchedCount> watched_parameters(const BusLayout& layout) noexcept;

}  // namespace godobject::hal::cia402
