#include "firmware/drives/cia402/commissioning.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "firmware/cycle/cycles_in.h"
#include "firmware/drives/cia402/bus_messages.h"
#include "hal/canopen/emergency.h"
#include "hal/canopen/network.h"
#include "hal/canopen/sdo.h"
#include "hal/cia402/read_object.h"
#include "toolchain/command_line/failure.h"

namespace godobject::firmware {
namespace {

using command::ExitCode;
using command::Failure;

constexpr std::int64_t kMillisecond_ns = 1'000'000;
/// Time until all drives must answer [ms]. Chosen: 25 times that of the probe after a start (CanDrives).
constexpr int kSettle_ms = 200;
/// Time until a drive must have left its fault [ms]. Chosen: half of it with a reset, which takes some 16 ms
/// (JointChannel), half for the drive's own transitions.
constexpr int kRecover_ms = 1000;

/// Writes a mode. Returns the milliseconds until the write was confirmed and TPDO2 showed the mode. None: not within
/// half a second, or the write was refused.
std::optional<int> set_mode(hal::CanBus& bus, hal::Clock& clock, int node, std::int8_t mode, bool& refused) {
  using namespace hal::canopen;
  constexpr int kWait_ms = 500;
  if (bus.send(sdo_write(node, kMode, 0, static_cast<std::uint8_t>(mode), 1)) != hal::SendResult::kSent) return {};
  bool written = false;
  bool told = false;
  for (int ms = 0; ms < kWait_ms; ++ms) {
    hal::ReceivedFrame received;
    SdoResponse response;
    while (bus.receive(received)) {
      const hal::CanFrame& frame = received.frame;
      if (frame.id == cob(kCobTpdo2, node)) told = frame.length == 1 && static_cast<std::int8_t>(frame.data[0]) == mode;
      if (!parse_sdo_response(frame, response) || response.node != node || response.index != kMode) continue;
      refused = response.kind == SdoResponse::Kind::kAborted;
      if (refused) return {};
      written = true;
    }
    if (written && told) return ms;
    clock.sleep_until(clock.now_ns() + kMillisecond_ns);
  }
  return {};
}

void try_mode(hal::CanBus& bus, hal::Clock& clock, int node, JointTrial& trial) {
  bool back_refused = false;
  const std::optional<int> away = set_mode(bus, clock, node, 0, trial.mode_refused);
  const std::optional<int> back = set_mode(bus, clock, node, hal::canopen::kModeTorque, back_refused);
  if (away && back) trial.mode_after_ms = std::max(*away, *back);
}

/// Runs cycles without power.
class IdleCycles {
 public:
  /// `period`: T [s].
  IdleCycles(hal::CanDrives& drives, hal::Clock& clock, double period, const std::atomic<bool>& end)
      : drives_(drives),
        clock_(clock),
        period_ns_(std::llround(1e9 * period)),
        end_(end),
        next_ns_(clock.now_ns() / period_ns_ * period_ns_) {}

  /// Returns the cycles within a time; where a period is long, at least a quarter of those at 1 ms.
  std::uint32_t within(int ms) const {
    const auto least = static_cast<std::uint32_t>(ms) / 4;
    return cycles_in(1e-3 * ms, 1e-9 * static_cast<double>(period_ns_), least);
  }

  const hal::JointReading& run(hal::PowerRequest power) {
    if (end_.load(std::memory_order_relaxed)) {
      throw Failure(ExitCode::kUnavailable, "ended before all joints were tested; run it again");
    }
    next_ns_ += period_ns_;
    if (clock_.now_ns() > next_ns_ + period_ns_) next_ns_ = clock_.now_ns();
    clock_.sleep_until(next_ns_);
    drives_.request();
    clock_.sleep_until(next_ns_ + drives_.collect_ns());
    drives_.receive(reading_);
    drives_.send({JointVector::Zero(), power});
    return reading_;
  }

