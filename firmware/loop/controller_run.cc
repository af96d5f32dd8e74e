#include "firmware/loop/controller_run.h"

#include <algorithm>

namespace godobject::firmware {

bool refuses_to_start(Fault fault) noexcept {
  return fault == Fault::kDrivesAbsent || fault == Fault::kNotAtRest || fault == Fault::kSignWrong ||
         fault == Fault::kSignUndecided || fault == Fault::kOutsideLimits;
}

namespace detail {

void watch(const CycleRecord& record, RunReport& report) noexcept {
  const std::uint32_t waited = report.waiting.load(std::memory_order_relaxed);
  const bool waits = record.mode == Mode::kIdle || record.mode == Mode::kArmed;
  report.waiting.store(waits ? waited + 1 : 0, std::memory_order_relaxed);
  if (record.behind > report.longest_behind.load(std::memory_order_relaxed)) {
    report.longest_behind.store(record.behind, std::memory_order_relaxed);
  }
  const auto note = [](std::uint8_t joints, std::atomic<std::uint8_t>& noted) {
    if (joints != 0) noted.fetch_or(joints, std::memory_order_relaxed);
  };
  note(record.limited, report.limited);
  note(record.warm, report.warm);
  note(record.temperature_lost, report.temperature_lost);
  const Standing standing{record.mode, record.fault, record.alarm, static_cast<std::int8_t>(record.alarm_joint)};
  report.standing.store(standing, std::memory_order_relaxed);
  ++report.in_mode[static_cast<std::size_t>(record.mode)];
  if (!(record.share > 0.0)) return;
  const double force = record.F_G_R.force.norm();
  ++report.rendering;
  if (force > 0.0) ++report.in_contact;
  report.largest_force = std::max(report.largest_force, force);
  report.largest_torque = std::max(report.largest_torque, record.F_G_R.torque.norm());
  report.deepest = std::max(report.deepest, record.penetration);
}

}  // namespace detail
}  // namespace godobject::firmware
