#pragma once

#include <array>
#include <cstdint>

#include "hal/can_frame.h"
#include "hal/canopen/sdo.h"
#include "hal/cia402/alarm_latch.h"
#include "hal/cia402/parameters.h"
#include "hal/cia402/stations.h"

namespace godobject::hal::cia402 {

/// Reads the watched parameters of the drives on one bus in turn, one exchange at a time. Real-time safe.
class ParameterWatch {
 public:
  static constexpr int kMostSilent = 5;  ///< exchanges in a row without an answer: then there is nothing to trust in

  ParameterWatch() = default;
  ParameterWatch(const BusLayout& layout, int bus) noexcept;

  /// The next request. False: there is no drive on this bus. What has not been answered until now counts as silent.
  bool next(CanFrame& request) noexcept;

  /// Cycles of a millisecond between two requests: `wanted`, or fewer, so that each parameter is read within a second.
  int interval(int wanted) const noexcept;

  /// Looks at an SDO response of this bus; what was not asked for is passed over.
  void take(const canopen::SdoResponse& response) noexcept;

  /// What is wrong; `alarm` is kNone while nothing is.
  const AlarmDetail& finding() const noexcept { return finding_; }

 private:
  void find(Alarm alarm, const canopen::SdoResponse& response) noexcept;

  std::array<ParameterStep, kWatchedCount> steps_{};
  int bus_ = 0;
  int joint_count_ = 0;  // on this bus
  std::array<int, kMaxJoints> joints_{};
  std::array<int, kMaxJoints> nodes_{};
  std::array<int, kMaxJoints> silent_{};
  std::size_t drive_ = 0;  // whose turn it is
  std::size_t step_ = 0;
  bool waits_ = false;
  AlarmDetail finding_;
};

}  // namespace godobject::hal::cia402
