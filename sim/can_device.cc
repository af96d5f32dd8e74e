#include "sim/can_device.h"

#include <algorithm>
#include <cmath>

namespace godobject::sim {
namespace {

constexpr std::size_t at(int i) noexcept { return static_cast<std::size_t>(i); }

}  // namespace

CanDevice::CanDevice(Plant& plant, const hal::BusLayout& layout, std::span<const JointHardwareParameters> joints,
                     const CanScript& script) noexcept
    : layout_(layout), nodes_(plant, layout, joints, script) {
  for (int i = 0; i < layout.bus_count; ++i) {
    wires_[at(i)].emplace(layout);
    ends_[at(i)].emplace(*wires_[at(i)], kController, std::llround(1e9 * layout.compute));
  }
}

/// All that nodes have to say goes to their queues; idle wires take the next frame.
void CanDevice::start_frames() noexcept {
  hal::CanFrame frame;
  for (int i = 0; i < nodes_.node_count(); ++i) {
    // a queue that is full keeps what it has: the node is as silent as one that nobody acknowledges
    while (nodes_.node(i).take_frame(frame)) wires_[at(nodes_.bus_of(i))]->hand_over(1 + i, frame, now_ns());
  }
  for (int i = 0; i < layout_.bus_count; ++i) wires_[at(i)]->arbitrate(now_ns());
}

void CanDevice::end_frames() noexcept {
  WireFrame ended;
  for (int i = 0; i < layout_.bus_count; ++i) {
    ends_[at(i)]->set_now(now_ns());
    while (wires_[at(i)]->take(now_ns(), ended)) {
      ends_[at(i)]->deliver(ended);
      nodes_.receive(i, ended.frame, ended.end - 1);
    }
  }
}

void CanDevice::advance_to(std::int64_t ns) noexcept {
  while (now_ns() < ns) {
    nodes_.run_timers();
    start_frames();
    std::int64_t next_ns = std::min(ns, nodes_.next_timer_ns());
    for (int i = 0; i < layout_.bus_count; ++i) next_ns = std::min(next_ns, wires_[at(i)]->next_ns());
    nodes_.step_to(next_ns);
    end_frames();
  }
}

}  // namespace godobject::sim
