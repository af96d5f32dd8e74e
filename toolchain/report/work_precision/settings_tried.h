#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "godobject/pose.h"
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
  precision::Judging judging = {};
  std::optional<Sliding> sliding = {};  ///< where the friction's ratio is measured
  bool finest_refined = false;          ///< also refined at half the voxel edge, which takes minutes to compile
};

const std::vector<PrecisionScene>& precision_scenes();

/// The images that are tried in a scene as it is written.
struct TriedImage {
  std::string name;  ///< of the case
  precision::ImageSetting setting;
  bool margins = false;  ///< `contact` also with a tenth and ten times of its margin
};
std::vector<TriedImage> tried_images(const precision::ImageSetting& written, bool quick, bool finest_refined);

/// Names of the sheets that a case fills: what does not differ from run to run, and what does.
inline constexpr const char* kErrors = "work_precision_errors";
inline constexpr const char* kCosts = "work_precision_costs";

/// An image and what it is tried on.
struct ImageTrial {
  PrecisionScene scene;
  TriedImage image;
  std::filesystem::path scenes;  ///< folder of the scene files
  std::filesystem::path kept;    ///< for images and references that several cases need
  std::string inputs;            ///< scene file, meshes and motion, as text
  bool quick = false;
};

/// All solvers with and without friction along the scene's motion: the errors.
CaseResult image_errors(const ImageTrial& trial);

/// Of the same settings what cycles cost.
CaseResult image_costs(const ImageTrial& trial);

}  // namespace godobject::report
