#include "sim/can_bridge.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "hal/canopen/object_numbers.h"

namespace godobject::sim {
namespace {

/// Frames that drives send: PDOs, SDO responses, emergencies and heartbeats. No node takes them, whoever sent them.
bool is_of_node(std::uint16_t id) noexcept {
  using namespace hal::canopen;
  constexpr int kMaxNode = 0x7F;  // the controller's node number
  const int node = id & kMaxNode;
  switch (id - node) {
    case kCobEmergency: return node != 0;
    case kCobTpdo1:
    case kCobSdoResponse: return true;
    case kCobHeartbeat: return node != kMaxNode;
    default: return false;
  }
}

}  // namespace

CanBridge::CanBridge(CanDevice& device, const hal::BusLayout& layout, const hal::BusTiming& timing,
                     std::span<hal::CanBus* const> buses) noexcept
    : device_(device),
      bus_count_(layout.bus_count),
      period_ns_(std::llround(1e9 * layout.period)),
      compute_ns_(std::llround(1e9 * layout.compute)),
      collect_ns_(timing.collect_ns) {
  assert(static_cast<int>(buses.size()) == bus_count_);
  for (std::size_t i = 0; i < buses.size(); ++i) sides_[i].bus = buses[i];
  for (int i = 0; i < layout.joint_count; ++i) {
    ++sides_[static_cast<std::size_t>(layout.drives[static_cast<std::size_t>(i)].bus)].joints;
  }
  device.set_tap(this);
}

bool CanBridge::Side::sync_waits() const noexcept { return count > 0 && inbox[first].id == hal::canopen::kCobSync; }

bool CanBridge::Side::torque_waits() const noexcept {
  return count > 0 && inbox[first].id > hal::canopen::kCobRpdo1 && inbox[first].id < hal::canopen::kCobRpdo1 + 0x80;
}

/// Passes the oldest frame of a bus to the device. If the device's queue is full the frame is lost, as in a slow node.
void CanBridge::hand_over(int bus) noexcept {
  Side& side = sides_[static_cast<std::size_t>(bus)];
  if (side.torque_waits()) ++side.torques;
  (void)device_.bus(bus).send(side.inbox[side.first]);
  side.first = (side.first + 1) % kInbox;
  --side.count;
}

void CanBridge::read() noexcept {
  hal::ReceivedFrame received;
  for (Side& side : sides()) {
    while (side.bus->receive(received)) {
      if (received.own || is_of_node(received.frame.id)) continue;
      ++counters_.received;
      if (side.count == kInbox) {
        ++counters_.dropped;
      } else {
        side.inbox[(side.first + side.count++) % kInbox] = received.frame;
      }
    }
  }
}

/// Passes frames that follow SYNC before any torque: the controller handed them over right after SYNC.
void CanBridge::pass_on_behind_sync() noexcept {
  for (int i = 0; i < bus_count_; ++i) {
    const Side& side = sides_[static_cast<std::size_t>(i)];
    while (side.synced && side.count > 0 && !side.sync_waits() && !side.torque_waits()) hand_over(i);
  }
}

/// Passes frames that do not begin a cycle. A SYNC that arrives after its cycle has begun without it belongs to that
/// cycle.
void CanBridge::pass_on(std::int64_t now_ns) noexcept {
  if (in_step_) {
    if (device_.now_ns() < begin_ns_ + collect_ns_) pass_on_behind_sync();
    const bool waits = std::any_of(sides_.begin(), sides_.begin() + bus_count_,
                                   [](const Side& side) { return side.count > 0 && !side.sync_waits(); });
    if (waits) {
      collect();
      device_.advance_to(begin_ns_ + std::max(collect_ns_, now_ns - begin_clock_ns_ - compute_ns_));
    }
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

/// True if the next cycle may begin: all buses have its SYNC, or the time for the missing ones is over.
bool CanBridge::sync_is_there(std::int64_t now_ns) noexcept {
  const auto waits = [](const Side& side) { return side.sync_waits(); };
  const auto all = sides();
  if (!std::any_of(all.begin(), all.end(), waits)) return false;
  if (first_sync_ns_ < 0) first_sync_ns_ = now_ns;
  return std::all_of(all.begin(), all.end(), waits) || now_ns - first_sync_ns_ >= period_ns_ / 20;
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
  drain();
  for (int i = 0; i < bus_count_; ++i) {
    Side& side = sides_[static_cast<std::size_t>(i)];
    side.synced = side.sync_waits();
    side.sampled = false;
    side.torques = 0;
    if (side.synced) hand_over(i);
  }
  pass_on_behind_sync();
  const auto samples = [](const Side& side) { return side.synced && !side.sampled; };
  while (device_.now_ns() < begin_ns_ + collect_ns_ && std::ranges::any_of(sides(), samples)) {
    device_.advance_to_event(begin_ns_ + collect_ns_);
  }
}

/// Advances from the samples to the time at which the controller takes them.
void CanBridge::collect() noexcept {
  if (device_.now_ns() >= begin_ns_ + collect_ns_) return;
  device_.advance_to(begin_ns_ + collect_ns_);
  drain();
}

bool CanBridge::has_all_torques() const noexcept {
  return std::all_of(sides_.begin(), sides_.begin() + bus_count_,
                     [](const Side& side) { return side.torques >= side.joints; });
}

void CanBridge::follow_clock(std::int64_t now_ns) noexcept {
  if (in_step_ && now_ns - begin_clock_ns_ <= 2 * period_ns_) return;
  if (in_step_) ++counters_.left_alone;
  in_step_ = false;
  device_.advance_to(begin_ns_ + (now_ns - begin_clock_ns_));
  drain();
}

/// Empties the device's own ends: their frames were passed on when the nodes handed them over.
void CanBridge::drain() noexcept {
  hal::ReceivedFrame received;
  for (int i = 0; i < bus_count_; ++i) {
    while (device_.bus(i).receive(received)) {
    }
  }
}

void CanBridge::on_frame(int bus, const hal::ReceivedFrame& received) noexcept {
  Side& side = sides_[static_cast<std::size_t>(bus)];
  if (received.own) {
    if (received.frame.id == hal::canopen::kCobSync) side.sampled = true;
    return;
  }
  ++counters_.forwarded;
  if (side.bus->send(received.frame) != hal::SendResult::kSent) ++counters_.not_sent;
}

std::int64_t CanBridge::poll(std::int64_t now_ns) noexcept {
  if (!started_) {
    started_ = true;
    begin_ns_ = device_.now_ns();
    begin_clock_ns_ = now_ns / period_ns_ * period_ns_;
  }
  read();
  read();  // now also frames that were sent on one bus before a SYNC on another
  const bool begins =
      std::any_of(sides_.begin(), sides_.begin() + bus_count_, [](const Side& side) { return side.sync_waits(); });
  if (!in_step_ && !begins) follow_clock(now_ns);
  pass_on(now_ns);
  if (sync_is_there(now_ns)) {
    begin_cycle();
    return now_ns;  // frames may have arrived meanwhile
  }
  if (in_step_) {
    collect();
    if (has_all_torques()) device_.advance_to(begin_ns_ + period_ns_);
  }
  follow_clock(now_ns);
  if (!in_step_) {
    // to shortly before the next possible SYNC, so that little time is left to simulate then
    const std::int64_t fifth_ns = period_ns_ / 5;
    const std::int64_t since_ns = now_ns - begin_clock_ns_ + fifth_ns / 2;
    return now_ns + fifth_ns - since_ns % fifth_ns;
  }
  const std::int64_t left_alone_ns = begin_clock_ns_ + 2 * period_ns_ + 1;
  return first_sync_ns_ < 0 ? left_alone_ns : std::min(left_alone_ns, first_sync_ns_ + period_ns_ / 20);
}

}  // namespace godobject::sim
