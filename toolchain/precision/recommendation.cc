#include "toolchain/precision/recommendation.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <new>
#include <numeric>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "toolchain/command_line/failure.h"
#include "toolchain/precision/press_path.h"
#include "toolchain/scene_compiler/compile_scene.h"

namespace godobject::precision {
namespace {

using command::ExitCode;
using command::Failure;

std::vector<Wrench> wrenches(const std::vector<TracedCycle>& cycles) {
  std::vector<Wrench> all;
  for (const TracedCycle& cycle : cycles) all.push_back(cycle.spring_W);
  return all;
}

Paths or_pressed(Paths paths, const ExactScene& exact, const scene_compiler::SceneConfig& config) {
  if (paths.empty()) paths = press_paths(exact);
  if (!paths.empty()) return paths;
  throw Failure(ExitCode::kBadData,
                fmt::format("{} and {}: the bodies do not meet from any side; give a motion with --path",
                            config.moving.name, config.still.name));
}

std::string us(double nanoseconds) { return fmt::format("{:.3g} us", 1e-3 * nanoseconds); }

std::string line(const Result& result) {
  return fmt::format("{:>9}  {:>9.4g} %  {:>9.4g} mm  {}", us(result.cost.p99_ns), 100.0 * result.wrench.relative,
                     1e3 * result.penetration.deepest, name(result.setting));
}

/// True if a file cannot be read or written: another image would meet that too.
bool is_of_a_file(const Failure& failure) {
  const ExitCode code = failure.exit_code();
  return code == ExitCode::kNoInput || code == ExitCode::kIo || code == ExitCode::kNoPermission;
}

/// Returns the best result of `paper` at no more than `budget_ns`, or nothing.
const Result* best_of_paper(const std::vector<Result>& tried, double budget_ns) {
  std::vector<Trade> trades;
  for (const Result& result : tried) {
    const bool is_paper = result.setting.solver == Solver::kPaper;
    trades.push_back(is_paper ? trade(result) : Trade{HUGE_VAL, HUGE_VAL});
  }
  const auto best = best_within(trades, budget_ns);
  return best ? &tried[*best] : nullptr;
}

nlohmann::ordered_json json(const ImageSetting& image) {
  return {{"voxel_size", image.voxel_size},
          {"refined", image.refined},
          {"both_directions", image.both_directions},
          {"points", image.points},
          {"levels", image.levels}};
}

nlohmann::ordered_json json(const Result& result) {
  nlohmann::ordered_json all{{"solver", format::kSolverNames[static_cast<std::size_t>(result.setting.solver)]},
                             {"friction", result.setting.friction}};
  all.update(json(result.setting.image));
  all["margin"] = result.setting.margin;
  all["wrench_error"] = result.wrench.relative;
  all["wrench_error_rms"] = result.wrench.rms;
  all["deepest_penetration"] = result.penetration.deepest;
  all["image_bytes"] = result.image_bytes;
  return all;
}

}  // namespace

Trade trade(const Result& result) { return {result.cost.p99_ns, result.wrench.relative}; }

std::vector<ImageSetting> candidate_images(const scene_compiler::SceneConfig& config) {
  const ImageSetting written = image_setting(config);
  std::vector<ImageSetting> images{written};
  const auto changed = [&](auto change) {
    images.push_back(written);
    change(images.back());
  };
  changed([](ImageSetting& image) { image.voxel_size *= 2.0; });
  changed([](ImageSetting& image) { image.voxel_size *= 0.5; });
  changed([](ImageSetting& image) { image.refined = !image.refined; });
  changed([](ImageSetting& image) { image.both_directions = !image.both_directions; });
  changed([](ImageSetting& image) { image.points = std::max(image.points / 4, std::min(image.points, 200u)); });
  changed([](ImageSetting& image) { image.points = std::min(4 * image.points, format::kMaxPoints); });
  changed([](ImageSetting& image) { image.refined = image.both_directions = false; });
  return images;
}

Trial::Trial(const scene_compiler::SceneConfig& config, Paths paths, const Judging& judging)
    : config_(config),
      judging_(judging),
      exact_(config, judging.points),
      paths_(or_pressed(std::move(paths), exact_, config)) {}

const std::vector<TracedCycle>& Trial::reference(bool friction) {
  std::vector<TracedCycle>& wanted = reference_[friction ? 1 : 0];
  if (wanted.empty()) wanted = exact_.reference(paths_, friction);
  return wanted;
}

void Trial::give_reference(bool friction, std::vector<TracedCycle> cycles) {
  reference_[friction ? 1 : 0] = std::move(cycles);
}

std::vector<Setting> settings_of(const scene_compiler::SceneConfig& config, const ImageSetting& image,
                                 std::span<const Variant> variants) {
  const double margin = with(config, image).settings.margin;
  std::vector<Setting> settings;
  for (const Variant& variant : variants) {
    settings.push_back({.image = image,
                        .solver = variant.solver,
                        .friction = variant.friction,
                        .margin = variant.margin_ratio * margin});
  }
  return settings;
}

std::vector<CycleCost> costs_of(const SceneView& scene, std::span<const Setting> settings, const Paths& paths,
                                std::size_t passes) {
  std::vector<Session> sessions;
  for (const Setting& setting : settings) sessions.emplace_back(scene, setting);
  return time_cycles(sessions, paths, passes);
}

std::vector<Result> Trial::errors(const files::SceneImage& image, std::span<const Setting> settings) {
  const Parameters& q = exact_.parameters();
  std::vector<Result> results;
  for (const Setting& setting : settings) {
    Result result{.setting = setting,
                  .wrench = {},
                  .penetration = {},
                  .cost = {},
                  .image_bytes = image.bytes.span().size(),
                  .cycles = {}};
    Session session(image.scene, setting);
    result.cycles = trace(session, paths_);
    result.wrench = wrench_error(wrenches(result.cycles), wrenches(reference(setting.friction)),
                                 q.coupling_rotation / q.coupling_translation);
    result.penetration = penetration_error(exact_, result.cycles, judging_.penetration_stride);
    results.push_back(std::move(result));
  }
  return results;
}

std::vector<Result> Trial::operator()(const Image& image, std::span<const Variant> variants) {
  scene_compiler::compile_scene({.scene_file = {},
                                 .config = with(config_, image.setting),
                                 .output = image.file,
                                 .only_solver = image.only_solver,
                                 .choice = {},
                                 .progress = {}});
  const files::SceneImage scene = files::SceneImage::read(image.file);
  std::filesystem::remove(image.file);
  const std::vector<Setting> settings = settings_of(config_, image.setting, variants);
  std::vector<Result> results = errors(scene, settings);
  const std::vector<CycleCost> costs = costs_of(scene.scene, settings, paths_, image.passes);
  for (std::size_t i = 0; i < results.size(); ++i) results[i].cost = costs[i];
  return results;
}

Recommendation recommend(const std::vector<ImageSetting>& images, double budget_ns,
                         const std::function<std::vector<Result>(const ImageSetting&)>& evaluate) {
  Recommendation recommendation;
  for (const ImageSetting& image : images) {
    try {
      for (Result& result : evaluate(image)) {
        result.cycles.clear();  // only the numbers are stored
        recommendation.tried.push_back(std::move(result));
      }
    } catch (const Failure& failure) {
      if (is_of_a_file(failure)) throw;
      recommendation.refused.push_back({image, failure.what()});
    } catch (const std::bad_alloc&) {
      recommendation.refused.push_back({image, "not enough memory; increase voxel_size or decrease moving.points"});
    }
  }
  std::vector<Trade> trades;
  for (const Result& result : recommendation.tried) trades.push_back(trade(result));
  recommendation.chosen = best_within(trades, budget_ns);
  return recommendation;
}

double parse_budget_ns(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  std::string_view unit(end, static_cast<std::size_t>(text.data() + text.size() - end));
  unit.remove_prefix(std::min(unit.find_first_not_of(' '), unit.size()));
  const double scale = unit == "ns" ? 1.0 : unit == "us" ? 1e3 : unit == "ms" ? 1e6 : 0.0;
  if (error != std::errc() || scale == 0.0 || !(value > 0.0) || !std::isfinite(value)) {
    throw Failure(ExitCode::kUsage,
                  fmt::format("--budget {}: no time with a unit; give the time of a cycle, for example 20us", text));
  }
  return scale * value;
}

std::string reason_for_nothing(const Recommendation& recommendation) {
  const std::vector<RefusedImage>& refused = recommendation.refused;
  if (recommendation.tried.empty()) {
    std::vector<std::string> reasons;
    for (const RefusedImage& image : refused) {
      if (std::find(reasons.begin(), reasons.end(), image.reason) == reasons.end()) reasons.push_back(image.reason);
    }
    return fmt::format("the compiler refused all {} images: {}", refused.size(), fmt::join(reasons, " | "));
  }
  const std::string without = refused.empty() ? "" : fmt::format(" ({} images were refused)", refused.size());
  return fmt::format(
      "none of the {} settings that were tried is that quick{}; give a larger budget, a coarser mesh or a larger "
      "voxel_size",
      recommendation.tried.size(), without);
}

std::string text(const Recommendation& recommendation, double budget_ns) {
  const std::vector<Result>& tried = recommendation.tried;
  std::vector<std::size_t> by_cost(tried.size());
  std::iota(by_cost.begin(), by_cost.end(), 0u);
  std::sort(by_cost.begin(), by_cost.end(),
            [&](std::size_t a, std::size_t b) { return tried[a].cost.p99_ns < tried[b].cost.p99_ns; });
  std::string text = fmt::format(
      "budget   {} a cycle (p99 on this machine); wrench error against exact meshes, deepest "
      "penetration of them:\n",
      us(budget_ns));
  for (const std::size_t i : by_cost) {
    text += fmt::format("  {} {}\n", recommendation.chosen == i ? '*' : ' ', line(tried[i]));
  }
  for (const RefusedImage& image : recommendation.refused)
    text += fmt::format("  - refused: {}: {}\n", name(image.setting), image.reason);
  if (!recommendation.chosen) return text;
  const Result& chosen = tried[*recommendation.chosen];
  text += fmt::format("chosen   {}: the smallest wrench error, {:.3g} %, at {} or less\n", name(chosen.setting),
                      100.0 * chosen.wrench.relative, us(budget_ns));
  if (const Result* paper = best_of_paper(tried, budget_ns); paper != nullptr && paper != &chosen) {
    text += fmt::format("         paper's best under this budget: {:.3g} %, {:.3g} times as much\n",
                        100.0 * paper->wrench.relative, paper->wrench.relative / chosen.wrench.relative);
  }
  return text;
}

nlohmann::ordered_json json(const Recommendation& recommendation, double budget_ns) {
  nlohmann::ordered_json all{{"budget_ns", budget_ns}, {"chosen", nullptr}, {"tried", nlohmann::ordered_json::array()}};
  if (recommendation.chosen) all["chosen"] = json(recommendation.tried[*recommendation.chosen]);
  for (const Result& result : recommendation.tried) all["tried"].push_back(json(result));
  for (const RefusedImage& image : recommendation.refused) {
    nlohmann::ordered_json refused = json(image.setting);
    refused["reason"] = image.reason;
    all["refused"].push_back(std::move(refused));
  }
  return all;
}

}  // namespace godobject::precision
