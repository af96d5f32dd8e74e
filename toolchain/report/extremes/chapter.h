#pragma once

#include <cstdint>
#include <filesystem>

#include "toolchain/report/extremes/extremes_fault.h"
#include "toolchain/report/study/case.h"

namespace godobject::report {

struct ExtremesRequest {
  std::filesystem::path devices = {};  ///< folder of the device files
  std::int64_t cycles = 0;             ///< total of the fuzzer; 0: the default number
  bool quick = false;
  std::uint32_t seed = 0;    ///< of the fuzzer, and of random setups and paths of other rows
  ExtremesFault fault = {};  ///< for tests of the rows
  bool one_place = false;    ///< for such tests: one of several meshes, places or solvers, and short runs
};

/// Returns the chapter on numerical extremes, with the fuzzer. Throws Failure (kNoInput) if the device file is missing.
Chapter extremes_chapter(const ExtremesRequest& request);

/// Runs a case file of the fuzzer again and prints the violations. Returns true if there is one. Throws Failure.
bool replay(const std::filesystem::path& file);

}  // namespace godobject::report
