#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "godobject/pose.h"

namespace godobject::files {

/// A device path: one pose of the moving mesh's frame in W for each period.
struct PosePath {
  std::vector<double> t;           ///< [s], as written in the file
  std::vector<Pose> poses;         ///< as read: rotations not normalised, NaN and Inf possible
  std::vector<std::size_t> lines;  ///< the line of each pose in the file
};

/// Reads the columns `t,px,py,pz,qw,qx,qy,qz`. Throws Failure: kNoInput, or kBadData naming the line if t does not
/// increase by `period` [s] within 10 %: rows are that far apart, whatever t says.
PosePath read_pose_path(const std::filesystem::path& file, double period);

}  // namespace godobject::files
