#pragma once

#include <string>
#include <vector>

#include "toolchain/bench/chapters.h"

namespace godobject::bench {

/// Prepares Google Benchmark; call it before micro_chapter. `arguments`: its options (--benchmark_...), without the
/// program's name. Throws Failure (kUsage) for an unknown option.
void start_google_benchmark(bool full, const std::vector<std::string>& arguments);

/// Times single parts by Google Benchmark: look-ups near the surface, in the band and beyond it, bounds of spheres, the
/// search in the tree, the brute-force scans, the solver on the rows of a cycle in contact, and the closed forms of
/// `paper` and `corrected`.
Chapter micro_chapter(const BenchRequest& request);

}  // namespace godobject::bench