 private:
  hal::CanDrives& drives_;
  hal::Clock& clock_;
  std::int64_t period_ns_;
  const std::atomic<bool>& end_;
  std::int64_t next_ns_;
  hal::JointReading reading_;
};

Failure alarm_of(const hal::CanDrives& drives, const std::vector<std::string>& names) {
  return Failure(ExitCode::kUnavailable, explain(drives.alarm_detail(), names));
}

/// Waits until all drives answer; then none may have an alarm.
void settle(IdleCycles& cycles, const hal::CanDrives& drives, const std::vector<std::string>& names) {
  const hal::JointReading* reading = nullptr;
  for (std::uint32_t k = 0; k < cycles.within(kSettle_ms); ++k) reading = &cycles.run(hal::PowerRequest::kOff);
  if (reading->alarm != hal::Alarm::kNone) throw alarm_of(drives, names);
  for (int i = 0; i < drives.joint_count(); ++i) {
    if (reading->state[static_cast<std::size_t>(i)] == hal::DriveState::kOff) continue;
    throw Failure(ExitCode::kUnavailable,
                  fmt::format("joint {}: the drive is not off before the test; reset it with its own tool", i + 1));
  }
}

void recover(IdleCycles& cycles, const hal::CanDrives& drives, int joint, const std::vector<std::string>& names) {
  const std::uint32_t most = cycles.within(kRecover_ms);
  for (std::uint32_t k = 0; k < most; ++k) {
    const hal::JointReading& reading = cycles.run(k < most / 2 ? hal::PowerRequest::kReset : hal::PowerRequest::kOff);
    const bool off = reading.state[static_cast<std::size_t>(joint)] == hal::DriveState::kOff;
    if (k > 2 && off && reading.alarm == hal::Alarm::kNone) return;
  }
  throw alarm_of(drives, names);
}

void try_deadline(IdleCycles& cycles, hal::CanDrives& drives, int joint, const hal::BusLayout& layout,
                  const std::vector<std::string>& names, JointTrial& trial) {
  const hal::JointReading& before = cycles.run(hal::PowerRequest::kOff);
  trial.position = before.position[joint];
  drives.withhold(joint);
  const std::uint32_t deadline = cycles_in(layout.command_deadline, layout.period);
  const std::uint32_t most = deadline + cycles_in(1e-3 * kPatience_ms, layout.period);
  std::uint32_t after = 0;
  for (std::uint32_t k = 1; k <= most && after == 0; ++k) {
    const hal::JointReading& reading = cycles.run(hal::PowerRequest::kOff);
    const hal::cia402::AlarmDetail& alarm = drives.alarm_detail();
    if (alarm.alarm != hal::Alarm::kNone) {
      if (alarm.alarm != hal::Alarm::kDriveError || alarm.joint != joint) throw alarm_of(drives, names);
      trial.emergency = static_cast<std::uint16_t>(alarm.found);
    }
    trial.fault = reading.state[static_cast<std::size_t>(joint)] == hal::DriveState::kFault;
    if (trial.fault || trial.emergency != 0) after = k;
  }
  if (after > 0) trial.after_ms = static_cast<int>(std::lround(1e3 * layout.period * after));
  drives.withhold(-1);
  const bool is_it = trial.fault || trial.emergency == hal::canopen::kRpdoTimeout;
  trial.in_time = is_it && after <= deadline + cycles_in(1e-3 * kSeenAfter_ms, layout.period, 2);
  recover(cycles, drives, joint, names);
}

std::string seen(const JointTrial& trial) {
  if (trial.after_ms < 0) return "nothing";
  std::string what = trial.emergency != 0 ? fmt::format("emergency {:04X}", trial.emergency) : "";
  if (trial.fault) what += what.empty() ? "fault" : ", fault";
  return fmt::format("{} after {} ms", what, trial.after_ms);
}

std::string mode_told(const JointTrial& trial) {
  if (trial.mode_refused) return "refused";
  return trial.mode_after_ms < 0 ? "no" : fmt::format("{} ms", trial.mode_after_ms);
}

std::string hex(const std::optional<std::uint32_t>& value) { return value ? fmt::format("{:08X}", *value) : "-"; }

}  // namespace

std::vector<JointTrial> try_drives(hal::CanDrives& drives, const hal::BusLayout& layout,
                                   std::span<hal::CanBus* const> buses, hal::Clock& clock,
                                   const std::vector<std::string>& names, const std::atomic<bool>& end) {
  std::vector<JointTrial> trials(static_cast<std::size_t>(layout.joint_count));
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const hal::DriveConfig& drive = layout.drives[i];
    const auto read = [&](std::uint16_t index, std::uint8_t subindex) -> std::optional<std::uint32_t> {
      std::uint32_t value = 0;
      hal::CanBus& bus = *buses[static_cast<std::size_t>(drive.bus)];
      if (!read_object(bus, clock, drive.node, index, subindex, value)) return std::nullopt;
      return value;
    };
    trials[i].device_type = read(hal::canopen::kDeviceType, 0);
    for (const hal::IdentityField& field : hal::kIdentityFields) {
      trials[i].identity.*field.value = read(hal::canopen::kIdentity, field.subindex);
    }
    trials[i].rated_torque = read(hal::canopen::kMotorRatedTorque, 0);
    try_mode(*buses[static_cast<std::size_t>(drive.bus)], clock, drive.node, trials[i]);
  }
  IdleCycles cycles(drives, clock, layout.period, end);
  settle(cycles, drives, names);
  for (std::size_t i = 0; i < trials.size(); ++i) {
    try_deadline(cycles, drives, static_cast<int>(i), layout, names, trials[i]);
  }
  return trials;
}

