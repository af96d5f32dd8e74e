#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "toolchain/files/scene_image.h"
#include "toolchain/precision/trace.h"
#include "toolchain/scene_compiler/scene_config.h"

/// What several cases of a scene need, made once by this program and kept in a folder.
namespace godobject::report {

/// The image of `config`; `key` names all that it depends on beside the program.
files::SceneImage kept_image(const std::filesystem::path& folder, const std::string& key,
                             const scene_compiler::SceneConfig& config);

/// Cycles that `run` gives; `key` as above. Kept in the machine's own order of bytes. Throws Failure (kBadData) where
/// the file holds no whole number of cycles.
std::vector<precision::TracedCycle> kept_cycles(const std::filesystem::path& folder, const std::string& key,
                                                const std::function<std::vector<precision::TracedCycle>()>& run);

}  // namespace godobject::report
