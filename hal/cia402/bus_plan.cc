#include "hal/cia402/bus_plan.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>

namespace godobject::hal {
namespace {

constexpr int kSyncBytes = 0;
constexpr int kSampleBytes = 8;     // TPDO1 {6041:16, 6064:32, 6077:16}
constexpr int kTorqueBytes = 4;     // RPDO1 {6040:16, 6071:16}
constexpr int kPanelBytes = 1;      // TPDO1 {6000:1}
constexpr int kHeartbeatBytes = 1;  // {state}
constexpr int kModeBytes = 1;       // TPDO2 {6061:8}
constexpr int kSdoBytes = 8;

enum class Stuffing { kNone, kWorst };

/// Duration in nanoseconds, rounded up; 1e-6 ns of it is rounding error.
std::int64_t duration_ns(double bits, double rate) noexcept {
  return static_cast<std::int64_t>(std::ceil(1e9 * bits / rate - 1e-6));
}

std::int64_t frame_ns(int bytes, bool fd, const BusLayout& layout, Stuffing stuffing) noexcept {
  const bool worst = stuffing == Stuffing::kWorst;
  if (!fd) {
    const int stuffed = 34 + 8 * bytes;
    return duration_ns(44 + 8 * bytes + 3 + (worst ? (stuffed - 1) / 4 : 0), layout.bit_rate);
  }
  const int crc = bytes <= 16 ? 17 + 6 : 21 + 7;
  const int nominal = 17 + 13 + (worst ? 4 : 0);
  const int data = 5 + 8 * bytes + 4 + crc + (worst ? 1 + 2 * bytes : 0);
  return duration_ns(nominal, layout.bit_rate) + duration_ns(data, layout.data_rate);
}

bool has_fd_services(const BusLayout& layout) noexcept { return layout.fd && layout.fd_services; }

/// The load of one bus as far as it does not depend on the other buses.
BusLoad frames_of(const BusLayout& layout, int bus) noexcept {
  BusLoad load;
  load.panel = layout.panel.bus == bus;
  for (const DriveConfig& drive : std::span(layout.drives).first(static_cast<std::size_t>(layout.joint_count))) {
    if (drive.bus == bus) ++load.joints;
  }
  load.sync_ns = longest_frame_ns(kSyncBytes, layout.fd, layout);
  load.samples_ns = load.joints * longest_frame_ns(kSampleBytes, layout.fd, layout) +
                    (load.panel ? longest_frame_ns(kPanelBytes, layout.fd, layout) : 0);
  load.torques_ns = load.joints * longest_frame_ns(kTorqueBytes, layout.fd, layout);
  load.blocking_ns = std::max(longest_frame_ns(kHeartbeatBytes, has_fd_services(layout), layout),
                              longest_frame_ns(kModeBytes, layout.fd, layout));
  return load;
}

/// Completes the load of a bus whose samples are collected at `collect_ns`.
void judge(const BusLayout& layout, std::int64_t collect_ns, BusLoad& load) noexcept {
  const std::int64_t period_ns = duration_ns(layout.period, 1.0);
  const std::int64_t compute_ns = duration_ns(layout.compute, 1.0);
  const std::int64_t sdo_ns = longest_frame_ns(kSdoBytes, has_fd_services(layout), layout);
  const std::int64_t sampled_ns = load.sync_ns + duration_ns(layout.answer, 1.0) + load.samples_ns;

  load.end_ns = collect_ns + compute_ns + load.blocking_ns + load.torques_ns;
  load.slot_ns = collect_ns + compute_ns + sdo_ns + load.torques_ns - load.blocking_ns;
  load.late_ns = std::max<std::int64_t>(0, sdo_ns + sampled_ns - collect_ns);
  load.fits = load.end_ns <= period_ns && load.slot_ns <= period_ns;

  const int producers = load.joints + (load.panel ? 1 : 0) + 1;  // of heartbeats, with the controller
  load.utilisation = static_cast<double>(load.sync_ns + load.samples_ns + load.torques_ns) * 1e-9 / layout.period +
                     producers * static_cast<double>(load.blocking_ns) * 1e-9 / layout.drive_heartbeat +
                     load.joints * static_cast<double>(load.blocking_ns) * 1e-9 / layout.mode_refresh +
                     2.0 * static_cast<double>(sdo_ns) * 1e-9 / layout.read_back_interval;
}

}  // namespace

std::int64_t longest_frame_ns(int bytes, bool fd, const BusLayout& layout) noexcept {
  return frame_ns(bytes, fd, layout, Stuffing::kWorst);
}

std::int64_t shortest_frame_ns(int bytes, bool fd, const BusLayout& layout) noexcept {
  return frame_ns(bytes, fd, layout, Stuffing::kNone);
}

BusPlan plan_buses(const BusLayout& layout) noexcept {
  assert(layout.bus_count >= 1 && layout.bus_count <= kMaxBuses);
  assert(layout.joint_count >= 0 && layout.joint_count <= kMaxJoints);
  BusPlan plan;
  const std::span<BusLoad> buses = std::span(plan.buses).first(static_cast<std::size_t>(layout.bus_count));

  std::int64_t& collect_ns = plan.timing.collect_ns;
  for (int bus = 0; bus < layout.bus_count; ++bus) {
    BusLoad& load = plan.buses[static_cast<std::size_t>(bus)];
    load = frames_of(layout, bus);
    // until the drives answer the wire is idle, and another frame may begin
    const std::int64_t idle_ns = layout.answer > 0.0 ? duration_ns(layout.answer, 1.0) + load.blocking_ns : 0;
    collect_ns = std::max(collect_ns, load.blocking_ns + load.sync_ns + idle_ns + load.samples_ns);
  }

  std::int64_t last_torque_ns = 0;
  plan.fits = true;
  for (BusLoad& load : buses) {
    judge(layout, collect_ns, load);
    plan.fits = plan.fits && load.fits;
    if (load.joints > 0) last_torque_ns = std::max(last_torque_ns, load.end_ns);
  }
  // the earliest sample: at the end of a SYNC without blocking
  const std::int64_t sample_ns = shortest_frame_ns(kSyncBytes, layout.fd, layout);
  plan.timing.delay_s =
      layout.drive_delay + 1e-9 * static_cast<double>(std::max<std::int64_t>(0, last_torque_ns - sample_ns));

  std::array<int, kMaxBuses> sent{};  // RPDOs so far: they are sent in the order of the joints
  for (std::size_t joint = 0; joint < static_cast<std::size_t>(layout.joint_count); ++joint) {
    const DriveConfig& drive = layout.drives[joint];
    assert(drive.bus >= 0 && drive.bus < layout.bus_count);
    const auto bus = static_cast<std::size_t>(drive.bus);
    plan.unblocked_ns[joint] = collect_ns + duration_ns(layout.compute, 1.0) +
                               ++sent[bus] * longest_frame_ns(kTorqueBytes, layout.fd, layout) -
                               plan.buses[bus].sync_ns;
    plan.torque_step[joint] = 1e-3 * drive.rated_torque * std::abs(drive.gear);
  }
  return plan;
}

}  // namespace godobject::hal
