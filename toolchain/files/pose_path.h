#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "godobject/pose.h"

namespace godobject::files {

/// A device path: one pose of the moving mesh's frame in W for each millisecond.
struct PosePath {
  std::vector<double> t;           ///< [s], as written in the file
  std::vector<Pose> poses;         ///< as read: rotations not normalised, NaN and Inf possible
  std::vector<std::size_t> lines;  ///< the line of each pose in the file
};

/// Reads the columns `t,px,py,pz,qw,qx,qy,qz`. Throws Failure: kNoInput, or kBadData naming the line if t does not
/// increase by 1 ms within 10 %.
PosePath read_pose_path(const std::filesystem::path& file);

}  // namespace godobject::files
