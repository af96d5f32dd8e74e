#include "toolchain/report/work_precision/settings_tried.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include <fmt/format.h>

#include "toolchain/path/pose_file.h"
#include "toolchain/report/contact_quality/reference.h"
#include "toolchain/report/contact_quality/signals.h"
#include "toolchain/report/study/result_file.h"
#include "toolchain/report/work_precision/bounds.h"
#include "toolchain/report/work_precision/kept.h"
#include "toolchain/scene_compiler/points/sample_elimination.h"

namespace godobject::report {
namespace {

using precision::ImageSetting;

std::vector<Vector3> forces(const std::vector<precision::TracedCycle>& cycles) {
  std::vector<Vector3> all;
  for (const precision::TracedCycle& cycle : cycles) all.push_back(cycle.spring_W.force);
  return all;
}

/// Returns the mean ratio of tangential to normal spring force while sliding; NaN if the scene does not measure it.
double friction_ratio(const PrecisionScene& scene, const precision::Result& result) {
  double sum = 0.0;
  double count = 0.0;
  if (!scene.sliding || !result.setting.friction) return std::numeric_limits<double>::quiet_NaN();
  for (std::size_t k = scene.sliding->begin; k < std::min(scene.sliding->end, result.cycles.size()); ++k) {
    const Vector3& force = result.cycles[k].spring_W.force;
    const double normal = force.dot(scene.sliding->normal);
    if (normal <= 0.0) continue;
    sum += across(force, scene.sliding->normal).norm() / normal;
    count += 1.0;
  }
  return sum / count;
}

/// Returns the cycles with the largest force of the reference, one in each of `wanted` parts of the motion.
std::vector<std::size_t> checkpoints(const std::vector<precision::TracedCycle>& reference, std::size_t wanted) {
  std::vector<std::size_t> chosen;
  for (std::size_t part = 0; part < wanted; ++part) {
    const std::size_t begin = part * reference.size() / wanted;
    const std::size_t end = (part + 1) * reference.size() / wanted;
    std::size_t hardest = begin;
    for (std::size_t k = begin; k < end; ++k) {
      if (reference[k].spring_W.force.norm() > reference[hardest].spring_W.force.norm()) hardest = k;
    }
    if (reference[hardest].spring_W.force.norm() > 0.0) chosen.push_back(hardest);
  }
  return chosen;
}

/// Returns the largest distance of the god object to the constrained optimum on the exact still mesh at a few poses
/// [m]. NaN with friction, and if no optimum was found.
double optimum_distance(const precision::ExactScene& exact, const std::vector<Pose>& path,
                        const std::vector<std::size_t>& cycles, const precision::Result& result) {
  double farthest = std::numeric_limits<double>::quiet_NaN();
  if (result.setting.friction) return farthest;
  OptimumProblem problem;
  problem.rho_squared = exact.parameters().coupling_rotation / exact.parameters().coupling_translation;
  for (std::size_t i = 0; i < exact.points().size; ++i) problem.points_B.push_back(exact.points().point(i));
  problem.pieces = [&](const Vector3& p_W, std::vector<analytic::Piece>& out) {
    const FieldSample sample = exact.still().sample(p_W);
    out.push_back({sample.distance, sample.gradient});
  };
  for (const std::size_t k : cycles) {
    problem.H_WD = path[k] * exact.H_MB();
    const OptimumGap gap = optimum_gap(problem, result.cycles[k].H_WM * exact.H_MB(), true);
    if (gap.known) farthest = std::isnan(farthest) ? gap.distance : std::max(farthest, gap.distance);
  }
  return farthest;
}

const std::vector<std::string> kKey = {"scene",           "solver", "friction", "voxel_mm", "refined",
                                       "both_directions", "points", "levels",   "margin_um"};

std::vector<std::string> key_of(const std::string& scene, const precision::Setting& setting) {
  return {scene,
          format::kSolverNames[static_cast<std::size_t>(setting.solver)],
          setting.friction ? "on" : "off",
          fmt::format("{:.6g}", 1e3 * setting.image.voxel_size),
          setting.image.refined ? "yes" : "no",
          setting.image.both_directions ? "yes" : "no",
          std::to_string(setting.image.points),
          std::to_string(setting.image.levels),
          fmt::format("{:.6g}", 1e6 * setting.margin)};
}

Sheet sheet(const char* name, const std::vector<std::string>& values) {
  Sheet made{.name = name, .columns = kKey, .rows = {}};
  made.columns.insert(made.columns.end(), values.begin(), values.end());
  return made;
}

void add(Sheet& sheet, std::vector<std::string> row, std::initializer_list<double> values) {
  for (const double value : values) row.push_back(cell(value));
  sheet.rows.push_back(std::move(row));
}

std::filesystem::path path_file(const ImageTrial& trial) { return trial.scenes / "paths" / trial.scene.path; }

scene_compiler::SceneConfig scene_config(const ImageTrial& trial) {
  return scene_compiler::read_scene_config(trial.scenes / (trial.scene.name + ".toml"));
}

files::SceneImage image_of(const ImageTrial& trial, const scene_compiler::SceneConfig& config) {
  scene_compiler::SceneConfig compiled = precision::with(config, trial.image.setting);
  compiled.moving.scale *= trial.fault.body_scale;
  // this program says what the name of a setting means
  return kept_image(
      trial.kept,
      fmt::format("{} {} image {} scale {}", program_digest(), trial.inputs, trial.image.name, compiled.moving.scale),
      compiled);
}

/// Returns all solvers, each with and without friction.
std::vector<precision::Setting> settings(const ImageTrial& trial, const scene_compiler::SceneConfig& config) {
  std::vector<precision::Variant> variants;
  for (std::uint32_t i = 0; i < format::kSolverCount; ++i) {
    for (const bool friction : {false, true}) variants.push_back({static_cast<Solver>(i), friction, 1.0});
  }
  if (trial.image.margins)
    variants.insert(variants.end(), {{Solver::kContact, true, 0.1}, {Solver::kContact, true, 10.0}});
  return precision::settings_of(config, trial.image.setting, variants);
}

}  // namespace

const std::vector<PrecisionScene>& precision_scenes() {
  static const std::vector<PrecisionScene> all = {
      {.name = "bunny-teapot", .path = "bunny-teapot.csv", .finest_refined = true},
      {.name = "bunny-plate", .path = "through-plate.toml", .sliding = Sliding{.begin = 550, .end = 700}},
      {.name = "peg-hole", .path = "peg-hole.toml", .judging = {.points = 400, .penetration_stride = 32}}};
  return all;
}

std::vector<TriedImage> tried_images(const ImageSetting& written, bool quick, bool finest_refined) {
  std::vector<TriedImage> images;
  const auto add = [&](const std::string& name, auto change) {
    ImageSetting setting = written;
    change(setting);
    setting.levels = std::min(setting.levels, scene_compiler::most_levels(setting.points));
    const bool as_written = name == "as-written";
    images.push_back({name, setting, as_written ? "as written" : name == "voxel-1-plain" ? "plain" : "", as_written});
  };
  const auto plain = [](ImageSetting& setting) { setting.refined = setting.both_directions = false; };
  if (quick) {
    add("voxel-1-points-1000-plain", [&](ImageSetting& s) { plain(s), s.points = 1000; });
    add("voxel-1-plain", plain);  // also in the whole run
    return images;
  }
  add("as-written", [](ImageSetting&) {});
  add("voxel-2", [](ImageSetting& s) { s.voxel_size *= 2.0; });
  if (finest_refined) add("voxel-0.5", [](ImageSetting& s) { s.voxel_size *= 0.5; });
  add("points-1000", [](ImageSetting& s) { s.points = 1000; });
  add("points-20000", [](ImageSetting& s) { s.points = 20000; });
  add("levels-4", [](ImageSetting& s) { s.levels = 4; });
  add("not-refined", [](ImageSetting& s) { s.refined = false; });
  add("one-direction", [](ImageSetting& s) { s.both_directions = false; });
  for (const double ratio : {2.0, 1.0, 0.5, 0.25}) {
    for (const std::uint32_t points : {1000u, written.points, 20000u}) {
      const bool written_size = ratio == 1.0 && points == written.points;
      const std::string name =
          written_size ? "voxel-1-plain" : fmt::format("voxel-{:g}-points-{}-plain", ratio, points);
      add(name, [&](ImageSetting& s) {
        plain(s);
        s.voxel_size *= ratio;
        s.points = points;
      });
    }
  }
  return images;
}

CaseResult image_errors(const ImageTrial& trial) {
  const scene_compiler::SceneConfig config = scene_config(trial);
  const std::vector<Pose> path = path::read_poses(path_file(trial), config.settings.period);
  precision::Trial judge(config, {path}, trial.scene.judging);
  for (const bool friction : {false, true}) {
    const std::string key = fmt::format("{} reference, friction {}", trial.inputs, friction);
    judge.give_reference(friction, kept_cycles(trial.kept, key, [&] { return judge.reference(friction); }));
  }
  const std::vector<precision::Result> results = judge.errors(image_of(trial, config), settings(trial, config));

  CaseResult made;
  Sheet errors =
      sheet(kErrors, {"wrench_error", "wrench_error_N", "force_error", "torque_error", "force_magnitude_N",
                      "force_direction_rad", "penetration_deepest_mm", "penetration_rms_mm", "optimum_distance_mm",
                      "friction_ratio", "chatter_N", "chatter_of_reference_N", "image_bytes"});
  const std::vector<std::size_t> checked = checkpoints(judge.reference(false), trial.quick ? 1 : 3);
  for (const precision::Result& result : results) {
    add(errors, key_of(trial.scene.name, result.setting),
        {result.wrench.relative, result.wrench.rms, result.wrench.force, result.wrench.torque, result.wrench.magnitude,
         result.wrench.direction, 1e3 * result.penetration.deepest, 1e3 * result.penetration.rms,
         1e3 * optimum_distance(judge.exact(), path, checked, result), friction_ratio(trial.scene, result),
         chatter(forces(result.cycles)), chatter(forces(judge.reference(result.setting.friction))),
         static_cast<double>(result.image_bytes)});
    const bool usual = result.setting.solver == Solver::kContact && result.setting.margin == config.settings.margin;
    if (trial.image.judged_as.empty() || !usual) continue;
    const ErrorBounds bounds = error_bounds(trial.scene.name, trial.image.judged_as, result.setting.friction);
    made.findings.push_back(judged(bounds.force, 100.0 * result.wrench.force));
    made.findings.push_back(judged(bounds.torque, 100.0 * result.wrench.torque));
    made.findings.push_back(judged(bounds.penetration, 1e3 * result.penetration.deepest));
  }
  made.sheets = {errors};
  return made;
}

CaseResult image_costs(const ImageTrial& trial) {
  const scene_compiler::SceneConfig config = scene_config(trial);
  const std::vector<precision::Setting> tried = settings(trial, config);
  const files::SceneImage image = image_of(trial, config);
  const precision::Paths paths{path::read_poses(path_file(trial), config.settings.period)};
  const std::size_t passes = trial.quick ? 3 : 5;
  const std::vector<precision::CycleCost> found = precision::costs_of(image.scene, tried, paths, passes);
  const std::vector<precision::CycleCost> again = precision::costs_of(image.scene, tried, paths, passes);
  double load = 0.0;
  ::getloadavg(&load, 1);
  const double us = 1e-3 * trial.fault.time_gain;
  Sheet costs = sheet(kCosts, {"p50_us", "p99_us", "max_us", "p99_again_us", "instructions_a_cycle", "load"});
  for (std::size_t i = 0; i < tried.size(); ++i) {
    const precision::CycleCost& cost = found[i];
    add(costs, key_of(trial.scene.name, tried[i]),
        {us * cost.p50_ns, us * cost.p99_ns, us * cost.max_ns, us * trial.fault.slower * again[i].p99_ns,
         cost.instructions, load});
  }
  return {.findings = {}, .sheets = {costs}};
}

}  // namespace godobject::report
