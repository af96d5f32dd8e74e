#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/spatial/vector.h"
#include "toolchain/precision/recommendation.h"
#include "toolchain/report/study/case.h"

namespace godobject::report {

/// Where a body slides along a flat face.
struct Sliding {
  std::size_t begin = 0;  ///< cycles
  std::size_t end = 0;
  Vector3 normal = Vector3::UnitZ();  ///< of the face, in W
};

/// A scene of the study, and the motion in it.
struct PrecisionScene {
  std::string name;
  std::string path;  ///< in the folder `paths`
  std::uint32_t reference_points = precision::kReferencePoints;
  std::optional<Sliding> sliding = {};  ///< where the friction's ratio is measured
};

const std::vector<PrecisionScene>& precision_scenes();

/// The images that are tried in a scene as it is written.
struct TriedImage {
  std::string name;  ///< of the case
  precision::ImageSetting setting;
  bool margins = false;  ///< `contact` also with a tenth and ten times of its margin
};
std::vector<TriedImage> tried_images(const precision::ImageSetting& written, bool quick);

/// Names of the sheets that a case fills: what does not differ from run to run, and what does.
inline constexpr const char* kErrors = "work_precision_errors";
inline constexpr const char* kCosts = "work_precision_costs";

/// Compiles the image, runs all solvers with and without friction along the scene's motion.
CaseResult try_image(const PrecisionScene& scene, const TriedImage& image, const std::filesystem::path& scenes,
                     const std::filesystem::path& work, bool quick);

}  // namespace godobject::report
