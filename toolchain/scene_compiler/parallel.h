#pragma once

#include <cstddef>
#include <functional>

namespace godobject::scene_compiler {

using Progress = std::function<void(double)>;  ///< gets 0 .. 1; may be empty

/// Runs work(i) for i = 0 .. count - 1 on all processors, each i once, in any order. The first exception ends it and is
/// thrown to the caller. `progress` is called on the caller's thread.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& work, const Progress& progress = {});

}  // namespace godobject::scene_compiler
