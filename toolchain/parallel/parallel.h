#pragma once

#include <cstddef>
#include <functional>

namespace godobject::parallel {

/// Gets the finished share of some work, 0 .. 1. May be empty.
using Progress = std::function<void(double)>;

/// Runs work(begin, end) over 0 .. count in chunks of `chunk` on all processors, each chunk once, in any order. The
/// first exception stops the work and is thrown to the caller. `progress` is called on the caller's thread.
void for_each_chunk(std::size_t count, std::size_t chunk, const std::function<void(std::size_t, std::size_t)>& work,
                    const Progress& progress = {});

/// Runs work(i) for i = 0 .. count - 1, likewise.
void for_each_index(std::size_t count, const std::function<void(std::size_t)>& work, const Progress& progress = {});

/// Returns a Progress that maps 0 .. 1 of a part of the work to begin .. end of the whole; empty if `progress` is.
Progress part_of(Progress progress, double begin, double end);

}  // namespace godobject::parallel
