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

/// How closely settings are judged.
struct Judging {
  std::uint32_t points = 6000;         ///< on each body of the exact scene
  std::size_t penetration_stride = 8;  ///< every so many cycles a pose is held against the exact meshes
};

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

/// Each variant on an image of a scene.
std::vector<Setting> settings_of(const scene_compiler::SceneConfig& config, const ImageSetting& image,
                                 std::span<const Variant> variants);

/// What cycles of the settings, all of one image, take: time_cycles.
std::vector<CycleCost> costs_of(const Scene& scene, std::span<const Setting> settings, const Paths& paths,
                                std::size_t passes);

/// Tries settings of one scene: runs them along the paths and holds them against the exact meshes.
class Trial {
 public:
  /// `paths`: none: those of press_paths(). Throws Failure where the body meets nothing.
  Trial(const scene_compiler::SceneConfig& config, Paths paths, const Judging& judging = {});

  struct Image {
    ImageSetting setting;
    std::filesystem::path file;         ///< where it is compiled to; gone afterwards
    std::optional<Solver> only_solver;  ///< that it is for
    std::size_t passes = 5;             ///< that times are medians of
  };

  /// Compiles one image; each variant on it.
  std::vector<Result> operator()(const Image& image, std::span<const Variant> variants);

  /// All but the costs, of settings that are all of this image.
  std::vector<Result> errors(const files::SceneImage& image, std::span<const Setting> settings);

  const ExactScene& exact() const { return exact_; }

  /// Along all paths; run where it is asked for first, unless it was given.
  const std::vector<TracedCycle>& reference(bool friction);

  /// As another trial of the same scene, paths and points has run it.
  void give_reference(bool friction, std::vector<TracedCycle> cycles);

 private:
  scene_compiler::SceneConfig config_;
  Judging judging_;
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

/// The same for an image's provenance, but for the times: the same choice gives the same image.
nlohmann::ordered_json json(const Recommendation& recommendation, double budget_ns);

}  // namespace godobject::precision
