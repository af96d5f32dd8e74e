#pragma once

#include <filesystem>
#include <functional>

namespace godobject::report {

/// A file that several cases need. `make` writes it, whole or not at all, where it is not there; meanwhile other cases
/// that want it wait, in this process and in others. A file FILE.lock stays beside it. Throws Failure (kIo) where that
/// cannot be locked, and what `make` throws.
void make_once(const std::filesystem::path& file, const std::function<void()>& make);

}  // namespace godobject::report
