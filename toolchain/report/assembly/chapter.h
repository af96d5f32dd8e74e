#pragma once

#include <cstdint>
#include <filesystem>

#include "toolchain/report/assembly/assembly_fault.h"
#include "toolchain/report/study/case.h"

namespace godobject::report {

struct AssemblyRequest {
  std::filesystem::path scenes;  ///< folder of the scene files
  std::filesystem::path kept;    ///< folder of images that several cases share; created if missing
  bool quick = false;            ///< only generated parts, which compile in seconds
  std::uint32_t seed = 0;        ///< of random loads
  AssemblyFault fault = {};      ///< for tests of the rows
};

/// Returns the chapter on parts that fit tightly. Throws Failure (kNoInput) if a scene file or mesh is missing.
Chapter assembly_chapter(const AssemblyRequest& request);

}  // namespace godobject::report
