#pragma once

#include "hal/frame_tap.h"
#include "hal/record_ring.h"

namespace godobject::hal {

/// A frame and the bus on which it came.
struct LoggedFrame {
  int bus = 0;
  ReceivedFrame received;
};

/// From the bus to the thread that writes the logs. Seven joints send 18 frames a millisecond: two seconds, 3 MiB,
/// static storage.
class CanLogRing final : public FrameTap {
 public:
  static constexpr std::size_t kCapacity = 32768;

  void on_frame(int bus, const ReceivedFrame& received) noexcept override { ring_.push({bus, received}); }

  /// The reader's side. False: there is none.
  bool pop(LoggedFrame& frame) noexcept { return ring_.pop(frame); }

  std::uint64_t lost() const noexcept { return ring_.lost(); }

 private:
  RecordRing<LoggedFrame, kCapacity> ring_;
};

}  // namespace godobject::hal
