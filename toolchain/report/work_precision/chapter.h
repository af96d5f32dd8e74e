#pragma once

#include <filesystem>

#include "toolchain/report/study/case.h"

namespace godobject::report {

struct WorkPrecisionRequest {
  std::filesystem::path scenes;  ///< folder of the scene files; their motions in its folder `paths`
  std::filesystem::path kept;    ///< made where it is not there: images and references that several cases need
  bool quick = false;
};

/// Error against run time. Throws Failure (kNoInput) where a scene file or motion is not there.
Chapter work_precision_chapter(const WorkPrecisionRequest& request);

}  // namespace godobject::report
