#include "sim/can_bridge.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "hal/canopen/object_numbers.h"

namespace godobject::sim {

CanBridge::CanBridge(CanDevice& device, const hal::BusLayout& layout, const hal::BusTiming& timing,
                     std::span<hal::CanBus* const> buses) noexcept
    : device_(device),
      bus_count_(layout.bus_count),
      period_ns_(std::llround(1e9 * layout.period)),
      compute_ns_(std::llround(1e9 * layout.compute)),
      collect_ns_(timing.collect_ns) {
  assert(static_cast<int>(buses.size()) == bus_count_);
  for (std::size_t i = 0; i < buses.size(); ++i) sides_[i].bus = buses[i];
}

bool CanBridge::Side::sync_waits() const noexcept { return count > 0 && inbox[first].id == hal::canopen::kCobSync; }

bool CanBridge::Side::torque_waits() const noexcept {
  return count > 0 && inbox[first].id > hal::canopen::kCobRpdo1 && inbox[first].id < hal::canopen::kCobRpdo1 + 0x80;
}

/// The oldest frame of a bus goes to the device. A full queue loses it, as a node that is too slow does.
void CanBridge::hand_over(int bus) noexcept {
  Side& side = sides_[static_cast<std::size_t>(bus)];
  (void)device_.bus(bus).send(side.inbox[side.first]);
  side.first = (side.first + 1) % kInbox;
  --side.count;
}

void CanBridge::read() noexcept {
  hal::ReceivedFrame received;
  for (Side& side : sides()) {
    while (side.bus->receive(received)) {
      if (received.own) continue;
      ++counters_.received;
      if (side.count == kInbox) {
        ++counters_.dropped;
      } else {
        side.inbox[(side.first + side.count++) % kInbox] = received.frame;
      }
    }
  }
}

/// What does not begin a cycle. A SYNC that comes after its cycle was begun without it belongs to that.
void CanBridge::pass_on(std::int64_t now_ns) noexcept {
  if (in_step_) {
    const std::int64_t elapsed_ns = now_ns - begin_clock_ns_;
    const std::int64_t hand_over_ns = begin_ns_ + std::max(collect_ns_, elapsed_ns - compute_ns_);
    const bool waits = std::any_of(sides_.begin(), sides_.begin() + bus_count_,
                                   [](const Side& side) { return side.count > 0 && !side.sync_waits(); });
    if (waits) device_.advance_to(hand_over_ns);
  }
  for (int i = 0; i < bus_count_; ++i) {
    Side& side = sides_[static_cast<std::size_t>(i)];
    while (side.count > 0) {
      const bool late_sync = in_step_ && !side.synced && now_ns - begin_clock_ns_ < period_ns_ / 2;
      if (side.sync_waits() && !late_sync) break;
      if (side.sync_waits()) side.synced = true;
      hand_over(i);
    }
  }
}

/// Whether the next cycle may begin: all buses have its SYNC, or the missing ones have had their time.
bool CanBridge::sync_is_there(std::int64_t now_ns) noexcept {
  const auto waits = [](const Side& side) { return side.sync_waits(); };
  const auto all = sides();
  if (!std::any_of(all.begin(), all.end(), waits)) return false;
  if (first_sync_ns_ < 0) first_sync_ns_ = now_ns;
  return std::all_of(all.begin(), all.end(), waits) || now_ns - first_sync_ns_ >= period_ns_ / 4;
}

void CanBridge::begin_cycle() noexcept {
  const std::int64_t next_ns = begin_ns_ + period_ns_;
  const bool beyond = !in_step_ || device_.now_ns() > next_ns;
  begin_ns_ = beyond ? (device_.now_ns() + period_ns_ - 1) / period_ns_ * period_ns_ : next_ns;
  begin_clock_ns_ = first_sync_ns_;
  first_sync_ns_ = -1;
  in_step_ = true;
  ++counters_.cycles;
  device_.advance_to(begin_ns_);
  for (int i = 0; i < bus_count_; ++i) {
    Side& side = sides_[static_cast<std::size_t>(i)];
    side.synced = side.sync_waits();
    if (!side.synced) continue;
    hand_over(i);
    while (side.count > 0 && !side.sync_waits() && !side.torque_waits()) hand_over(i);
  }
  device_.advance_to(begin_ns_ + collect_ns_);
  forward();
}

void CanBridge::go_by_clock(std::int64_t now_ns) noexcept {
  if (in_step_ && now_ns - begin_clock_ns_ <= 2 * period_ns_) return;
  if (in_step_) ++counters_.left_alone;
  in_step_ = false;
  device_.advance_to(begin_ns_ + (now_ns - begin_clock_ns_));
}

void CanBridge::forward() noexcept {
  hal::ReceivedFrame received;
  for (int i = 0; i < bus_count_; ++i) {
    while (device_.bus(i).receive(received)) {
      if (received.own) continue;
      ++counters_.forwarded;
      if (sides_[static_cast<std::size_t>(i)].bus->send(received.frame) != hal::SendResult::kSent) ++counters_.not_sent;
    }
  }
}

void CanBridge::poll(std::int64_t now_ns) noexcept {
  if (!started_) {
    started_ = true;
    begin_ns_ = device_.now_ns();
    begin_clock_ns_ = now_ns;
  }
  read();
  read();  // what was sent on one bus before a SYNC on another is there now
  if (!in_step_) go_by_clock(now_ns);
  pass_on(now_ns);
  while (sync_is_there(now_ns)) {
    begin_cycle();
    pass_on(now_ns);
  }
  go_by_clock(now_ns);
  forward();
}

}  // namespace godobject::sim
