#pragma once

#include <filesystem>
#include <vector>

#include "godobject/pose.h"

namespace godobject::path {

/// The poses of a motion, recorded (.csv, see toolchain/files/pose_path.h) or of key frames (TOML): of the moving
/// mesh's frame in W, one a millisecond. Throws Failure.
std::vector<Pose> read_poses(const std::filesystem::path& file);

}  // namespace godobject::path
