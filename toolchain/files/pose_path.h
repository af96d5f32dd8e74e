#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "godobject/pose.h"

namespace godobject::files {

/// A device path: one pose of the moving mesh's frame in W for each period.
struct PosePath {
  double period = 1e-3;            ///< T: the mean step of t; 1 ms for a single pose [s]
  std::vector<double> t;           ///< [s], as written in the file
  std::vector<Pose> poses;         ///< as read: rotations not normalised, NaN and Inf possible
  std::vector<std::size_t> lines;  ///< the line of each pose in the file
};

/// Reads the columns `t,px,py,pz,qw,qx,qy,qz`. Throws Failure: kNoInput, or kBadData naming the line if a step of
/// t differs by more than 10 % from the mean one, or that is not within 1.25e-4 .. 1e-2 s.
PosePath read_pose_path(const std::filesystem::path& file);

}  // namespace godobject::files
