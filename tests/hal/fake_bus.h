#pragma once

#include <deque>
#include <vector>

#include "hal/can_bus.h"

namespace godobject::hal {

/// A bus on which a test puts the frames: what is sent is kept and, unless told otherwise, comes back as an own frame.
class FakeBus final : public CanBus {
 public:
  SendResult send(const CanFrame& frame) noexcept override {
    if (result != SendResult::kSent) return result;
    sent.push_back(frame);
    if (echoes) receive_next(frame, true);
    return SendResult::kSent;
  }

  bool receive(ReceivedFrame& received) noexcept override {
    if (waiting.empty()) return false;
    received = waiting.front();
    waiting.pop_front();
    return true;
  }

  BusHealth health() const noexcept override { return state; }

  void receive_next(const CanFrame& frame, bool own = false) { waiting.push_back({frame, time_ns += 100'000, own}); }

  std::vector<CanFrame> take_sent() {
    std::vector<CanFrame> taken;
    taken.swap(sent);
    return taken;
  }

  std::deque<ReceivedFrame> waiting;
  std::vector<CanFrame> sent;
  SendResult result = SendResult::kSent;
  bool echoes = true;
  BusHealth state;
  std::int64_t time_ns = 0;
};

}  // namespace godobject::hal
