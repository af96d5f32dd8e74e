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

/// The part of a motion in which a body slides along a flat face.
struct Sliding {
  std::size_t begin = 0;  ///< cycles
  std::size_t end = 0;
  Vector3 normal = Vector3::UnitZ();  ///< normal of the face, in W
};

/// A scene of the study, and the motion in it.
struct PrecisionScene {
  std::string name;
  std::string path;  ///< file in the folder `paths`
  precision::Judging judging = {};
  std::optional<Sliding> sliding = {};  ///< measures the friction ratio
  bool finest_refined = false;          ///< also refined at half the voxel edge, which takes minutes to compile
};

const std::vector<PrecisionScene>& precision_scenes();

/// An image setting to try in a scene.
struct TriedImage {
  std::string name;  ///< name of the case
  precision::ImageSetting setting;
  std::string judged_as = {};  ///< name of its rows; empty: the errors are not judged
  bool margins = false;        ///< `contact` also with a tenth of its margin and with ten times its margin
};
std::vector<TriedImage> tried_images(const precision::ImageSetting& written, bool quick, bool finest_refined);

/// Names of the sheets of a case: errors are the same in every run, costs differ.
inline constexpr const char* kErrors = "work_precision_errors";
inline constexpr const char* kCosts = "work_precision_costs";

/// A fault that a test plants. The default changes nothing.
struct PrecisionFault {
  double body_scale = 1.0;  ///< of the moving mesh in the image, but not in the reference
  double time_gain = 1.0;   ///< of all measured times; a small one makes the choice independent of the machine
  double slower = 1.0;      ///< of the second measurement of a cycle's time, in addition
};

/// An image setting with its scene and inputs.
struct ImageTrial {
  PrecisionScene scene;
  TriedImage image;
  std::filesystem::path scenes;  ///< folder of the scene files
  std::filesystem::path kept;    ///< folder of images and references that several cases share
  std::string inputs;            ///< scene file, meshes and motion, as text
  bool quick = false;
  PrecisionFault fault = {};
};

/// Measures the errors of all solvers with and without friction along the scene's motion.
CaseResult image_errors(const ImageTrial& trial);

/// Measures the costs of the same settings.
CaseResult image_costs(const ImageTrial& trial);

}  // namespace godobject::report
