#pragma once

#include <filesystem>
#include <functional>

namespace godobject::report {

/// Makes a file that several cases need, if it is missing. `make` writes it, completely or not at all. Other cases that
/// need the file wait meanwhile, in this process and in others. A file FILE.lock remains beside it. Throws Failure
/// (kIo) if that file cannot be locked, and the exceptions of `make`.
void make_once(const std::filesystem::path& file, const std::function<void()>& make);

}  // namespace godobject::report
