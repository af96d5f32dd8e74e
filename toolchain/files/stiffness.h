#pragma once

#include "toolchain/files/toml_table.h"

namespace godobject::files {

/// Range of the stiffness k_D in scene files and on command lines [N/m].
inline constexpr TomlTable::Range kStiffness{1e-6, 1e8};

}  // namespace godobject::files