std::string trial_table(const hal::BusLayout& layout, std::span<const JointTrial> trials) {
  std::string text =
      "joint bus node     type   vendor  product rated Nm sign     zero position  mode told  expected within  seen\n";
  auto out = std::back_inserter(text);
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const hal::DriveConfig& drive = layout.drives[i];
    const JointTrial& trial = trials[i];
    fmt::format_to(out, "{:>5} {:>3} {:>4} {:>8} {:>8} {:>8} {:>8} {:>4} {:>8.4f} {:>8.4f} {:>10} {:>13g} ms  {}\n",
                   i + 1, drive.bus, drive.node, hex(trial.device_type), hex(trial.identity.vendor),
                   hex(trial.identity.product),
                   trial.rated_torque ? fmt::format("{:.4g}", 1e-3 * *trial.rated_torque) : "-", drive.sign, drive.zero,
                   trial.position, mode_told(trial), 1e3 * layout.command_deadline, seen(trial));
  }
  return text;
}

std::string identity_keys(const hal::BusLayout& layout, std::span<const JointTrial> trials) {
  std::string text;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    std::vector<std::string> keys;
    for (const hal::IdentityField& field : hal::kIdentityFields) {
      const std::optional<std::uint32_t>& value = trials[i].identity.*field.value;
      const bool is_serial = field.value == &hal::DriveIdentity::serial;
      if (value) keys.push_back(fmt::format(fmt::runtime(is_serial ? "{} = {}" : "{} = 0x{:X}"), field.name, *value));
    }
    fmt::format_to(std::back_inserter(text), "identity = {{ {} }}  # joint {}: bus {}, node {}\n",
                   fmt::join(keys, ", "), i + 1, layout.drives[i].bus, layout.drives[i].node);
  }
  return text;
}

std::string trial_objection(std::span<const JointTrial> trials) {
  const auto joints_without = [trials](auto&& good) {
    std::vector<std::size_t> joints;
    for (std::size_t i = 0; i < trials.size(); ++i) {
      if (!good(trials[i])) joints.push_back(i + 1);
    }
    return fmt::format("{}", fmt::join(joints, ", "));
  };
  const std::string untold = joints_without([](const JointTrial& trial) {
    return trial.mode_refused || (trial.mode_after_ms >= 0 && trial.mode_after_ms <= kModeAtOnce_ms);
  });
  const std::string late = joints_without([](const JointTrial& trial) { return trial.in_time; });
  std::string text;
  if (!late.empty()) {
    text = fmt::format(
        "joint {}: neither emergency 8250 nor a fault in time after the last RPDO; a drive that watches 1400:5 in "
        "operation enabled only must be tested there, before a person holds the arm: see Commissioning in "
        "firmware/README.md",
        late);
  }
  if (!untold.empty()) {
    if (!text.empty()) text += "; ";
    text += fmt::format(
        "joint {}: TPDO2 does not show a change of mode at once, so the controller would notice it only within a "
        "second; "
        "this drive cannot be used",
        untold);
  }
  return text;
}

}  // namespace godobject::firmware
