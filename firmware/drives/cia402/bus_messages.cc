#include "firmware/drives/cia402/bus_messages.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>

#include <fmt/format.h>

#include "firmware/cycle/supervisor.h"
#include "hal/canopen/emergency.h"

namespace godobject::firmware {
namespace {

std::string bus_name(int bus, const std::vector<std::string>& interfaces) {
  if (bus < 0 || bus >= static_cast<int>(interfaces.size())) return "";
  return interfaces[static_cast<std::size_t>(bus)];
}

void append(std::string& text, const std::string& part) {
  if (part.empty()) return;
  if (!text.empty()) text += ", ";
  text += part;
}

std::string joint_name(int joint) { return joint < 0 ? "" : fmt::format("joint {}", joint + 1); }

std::string object_name(std::uint16_t index, std::uint8_t subindex) {
  return index == 0 ? "" : fmt::format("object {:04X}:{}", index, subindex);
}

std::string temperatures(double celsius, double stop) {
  return fmt::format("{:.1f} degrees Celsius, the arm stops at {:g}", celsius, stop);
}

/// Returns the number of a field of the identity as makers print it: a serial number is decimal.
std::string identity_number(std::uint8_t subindex, std::uint32_t value) {
  return subindex == hal::kIdentityFields.back().subindex ? fmt::format("{}", value) : fmt::format("0x{:X}", value);
}

std::string identity_field(const hal::BringUpResult& result) {
  for (const hal::IdentityField& field : hal::kIdentityFields) {
    if (field.subindex == result.subindex) return field.name;
  }
  return "identity";
}

/// Returns the words about drives that answer at the wrong joints, with the joints.
std::string of_two_joints(const hal::BringUpResult& result) {
  const int other = result.other_joint + 1;
  if (result.status == hal::BringUpStatus::kDrivesSwapped) {
    return fmt::format(
        "the drives of joints {} and {} are swapped, or their cables or node numbers; swap them back, or correct "
        "identity in the device file",
        result.joint + 1, other);
  }
  return fmt::format(
      "is not the drive that the device file names; that drive answers as the one of joint {}; exchange the drives, "
      "their cables or their node numbers, or correct identity in the device file",
      other);
}

std::string at(const std::string& where, const std::string& what, const std::string& more) {
  std::string text = where.empty() ? what : fmt::format("{}: {}", where, what);
  if (!more.empty()) text += fmt::format(" ({})", more);
  return text;
}

}  // namespace

std::string explain(const hal::BringUpResult& result, const std::vector<std::string>& interfaces) {
  std::string where = bus_name(result.bus, interfaces);
  if (result.node > 0) append(where, fmt::format("node {}", result.node));
  append(where, joint_name(result.joint));
  append(where, object_name(result.index, result.subindex));
  std::string what = describe(result.status);
  std::string more;
  switch (result.status) {
    case hal::BringUpStatus::kSecondMaster: more = fmt::format("COB-ID {:03X}", result.found); break;
    case hal::BringUpStatus::kRefused: more = fmt::format("abort code {:08X}", result.found); break;
    case hal::BringUpStatus::kWrongSize:
      more = fmt::format("{} bytes instead of {}", result.found, result.expected);
      break;
    case hal::BringUpStatus::kWrongValue:
      more = fmt::format("0x{:X} instead of 0x{:X}", result.found, result.expected);
      break;
    case hal::BringUpStatus::kTooLow: more = fmt::format("{}, at least {}", result.found, result.expected); break;
    case hal::BringUpStatus::kWrongRatio:
      more = fmt::format("{:.9g} instead of {:.9g}", result.ratio_found, result.ratio_expected);
      break;
    case hal::BringUpStatus::kTooHot: more = temperatures(result.celsius, result.most_celsius); break;
    case hal::BringUpStatus::kDrivesSwapped:
    case hal::BringUpStatus::kDriveElsewhere: what = of_two_joints(result); [[fallthrough]];
    case hal::BringUpStatus::kWrongDrive:
      more = fmt::format("{} {} instead of {}", identity_field(result), identity_number(result.subindex, result.found),
                         identity_number(result.subindex, result.expected));
      break;
    case hal::BringUpStatus::kNoIdentity:
      more = fmt::format("{} {}", identity_field(result), identity_number(result.subindex, result.expected));
      break;
    default: break;
  }
  return at(where, what, more);
}

std::string explain(const hal::cia402::AlarmDetail& alarm, const std::vector<std::string>& interfaces) {
  std::string where = bus_name(alarm.bus, interfaces);
  append(where, joint_name(alarm.joint));
  append(where, object_name(alarm.index, alarm.subindex));
  std::string more;
  if (alarm.id != 0) append(more, fmt::format("COB-ID {:03X}", alarm.id));
  if (alarm.alarm == hal::Alarm::kDriveError) append(more, fmt::format("error code {:04X}", alarm.found));
  if (alarm.alarm == hal::Alarm::kDriveError && alarm.found == hal::canopen::kRpdoTimeout) {
    append(
        more,
        "torque frames were missing for longer than bus.command_deadline: the loop was late, or the bus lost them; run "
        "godobject-controller doctor");
  }
  if (alarm.alarm == hal::Alarm::kWrongMode && alarm.index != 0) {
    append(more, fmt::format("mode {} instead of {}", static_cast<std::int32_t>(alarm.found), alarm.expected));
  }
  if (alarm.alarm == hal::Alarm::kTooHot) append(more, temperatures(alarm.celsius, alarm.most_celsius));
  if (alarm.alarm == hal::Alarm::kParameterChanged) {
    append(more, fmt::format("0x{:X} instead of 0x{:X}", alarm.found, alarm.expected));
  }
  return at(where, describe(alarm.alarm), more);
}

std::string bus_summary(const hal::CanStatistics& statistics, int joint_count) {
  const auto sum = [joint_count](const auto& counts) {
    return std::accumulate(counts.begin(), counts.begin() + joint_count, std::uint64_t{0});
  };
  std::string hottest;
  if (statistics.hottest_joint >= 0) {
    hottest = fmt::format("temperature of the drives: at most {:.1f} degrees Celsius, joint {}\n", statistics.hottest,
                          statistics.hottest_joint + 1);
  }
  return fmt::format(
      "buses: {} frames sent, {} received; samples lost {}, late {}; malformed {}, queue full {}, floods {}\n"
      "round trip of all joints: at most {:.0f} us\n{}",
      statistics.sent, statistics.received, sum(statistics.lost), sum(statistics.late), statistics.malformed,
      statistics.full, statistics.floods, 1e-3 * static_cast<double>(statistics.longest_round_trip_ns), hottest);
}

}  // namespace godobject::firmware
