#pragma once

#include <cstdint>
#include <filesystem>

#include "toolchain/report/study/case.h"

namespace godobject::report {

struct ExtremesRequest {
  std::filesystem::path devices;  ///< folder of the device files
  std::int64_t cycles = 0;        ///< of the fuzzer in all; 0: as many as fit
  bool quick = false;
  std::uint32_t seed = 0;  ///< of the fuzzer: another one, other runs
};

/// Numerical extremes, and the fuzzer. Throws Failure (kNoInput) where the device file is missing.
Chapter extremes_chapter(const ExtremesRequest& request);

/// Runs a case file of the fuzzer again and prints what it finds. True: it is violated still. Throws Failure.
bool replay(const std::filesystem::path& file);

}  // namespace godobject::report
