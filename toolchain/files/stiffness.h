#pragma once

#include "toolchain/files/toml_table.h"

namespace godobject::files {

/// k_D that scene files and command lines may ask for [N/m].
inline constexpr TomlTable::Range kStiffness{1e-6, 1e8};

}  // namespace godobject::files
