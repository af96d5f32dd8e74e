#include "sim/direct_drives.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "sim/index.h"

namespace godobject::sim {

DirectDrives::DirectDrives(Plant& plant, std::span<const JointHardwareParameters> joints, const DriveTiming& timing,
                           std::span<const DriveFault> script) noexcept
    : plant_(plant), timing_(timing), script_(script) {
  assert(plant.now_ns() == 0 && static_cast<int>(joints.size()) >= plant.joint_count());
  assert(timing.collect_ns < timing.period_ns);
  assert(timing.period_ns > 0 && timing.delay_ns >= 0 && timing.delay_ns <= 8 * timing.period_ns);
  sampled_.fill(-1);
  delivered_.fill(-1);
  for (int i = 0; i < joint_count(); ++i) {
    assert(timing.sampled_ns[at(i)] >= 0 && timing.sampled_ns[at(i)] <= timing.collect_ns);
    assert(timing.acts_ns[at(i)] >= 0 && timing.acts_ns[at(i)] < timing.period_ns);
    hardware_[at(i)] = JointHardware(joints[at(i)]);
    counter_[at(i)] = joints[at(i)].counter_at_zero;
  }
  begin_cycle();
  sample_due();
}

double DirectDrives::delay() const noexcept {
  std::int64_t longest_ns = 0;
  for (int i = 0; i < joint_count(); ++i) {
    longest_ns = std::max(longest_ns, timing_.delay_ns + timing_.acts_ns[at(i)] - timing_.sampled_ns[at(i)]);
  }
  return 1e-9 * static_cast<double>(longest_ns);
}

const DriveFault* DirectDrives::fault(FaultKind kind, int joint) const noexcept {
  return find_fault(script_, kind, joint, cycle());
}

/// The position by differences of the counter, which a wrap does not disturb. A count is the beginning of its step, as
/// behind a bus.
double DirectDrives::read_position(int i) noexcept {
  const JointHardware& joint = hardware_[at(i)];
  const double q = plant_.positions()[i];
  const double step = joint.parameters().encoder_step;
  if (!(step > 0.0)) return q;
  const std::int32_t now = joint.counter(q);
  counts_[at(i)] +=
      static_cast<std::int32_t>(static_cast<std::uint32_t>(now) - static_cast<std::uint32_t>(counter_[at(i)]));
  counter_[at(i)] = now;
  return step * static_cast<double>(counts_[at(i)]);
}

void DirectDrives::begin_cycle() noexcept {
  if (now_ns() >= timing_.enable_ns && now_ns() - timing_.period_ns < timing_.enable_ns) enable_switch_ = true;
  for (int i = 0; i < joint_count(); ++i) {
    JointHardware& joint = hardware_[at(i)];
    joint.set_supply(fault(FaultKind::kSupplyLost, i) == nullptr, now_ns());
    if (fault(FaultKind::kDriveTrips, i) != nullptr) joint.trip(now_ns());
    if (fault(FaultKind::kDriveDisabled, i) != nullptr) joint.disable(now_ns());
  }
}

void DirectDrives::sample_due() noexcept {
  for (int i = 0; i < joint_count(); ++i) {
    if (sampled_[at(i)] < cycle() && now_ns() >= cycle() * timing_.period_ns + timing_.sampled_ns[at(i)]) sample(i);
  }
}

void DirectDrives::sample(int i) noexcept {
  const std::int64_t k = cycle();
  Sample& sample = samples_[at(k % kHistory)];
  const Sample& before = samples_[at((k + kHistory - 1) % kHistory)];
  sample.position[i] = read_position(i);
  const DriveFault* stuck = fault(FaultKind::kEncoderStuck, i);
  if (stuck != nullptr && k > stuck->first_cycle) sample.position[i] = before.position[i];
  if (const DriveFault* jump = fault(FaultKind::kEncoderJump, i)) sample.position[i] += jump->value;
  if (fault(FaultKind::kEncoderNotFinite, i) != nullptr) {
    sample.position[i] = std::numeric_limits<double>::quiet_NaN();
  }
  sample.torque[i] = hardware_[at(i)].measured_torque();
  sample.state[at(i)] = hardware_[at(i)].state();
  sampled_[at(i)] = k;
}

void DirectDrives::receive(hal::JointReading& reading) noexcept {
  const std::int64_t k = cycle();
  for (int i = 0; i < joint_count(); ++i) {
    const DriveFault* late = fault(FaultKind::kReadingLate, i);
    const std::int64_t age = late == nullptr ? 0 : static_cast<std::int64_t>(late->value);
    const std::int64_t newest = sampled_[at(i)] - std::clamp<std::int64_t>(age, 0, kHistory - 1);
    const Sample& sample = samples_[at(std::max<std::int64_t>(newest, 0) % kHistory)];
    const bool answers = sample.state[at(i)] != hal::DriveState::kUnavailable;
    if (!answers) last_.state[at(i)] = hal::DriveState::kUnavailable;
    if (newest > delivered_[at(i)] && answers && fault(FaultKind::kReadingLost, i) == nullptr) {
      delivered_[at(i)] = newest;
      last_.position[i] = sample.position[i];
      last_.torque[i] = sample.torque[i];
      last_.state[at(i)] = sample.state[at(i)];
    }
    last_.age[at(i)] = static_cast<std::uint32_t>(k - delivered_[at(i)]);
  }
  last_.emergency_stop = emergency_stop_ || fault(FaultKind::kEmergencyStop, kAllJoints) != nullptr;
  last_.enable_switch = enable_switch_ && fault(FaultKind::kEnableReleased, kAllJoints) == nullptr;
  last_.clutch_open = fault(FaultKind::kClutchOpen, kAllJoints) != nullptr;
  reading = last_;
}

bool DirectDrives::send(const hal::JointCommand& command) noexcept {
  ++counters_.commands;
  // a full history: the new command replaces the newest one
  const bool full = end_pending_ - first_pending_ == kHistory;
  Pending& pending = pending_[at((full ? end_pending_ - 1 : end_pending_) % kHistory)];
  if (!full) ++end_pending_;
  pending.command = command;
  bool sent = true;
  for (int i = 0; i < joint_count(); ++i) {
    double& torque = pending.command.torque[i];
    if (!std::isfinite(torque)) {
      ++counters_.not_finite;
      torque = 0.0;
    }
    const bool fails = fault(FaultKind::kSendFails, i) != nullptr;
    const bool dropped = fails || fault(FaultKind::kCommandLost, i) != nullptr;
    if (dropped) ++counters_.dropped;
    pending.waits[at(i)] = !dropped;
    pending.at_ns[at(i)] = std::max(now_ns(), cycle() * timing_.period_ns + timing_.delay_ns + timing_.acts_ns[at(i)]);
    if (fails) sent = false;
  }
  return sent;
}

void DirectDrives::apply_commands() noexcept {
  for (std::int64_t k = first_pending_; k < end_pending_; ++k) {
    Pending& pending = pending_[at(k % kHistory)];
    bool waits = false;
    for (int i = 0; i < joint_count(); ++i) {
      if (!pending.waits[at(i)]) continue;
      if (pending.at_ns[at(i)] > now_ns()) {
        waits = true;
        continue;
      }
      pending.waits[at(i)] = false;
      double torque = pending.command.torque[i];
      if (const DriveFault* const limit = fault(FaultKind::kTorqueLimited, i); limit != nullptr) {
        torque = std::clamp(torque, -limit->value, limit->value);
      }
      hardware_[at(i)].command(pending.command.power, torque, now_ns());
    }
    if (!waits && k == first_pending_) ++first_pending_;
  }
}

/// Time of the next event: a command arrives, or a joint is sampled.
std::int64_t DirectDrives::next_event_ns() const noexcept {
  std::int64_t next_ns = std::numeric_limits<std::int64_t>::max();
  for (int i = 0; i < joint_count(); ++i) {
    const std::int64_t sample_ns = (sampled_[at(i)] + 1) * timing_.period_ns + timing_.sampled_ns[at(i)];
    next_ns = std::min(next_ns, sample_ns);
    for (std::int64_t k = first_pending_; k < end_pending_; ++k) {
      const Pending& pending = pending_[at(k % kHistory)];
      if (pending.waits[at(i)]) next_ns = std::min(next_ns, pending.at_ns[at(i)]);
    }
  }
  return next_ns;
}

/// Advances the plant to `ns` in equal steps; no event is due before.
void DirectDrives::run_to(std::int64_t ns) noexcept {
  const std::int64_t begin_ns = now_ns();
  const std::int64_t steps = (ns - begin_ns + Plant::kStep_ns - 1) / Plant::kStep_ns;
  for (std::int64_t step = 1; step <= steps; ++step) {
    JointLoad load;
    for (int i = 0; i < joint_count(); ++i) {
      hardware_[at(i)].update(now_ns(), plant_.positions()[i], plant_.velocities()[i]);
      load.motor[i] = hardware_[at(i)].motor_torque();
      load.brake[i] = hardware_[at(i)].brake_torque();
    }
    plant_.step(begin_ns + (ns - begin_ns) * step / steps - now_ns(), load);
  }
}

void DirectDrives::advance_to(std::int64_t ns) noexcept {
  while (now_ns() < ns) {
    const std::int64_t next_cycle_ns = (cycle() + 1) * timing_.period_ns;
    apply_commands();
    run_to(std::min({ns, next_cycle_ns, next_event_ns()}));
    if (now_ns() == next_cycle_ns) begin_cycle();
    sample_due();
  }
}

}  // namespace godobject::sim
