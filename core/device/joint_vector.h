#pragma once

#include <Eigen/Core>

namespace godobject {

/// The largest number of joints of an arm.
inline constexpr int kMaxJoints = 7;

/// One number a joint. Entries from the arm's joint count on are zero.
using JointVector = Eigen::Matrix<double, kMaxJoints, 1>;

}  // namespace godobject
