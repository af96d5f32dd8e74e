#pragma once

#include <string_view>

#include "godobject/pose.h"
#include "toolchain/files/toml_table.h"

namespace godobject::firmware {

/// Reads a pose [x, y, z, qw, qx, qy, qz]. A rotation within 1e-3 of unit length is normalised, any other refused.
Pose read_pose(const files::TomlTable& table, std::string_view key);

/// Reads a rotation [qw, qx, qy, qz], with the same rule.
Quaternion read_rotation(const files::TomlTable& table, std::string_view key);

}  // namespace godobject::firmware
