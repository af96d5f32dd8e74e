#include "tests/support/arms.h"

#include <initializer_list>
#include <stdexcept>
#include <string>

#include <toml++/toml.h>

namespace godobject::test {
namespace {

const toml::table& table(const toml::table& parent, std::string_view key) {
  const toml::table* found = parent[key].as_table();
  if (found == nullptr) throw std::runtime_error("no table " + std::string(key));
  return *found;
}

double number(const toml::table& parent, std::string_view key) {
  const auto found = parent[key].value<double>();
  if (!found) throw std::runtime_error("no number " + std::string(key));
  return *found;
}

template <int kSize>
Eigen::Matrix<double, kSize, 1> numbers(const toml::table& parent, std::string_view key) {
  const toml::array* found = parent[key].as_array();
  if (found == nullptr || found->size() != kSize) throw std::runtime_error("not the right count: " + std::string(key));
  Eigen::Matrix<double, kSize, 1> result;
  for (int i = 0; i < kSize; ++i) result[i] = found->get(static_cast<std::size_t>(i))->value<double>().value();
  return result;
}

Pose pose(const toml::table& parent, std::string_view key) {
  const auto n = numbers<7>(parent, key);
  return {Quaternion(n[3], n[4], n[5], n[6]), n.head<3>()};
}

LinkMass link_mass(const toml::table& parent) {
  const auto n = numbers<6>(parent, "inertia");
  LinkMass body;
  body.mass = number(parent, "mass");
  body.com = numbers<3>(parent, "com");
  body.inertia << n[0], n[3], n[4], n[3], n[1], n[5], n[4], n[5], n[2];
  return body;
}

/// A misspelt key must not pass for a missing one.
void expect_keys(const toml::table& parent, std::initializer_list<std::string_view> known) {
  for (const auto& [key, value] : parent) {
    bool found = false;
    for (const std::string_view name : known) found = found || key.str() == name;
    if (!found) throw std::runtime_error("unknown key " + std::string(key.str()));
  }
}

void read_joint(const toml::table& joint, std::size_t index, Arm& arm) {
  expect_keys(joint, {"a", "alpha", "d", "offset", "lower", "upper", "velocity", "torque", "rotor", "damping", "mass",
                      "com", "inertia", "null_damping", "limit_stiffness", "limit_damping"});
  ArmJoint& read = arm.model.joints.at(index);
  read.a = number(joint, "a");
  read.alpha = number(joint, "alpha");
  read.d = number(joint, "d");
  read.offset = number(joint, "offset");
  read.lower = number(joint, "lower");
  read.upper = number(joint, "upper");
  read.velocity = number(joint, "velocity");
  read.torque = number(joint, "torque");
  read.rotor = number(joint, "rotor");
  read.damping = number(joint, "damping");
  read.link = link_mass(joint);
  const auto i = static_cast<Eigen::Index>(index);
  arm.parameters.null_damping[i] = number(joint, "null_damping");
  arm.parameters.limit_stiffness[i] = number(joint, "limit_stiffness");
  arm.parameters.limit_damping[i] = number(joint, "limit_damping");
}

Quaternion random_rotation(Random& random) { return exp_rotation(random.motion(0.0, 3.14).rotation); }

LinkMass random_body(Random& random, double mass) {
  LinkMass body;
  body.mass = mass;
  body.com = random.in_cube(0.2);
  // the second moments of any mass are positive; an inertia is what they are about the axes
  const Matrix3 R = random_rotation(random).toRotationMatrix();
  const Vector3 moments =
      mass * Vector3(random.between(0.0, 0.02), random.between(0.0, 0.02), random.between(0.0, 0.02));
  const Matrix3 second = R * moments.asDiagonal() * R.transpose();
  body.inertia = second.trace() * Matrix3::Identity() - second;
  return body;
}

}  // namespace

Arm read_arm(std::string_view name) {
  const toml::table file = toml::parse_file(GODOBJECT_DEVICES_DIR "/" + std::string(name) + ".toml");
  expect_keys(file, {"arm", "torque", "joint", "tool", "payload"});
  Arm arm;
  const toml::table& base = table(file, "arm");
  expect_keys(base, {"name", "base", "gravity"});
  if (base["name"].value<std::string>() != name) throw std::runtime_error("the arm has another name");
  arm.model.H_WA = pose(base, "base");
  arm.model.gravity_W = numbers<3>(base, "gravity");
  arm.model.H_FM = pose(table(file, "tool"), "pose");
  arm.model.payload = link_mass(table(file, "payload"));

  const toml::table& torque = table(file, "torque");
  expect_keys(torque, {"rotation_length", "singular_none", "singular_full", "limit_band"});
  arm.parameters.rotation_length = number(torque, "rotation_length");
  arm.parameters.singular_none = number(torque, "singular_none");
  arm.parameters.singular_full = number(torque, "singular_full");
  arm.parameters.limit_band = number(torque, "limit_band");

  const toml::array* joints = file["joint"].as_array();
  if (joints == nullptr) throw std::runtime_error("no joints");
  for (const toml::node& joint : *joints) {
    read_joint(*joint.as_table(), static_cast<std::size_t>(arm.model.joint_count), arm);
    ++arm.model.joint_count;
  }
  return arm;
}

Arm random_arm(Random& random, int joint_count) {
  Arm arm;
  ArmModel& model = arm.model;
  model.joint_count = joint_count;
  model.H_WA = {random_rotation(random), random.in_cube(1.0)};
  model.gravity_W = random.between(1.0, 20.0) * random.direction();
  model.H_FM = {random_rotation(random), random.in_cube(0.2)};
  model.payload = random_body(random, random.between(0.0, 2.0));
  for (int i = 0; i < joint_count; ++i) {
    ArmJoint& joint = model.joints.at(static_cast<std::size_t>(i));
    joint.a = random.between(-0.3, 0.3);
    joint.alpha = random.between(-3.1, 3.1);
    joint.d = random.between(-0.3, 0.3);
    joint.offset = random.between(-3.1, 3.1);
    joint.lower = random.between(-3.0, -0.5);
    joint.upper = random.between(0.5, 3.0);
    joint.velocity = random.between(1.0, 5.0);
    joint.torque = random.between(1.0, 100.0);
    joint.rotor = random.between(0.0, 0.1);
    joint.link = random_body(random, random.between(0.1, 5.0));
    arm.parameters.null_damping[i] = random.between(0.0, 5.0);
    arm.parameters.limit_stiffness[i] = random.between(0.0, 200.0);
    arm.parameters.limit_damping[i] = random.between(0.0, 10.0);
  }
  return arm;
}

JointVector random_positions(Random& random, const ArmModel& model) {
  JointVector q = JointVector::Zero();
  for (int i = 0; i < model.joint_count; ++i) {
    const ArmJoint& joint = model.joints.at(static_cast<std::size_t>(i));
    q[i] = random.between(joint.lower, joint.upper);
  }
  return q;
}

JointVector random_joints(Random& random, const ArmModel& model, double size) {
  JointVector joints = JointVector::Zero();
  for (int i = 0; i < model.joint_count; ++i) joints[i] = random.between(-size, size);
  return joints;
}

}  // namespace godobject::test
