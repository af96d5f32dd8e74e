#include "firmware/commissioning.h"

#include <cmath>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "firmware/bus_messages.h"
#include "firmware/command/failure.h"
#include "hal/canopen/object_numbers.h"
#include "hal/cia402/read_object.h"

namespace godobject::firmware {
namespace {

using command::ExitCode;
using command::Failure;

constexpr std::int64_t kPeriod_ns = 1'000'000;
constexpr int kSettle = 200;    // cycles until all drives answer
constexpr int kRecover = 1000;  // cycles in which a drive must have come out of its fault
constexpr int kSeenAfter = 2;   // cycles in which what a drive has sent is taken
constexpr std::uint32_t kRpdoTimeout = 0x8250;

/// Cycles without power.
class IdleCycles {
 public:
  IdleCycles(hal::CanDrives& drives, hal::Clock& clock, const std::atomic<bool>& end)
      : drives_(drives), clock_(clock), end_(end), next_ns_(clock.now_ns() / kPeriod_ns * kPeriod_ns) {}

  const hal::JointReading& run(hal::PowerRequest power) {
    if (end_.load(std::memory_order_relaxed)) {
      throw Failure(ExitCode::kUnavailable, "ended before the deadlines of all joints were tried; none is proven");
    }
    next_ns_ += kPeriod_ns;
    if (clock_.now_ns() > next_ns_ + kPeriod_ns) next_ns_ = clock_.now_ns();
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
  const std::atomic<bool>& end_;
  std::int64_t next_ns_;
  hal::JointReading reading_;
};

[[noreturn]] void refuse(const hal::CanDrives& drives, const std::vector<std::string>& names) {
  throw Failure(ExitCode::kUnavailable, explain(drives.alarm_detail(), names));
}

/// All drives answer, none has an alarm.
void settle(IdleCycles& cycles, const hal::CanDrives& drives, const std::vector<std::string>& names) {
  const hal::JointReading* reading = nullptr;
  for (int k = 0; k < kSettle; ++k) reading = &cycles.run(hal::PowerRequest::kOff);
  if (reading->alarm != hal::Alarm::kNone) refuse(drives, names);
  for (int i = 0; i < drives.joint_count(); ++i) {
    if (reading->state[static_cast<std::size_t>(i)] == hal::DriveState::kOff) continue;
    throw Failure(ExitCode::kUnavailable,
                  fmt::format("joint {}: is not off before the trial; reset the drive with its own tool", i + 1));
  }
}

void recover(IdleCycles& cycles, const hal::CanDrives& drives, int joint, const std::vector<std::string>& names) {
  for (int k = 0; k < kRecover; ++k) {
    const hal::JointReading& reading =
        cycles.run(k < kRecover / 2 ? hal::PowerRequest::kReset : hal::PowerRequest::kOff);
    const bool off = reading.state[static_cast<std::size_t>(joint)] == hal::DriveState::kOff;
    if (k > 2 && off && reading.alarm == hal::Alarm::kNone) return;
  }
  refuse(drives, names);
}

void try_deadline(IdleCycles& cycles, hal::CanDrives& drives, int joint, int deadline_ms,
                  const std::vector<std::string>& names, JointTrial& trial) {
  const hal::JointReading& before = cycles.run(hal::PowerRequest::kOff);
  trial.position = before.position[joint];
  drives.withhold(joint);
  for (int ms = 1; ms <= deadline_ms + kPatience_ms && trial.after_ms < 0; ++ms) {
    const hal::JointReading& reading = cycles.run(hal::PowerRequest::kOff);
    const hal::cia402::AlarmDetail& alarm = drives.alarm_detail();
    if (alarm.alarm != hal::Alarm::kNone) {
      if (alarm.alarm != hal::Alarm::kDriveError || alarm.joint != joint) refuse(drives, names);
      trial.emergency = static_cast<std::uint16_t>(alarm.found);
    }
    trial.fault = reading.state[static_cast<std::size_t>(joint)] == hal::DriveState::kFault;
    if (trial.fault || trial.emergency != 0) trial.after_ms = ms;
  }
  drives.withhold(-1);
  const bool is_it = trial.fault || trial.emergency == kRpdoTimeout;
  trial.in_time = is_it && trial.after_ms <= deadline_ms + kSeenAfter;
  recover(cycles, drives, joint, names);
}

std::string seen(const JointTrial& trial) {
  if (trial.after_ms < 0) return "nothing";
  std::string what = trial.emergency != 0 ? fmt::format("emergency {:04X}", trial.emergency) : "";
  if (trial.fault) what += what.empty() ? "fault" : ", fault";
  return fmt::format("{} after {} ms", what, trial.after_ms);
}

std::string hex(const std::optional<std::uint32_t>& value) { return value ? fmt::format("{:08X}", *value) : "-"; }

}  // namespace

std::vector<JointTrial> try_deadlines(hal::CanDrives& drives, const hal::BusLayout& layout,
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
    trials[i].vendor = read(hal::canopen::kIdentity, 1);
    trials[i].product = read(hal::canopen::kIdentity, 2);
    trials[i].rated_torque = read(hal::canopen::kMotorRatedTorque, 0);
  }
  IdleCycles cycles(drives, clock, end);
  settle(cycles, drives, names);
  const auto deadline_ms = static_cast<int>(std::lround(1e3 * layout.command_deadline));
  for (std::size_t i = 0; i < trials.size(); ++i) {
    try_deadline(cycles, drives, static_cast<int>(i), deadline_ms, names, trials[i]);
  }
  return trials;
}

std::string deadline_table(const hal::BusLayout& layout, std::span<const JointTrial> trials) {
  std::string text =
      "joint bus node     type   vendor  product rated Nm sign     zero position  expected within  seen\n";
  auto out = std::back_inserter(text);
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const hal::DriveConfig& drive = layout.drives[i];
    const JointTrial& trial = trials[i];
    fmt::format_to(out, "{:>5} {:>3} {:>4} {:>8} {:>8} {:>8} {:>8} {:>4} {:>8.4f} {:>8.4f} {:>13g} ms  {}\n", i + 1,
                   drive.bus, drive.node, hex(trial.device_type), hex(trial.vendor), hex(trial.product),
                   trial.rated_torque ? fmt::format("{:.4g}", 1e-3 * *trial.rated_torque) : "-", drive.sign, drive.zero,
                   trial.position, 1e3 * layout.command_deadline, seen(trial));
  }
  return text;
}

std::string deadline_objection(std::span<const JointTrial> trials) {
  std::vector<std::size_t> joints;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    if (!trials[i].in_time) joints.push_back(i + 1);
  }
  if (joints.empty()) return "";
  return fmt::format(
      "joint{} {}: neither emergency 8250 nor a fault in time after the last RPDO; a drive that watches 1400:5 in "
      "operation "
      "enabled only must be tried there, see commissioning in firmware/README.md, before anybody holds the arm",
      joints.size() == 1 ? "" : "s", fmt::join(joints, ", "));
}

}  // namespace godobject::firmware
