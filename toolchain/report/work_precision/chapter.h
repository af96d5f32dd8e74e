#pragma once

#include <filesystem>

#include "toolchain/report/study/case.h"
#include "toolchain/report/work_precision/settings_tried.h"

namespace godobject::report {

struct WorkPrecisionRequest {
  std::filesystem::path scenes;  ///< folder of the scene files; their motions in its folder `paths`
  std::filesystem::path kept;    ///< folder of images and references that several cases share; created if missing
  bool quick = false;
  PrecisionFault fault = {};  ///< for tests of the rows
};

/// Returns the chapter on error against run time. Throws Failure (kNoInput) if a scene file or motion is missing.
Chapter work_precision_chapter(const WorkPrecisionRequest& request);

}  // namespace godobject::report
