#pragma once

#include <filesystem>
#include <string>

namespace godobject::page {

/// Returns the script of the player: of that file, or, if the name is empty, of the one that build and installation put
/// beside the folder of the commands. Throws command::Failure (kNoInput) if it cannot be read.
std::string read_player(const std::filesystem::path& file);

}  // namespace godobject::page
