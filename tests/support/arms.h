#pragma once

#include <string_view>

#include "core/device/joint_torque.h"
#include "tests/support/random.h"

namespace godobject::test {

/// An arm and the parameters of its joint torques.
struct Arm {
  ArmModel model;
  JointTorqueParameters parameters;
};

/// Reads firmware/devices/<name>.toml. Throws as firmware::read_device_file, and if the file names another arm.
Arm read_arm(std::string_view name);
inline Arm lwr() { return read_arm("lwr"); }
inline Arm desktop6() { return read_arm("desktop6"); }

/// Returns a random arm that `validate` accepts: geometry, masses, base, tool and parameters are random.
Arm random_arm(Random& random, int joint_count);

/// Returns random joint positions within the limits.
JointVector random_positions(Random& random, const ArmModel& model);

/// Returns random values in [-size, size] for the joints of the arm, and zeros for the rest.
JointVector random_joints(Random& random, const ArmModel& model, double size);

}  // namespace godobject::test
