#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "toolchain/files/scene_image.h"
#include "toolchain/precision/trace.h"
#include "toolchain/scene_compiler/scene_config.h"

/// Images and references that several cases of a scene share, made once and stored in a folder. Programs with the same
/// scene compiler share images; references are those of one program.
namespace godobject::report {

/// Returns the image of `config`; `key` names all its inputs except the compiler.
files::SceneImage kept_image(const std::filesystem::path& folder, const std::string& key,
                             const scene_compiler::SceneConfig& config);

/// Returns the cycles of `run`; `key` names all inputs except the program. They are stored in the machine's byte order.
/// Throws Failure (kBadData) if the file ends within a cycle.
std::vector<precision::TracedCycle> kept_cycles(const std::filesystem::path& folder, const std::string& key,
                                                const std::function<std::vector<precision::TracedCycle>()>& run);

}  // namespace godobject::report
