#pragma once

#include <string_view>

#include "core/device/joint_torque.h"
#include "tests/support/random.h"

namespace godobject::test {

/// An arm and how it is driven.
struct Arm {
  ArmModel model;
  JointTorqueParameters parameters;
};

/// Of firmware/devices/<name>.toml. Throws as firmware::read_device_file.
Arm read_arm(std::string_view name);
inline Arm lwr() { return read_arm("lwr"); }
inline Arm desktop6() { return read_arm("desktop6"); }

/// Any arm that `validate` accepts, base and tool turned at random, with parameters of no arm in particular.
Arm random_arm(Random& random, int joint_count);

/// Positions within the limits.
JointVector random_positions(Random& random, const ArmModel& model);

/// Up to `size` at each joint that the arm has.
JointVector random_joints(Random& random, const ArmModel& model, double size);

}  // namespace godobject::test
