#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "godobject/pose.h"

namespace godobject::files {

/// One device pose a millisecond, of the moving mesh's frame in W.
struct PosePath {
  std::vector<double> t;           ///< [s], as written in the file
  std::vector<Pose> poses;         ///< as read: rotations not normalised, NaN and Inf possible
  std::vector<std::size_t> lines;  ///< the file's line of each
};

/// Reads `t,px,py,pz,qw,qx,qy,qz`. Throws Failure: kNoInput, or kBadData naming the line if t does not increase by 1 ms
/// within 10 %.
PosePath read_pose_path(const std::filesystem::path& file);

}  // namespace godobject::files
