#pragma once

#include <cstdint>

#include "hal/joint_drives.h"

namespace godobject::hal::cia402 {

/// An alarm, and what is known of its cause.
struct AlarmDetail {
  Alarm alarm = Alarm::kNone;
  int bus = -1;
  int joint = -1;              ///< -1: nobody's
  std::uint16_t id = 0;        ///< COB-ID of the frame that told it; 0: it was told by none
  std::uint16_t index = 0;     ///< object; 0: it is about none
  std::uint8_t subindex = 0;   ///< of the object
  std::uint32_t expected = 0;  ///< of the object
  std::uint32_t found =
      0;  ///< in the object; of kDriveError the emergency code, of kWrongMode without an object the NMT state
};

/// Keeps the first alarm until it is reset. What only a new start can mend stays: a drive that has started anew, or in
/// which somebody has written.
class AlarmLatch {
 public:
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
