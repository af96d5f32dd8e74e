#include "firmware/configuration/device_file.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "firmware/configuration/cia402_keys.h"
#include "firmware/configuration/pose_key.h"
#include "toolchain/command_line/failure.h"
#include "toolchain/files/input_file.h"
#include "toolchain/files/text_file.h"
#include "toolchain/files/toml_file.h"
#include "toolchain/files/toml_table.h"

namespace godobject::firmware {
namespace {

using files::TomlTable;
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

/// Validates an arm of this joint alone, so that a complaint names its table.
void require_possible(const ArmJoint& joint, const TomlTable& table) {
  ArmModel alone;
  alone.joint_count = 1;
  alone.joints[0] = joint;
  const Status status = validate(alone);
  if (status != Status::kOk) table.complain("inertia", fmt::format("is not possible: {}", describe(status)));
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
               "zero",
               "identity",
               "temperature"});
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

/// A count must be a small part of the way of a period, or a step of the encoder looks like a jump (PositionCheck).
void require_resolution(const TomlTable& table, const ArmJoint& joint, const hal::BusLayout& bus, std::size_t index) {
  const hal::DriveConfig& drive = bus.drives[index];
  const double count = 2.0 * std::numbers::pi / (drive.counts * drive.gear);
  const double way = joint.velocity * bus.period;
  if (count < 0.5 * way) return;
  table.complain("counts",
                 fmt::format("times gear makes a count {:.3g} rad, but at its largest velocity the joint moves "
                             "{:.3g} rad in a period: at least two counts; give a finer encoder or a longer "
                             "bus.period",
                             count, way));
}

}  // namespace

Device read_device_file(const std::filesystem::path& file) {
  files::require_regular_input(file);
  std::string text = files::read_text(file);
  const toml::table root = files::parse_toml(text, file.string());
  files::allow_tables(root, file, {"arm", "torque", "bus", "joint", "tool", "payload"});
  Device device;
  device.text = std::move(text);
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
  finish_buses(bus, joints, device.bus);
  for (std::size_t i = 0; i < joints.size(); ++i) require_resolution(joints[i], device.model.joints[i], device.bus, i);

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
