#include "hal/cia402/parameters.h"

#include <algorithm>
#include <cmath>

#include "hal/canopen/network.h"
#include "hal/canopen/object_numbers.h"
#include "hal/canopen/pdo.h"

namespace godobject::hal::cia402 {
namespace {

using namespace canopen;
using Kind = ParameterStep::Kind;

constexpr std::uint32_t kProfileMask = 0xFFFF;   // bits of 1000: number of the device profile
constexpr std::uint32_t kInputsMask = 0x1FFFF;   // bits of 1000: the profile, and digital inputs
constexpr std::uint32_t kSyncMask = 0x400007FF;  // bits of 1005: COB-ID; the node produces no SYNC
constexpr std::uint16_t kRpdoCommunicationLast = 0x1403;
constexpr std::uint16_t kTpdoCommunicationLast = 0x1803;
constexpr std::uint32_t kNoChange = 1;        // 1029: the NMT state does not change, 6007 acts
constexpr std::uint32_t kAbortQuickStop = 3;  // 6007: quick stop
constexpr std::uint32_t kQuickStopRamp = 2;   // 605A, 605E: slow down on the quick-stop ramp, then no power

std::uint32_t scaled(double value, double unit) noexcept {
  return static_cast<std::uint32_t>(std::lround(value / unit));
}

void write(ParameterSteps& steps, std::uint16_t index, std::uint8_t subindex, int size, std::uint32_t value) noexcept {
  steps.add({Kind::kWrite, index, subindex, size, value});
}

void expect(ParameterSteps& steps, std::uint16_t index, std::uint8_t subindex, int size, std::uint32_t value,
            std::uint32_t mask = 0xFFFFFFFF) noexcept {
  steps.add({Kind::kExpect, index, subindex, size, value, mask});
}

/// A PDO. It is set up in this order: invalid, empty, entries, their number, type, timers, valid.
struct Pdo {
  std::uint16_t communication;
  std::uint16_t mapping;
  std::uint16_t cob;
  std::uint8_t type;
  std::uint32_t event_timer_ms;  // an RPDO's deadline, a TPDO's period; 0: none
  std::span<const std::uint32_t> entries;
};

void map_pdo(ParameterSteps& steps, const Pdo& pdo) noexcept {
  write(steps, pdo.communication, 1, 4, kPdoInvalid | pdo.cob);
  write(steps, pdo.mapping, 0, 1, 0);
  for (std::size_t i = 0; i < pdo.entries.size(); ++i) {
    write(steps, pdo.mapping, static_cast<std::uint8_t>(i + 1), 4, pdo.entries[i]);
  }
  write(steps, pdo.mapping, 0, 1, static_cast<std::uint32_t>(pdo.entries.size()));
  write(steps, pdo.communication, 2, 1, pdo.type);
  // inhibit time 0: a change does not wait after the one before
  const bool by_change = pdo.communication >= kTpdo1Communication && pdo.type == kPdoAtOnce;
  if (by_change) steps.add({Kind::kWriteIfThere, pdo.communication, 3, 2, 0});
  if (pdo.event_timer_ms > 0) write(steps, pdo.communication, 5, 2, pdo.event_timer_ms);
  write(steps, pdo.communication, 1, 4, pdo.cob);
}

/// Bits of an object that a node must keep as they were written. A node that switched a PDO off may keep another
/// COB-ID.
std::uint32_t kept_bits(const ParameterStep& write) noexcept {
  const bool is_rpdo = write.index >= kRpdo1Communication && write.index <= kRpdoCommunicationLast;
  const bool is_tpdo = write.index >= kTpdo1Communication && write.index <= kTpdoCommunicationLast;
  if (!(is_rpdo || is_tpdo) || write.subindex != 1) return 0xFFFFFFFF >> (32 - 8 * write.size);
  return (write.value & kPdoInvalid) != 0 ? kPdoInvalid : kPdoCobMask;
}

/// Reads back all written objects: the value of the last write.
void read_back(ParameterSteps& steps) noexcept {
  const std::span<const ParameterStep> before = steps.all();
  for (std::size_t i = 0; i < before.size(); ++i) {
    ParameterStep step = before[i];
    if (step.kind != Kind::kWrite && step.kind != Kind::kWriteIfThere) continue;
    const auto same = [&step](const ParameterStep& later) { return later.is_of_same_object(step); };
    if (std::ranges::any_of(before.subspan(i + 1), same)) continue;
    step.mask = kept_bits(step);
    step.value &= step.mask;
    step.kind = step.kind == Kind::kWrite ? Kind::kExpect : Kind::kExpectIfThere;
    if (step.index == kMode) step.index = kModeDisplay;  // 6060 is a request; 6061 is the drive's mode
    steps.add(step);
  }
}

/// Adds 60C2: period = sub1 * 10^sub2 s, exact if a byte can hold it, else the nearest. `period`: at most 255 ms.
void set_interpolation_period(ParameterSteps& steps, double period) noexcept {
  int exponent = -3;
  double count = period * 1e3;
  while (10.0 * count < 255.5 && std::fabs(count - std::round(count)) > 1e-6) {
    --exponent;
    count *= 10.0;
  }
  steps.add({Kind::kWriteIfThere, kInterpolationPeriod, 1, 1, static_cast<std::uint32_t>(std::lround(count))});
  steps.add({Kind::kWriteIfThere, kInterpolationPeriod, 2, 1, static_cast<std::uint8_t>(exponent)});
}

/// Largest torque that the controller commands, in permille of the rated torque.
std::uint32_t greatest_torque(const DriveConfig& drive) noexcept {
  return scaled(drive.torque_limit, 1e-3 * std::fabs(drive.gear) * drive.rated_torque);
}

std::uint32_t watched_node(const BusLayout& layout) noexcept {
  return static_cast<std::uint32_t>(kControllerNode) << 16 | scaled(layout.heartbeat_timeout, 1e-3);
}

}  // namespace

bool ParameterStep::accepts(std::uint32_t found) const noexcept {
  const std::uint32_t masked = found & mask;
  if (or_more && masked > value) return true;
  return (masked > value ? masked - value : value - masked) <= tolerance;
}

void drive_steps(const BusLayout& layout, const DriveConfig& drive, ParameterSteps& steps) noexcept {
  const std::uint32_t rated = scaled(drive.rated_torque, 1e-3);
  expect(steps, kDeviceType, 0, 4, kServoDrive & kProfileMask, kProfileMask);
  expect(steps, kSupportedModes, 0, 4, kSupportsTorque, kSupportsTorque);
  steps.add({Kind::kExpect, kMotorRatedTorque, 0, 4, rated, 0xFFFFFFFF, rated / 100});
  // mapped objects must have the sizes of their places in the PDOs
  expect(steps, kTargetTorque, 0, 2, 0, 0);
  expect(steps, kActualTorque, 0, 2, 0, 0);
  expect(steps, kPosition, 0, 4, 0, 0);
  expect(steps, kSyncCob, 0, 4, kCobSync, kSyncMask);
  steps.add({Kind::kWriteIfThere, kSyncPeriod, 0, 4, scaled(layout.period, 1e-6)});
  steps.add({Kind::kExpectIfThere, kEmergencyCob, 0, 4, cob(kCobEmergency, drive.node), kPdoCobMask});
  steps.add({Kind::kExpectIfThere, kSyncOverflow, 0, 1, 0});  // 0: SYNC without a counter
  steps.add({Kind::kExpectIfThere, kPolarity, 0, 1, 0});
  for (const Object limit : {kMaxTorque, kPositiveTorqueLimit, kNegativeTorqueLimit}) {
    steps.add(
        {.kind = Kind::kExpectIfThere, .index = limit, .size = 2, .value = greatest_torque(drive), .or_more = true});
  }
  steps.add({.kind = Kind::kExpect, .index = kQuickStopDeceleration, .size = 4, .value = 1, .or_more = true});
  for (std::uint16_t i = kRpdo1Communication + 1; i <= kRpdoCommunicationLast; ++i) {
    const auto base = static_cast<std::uint32_t>(kCobRpdo1 + 0x100 * (i - kRpdo1Communication));
    steps.add({Kind::kWriteIfThere, i, 1, 4, kPdoInvalid | (base + static_cast<std::uint32_t>(drive.node))});
  }
  for (std::uint16_t i = kTpdo2Communication + 1; i <= kTpdoCommunicationLast; ++i) {
    const auto base = static_cast<std::uint32_t>(kCobTpdo1 + 0x100 * (i - kTpdo1Communication));
    steps.add({Kind::kWriteIfThere, i, 1, 4, kPdoInvalid | (base + static_cast<std::uint32_t>(drive.node))});
  }

  const std::array<std::uint32_t, 2> command = {pdo_entry(kControlword, 0, 16), pdo_entry(kTargetTorque, 0, 16)};
  const std::array<std::uint32_t, 3> sample = {pdo_entry(kStatusword, 0, 16), pdo_entry(kPosition, 0, 32),
                                               pdo_entry(kActualTorque, 0, 16)};
  const Pdo rpdo{kRpdo1Communication,
                 kRpdo1Mapping,
                 cob(kCobRpdo1, drive.node),
                 kPdoAtOnce,
                 scaled(layout.command_deadline, 1e-3),
                 command};
  const Pdo tpdo{kTpdo1Communication, kTpdo1Mapping, cob(kCobTpdo1, drive.node), kPdoEverySync, 0, sample};
  const std::array<std::uint32_t, 1> mode = {pdo_entry(kModeDisplay, 0, 8)};
  const Pdo of_mode{kTpdo2Communication,
                    kTpdo2Mapping,
                    cob(kCobTpdo2, drive.node),
                    kPdoAtOnce,
                    scaled(layout.mode_refresh, 1e-3),
                    mode};
  map_pdo(steps, rpdo);
  map_pdo(steps, tpdo);
  map_pdo(steps, of_mode);
  write(steps, kConsumerHeartbeat, 1, 4, watched_node(layout));
  write(steps, kProducerHeartbeat, 0, 2, scaled(layout.drive_heartbeat, 1e-3));
  write(steps, kErrorBehaviour, 1, 1, kNoChange);
  write(steps, kAbortConnectionOption, 0, 2, kAbortQuickStop);
  write(steps, kQuickStopOption, 0, 2, kQuickStopRamp);
  write(steps, kFaultReactionOption, 0, 2, kQuickStopRamp);
  set_interpolation_period(steps, layout.period);
  write(steps, kMode, 0, 1, static_cast<std::uint32_t>(kModeTorque));

  read_back(steps);
}

void panel_steps(const BusLayout& layout, ParameterSteps& steps) noexcept {
  expect(steps, kDeviceType, 0, 4, kDigitalInputModule & kInputsMask, kInputsMask);
  expect(steps, kDigitalInputs8, 1, 1, 0, 0);
  expect(steps, kSyncCob, 0, 4, kCobSync, kSyncMask);
  steps.add({Kind::kExpectIfThere, kSyncOverflow, 0, 1, 0});
  steps.add({Kind::kExpectIfThere, kInputPolarity8, 1, 1, 0});
  const std::array<std::uint32_t, 1> inputs = {pdo_entry(kDigitalInputs8, 1, 8)};
  const Pdo tpdo{kTpdo1Communication, kTpdo1Mapping, cob(kCobTpdo1, layout.panel.node), kPdoEverySync, 0, inputs};
  map_pdo(steps, tpdo);
  steps.add({Kind::kWriteIfThere, kConsumerHeartbeat, 1, 4, watched_node(layout)});
  write(steps, kProducerHeartbeat, 0, 2, scaled(layout.drive_heartbeat, 1e-3));
  read_back(steps);
}

std::array<ParameterStep, kWatchedCount> watched_parameters(const BusLayout& layout) noexcept {
  return {{{Kind::kExpect, kRpdo1Communication, 5, 2, scaled(layout.command_deadline, 1e-3)},
           {Kind::kExpect, kRpdo1Communication, 2, 1, kPdoAtOnce},
           {Kind::kExpect, kConsumerHeartbeat, 1, 4, watched_node(layout)},
           {Kind::kExpect, kAbortConnectionOption, 0, 2, kAbortQuickStop},
           {Kind::kExpect, kQuickStopOption, 0, 2, kQuickStopRamp},
           {Kind::kExpect, kModeDisplay, 0, 1, static_cast<std::uint32_t>(kModeTorque)}}};
}

}  // namespace godobject::hal::cia402
