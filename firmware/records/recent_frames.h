#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>

#include "hal/can_log_ring.h"

namespace godobject::firmware {

/// A queue of frames with the time of their cycle, packed: some 30 bytes a frame. A mark separates the frames that were
/// taken from those that were not.
class RecentFrames {
 public:
  /// `cycle_ns`: time of the cycle by the loop's clock. The times of frames are those of the kernel, whose clock may be
  /// set.
  void push(std::int64_t cycle_ns, const hal::LoggedFrame& frame);

  /// Returns the oldest frame behind the mark and moves the mark over it. False: there is none.
  bool take(hal::LoggedFrame& frame);

  /// Sets the mark to the oldest frame, so that `take` begins again.
  void rewind() noexcept { mark_ = 0; }

  /// Removes the frames of cycles before `cycle_ns`, and of those only frames that were taken if `taken_only`.
  void drop_before(std::int64_t cycle_ns, bool taken_only);

  bool all_taken() const noexcept { return mark_ == bytes_.size(); }

  std::size_t bytes() const noexcept { return bytes_.size(); }

 private:
  struct Head {
    std::int64_t cycle_ns = 0;
    std::int64_t time_ns = 0;
    std::uint16_t id = 0;
    std::uint8_t bus = 0;
    std::uint8_t length = 0;
    bool fd = false;
  };
  Head head_at(std::size_t offset) const;

  std::deque<unsigned char> bytes_;
  std::size_t mark_ = 0;  // offset in bytes_
};

}  // namespace godobject::firmware
