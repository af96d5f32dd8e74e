#pragma once

#include <cstddef>

#include "hal/frame_tap.h"
#include "hal/record_ring.h"

namespace godobject::hal {

/// A frame and its bus.
struct LoggedFrame {
  int bus = 0;
  ReceivedFrame received;
};

/// Carries frames from the cycle to the thread that writes the logs. Capacity, chosen: 1.7 s of seven joints on three
/// buses at 1 kHz, which have 19 frames in a cycle (3 SYNC, 7 TPDO1, 7 RPDO1, the panel's, one SDO or heartbeat); a
/// third of a second on eight buses at 4 kHz. 3 MiB: static storage, or the heap before the loop.
class CanLogRing final : public FrameTap {
 public:
  static constexpr std::size_t kCapacity = 32768;

  void on_frame(int bus, const ReceivedFrame& received) noexcept override { ring_.push({bus, received}); }

  /// The reader's side: takes the oldest frame. False: there is none.
  bool pop(LoggedFrame& frame) noexcept { return ring_.pop(frame); }

  std::uint64_t lost() const noexcept { return ring_.lost(); }

 private:
  RecordRing<LoggedFrame, kCapacity> ring_;
};
static_assert(sizeof(CanLogRing) < (std::size_t{3} << 20) + 1024);

}  // namespace godobject::hal
