#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "toolchain/files/scene_image.h"
#include "toolchain/precision/errors.h"
#include "toolchain/precision/exact_scene.h"
#include "toolchain/precision/pareto.h"
#include "toolchain/precision/setting.h"
#include "toolchain/precision/trace.h"

namespace godobject::precision {

/// The precision with which settings are judged; both numbers are chosen.
struct Judging {
  std::uint32_t points = 6000;         ///< on each body of the exact scene
  std::size_t penetration_stride = 8;  ///< cycles from one check against the exact meshes to the next
};

/// The part of a setting that is chosen after the image is compiled.
struct Variant {
  Solver solver = Solver::kContact;
  bool friction = false;
  double margin_ratio = 1.0;  ///< of the scene's margin
};

/// The result of a setting along some paths.
struct Result {
  Setting setting;
  WrenchError wrench;
  PenetrationError penetration;
  CycleCost cost;
  std::uint64_t image_bytes = 0;
  std::vector<TracedCycle> cycles;
};

/// Returns the trade-off of a result: the 99th percentile of a cycle's time [ns] and the relative error of the wrench.
Trade trade(const Result& result);

/// Returns the images to try for a scene: the one of the scene file, then one change at a time.
std::vector<ImageSetting> candidate_images(const scene_compiler::SceneConfig& config);

/// Returns the settings of all variants on an image of a scene.
std::vector<Setting> settings_of(const scene_compiler::SceneConfig& config, const ImageSetting& image,
                                 std::span<const Variant> variants);

/// Returns the cycle costs of the settings, which share one image, as time_cycles does.
std::vector<CycleCost> costs_of(const SceneView& scene, std::span<const Setting> settings, const Paths& paths,
                                std::size_t passes);

/// Tries settings of one scene: runs them along the paths and compares them with the exact meshes.
class Trial {
 public:
  /// If `paths` is empty, press_paths() makes them. Throws Failure if the body meets nothing.
  Trial(const scene_compiler::SceneConfig& config, Paths paths, const Judging& judging = {});

  struct Image {
    ImageSetting setting;
    std::filesystem::path file;         ///< where the image is compiled; deleted afterwards
    std::optional<Solver> only_solver;  ///< the solver that the image is for
    std::size_t passes = 5;             ///< passes over which times are medians
  };

  /// Compiles one image and tries each variant on it.
  std::vector<Result> operator()(const Image& image, std::span<const Variant> variants);

  /// Returns the results without the costs. All settings must use this image.
  std::vector<Result> errors(const files::SceneImage& image, std::span<const Setting> settings);

  const ExactScene& exact() const { return exact_; }

  /// Returns the reference along all paths. The first call runs it, unless it was given.
  const std::vector<TracedCycle>& reference(bool friction);

  /// Stores a reference that another trial with the same scene, paths and points has run.
  void give_reference(bool friction, std::vector<TracedCycle> cycles);

 private:
  scene_compiler::SceneConfig config_;
  Judging judging_;
  ExactScene exact_;
  Paths paths_;
  std::array<std::vector<TracedCycle>, 2> reference_;  ///< without and with friction, once requested
};

/// An image that the compiler refuses.
struct RefusedImage {
  ImageSetting setting;
  std::string reason;
};

struct Recommendation {
  std::vector<Result> tried;
  std::vector<RefusedImage> refused;  ///< without results
  std::optional<std::size_t> chosen;  ///< index into `tried`; nothing: all cost more than the budget, or are refused
};

/// Evaluates the images and chooses the best_within() of `budget_ns`. An image whose evaluation throws Failure or
/// std::bad_alloc counts as refused. A Failure of a file (kNoInput, kIo, kNoPermission) is thrown on.
Recommendation recommend(const std::vector<ImageSetting>& images, double budget_ns,
                         const std::function<std::vector<Result>(const ImageSetting&)>& evaluate);

/// Returns "20us", "0.5 ms" or "20000ns" as nanoseconds. Throws Failure (kUsage).
double parse_budget_ns(std::string_view text);

/// Returns the reason why nothing was chosen, and the cure.
std::string reason_for_nothing(const Recommendation& recommendation);

/// Returns the tried settings, cheapest first, the refused images with their reasons, the choice and its reason, and
/// the best that `paper` does at the same cost.
std::string text(const Recommendation& recommendation, double budget_ns);

/// Returns the same for an image's provenance, without times and reasons: equal choices give equal images.
nlohmann::ordered_json json(const Recommendation& recommendation, double budget_ns);

}  // namespace godobject::precision
