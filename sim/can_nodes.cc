#include "sim/can_nodes.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/index.h"
#include "sim/virtual_clock.h"

namespace godobject::sim {

CanNodes::CanNodes(Plant& plant, const hal::BusLayout& layout, std::span<const JointHardwareParameters> joints,
                   const CanScript& script) noexcept
    : plant_(plant),
      layout_(layout),
      script_(script),
      period_ns_(std::llround(1e9 * layout.period)),
      joint_count_(layout.joint_count) {
  assert(plant.now_ns() == 0 && plant.joint_count() == joint_count_);
  assert(static_cast<int>(joints.size()) >= joint_count_ && period_ns_ > 0);
  for (int i = 0; i < joint_count_; ++i) {
    drives_[at(i)].emplace(layout.drives[at(i)], joints[at(i)], layout.fd);
    moved_[at(i)] = i;
  }
  if (layout.panel.bus >= 0) panel_.emplace(layout.panel, layout.fd);
  for (int i = 0; i < node_count(); ++i) {
    node(i).set_answer(std::llround(1e9 * layout.answer));
    node(i).set_supply(true, 0);
  }
  begin_cycle();
  update_drives();
}

CanopenNode& CanNodes::node(int i) noexcept {
  if (i == joint_count_) return *panel_;
  return *drives_[at(i)];
}

const CanopenNode& CanNodes::node(int i) const noexcept {
  if (i == joint_count_) return *panel_;
  return *drives_[at(i)];
}

int CanNodes::bus_of(int i) const noexcept { return i == joint_count_ ? layout_.panel.bus : layout_.drives[at(i)].bus; }

void CanNodes::swap_drives(int i, int j) noexcept {
  const auto identity = [this](int joint) {
    hal::DriveIdentity all;
    for (const hal::IdentityField& field : hal::kIdentityFields) {
      all.*field.value = drive(joint).objects().value(hal::canopen::kIdentity, field.subindex);
    }
    return all;
  };
  const hal::DriveIdentity of_i = identity(i);
  drive(i).set_identity(identity(j));
  drive(j).set_identity(of_i);
  std::swap(moved_[at(i)], moved_[at(j)]);
  update_drives();
}

void CanNodes::begin_cycle() noexcept {
  const auto fault = [this](FaultKind kind, int joint) { return find_fault(script_.faults, kind, joint, cycle()); };
  for (int i = 0; i < joint_count_; ++i) {
    Cia402Slave& drive = *drives_[at(i)];
    drive.set_supply(fault(FaultKind::kSupplyLost, i) == nullptr, now_ns());
    if (fault(FaultKind::kDriveTrips, i) != nullptr) drive.trip(kOverCurrent, now_ns());
    if (fault(FaultKind::kDriveDisabled, i) != nullptr) drive.disable(now_ns());
    const DriveFault* slip = fault(FaultKind::kModeSlips, i);
    drive.slip_mode(slip == nullptr ? hal::canopen::kModeTorque : static_cast<std::int8_t>(slip->value));
    const DriveFault* heat = fault(FaultKind::kTemperature, i);
    if (heat != nullptr) drive.set_temperature(heat->value);
    const DriveFault* limit = fault(FaultKind::kTorqueLimited, i);
    drive.set_own_limit(limit == nullptr ? std::numeric_limits<double>::infinity() : limit->value);
    const DriveFault* jump = fault(FaultKind::kEncoderJump, i);
    drive.set_encoder_fault(jump == nullptr ? 0.0 : jump->value, fault(FaultKind::kEncoderStuck, i) != nullptr);
  }
  update_panel();
}

void CanNodes::update_panel() noexcept {
  if (!panel_) return;
  const auto fault = [this](FaultKind kind) {
    return find_fault(script_.faults, kind, kAllJoints, cycle()) != nullptr;
  };
  const bool pressed = emergency_stop_ || fault(FaultKind::kEmergencyStop);
  const bool held = enable_switch_ && now_ns() >= script_.hold_from_ns && !fault(FaultKind::kEnableReleased);
  unsigned inputs = 0;
  if (!pressed) inputs |= hal::canopen::kPanelStopReleased;
  if (held) inputs |= hal::canopen::kPanelEnable;
  if (clutch_ || fault(FaultKind::kClutchOpen)) inputs |= hal::canopen::kPanelClutch;
  panel_->set_inputs(static_cast<std::uint8_t>(inputs));
}

void CanNodes::update_drives() noexcept {
  for (int i = 0; i < joint_count_; ++i) {
    const int joint = moved_[at(i)];
    drives_[at(i)]->update(plant_.now_ns(), plant_.positions()[joint], plant_.velocities()[joint]);
  }
}

void CanNodes::pass_to(std::int64_t ns) noexcept {
  const std::int64_t next_cycle_ns = (cycle() + 1) * period_ns_;
  assert(ns <= next_cycle_ns);
  now_ns_ = ns;
  if (now_ns_ < next_cycle_ns) return;
  if (!script_.faults.empty()) settle();
  begin_cycle();
}

void CanNodes::settle() noexcept {
  const std::int64_t begin_ns = plant_.now_ns();
  const std::int64_t steps = (now_ns_ - begin_ns + Plant::kStep_ns - 1) / Plant::kStep_ns;
  for (std::int64_t step = 1; step <= steps; ++step) {
    update_drives();
    JointLoad load;
    for (int i = 0; i < joint_count_; ++i) {
      load.motor[moved_[at(i)]] = drives_[at(i)]->motor_torque();
      load.brake[moved_[at(i)]] = drives_[at(i)]->brake_torque();
    }
    plant_.step(begin_ns + (now_ns_ - begin_ns) * step / steps - plant_.now_ns(), load);
  }
  update_drives();
}

void CanNodes::receive(int bus, const hal::CanFrame& frame, int sender) noexcept {
  const bool of_node = sender >= 0 && sender < node_count();
  if (!of_node && plant_.now_ns() < now_ns()) settle();
  update_panel();  // the panel reads its switches at the end of SYNC
  for (int i = 0; i < node_count(); ++i) {
    if (i != sender && bus_of(i) == bus) node(i).receive(frame, now_ns());
  }
}

void CanNodes::run_timers() noexcept {
  if (next_timer_ns() > now_ns()) return;
  settle();
  for (int i = 0; i < node_count(); ++i) node(i).run_timers(now_ns());
}

std::int64_t CanNodes::next_timer_ns() const noexcept {
  std::int64_t next = kNever;
  for (int i = 0; i < node_count(); ++i) next = std::min(next, node(i).next_timer_ns());
  return next;
}

}  // namespace godobject::sim
