#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace godobject::files {

/// Returns the content of a text file or a pipe. Throws Failure: kNoInput if it cannot be read, kBadData if it has more
/// than `most` bytes, as an endless device has.
std::string read_text(const std::filesystem::path& file, std::size_t most = std::size_t{16} << 20);

}  // namespace godobject::files
