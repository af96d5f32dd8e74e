#pragma once

#include <filesystem>
#include <string>

#include "toolchain/report/study/case.h"

namespace godobject::report {

struct ContactQualityRequest {
  std::filesystem::path meshes;  ///< folder of the project's meshes
  bool quick = false;            ///< a few scenes, short
  std::string scene;             ///< only those whose name holds this
};

/// All solvers through all scenes, a case a scene; writes contact_quality.csv and contact_summary.csv. Throws Failure:
/// kUsage where there is no such scene, kNoInput where a mesh is missing.
Chapter contact_chapter(const ContactQualityRequest& request);

}  // namespace godobject::report
