#include "firmware/configuration/cia402_keys.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include <fmt/format.h>

#include "core/scene/format.h"
#include "hal/joint_drives.h"

namespace godobject::firmware {
namespace {

using files::TomlTable;

/// Least periods from one heartbeat to the next. Chosen: SDO exchanges need some cycles between two heartbeats.
constexpr double kBeatPeriods = 5.0;

/// Rounds up to whole milliseconds, which 1400:5 counts [s].
double whole_ms(double seconds) { return 1e-3 * std::ceil(1e3 * seconds - 1e-6); }

/// The joint's range must be unambiguous: within half a wrap of 6064, a counter of 32 bits, from `joint.zero`.
void require_unambiguous(const TomlTable& table, const ArmJoint& joint, const hal::DriveConfig& drive) {
  constexpr double kBeyond = 0.5;  // largest position beyond a joint's limits before the start, chosen [rad]
  constexpr double kCounts = 4'294'967'296.0;
  const double half_turn = std::numbers::pi * kCounts / (drive.counts * drive.gear);
  const double reach = std::max(std::fabs(joint.lower - drive.zero), std::fabs(joint.upper - drive.zero)) + kBeyond;
  if (reach < half_turn) return;
  table.complain("counts", fmt::format("times gear makes the 32 bits of 6064 wrap {:.3g} rad from joint.zero, but the "
                                       "joint moves {:.3g} rad, with a reserve of {:.3g}; check counts and zero",
                                       half_turn, reach, kBeyond));
}

/// Refuses a period that 60C2, a byte times a power of ten, does not hold exactly.
void require_exact_period(const TomlTable& table, double period) {
  for (int exponent = 3; exponent <= 6; ++exponent) {
    const double count = period * std::pow(10.0, exponent);
    if (count < 255.5 && std::fabs(count - std::round(count)) < 1e-6) return;
  }
  table.complain("period", fmt::format("= {:g} cannot be told to the drives: 60C2 holds whole numbers up to 255 of 1, "
                                       "0.1, 0.01 or 0.001 ms; for instance 0.001, 0.0005 or 0.00025",
                                       period));
}

hal::DriveIdentity read_identity(const TomlTable& table) {
  constexpr TomlTable::Range kU32{0.0, 4'294'967'295.0};
  table.allow({"vendor", "product", "revision", "serial"});
  hal::DriveIdentity identity;
  for (const hal::IdentityField& field : hal::kIdentityFields) {
    if (table.has(field.name)) identity.*field.value = static_cast<std::uint32_t>(table.whole_number(field.name, kU32));
  }
  return identity;
}

/// Sets size and sign of the object from a name such as "i16".
void read_type(const TomlTable& table, hal::TemperatureConfig& temperature) {
  const std::string type = table.text("type", "i16");
  for (const int size : {1, 2, 4}) {
    for (const char sign : {'i', 'u'}) {
      if (type != fmt::format("{}{}", sign, 8 * size)) continue;
      temperature.size = size;
      temperature.is_signed = sign == 'i';
      return;
    }
  }
  table.complain("type", fmt::format("= \"{}\" is not known; it must be i8, i16, i32, u8, u16 or u32", type));
}

hal::TemperatureConfig read_temperature(const TomlTable& table) {
  constexpr TomlTable::Range kCelsius{-40.0, 300.0};
  hal::TemperatureConfig temperature;
  if (!table.present()) return temperature;
  table.allow({"object", "sub", "type", "scale", "warn", "stop"});
  temperature.index = static_cast<std::uint16_t>(table.whole_number("object", {0x2001, 0x5FFF}));
  temperature.subindex = static_cast<std::uint8_t>(table.whole_number("sub", {0, 254}, 0));
  read_type(table, temperature);
  temperature.scale = table.number("scale", {1e-6, 1e3}, temperature.scale);
  temperature.warn = table.number("warn", kCelsius);
  temperature.stop = table.number("stop", kCelsius);
  if (temperature.stop <= temperature.warn) {
    table.complain("stop", fmt::format("= {:g} must be above warn = {:g}", temperature.stop, temperature.warn));
  }
  return temperature;
}

/// Refuses a serial number that another joint's drive has: two drives of a product never share it.
void check_serial(const TomlTable& joint, const hal::BusLayout& bus, std::size_t index) {
  const hal::DriveIdentity& own = bus.drives[index].identity;
  for (std::size_t j = 0; own.serial && j < index; ++j) {
    const hal::DriveIdentity& other = bus.drives[j].identity;
    if (!other.serial || !hal::may_be_same(own, other)) continue;
    joint.inner("identity")
        .complain("serial", fmt::format("= {} is also joint {}'s; read the serial numbers of both "
                                        "drives with godobject-controller commission",
                                        *own.serial, j + 1));
  }
}

/// Refuses a node number that another node on the same bus has.
void check_nodes(const TomlTable& joint, const hal::BusLayout& bus, std::size_t index) {
  const hal::DriveConfig& drive = bus.drives[index];
  for (std::size_t j = 0; j < index; ++j) {
    if (bus.drives[j].bus == drive.bus && bus.drives[j].node == drive.node) {
      joint.complain("node", fmt::format("= {} is also joint {}'s on the same bus; give it another node or bus",
                                         drive.node, j + 1));
    }
  }
  if (bus.panel.bus == drive.bus && bus.panel.node == drive.node) {
    joint.complain("node",
                   fmt::format("= {} is also the panel's on the same bus; give it another node or bus", drive.node));
  }
}

}  // namespace

void set_usual_times(hal::BusLayout& bus) {
  bus.command_deadline = whole_ms(hal::default_deadline(bus.period));
  bus.drive_heartbeat = std::max(bus.drive_heartbeat, kBeatPeriods * bus.period);
  bus.heartbeat_timeout = std::max(bus.heartbeat_timeout, 2.0 * bus.drive_heartbeat);
}

void read_bus(const TomlTable& table, hal::BusLayout& bus) {
  table.allow({"period", "bit_rate", "fd", "fd_services", "data_rate", "answer", "drive_delay", "command_deadline",
               "drive_heartbeat", "heartbeat_timeout", "boot_timeout", "limited_time", "panel_bus", "panel_node"});
  bus.period = table.number("period", {format::kShortestPeriod, format::kLongestPeriod}, bus.period);
  require_exact_period(table, bus.period);
  set_usual_times(bus);
  bus.bit_rate = table.number("bit_rate", {1e4, 1e6});
  bus.fd = table.flag("fd", bus.fd);
  bus.fd_services = table.flag("fd_services", bus.fd_services);
  if (bus.fd_services && !bus.fd) table.complain("fd_services", "= true needs fd = true");
  bus.data_rate = table.number("data_rate", {bus.bit_rate, 8e6}, std::max(bus.data_rate, bus.bit_rate));
  bus.answer = table.number("answer", {0.0, 5e-4}, bus.answer);
  bus.drive_delay = table.number("drive_delay", {0.0, 5e-3});
  // one lost torque must not stop a drive, nor may it hold the last one for long
  const double least = std::max(2e-3, whole_ms(2.0 * bus.period));
  bus.command_deadline =
      table.number("command_deadline", {least, std::max(0.01, bus.command_deadline)}, bus.command_deadline);
  bus.drive_heartbeat =
      table.number("drive_heartbeat", {std::max(5e-3, kBeatPeriods * bus.period), 0.1}, bus.drive_heartbeat);
  const double two_heartbeats = 2.0 * bus.drive_heartbeat;
  bus.heartbeat_timeout =
      table.number("heartbeat_timeout", {two_heartbeats, 0.5}, std::max(bus.heartbeat_timeout, two_heartbeats));
  bus.boot_timeout = table.number("boot_timeout", {0.1, 60.0}, bus.boot_timeout);
  bus.limited_time = table.number("limited_time", {bus.period, 1.0}, std::max(bus.limited_time, bus.period));
  bus.panel.bus = static_cast<int>(table.whole_number("panel_bus", {-1, hal::kMaxBuses - 1}, bus.panel.bus));
  bus.panel.node = static_cast<int>(table.whole_number("panel_node", {1, 126}, bus.panel.node));
}

hal::DriveConfig read_drive(const TomlTable& table, const ArmJoint& joint) {
  hal::DriveConfig drive;
  drive.bus = static_cast<int>(table.whole_number("bus", {0, hal::kMaxBuses - 1}));
  drive.node = static_cast<int>(table.whole_number("node", {1, 126}));
  drive.counts = table.number("counts", {16.0, 1e9});
  drive.gear = table.number("gear", {1e-3, 1e4});
  drive.rated_torque = table.number("rated_torque", {1e-9, 1e6});
  drive.torque_limit = joint.torque;
  drive.sign = table.number("sign", {-1.0, 1.0});
  if (std::fabs(drive.sign) != 1.0) table.complain("sign", "must be 1 or -1");
  drive.zero = table.number("zero", {-4.0 * std::numbers::pi, 4.0 * std::numbers::pi});
  drive.identity = read_identity(table.inner("identity"));
  drive.temperature = read_temperature(table.inner("temperature"));
  require_unambiguous(table, joint, drive);
  // 6071 and 6077 are 16 bit numbers of permille of the rated torque: up to 32 times it
  const double share = joint.torque / (drive.gear * drive.rated_torque);
  if (!(share > 0.01 && share < 32.0)) {
    table.complain("rated_torque", fmt::format("times gear is {:.3g} Nm at the joint, out of proportion to its torque "
                                               "limit of {:.3g} Nm; check both",
                                               drive.gear * drive.rated_torque, joint.torque));
  }
  return drive;
}

void finish_buses(const TomlTable& table, const std::vector<TomlTable>& joints, hal::BusLayout& bus) {
  bus.joint_count = static_cast<int>(joints.size());
  int last = bus.panel.bus;
  for (const hal::DriveConfig& drive : bus.drives) last = std::max(last, drive.bus);
  bus.bus_count = last + 1;
  for (int b = 0; b < bus.bus_count; ++b) {
    const bool used = b == bus.panel.bus || std::any_of(bus.drives.begin(), bus.drives.begin() + bus.joint_count,
                                                        [b](const hal::DriveConfig& drive) { return drive.bus == b; });
    if (!used)
      table.complain("panel_bus", fmt::format("or a joint's bus is wrong: bus {} has no node; count buses from 0", b));
  }
  for (std::size_t i = 0; i < joints.size(); ++i) {
    check_nodes(joints[i], bus, i);
    check_serial(joints[i], bus, i);
  }
}

}  // namespace godobject::firmware
