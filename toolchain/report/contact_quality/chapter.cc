#include "toolchain/report/contact_quality/chapter.h"

#include <algorithm>
#include <iterator>
#include <memory>

#include <fmt/format.h>

#include "toolchain/command_line/failure.h"
#include "toolchain/files/html_text.h"
#include "toolchain/files/input_file.h"
#include "toolchain/report/contact_quality/measure.h"
#include "toolchain/report/contact_quality/scenes.h"
#include "toolchain/report/contact_quality/table.h"

namespace godobject::report {
namespace {

using command::ExitCode;
using command::Failure;

std::vector<SceneSpec> chosen_scenes(const ContactQualityRequest& request) {
  std::vector<SceneSpec> all = scenes();
  std::erase_if(all, [&](const SceneSpec& scene) {
    return (request.quick && !scene.quick) || scene.name.find(request.scene) == std::string::npos;
  });
  if (all.empty()) {
    throw Failure(ExitCode::kUsage,
                  fmt::format("--scene {}: no scene's name contains this; see --list", request.scene));
  }
  return all;
}

/// Refuses a missing mesh of a body before the first scene runs.
void require_meshes(const std::vector<SceneSpec>& chosen, const std::filesystem::path& folder) {
  const bool reads =
      std::any_of(chosen.begin(), chosen.end(), [](const SceneSpec& scene) { return scene.body == BodyShape::kBunny; });
  if (reads) {
    files::require_regular_input(folder / kBunnyMesh,
                                 "name its folder with --meshes: toolchain/scenes/meshes of the sources has it");
  }
}

std::vector<Measurement> measure_scene(const SceneSpec& scene, const ContactQualityRequest& request,
                                       const std::filesystem::path& work) {
  const Effort effort = request.quick ? Effort{.dashes = 5, .tremor_s = 2.0} : Effort{};
  const Body body = make_body(name(scene.body), body_mesh(scene.body, request.meshes), body_points(scene.body), work);
  const WorldSettings settings{.voxel_size = scene.voxel_size, .safety_distance = 1.5 * scene.voxel_size};
  std::unique_ptr<World> world;
  std::unique_ptr<World> still_world;
  if (scene.kind == WorldKind::kCompiled) {
    world = make_compiled_world(scene.name, placed(scene), body, settings, work);
  } else {
    world = make_analytic_world(scene.solid.moved(scene.H_WO), body, settings);
    if (scene.kind == WorldKind::kMoved) still_world = make_analytic_world(scene.solid, body, settings);
  }
  std::vector<Measurement> measurements;
  for (std::uint32_t s = 0; s < format::kSolverCount; ++s) {
    const auto found = measure(scene, *world, still_world.get(), static_cast<Solver>(s), effort);
    measurements.insert(measurements.end(), found.begin(), found.end());
  }
  return measurements;
}

const char* const kSheet = "contact_measurements";

Sheet sheet_of(const std::vector<Measurement>& measurements) {
  Sheet sheet{.name = kSheet, .columns = {"scene", "world", "solver", "quantity", "value"}, .rows = {}};
  for (const Measurement& m : measurements) {
    sheet.rows.push_back({m.scene, m.world, format::kSolverNames[static_cast<std::size_t>(m.solver)],
                          spec(m.quantity).key, cell(m.value)});
  }
  return sheet;
}

std::vector<Measurement> measurements_of(const Sheet& sheet) {
  std::vector<Measurement> measurements;
  for (const auto& row : sheet.rows) {
    const auto solver = std::find(std::begin(format::kSolverNames), std::end(format::kSolverNames), row[2]);
    const auto quantity = std::find_if(quantities().begin(), quantities().end(),
                                       [&](const QuantitySpec& candidate) { return candidate.key == row[3]; });
    if (solver == std::end(format::kSolverNames) || quantity == quantities().end()) continue;
    measurements.push_back(
        {row[0], row[1], static_cast<Solver>(solver - std::begin(format::kSolverNames)), quantity->id, number(row[4])});
  }
  return measurements;
}

Section conclude(const std::vector<CaseOutcome>& outcomes, const std::filesystem::path& folder) {
  const std::vector<Measurement> measurements = measurements_of(gathered(outcomes, kSheet));
  Section section;
  if (!measurements.empty()) {
    write_file(folder / "contact_quality.csv", measurements_csv(measurements));
    write_file(folder / "contact_summary.csv", summary_csv(measurements));
    section.text = text_table(measurements) + notes(measurements);
    section.html = fmt::format(
        "<p>All solvers side by side as <a href=\"contact_summary.csv\">CSV</a>; each scene as <a "
        "href=\"contact_quality.csv\">CSV</a>.</p>\n<div class=\"wide\"><pre>{}</pre></div>\n<p>{}</p>\n",
        files::html_text(text_table(measurements)), files::html_text(notes(measurements)));
  }
  section.findings = not_run(outcomes);
  for (const QuantitySpec& quantity : quantities()) {
    const auto verdict = judge(measurements, quantity.id, Solver::kContact);
    if (!quantity.target || !verdict) continue;
    section.findings.push_back(
        judged(bound_of(quantity), verdict->value, quantity.median ? "median of the scenes" : verdict->worst_scene));
  }
  return section;
}

}  // namespace

std::vector<Bound> contact_bounds() {
  std::vector<Bound> bounds;
  for (const QuantitySpec& quantity : quantities()) {
    if (quantity.target) bounds.push_back(bound_of(quantity));
  }
  return bounds;
}

Chapter contact_chapter(const ContactQualityRequest& request) {
  const std::vector<SceneSpec> chosen = chosen_scenes(request);
  require_meshes(chosen, request.meshes);
  Chapter chapter{.name = "contact",
                  .title = "Contact quality",
                  .introduction =
                      "<p>The three solvers run in the same scenes along the same device paths. The targets are those "
                      "of <code>contact</code>. Times grow if cases run side by side.</p>",
                  .bounds = contact_bounds(),
                  .cases = {},
                  .conclude = conclude};
  for (const SceneSpec& scene : chosen) {
    chapter.cases.push_back({.name = fmt::format("contact.{}-{}", scene.name, name(scene.kind)),
                             .inputs = fmt::format("quick {}", request.quick),
                             .run =
                                 [scene, request](const std::filesystem::path& work) {
                                   return CaseResult{.findings = {},
                                                     .sheets = {sheet_of(measure_scene(scene, request, work))}};
                                 },
                             .seconds = (scene.kind == WorldKind::kCompiled ? 25.0 : 3.0)});
  }
  return chapter;
}

}  // namespace godobject::report
