#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "toolchain/report/contact_quality/quantities.h"

namespace godobject::report {

struct ContactQualityRequest {
  std::filesystem::path output;                                       ///< folder; made where it is not there
  std::filesystem::path meshes;                                       ///< folder of the project's meshes
  bool quick = false;                                                 ///< a few scenes, short
  std::string scene;                                                  ///< only those whose name holds this
  std::function<void(std::string_view phase, double done)> progress;  ///< may be empty
};

/// Runs all solvers through all scenes, writes OUTPUT/contact_quality.csv and OUTPUT/contact_summary.csv and returns
/// the measurements. Throws Failure.
std::vector<Measurement> contact_quality(const ContactQualityRequest& request);

}  // namespace godobject::report
