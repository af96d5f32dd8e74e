#include "sim/loopback_bus.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "hal/canopen/object_numbers.h"
#include "sim/index.h"

namespace godobject::sim {

std::int64_t frame_ns(const hal::BusLayout& layout, const hal::CanFrame& frame) noexcept {
  const int n = frame.length;
  const double seconds = frame.fd ? 34.0 / layout.bit_rate + ((n > 16 ? 38 : 33) + 10 * n) / layout.data_rate
                                  : (55 + 10 * n) / layout.bit_rate;
  return std::llround(1e9 * seconds);
}

bool LoopbackBus::hand_over(int end, const hal::CanFrame& frame, std::int64_t ready_ns) noexcept {
  assert(end >= 0 && end < kEnds);
  Queue& queue = queues_[at(end)];
  if (queue.count == kQueue) return false;
  Queued& last = queue.frames[at((queue.first + queue.count++) % kQueue)];
  last = {frame, ready_ns};
  last.frame.fd = frame.fd || (layout_.fd && layout_.fd_services);
  return true;
}

void LoopbackBus::clear(int end) noexcept { queues_[at(end)].count = 0; }

void LoopbackBus::arbitrate(std::int64_t now_ns) noexcept {
  if (busy_) return;
  int winner = -1;
  for (int i = 0; i < kEnds; ++i) {
    const Queue& queue = queues_[at(i)];
    if (queue.count == 0 || queue.head().ready_ns > now_ns) continue;
    if (winner < 0 || queue.head().frame.id < queues_[at(winner)].head().frame.id) winner = i;
  }
  if (winner < 0) return;
  Queue& queue = queues_[at(winner)];
  const std::int64_t takes_ns = frame_ns(layout_, queue.head().frame);
  on_wire_ = {queue.head().frame, winner, now_ns + takes_ns};
  queue.first = (queue.first + 1) % kQueue;
  --queue.count;
  busy_ = true;
  busy_ns_ += takes_ns;
}

std::int64_t LoopbackBus::next_ns() const noexcept {
  if (busy_) return on_wire_.end_ns;
  std::int64_t next = kNever;
  for (const Queue& queue : queues_) {
    if (queue.count > 0) next = std::min(next, queue.head().ready_ns);
  }
  return next;
}

bool LoopbackBus::take(std::int64_t now_ns, WireFrame& ended) noexcept {
  if (!busy_ || on_wire_.end_ns > now_ns) return false;
  ended = on_wire_;
  busy_ = false;
  return true;
}

hal::SendResult LoopbackEnd::send(const hal::CanFrame& frame) noexcept {
  if (health_.down) return hal::SendResult::kDown;
  if (full_) return hal::SendResult::kFull;
  if (health_.bus_off) return hal::SendResult::kSent;  // handed over, but never on the wire
  const bool computed = frame.id > hal::canopen::kCobRpdo1 && frame.id < hal::canopen::kCobTpdo2;
  const std::int64_t ready_ns = now_ns_ + (computed ? compute_ns_ : 0);
  return bus_.hand_over(end_, frame, ready_ns) ? hal::SendResult::kSent : hal::SendResult::kFull;
}

bool LoopbackEnd::receive(hal::ReceivedFrame& received) noexcept {
  if (count_ == 0) return false;
  received = received_[first_];
  first_ = (first_ + 1) % kReceiveQueue;
  --count_;
  return true;
}

void LoopbackEnd::deliver(const WireFrame& ended) noexcept {
  if (health_.down || health_.bus_off) return;
  if (count_ == kReceiveQueue) {
    ++health_.dropped;
    return;
  }
  received_[(first_ + count_) % kReceiveQueue] = {ended.frame, ended.end_ns, ended.end == end_};
  ++count_;
}

void LoopbackEnd::set_down(bool down) noexcept {
  health_.down = down;
  if (down) bus_.clear(end_);
  if (!down) health_.bus_off = false;
}

void LoopbackEnd::set_bus_off() noexcept {
  health_.bus_off = true;
  bus_.clear(end_);
}

}  // namespace godobject::sim
