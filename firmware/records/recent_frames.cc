#include "firmware/records/recent_frames.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <iterator>

namespace godobject::firmware {

void RecentFrames::push(std::int64_t cycle_ns, const hal::LoggedFrame& logged) {
  const hal::CanFrame& frame = logged.received.frame;
  const Head head{.cycle_ns = cycle_ns,
                  .time_ns = logged.received.time_ns,
                  .id = frame.id,
                  .bus = static_cast<std::uint8_t>(logged.bus),
                  .length = static_cast<std::uint8_t>(frame.length),
                  .fd = frame.fd};
  std::array<unsigned char, sizeof head> raw;
  std::memcpy(raw.data(), &head, sizeof head);
  bytes_.insert(bytes_.end(), raw.begin(), raw.end());
  bytes_.insert(bytes_.end(), frame.data.begin(), std::next(frame.data.begin(), head.length));
}

RecentFrames::Head RecentFrames::head_at(std::size_t offset) const {
  std::array<unsigned char, sizeof(Head)> raw;
  std::copy_n(std::next(bytes_.begin(), static_cast<std::ptrdiff_t>(offset)), raw.size(), raw.begin());
  Head head;
  std::memcpy(&head, raw.data(), sizeof head);
  return head;
}

bool RecentFrames::take(hal::LoggedFrame& logged) {
  if (mark_ == bytes_.size()) return false;
  const Head head = head_at(mark_);
  logged = {};
  logged.bus = head.bus;
  logged.received.time_ns = head.time_ns;
  hal::CanFrame& frame = logged.received.frame;
  frame.id = head.id;
  frame.length = head.length;
  frame.fd = head.fd;
  std::copy_n(std::next(bytes_.begin(), static_cast<std::ptrdiff_t>(mark_ + sizeof(Head))), head.length,
              frame.data.begin());
  mark_ += sizeof(Head) + head.length;
  return true;
}

void RecentFrames::drop_before(std::int64_t cycle_ns, bool taken_only) {
  while (!bytes_.empty() && !(taken_only && mark_ == 0)) {
    const Head oldest = head_at(0);
    if (oldest.cycle_ns >= cycle_ns) return;
    const std::size_t size = sizeof(Head) + oldest.length;
    bytes_.erase(bytes_.begin(), std::next(bytes_.begin(), static_cast<std::ptrdiff_t>(size)));
    mark_ = mark_ < size ? 0 : mark_ - size;
  }
}

}  // namespace godobject::firmware
