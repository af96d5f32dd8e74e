#include "sim/can_device.h"

#include <algorithm>
#include <cmath>

#include "sim/index.h"

namespace godobject::sim {

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

/// Applies the faults that are not of a single frame.
void CanDevice::begin_cycle() noexcept {
  if (!faults_.empty()) nodes_.settle();
  for (const BusFault& fault : faults_) {
    apply_to_wire(fault);
    CanopenNode* node = find_node(fault.bus, fault.node);
    if (node != nullptr) apply_to_node(fault, *node);
  }
}

void CanDevice::apply_to_wire(const BusFault& fault) noexcept {
  const std::int64_t cycle = nodes_.cycle();
  LoopbackEnd& end = *ends_[at(fault.bus)];
  const bool begins = fault.begins(cycle);
  const bool changes = begins || fault.ends(cycle);
  switch (fault.kind) {
    case BusFaultKind::kForeignFrame:
      for (int i = 0; fault.is_on(cycle) && i < static_cast<int>(fault.value); ++i) {
        if (!wires_[at(fault.bus)]->hand_over(kForeign, fault.frame, now_ns())) break;
      }
      break;
    case BusFaultKind::kBusOff:
      if (begins) end.set_bus_off();
      break;
    case BusFaultKind::kInterfaceDown:
      if (changes) end.set_down(begins);
      break;
    case BusFaultKind::kTransmitQueueFull:
      if (changes) end.set_full(begins);
      break;
    default: break;
  }
}

void CanDevice::apply_to_node(const BusFault& fault, CanopenNode& node) noexcept {
  const bool begins = fault.begins(nodes_.cycle());
  const bool changes = begins || fault.ends(nodes_.cycle());
  const auto value = static_cast<std::uint32_t>(fault.value);
  switch (fault.kind) {
    case BusFaultKind::kEmergency:
      if (begins) node.send_emergency(static_cast<std::uint16_t>(value), kGenericError);
      break;
    case BusFaultKind::kNodeReset:
      if (begins) node.restart(now_ns());
      break;
    case BusFaultKind::kHeartbeatStops:
      if (changes) node.mute_heartbeat(begins);
      break;
    case BusFaultKind::kSdoRefused:
      if (changes) node.refuse_sdo(begins ? static_cast<SdoAbort>(value) : SdoAbort::kNone, fault.index);
      break;
    case BusFaultKind::kParameterChanged:
      if (begins) node.objects().set(fault.index, fault.sub, value);
      break;
    default: break;
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

/// Delivers a frame to all nodes and the controller, as if it had ended now.
void CanDevice::arrive(int bus, const WireFrame& ended) noexcept {
  ends_[at(bus)]->deliver(ended);
  nodes_.receive(bus, ended.frame, ended.end - 1);
}

/// Delivers a frame that has ended on the wire, with the faults of the script.
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

/// Moves the frames of the nodes to their queues.
void CanDevice::take_frames() noexcept {
  hal::CanFrame frame;
  for (int i = 0; i < nodes_.node_count(); ++i) {
    const int bus = nodes_.bus_of(i);
    // a full queue keeps its frames: the node is silent, as one without acknowledgement
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
