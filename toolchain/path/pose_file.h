#pragma once

#include <filesystem>
#include <vector>

#include "godobject/pose.h"

namespace godobject::path {

/// Returns the poses of a motion, recorded (.csv, see toolchain/files/pose_path.h) or from key frames (TOML): the
/// moving mesh's frame in W, one pose for each period of the motion. Throws Failure.
std::vector<Pose> read_poses(const std::filesystem::path& file);

}  // namespace godobject::path
