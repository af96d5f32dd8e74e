#include "tests/support/arms.h"

#include <stdexcept>
#include <string>

#include "firmware/configuration/device_file.h"

namespace godobject::test {
namespace {

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
  const firmware::Device device = firmware::read_device_file(GODOBJECT_DEVICES_DIR "/" + std::string(name) + ".toml");
  if (device.name != name) throw std::runtime_error("the arm has another name");
  return {device.model, device.torque};
}

Arm random_arm(Random& random, int joint_count) {
  Arm arm;
  ArmModel& model = arm.model;
  model.joint_count = joint_count;
  model.H_RA = {random_rotation(random), random.in_cube(1.0)};
  model.gravity_R = random.between(1.0, 20.0) * random.direction();
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
