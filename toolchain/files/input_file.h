#pragma once

#include <filesystem>
#include <string_view>

namespace godobject::files {

/// To be called before `file` is opened for reading, so that the user is told which of these it is. Throws Failure
/// (kNoInput) naming the file if nothing stands there (then with `cure`), if it is a folder, or if it may not be read.
void require_input(const std::filesystem::path& file, std::string_view cure = "check the path");

/// The same for what is read more than once, or as a whole: a pipe or a device is refused as well.
void require_regular_input(const std::filesystem::path& file, std::string_view cure = "check the path");

}  // namespace godobject::files
