#pragma once

#include <Eigen/Core>

namespace godobject {

using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;

/// A rigid motion as the paper writes it: translation, then rotation vector, both in one frame. [m, rad]
/// The set is (x, r) of the paper's `setMatrix` and `getTranslation`/`getRotation`: NOT the SE(3) logarithm.
struct Motion {
  Vector3 translation = Vector3::Zero();
  Vector3 rotation = Vector3::Zero();
};

/// Force, then torque, both in one frame and about one point. [N, Nm] unless a name says otherwise.
struct Wrench {
  Vector3 force = Vector3::Zero();
  Vector3 torque = Vector3::Zero();
};

}  // namespace godobject
