#pragma once

#include <filesystem>
#include <vector>

#include "godobject/pose.h"

namespace godobject::path {

/// Returns the poses of a motion, recorded (.csv, see toolchain/files/pose_path.h) or from key frames (TOML): the
/// moving mesh's frame in W, one pose for each `period` [s]. Throws Failure, also if the file's period is another one.
std::vector<Pose> read_poses(const std::filesystem::path& file, double period);

}  // namespace godobject::path
