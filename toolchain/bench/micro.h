#pragma once

#include <string>
#include <vector>

#include "toolchain/bench/chapters.h"

namespace godobject::bench {

/// Before micro_chapter. `arguments`: --benchmark_... for Google Benchmark, without the program's name. Throws Failure
/// (kUsage) for what it does not know.
void start_google_benchmark(bool full, const std::vector<std::string>& arguments);

/// Single parts under Google Benchmark: look-ups near the surface, in the band and beyond it, bounds of spheres, the
/// tree's search, the brute-force scans, the solver on the rows of a cycle in contact, the closed forms of `paper` and
/// `corrected`.
Chapter micro_chapter(const BenchRequest& request);

}  // namespace godobject::bench
