#include "firmware/configuration/device_file.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "firmware/configuration/pose_key.h"
#include "toolchain/command_line/failure.h"
#include "toolchain/files/toml_file.h"
#include "toolchain/files/toml_table.h"

namespace godobject::firmware {
namespace {

using command::TomlTable;
using Range = TomlTable::Range;

constexpr Range kLength{-1e3, 1e3};
constexpr Range kSize{1e-9, 1e3};
constexpr Range kAngle{-4.0 * std::numbers::pi, 4.0 * std::numbers::pi};
constexpr Range kPositive{1e-9, 1e6};
constexpr Range kNotNegative{0.0, 1e6};
constexpr Range kMoment{-1e6, 1e6};

Vector3 read_vector(const TomlTable& table, std::string_view key, Range range) {
  const std::vector<double> n = table.numbers(key, 3, range);
  return {n[0], n[1], n[2]};
}

LinkMass read_mass(const TomlTable& table, Range mass) {
  LinkMass body;
  body.mass = table.number("mass", mass);
  body.com = read_vector(table, "com", kLength);
  const std::vector<double> n = table.numbers("inertia", 6, kMoment);
  body.inertia << n[0], n[3], n[4], n[3], n[1], n[5], n[4], n[5], n[2];
  return body;
}

/// An arm of this joint alone, so that a complaint finds its table.
void require_possible(const ArmJoint& joint, const TomlTable& table) {
  ArmModel alone;
  alone.joint_count = 1;
  alone.joints[0] = joint;
  const Status status = validate(alone);
  if (status != Status::kOk) table.complain("inertia", fmt::format("is not possible: {}", describe(status)));
}

/// Half a turn of 6064, a counter of 32 bits, beyond which a position is another one, too; with what a joint may stand
/// beyond its limits before it is driven.
void require_unambiguous(const TomlTable& table, const ArmJoint& joint, const hal::DriveConfig& drive) {
  constexpr double kBeyond = 0.5;  // rad
  constexpr double kCounts = 4'294'967'296.0;
  const double half_turn = std::numbers::pi * kCounts / (drive.counts * drive.gear);
  const double reach = std::max(std::fabs(joint.lower - drive.zero), std::fabs(joint.upper - drive.zero)) + kBeyond;
  if (reach < half_turn) return;
  table.complain("counts", fmt::format("times gear lets the 32 bits of 6064 wrap {:.3g} rad from joint.zero, but the "
                                       "joint goes {:.3g} rad, {:.3g} of reserve included; check counts and zero",
                                       half_turn, reach, kBeyond));
}

hal::DriveConfig read_drive(const TomlTable& table, const ArmJoint& joint) {
  hal::DriveConfig drive;
  drive.bus = static_cast<int>(table.whole_number("bus", {0, hal::kMaxBuses - 1}));
  drive.node = static_cast<int>(table.whole_number("node", {1, 126}));
  drive.counts = table.number("counts", {16.0, 1e9});
  drive.gear = table.number("gear", {1e-3, 1e4});
  drive.rated_torque = table.number("rated_torque", kPositive);
  drive.torque_limit = joint.torque;
  drive.sign = table.number("sign", {-1.0, 1.0});
  if (std::fabs(drive.sign) != 1.0) table.complain("sign", "must be 1 or -1");
  drive.zero = table.number("zero", kAngle);
  require_unambiguous(table, joint, drive);
  // torques travel as 16 bit permille of the rated one
  const double share = joint.torque / (drive.gear * drive.rated_torque);
  if (!(share > 0.01 && share < 32.0)) {
    table.complain("rated_torque", fmt::format("times gear is {:.3g} Nm at the joint, out of proportion to its torque "
                                               "limit of {:.3g} Nm; check both",
                                               drive.gear * drive.rated_torque, joint.torque));
  }
  return drive;
}

void read_joint(const TomlTable& table, std::size_t index, Device& device) {
  table.allow({"a",
               "alpha",
               "d",
               "offset",
               "lower",
               "upper",
               "velocity",
               "torque",
               "rotor",
               "damping",
               "mass",
               "com",
               "inertia",
               "null_damping",
               "limit_stiffness",
               "limit_damping",
               "bus",
               "node",
               "counts",
               "gear",
               "rated_torque",
               "sign",
               "zero"});
  ArmJoint& joint = device.model.joints[index];
  joint.a = table.number("a", kLength);
  joint.alpha = table.number("alpha", kAngle);
  joint.d = table.number("d", kLength);
  joint.offset = table.number("offset", kAngle);
  joint.lower = table.number("lower", kAngle);
  joint.upper = table.number("upper", {joint.lower + 1e-3, kAngle.high});
  joint.velocity = table.number("velocity", kPositive);
  joint.torque = table.number("torque", kPositive);
  joint.rotor = table.number("rotor", kNotNegative);
  joint.damping = table.number("damping", kNotNegative);
  joint.link = read_mass(table, kPositive);
  require_possible(joint, table);
  const auto i = static_cast<Eigen::Index>(index);
  device.torque.null_damping[i] = table.number("null_damping", kNotNegative);
  device.torque.limit_stiffness[i] = table.number("limit_stiffness", kNotNegative);
  device.torque.limit_damping[i] = table.number("limit_damping", kNotNegative);
  device.bus.drives[index] = read_drive(table, joint);
}

/// Who is where: every node once a bus, every bus up to the last one in use.
void check_nodes(const TomlTable& joint, const hal::BusLayout& bus, std::size_t index) {
  const hal::DriveConfig& drive = bus.drives[index];
  for (std::size_t j = 0; j < index; ++j) {
    if (bus.drives[j].bus == drive.bus && bus.drives[j].node == drive.node) {
      joint.complain("node", fmt::format("= {} is joint {}'s on the same bus, too; give it another node or bus",
                                         drive.node, j + 1));
    }
  }
  if (bus.panel.bus == drive.bus && bus.panel.node == drive.node) {
    joint.complain("node", fmt::format("= {} is the panel's on the same bus, too", drive.node));
  }
}

void read_bus(const TomlTable& table, hal::BusLayout& bus) {
  table.allow({"bit_rate", "fd", "data_rate", "answer", "drive_delay", "command_deadline", "drive_heartbeat",
               "heartbeat_timeout", "boot_timeout", "panel_bus", "panel_node"});
  bus.bit_rate = table.number("bit_rate", {1e4, 1e6});
  bus.fd = table.flag("fd", bus.fd);
  bus.data_rate = table.number("data_rate", {bus.bit_rate, 8e6}, std::max(bus.data_rate, bus.bit_rate));
  bus.answer = table.number("answer", {0.0, 5e-4}, bus.answer);
  bus.drive_delay = table.number("drive_delay", {0.0, 5e-3});
  bus.command_deadline = table.number("command_deadline", {2e-3, 0.01}, bus.command_deadline);
  bus.drive_heartbeat = table.number("drive_heartbeat", {5e-3, 0.1}, bus.drive_heartbeat);
  bus.heartbeat_timeout = table.number("heartbeat_timeout", {2.0 * bus.drive_heartbeat, 0.5}, bus.heartbeat_timeout);
  bus.boot_timeout = table.number("boot_timeout", {0.1, 60.0}, bus.boot_timeout);
  bus.panel.bus = static_cast<int>(table.whole_number("panel_bus", {-1, hal::kMaxBuses - 1}, bus.panel.bus));
  bus.panel.node = static_cast<int>(table.whole_number("panel_node", {1, 126}, bus.panel.node));
}

void count_buses(const TomlTable& table, const std::vector<TomlTable>& joints, hal::BusLayout& bus) {
  bus.joint_count = static_cast<int>(joints.size());
  int last = bus.panel.bus;
  for (const hal::DriveConfig& drive : bus.drives) last = std::max(last, drive.bus);
  bus.bus_count = last + 1;
  for (int b = 0; b < bus.bus_count; ++b) {
    const bool used = b == bus.panel.bus || std::any_of(bus.drives.begin(), bus.drives.begin() + bus.joint_count,
                                                        [b](const hal::DriveConfig& drive) { return drive.bus == b; });
    if (!used)
      table.complain("panel_bus", fmt::format("or a joint's bus is wrong: nobody is on bus {}; count from 0", b));
  }
  for (std::size_t i = 0; i < joints.size(); ++i) check_nodes(joints[i], bus, i);
}

void read_torque(const TomlTable& table, Device& device) {
  table.allow({"rotation_length", "singular_none", "singular_full", "limit_band"});
  JointTorqueParameters& torque = device.torque;
  torque.rotation_length = table.number("rotation_length", kSize);
  torque.singular_none = table.number("singular_none", kSize);
  torque.singular_full = table.number("singular_full", {torque.singular_none * 1.001, kSize.high});
  double widest = kAngle.high;
  for (int i = 0; i < device.model.joint_count; ++i) {
    const ArmJoint& joint = device.model.joints[static_cast<std::size_t>(i)];
    widest = std::min(widest, 0.5 * (joint.upper - joint.lower));
  }
  torque.limit_band = table.number("limit_band", {1e-6, widest});
}

}  // namespace

Device read_device_file(const std::filesystem::path& file) {
  const toml::table root = command::parse_toml_file(file);
  command::allow_tables(root, file, {"arm", "torque", "bus", "joint", "tool", "payload"});
  Device device;
  const TomlTable arm(root, "arm", file);
  arm.allow({"name", "base", "gravity"});
  device.name = arm.text("name");
  device.model.H_RA = read_pose(arm, "base");
  device.model.gravity_R = read_vector(arm, "gravity", {-100.0, 100.0});

  const std::vector<TomlTable> joints = TomlTable::each(root, "joint", file);
  if (joints.empty() || joints.size() > kMaxJoints) {
    throw command::Failure(command::ExitCode::kBadConfig, fmt::format("{}: has {} [[joint]] tables; it must be 1 to {}",
                                                                      file.string(), joints.size(), kMaxJoints));
  }
  for (std::size_t i = 0; i < joints.size(); ++i) read_joint(joints[i], i, device);
  device.model.joint_count = static_cast<int>(joints.size());
  const TomlTable bus(root, "bus", file);
  read_bus(bus, device.bus);
  count_buses(bus, joints, device.bus);

  const TomlTable tool(root, "tool", file);
  tool.allow({"pose"});
  device.model.H_FM = read_pose(tool, "pose");
  const TomlTable payload(root, "payload", file);
  payload.allow({"mass", "com", "inertia"});
  device.model.payload = read_mass(payload, kNotNegative);
  read_torque(TomlTable(root, "torque", file), device);

  const Status model = validate(device.model);
  if (model != Status::kOk) payload.complain("inertia", fmt::format("is not possible: {}", describe(model)));
  const Status torque = validate(device.torque, device.model);
  if (torque != Status::kOk) {
    throw command::Failure(command::ExitCode::kBadConfig, fmt::format("{}: {}", file.string(), describe(torque)));
  }
  return device;
}

void regrip(const Pose& H_TM, Device& device) {
  const Pose H_MT = H_TM.inverse();
  const Matrix3 R_MT = H_MT.rotation.toRotationMatrix();
  LinkMass& payload = device.model.payload;
  payload.com = H_MT * payload.com;
  payload.inertia = R_MT * payload.inertia * R_MT.transpose();
  const Pose H_FT = device.model.H_FM;
  device.model.H_FM = H_FT * H_TM;
}

}  // namespace godobject::firmware
