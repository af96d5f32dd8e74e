#include "sim/can_device.h"

#include <algorithm>
#include <cmath>

namespace godobject::sim {
namespace {

constexpr std::size_t at(int i) noexcept { return static_cast<std::size_t>(i); }

}  // namespace

CanDevice::CanDevice(Plant& plant, const hal::BusLayout& layout, std::span<const JointHardwareParameters> joints,
                     const CanScript& script, std::span<const BusFault> faults) noexcept
    : layout_(layout), faults_(faults), nodes_(plant, layout, joints, script) {
  for (int i = 0; i < layout.bus_count; ++i) {
    wires_[at(i)].emplace(layout);
    ends_[at(i)].emplace(*wires_[at(i)], kController, std::llround(1e9 * layout.compute));
  }
  begin_cycle();
}

CanopenNode* CanDevice::find_node(int bus, int node) noexcept {
  for (int i = 0; i < nodes_.node_count(); ++i) {
    if (nodes_.bus_of(i) == bus && nodes_.node(i).number() == node) return &nodes_.node(i);
  }
  return nullptr;
}

/// The faults that are no single frame's.
void CanDevice::begin_cycle() noexcept {
  if (!faults_.empty()) nodes_.settle();
  const std::int64_t cycle = nodes_.cycle();
  for (const BusFault& fault : faults_) {
    LoopbackEnd& end = *ends_[at(fault.bus)];
    const bool begins = fault.begins(cycle);
    const bool ends = cycle == fault.first_cycle + fault.cycles;
    CanopenNode* node = find_node(fault.bus, fault.node);
    switch (fault.kind) {
      case BusFaultKind::kForeignFrame:
        for (int i = 0; fault.is_on(cycle) && i < static_cast<int>(fault.value); ++i) {
          if (!wires_[at(fault.bus)]->hand_over(kForeign, fault.frame, now_ns())) break;
        }
        break;
      case BusFaultKind::kEmergency:
        if (begins && node != nullptr) node->send_emergency(static_cast<std::uint16_t>(fault.value), kGenericError);
        break;
      case BusFaultKind::kNodeReset:
        if (begins && node != nullptr) node->restart(now_ns());
        break;
      case BusFaultKind::kHeartbeatStops:
        if ((begins || ends) && node != nullptr) node->mute_heartbeat(begins);
        break;
      case BusFaultKind::kSdoRefused:
        if ((begins || ends) && node != nullptr) {
          node->refuse_sdo(begins ? static_cast<SdoAbort>(static_cast<std::uint32_t>(fault.value)) : SdoAbort::kNone);
        }
        break;
      case BusFaultKind::kParameterChanged:
        if (begins && node != nullptr)
          node->objects().set(fault.index, fault.sub, static_cast<std::uint32_t>(fault.value));
        break;
      case BusFaultKind::kBusOff:
        if (begins) end.set_bus_off();
        break;
      case BusFaultKind::kInterfaceDown:
        if (begins || ends) end.set_down(begins);
        break;
      case BusFaultKind::kTransmitQueueFull:
        if (begins || ends) end.set_full(begins);
        break;
      default: break;
    }
  }
}

void CanDevice::hold(const Held& held) noexcept {
  for (Held& place : held_) {
    if (place.used) continue;
    place = held;
    place.used = true;
    return;
  }
}

/// A frame whose time has come reaches everybody, as if it had ended now.
void CanDevice::arrive(int bus, const WireFrame& ended) noexcept {
  ends_[at(bus)]->deliver(ended);
  nodes_.receive(bus, ended.frame, ended.end - 1);
}

/// A frame at the end of its way, with what the script does to it.
void CanDevice::spoil(int bus, WireFrame& ended) noexcept {
  bool twice = false;
  for (const BusFault& fault : faults_) {
    if (fault.bus != bus || fault.id != ended.frame.id || !fault.is_on(nodes_.cycle())) continue;
    switch (fault.kind) {
      case BusFaultKind::kFrameDropped:
        if (ended.end == kController) ends_[at(bus)]->deliver(ended);
        return;
      case BusFaultKind::kFrameDelayed: {
        const std::int64_t late_ns = std::llround(fault.value * static_cast<double>(nodes_.period_ns()));
        return hold({.bus = bus, .due_ns = now_ns() + late_ns, .frame = ended});
      }
      case BusFaultKind::kFrameReordered:
        return hold({.until_next = true, .bus = bus, .due_ns = kNever, .frame = ended});
      case BusFaultKind::kFrameDuplicated: twice = true; break;
      case BusFaultKind::kFrameLength: ended.frame.length = static_cast<std::uint8_t>(fault.value); break;
      case BusFaultKind::kFrameReplaced:
        ended.frame.length = fault.frame.length;
        ended.frame.data = fault.frame.data;
        break;
      default: break;
    }
  }
  arrive(bus, ended);
  if (twice) arrive(bus, ended);
  for (Held& held : held_) {
    if (!held.used || !held.until_next || held.bus != bus) continue;
    held.used = false;
    held.frame.end_ns = now_ns();
    arrive(bus, held.frame);
  }
}

void CanDevice::release_due() noexcept {
  for (Held& held : held_) {
    if (!held.used || held.due_ns > now_ns()) continue;
    held.used = false;
    held.frame.end_ns = now_ns();
    arrive(held.bus, held.frame);
  }
}

/// All that nodes have to say goes to their queues.
void CanDevice::take_frames() noexcept {
  hal::CanFrame frame;
  for (int i = 0; i < nodes_.node_count(); ++i) {
    const int bus = nodes_.bus_of(i);
    // a queue that is full keeps what it has: the node is as silent as one that nobody acknowledges
    while (nodes_.node(i).take_frame(frame)) {
      const bool taken = wires_[at(bus)]->hand_over(1 + i, frame, now_ns());
      if (taken && tap_ != nullptr) tap_->on_frame(bus, {frame, now_ns(), false});
    }
  }
}

void CanDevice::end_frames() noexcept {
  WireFrame ended;
  for (int i = 0; i < layout_.bus_count; ++i) {
    ends_[at(i)]->set_now(now_ns());
    while (wires_[at(i)]->take(now_ns(), ended)) {
      if (ended.end == kController && tap_ != nullptr) tap_->on_frame(i, {ended.frame, ended.end_ns, true});
      spoil(i, ended);
    }
  }
}

void CanDevice::advance_to_event(std::int64_t ns) noexcept {
  nodes_.run_timers();
  take_frames();
  std::int64_t next_ns = std::min(ns, nodes_.next_timer_ns());
  for (int i = 0; i < layout_.bus_count; ++i) {
    wires_[at(i)]->arbitrate(now_ns());
    next_ns = std::min(next_ns, wires_[at(i)]->next_ns());
  }
  const std::int64_t next_cycle_ns = (nodes_.cycle() + 1) * nodes_.period_ns();
  next_ns = std::min(next_ns, next_cycle_ns);
  for (const Held& held : held_) {
    if (held.used) next_ns = std::min(next_ns, held.due_ns);
  }
  nodes_.pass_to(next_ns);
  end_frames();
  release_due();
  if (now_ns() == next_cycle_ns) begin_cycle();
  take_frames();
}

void CanDevice::advance_to(std::int64_t ns) noexcept {
  while (now_ns() < ns) advance_to_event(ns);
  nodes_.settle();
}

}  // namespace godobject::sim
