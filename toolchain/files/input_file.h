#pragma once

#include <filesystem>
#include <string_view>

namespace godobject::files {

/// Refuses a `file` that cannot be read, with the reason. Call it before opening the file. Throws Failure (kNoInput)
/// naming the file if nothing has this name (then with `cure`), if it is a folder, or if reading is not permitted.
void require_input(const std::filesystem::path& file, std::string_view cure = "check the path");

/// The same for files that are read more than once, or as a whole. A pipe or a device is refused too.
void require_regular_input(const std::filesystem::path& file, std::string_view cure = "check the path");

}  // namespace godobject::files
