#pragma once

#include <cstdint>

#include "hal/joint_drives.h"

namespace godobject::hal::cia402 {

/// An alarm and its cause.
struct AlarmDetail {
  Alarm alarm = Alarm::kNone;
  int bus = -1;
  int joint = -1;              ///< -1: no single joint
  std::uint16_t id = 0;        ///< COB-ID of the frame that raised it; 0: none
  std::uint16_t index = 0;     ///< index of an object; 0: none
  std::uint8_t subindex = 0;   ///< of the object
  std::uint32_t expected = 0;  ///< value of the object
  std::uint32_t found = 0;  ///< value found; kDriveError: the emergency code; kWrongMode without object: the NMT state
  double celsius = 0.0;     ///< kTooHot: temperature [degC]
  double most_celsius = 0.0;  ///< kTooHot: temperature that stops the arm [degC]
};

/// Latches the first alarm until it is reset. Alarms that only a new start can cure stay over a reset: a drive has
/// restarted, or another node has written to it.
class AlarmLatch {
 public:
  /// Latches an alarm. kNone changes nothing.
  void raise(const AlarmDetail& detail) noexcept {
    if (first_.alarm == Alarm::kNone) first_ = detail;
    if (lasting_.alarm == Alarm::kNone && lasts(detail.alarm)) lasting_ = detail;
  }

  void reset() noexcept { first_ = lasting_; }

  void clear() noexcept { *this = AlarmLatch(); }

  const AlarmDetail& first() const noexcept { return first_; }

 private:
  static bool lasts(Alarm alarm) noexcept {
    return alarm == Alarm::kNodeReset || alarm == Alarm::kForeignWrite || alarm == Alarm::kParameterChanged ||
           alarm == Alarm::kAnswersLate;
  }

  AlarmDetail first_;
  AlarmDetail lasting_;
};

}  // namespace godobject::hal::cia402
