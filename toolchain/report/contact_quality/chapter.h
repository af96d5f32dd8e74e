#pragma once

#include <filesystem>
#include <string>

#include "toolchain/report/study/case.h"

namespace godobject::report {

struct ContactQualityRequest {
  std::filesystem::path meshes;  ///< folder of the project's meshes
  bool quick = false;            ///< few scenes and short motions
  std::string scene;             ///< only scenes whose name contains this
};

/// Returns the bounds of the chapter, which are those of `contact`.
std::vector<Bound> contact_bounds();

/// Returns the chapter that runs all solvers through all scenes, one case per scene. It writes contact_quality.csv and
/// contact_summary.csv. Throws Failure: kUsage if there is no such scene, kNoInput if a mesh is missing.
Chapter contact_chapter(const ContactQualityRequest& request);

}  // namespace godobject::report
