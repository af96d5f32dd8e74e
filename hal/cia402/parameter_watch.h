#pragma once

#include <array>
#include <cstdint>

#include "hal/can_frame.h"
#include "hal/canopen/sdo.h"
#include "hal/cia402/alarm_latch.h"
#include "hal/cia402/parameters.h"
#include "hal/cia402/stations.h"
#include "hal/cia402/temperature_watch.h"

namespace godobject::hal::cia402 {

/// Reads the watched parameters and the temperatures of the drives on one bus in turn, one SDO exchange at a time.
/// Real-time safe.
class ParameterWatch {
 public:
  /// Exchanges in a row without an answer that raise the alarm. Chosen: an answer may be lost now and then; with 5 a
  /// drive without SDO is noticed within a second, since each of its parameters is read once a second.
  static constexpr int kMostSilent = 5;

  ParameterWatch() = default;
  ParameterWatch(const BusLayout& layout, int bus) noexcept;

  /// Makes the next request. The previous one, if not answered, counts as silent. False: there is no drive on this bus.
  bool next(CanFrame& request) noexcept;

  /// Cycles between two requests: `wanted`, or fewer such that each parameter and temperature is read within a second
  /// if no request waits for a heartbeat; at least one.
  int interval(int wanted) const noexcept;

  /// Checks an SDO response of this bus. Ignores responses to other requests.
  void take(const canopen::SdoResponse& response) noexcept;

  /// The first wrong parameter; `alarm` is kNone while there is none.
  const AlarmDetail& finding() const noexcept { return finding_; }

  /// The temperature of a joint's drive on this bus.
  const TemperatureWatch& temperature(int joint) const noexcept {
    return temperatures_[static_cast<std::size_t>(joint)];
  }

 private:
  void find(Alarm alarm, const canopen::SdoResponse& response) noexcept;
  void take_temperature(const canopen::SdoResponse& response) noexcept;
  TemperatureWatch& asked_temperature() noexcept { return temperatures_[static_cast<std::size_t>(joints_[drive_])]; }
  bool asks_for_temperature() const noexcept { return step_ == kWatchedCount; }

  std::array<ParameterStep, kWatchedCount> steps_{};
  int bus_{};
  int joint_count_ = 0;  // on this bus
  int within_ = 950;     // cycles in which every parameter is read once
  std::array<int, kMaxJoints> joints_{};
  std::array<int, kMaxJoints> nodes_{};
  std::array<int, kMaxJoints> silent_{};
  std::array<TemperatureWatch, kMaxJoints> temperatures_{};  // by joint
  std::size_t steps_of_round_ = kWatchedCount;               // one more if a drive has a temperature
  std::size_t drive_ = 0;                                    // whose turn it is
  std::size_t step_ = 0;                                     // kWatchedCount: the temperature
  bool waits_ = false;
  AlarmDetail finding_;
};

}  // namespace godobject::hal::cia402
