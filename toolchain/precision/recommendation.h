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

#include "toolchain/precision/errors.h"
#include "toolchain/precision/exact_scene.h"
#include "toolchain/precision/pareto.h"
#include "toolchain/precision/setting.h"
#include "toolchain/precision/trace.h"

namespace godobject::precision {

/// Points on each body of the exact scene that settings are judged by.
inline constexpr std::uint32_t kReferencePoints = 6000;

/// Every so many cycles a pose is held against the exact meshes.
inline constexpr std::size_t kPenetrationStride = 8;

/// What of a setting is chosen when the image is there.
struct Variant {
  Solver solver = Solver::kContact;
  bool friction = false;
  double margin_ratio = 1.0;  ///< to that of the scene
};

/// What a setting has come to along some paths.
struct Result {
  Setting setting;
  WrenchError wrench;
  PenetrationError penetration;
  CycleCost cost;
  std::uint64_t image_bytes = 0;
  std::vector<TracedCycle> cycles;
};

/// By the 99th percentile of a cycle's time [ns] and the relative error of the wrench.
Trade trade(const Result& result);

/// The images worth trying for a scene: as it is written, then with one thing changed at a time.
std::vector<ImageSetting> candidate_images(const scene_compiler::SceneConfig& config);

/// Tries settings of one scene: compiles them and runs them along the paths.
class Trial {
 public:
  /// `paths`: none: those of press_paths(). `points` on each body of the exact scene. Throws Failure where the body
  /// meets nothing.
  Trial(const scene_compiler::SceneConfig& config, Paths paths, std::uint32_t points = kReferencePoints);

  struct Image {
    ImageSetting setting;
    std::filesystem::path file;         ///< where it is compiled to; gone afterwards
    std::optional<Solver> only_solver;  ///< that it is for
    std::size_t passes = 5;             ///< that times are medians of
  };

  /// Each variant on one image.
  std::vector<Result> operator()(const Image& image, std::span<const Variant> variants);

  const ExactScene& exact() const { return exact_; }
  const std::vector<TracedCycle>& reference(bool friction);

 private:
  scene_compiler::SceneConfig config_;
  ExactScene exact_;
  Paths paths_;
  std::array<std::vector<TracedCycle>, 2> reference_;  ///< without and with friction, once it was asked for
};

struct Recommendation {
  std::vector<Result> tried;
  std::optional<std::size_t> chosen;  ///< into `tried`; nothing: all cost more than the budget
};

/// Of all that `evaluate` says of the images, what best_within() takes for `budget_ns`.
Recommendation recommend(const std::vector<ImageSetting>& images, double budget_ns,
                         const std::function<std::vector<Result>(const ImageSetting&)>& evaluate);

/// "20us", "0.5 ms", "20000ns" as nanoseconds. Throws Failure (kUsage).
double parse_budget_ns(std::string_view text);

/// What was tried, cheapest first, what was chosen and why, and what `paper` does at no more than its cost.
std::string text(const Recommendation& recommendation, double budget_ns);

/// The same for an image's provenance.
nlohmann::ordered_json json(const Recommendation& recommendation, double budget_ns);

}  // namespace godobject::precision
