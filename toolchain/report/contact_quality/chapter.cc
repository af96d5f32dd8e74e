#include "toolchain/report/contact_quality/chapter.h"

#include <algorithm>
#include <map>
#include <memory>

#include <fmt/format.h>

#include "firmware/command/failure.h"
#include "firmware/command/input_file.h"
#include "toolchain/command/atomic_file.h"
#include "toolchain/command/output_target.h"
#include "toolchain/command/work_folder.h"
#include "toolchain/report/contact_quality/measure.h"
#include "toolchain/report/contact_quality/scenes.h"
#include "toolchain/report/contact_quality/table.h"

namespace godobject::report {
namespace {

using command::ExitCode;
using command::Failure;

void write(const std::filesystem::path& file, const std::string& text) {
  command::AtomicFile out(file);
  out.write(text);
  out.commit();
}

std::vector<SceneSpec> chosen_scenes(const ContactQualityRequest& request) {
  std::vector<SceneSpec> all = scenes();
  std::erase_if(all, [&](const SceneSpec& scene) {
    return (request.quick && !scene.quick) || scene.name.find(request.scene) == std::string::npos;
  });
  if (all.empty()) {
    throw Failure(ExitCode::kUsage, fmt::format("--scene {}: no scene's name holds this", request.scene));
  }
  return all;
}

/// Some scenes read a body's mesh: refused before the first scene, not in the midst of them.
void require_meshes(const std::vector<SceneSpec>& chosen, const std::filesystem::path& folder) {
  const bool reads =
      std::any_of(chosen.begin(), chosen.end(), [](const SceneSpec& scene) { return scene.body == BodyShape::kBunny; });
  if (reads) {
    command::require_regular_input(folder / kBunnyMesh,
                                   "name its folder with --meshes: toolchain/scenes/meshes of the sources has it");
  }
}

}  // namespace

std::vector<Measurement> contact_quality(const ContactQualityRequest& request) {
  const std::vector<SceneSpec> chosen = chosen_scenes(request);
  require_meshes(chosen, request.meshes);
  command::make_output_folder(request.output);
  const std::filesystem::path table = request.output / "contact_quality.csv";
  const std::filesystem::path summary = request.output / "contact_summary.csv";
  command::output_target(summary);  // refused before the work, as the table is by its work folder
  const command::WorkFolder work(table);
  const Effort effort = request.quick ? Effort{.dashes = 5, .tremor_s = 2.0} : Effort{};

  std::map<BodyShape, Body> bodies;
  std::vector<Measurement> measurements;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const SceneSpec& scene = chosen[i];
    const auto progress = [&](std::size_t solver) {
      if (!request.progress) return;
      const double done = static_cast<double>(i) + static_cast<double>(solver) / (format::kSolverCount + 1.0);
      request.progress("contact quality", done / static_cast<double>(chosen.size()));
    };
    progress(0);
    if (!bodies.contains(scene.body)) {
      bodies.emplace(scene.body, make_body(name(scene.body), body_mesh(scene.body, request.meshes),
                                           body_points(scene.body), work.path()));
    }
    const Body& body = bodies.at(scene.body);
    const WorldSettings settings{.voxel_size = scene.voxel_size, .safety_distance = 1.5 * scene.voxel_size};
    const std::string file_name = fmt::format("{}-{}", scene.name, name(scene.kind));
    std::unique_ptr<World> world;
    std::unique_ptr<World> still_world;
    if (scene.kind == WorldKind::kCompiled) {
      world = make_compiled_world(file_name, placed(scene), body, settings, work.path());
    } else {
      world = make_analytic_world(scene.solid.moved(scene.H_WO), body, settings);
      if (scene.kind == WorldKind::kMoved) still_world = make_analytic_world(scene.solid, body, settings);
    }
    for (std::uint32_t s = 0; s < format::kSolverCount; ++s) {
      progress(s + 1);
      const auto found = measure(scene, *world, still_world.get(), static_cast<Solver>(s), effort);
      measurements.insert(measurements.end(), found.begin(), found.end());
    }
  }
  write(table, measurements_csv(measurements));
  write(summary, summary_csv(measurements));
  return measurements;
}

}  // namespace godobject::report
