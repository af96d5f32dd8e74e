#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "toolchain/command_line/failure.h"
#include "toolchain/command_line/progress.h"
#include "toolchain/command_line/run.h"
#include "toolchain/command_line/solver_names.h"
#include "toolchain/files/atomic_file.h"
#include "toolchain/files/output_target.h"
#include "toolchain/files/scene_image.h"
#include "toolchain/files/work_folder.h"
#include "toolchain/path/pose_file.h"
#include "toolchain/precision/recommendation.h"
#include "toolchain/scene_compiler/compile_scene.h"
#include "toolchain/scene_compiler/image/build_traits.h"
#include "toolchain/scene_compiler/image/image_json.h"
#include "toolchain/scene_compiler/report_json.h"
#include "toolchain/scene_compiler/report_text.h"

namespace {

using namespace godobject;
using namespace godobject::command;
using namespace godobject::files;
using namespace godobject::scene_compiler;

constexpr const char* kFooter = R"(
Examples:
  godobject-scenec teapot.toml -o teapot.scene --report teapot.json
  godobject-scenec teapot.toml -o teapot.scene --only-solver contact
  godobject-scenec teapot.toml -o teapot.scene --traits teapot.cmake
  godobject-scenec teapot.toml -o teapot.scene --budget 20us --path over-the-spout.csv
  godobject-scenec --inspect teapot.scene

A scene file (TOML; lengths in metres, defaults in brackets):
  [still]     mesh, scale [1], voxel_size, surface [auto|solid|shell], thickness of shells [2 voxel_size],
              field_tolerance at the surface, in voxels [0.05; a large one: bricks are never refined],
              or accuracy: largest distance between the stored surfaces of both bodies and the meshes [m]. Without
              voxel_size the compiler then chooses both bodies' voxel edges; with it the accuracy is refused, and the
              edge that it needs is named, where bricks cannot be fine enough
  [moving]    mesh, scale [1], surface [auto], points [5000], levels [7],
              voxel_size of its own field [still.voxel_size],
              ball [false]: render the mesh, a ball, by its centre alone, against a convex still body, without points
              and second direction; no torque arises, with friction none either
  [contact]   solver [contact|corrected|paper], safety_distance [1.5 voxel_size], margin [0.01 voxel_size],
              both_directions [true]: also points of the still body in the moving body's field,
              between_points [voxel_size; if that is chosen, at most 20 accuracy]: largest depth of the bodies between
              their points; points are added until it holds,
              edges [true if no body has more than {} sharp edges]: keep sharp edges of one body from crossing those
              of the other,
              point_budget [0: none]: near points of either body that a sub-step looks up, nearest first; beyond
              the budget the god object may lag behind the device, but crosses nothing
  [friction]  static, kinetic [0.9 static], viscous [0 Ns/m]; without this table there is no friction
  [paper]     rotation_static [0.2], rotation_kinetic [0.9 of it], viscous [0.002]
  [coupling]  stiffness [2000 N/m], damping [20 Ns/m], rotational [0.025 m^2], period [0.001 s] from one cycle to the next
  [workspace] low, high: [x, y, z] in metres in the still mesh's frame: the box that the moving body's centre of mass
              does not leave. The device feels its faces. Data that no cycle reads from there is left out of the image.
              Without this table the workspace has no limits
Meshes are PLY, STL or OBJ. Their paths are relative to the scene file.

The report lists walls and gaps of the still mesh thinner than two voxels. A wall of a solid is
{} (near-parallel: within 10 degrees).

--budget tries all solvers with the scene file as it is, and with voxel edge, points, refinement and directions changed
one at a time. Each setting is compiled and run on this machine, with the scene's friction, along --path, or along
generated motions that press the body from four sides and slide it. Among the settings whose 99th percentile of a
cycle's time is within the budget, it chooses the one whose wrench is nearest to that of the solver `contact` on the
exact meshes. A setting that the compiler refuses is listed with the reason, and the others are tried. It takes some ten
times as long as compiling and needs an idle machine. The image records the settings that were tried.

Exit codes: 0 done, 64 usage, 65 bad mesh or image, or nothing fits the budget, 66 an input is missing or cannot be
read, 74 cannot write, 77 no permission to write, 78 bad scene file.)";

struct Options {
  std::string scene_file;
  std::string output;
  std::string report;
  std::string only_solver;
  std::string traits;
  std::string budget;
  std::string path;
  bool inspects = false;
  std::string inspected;  ///< the image, if it follows --inspect; otherwise it is in scene_file
};

/// Replaces the scene file's settings by the ones that fit the budget best.
void choose_within_budget(const Options& options, CompileRequest& request) {
  const double budget_ns = precision::parse_budget_ns(options.budget);
  const SceneConfig config = read_scene_config(request.scene_file);
  if (config.ball) {
    throw Failure(ExitCode::kBadConfig, fmt::format("{}: --budget chooses points and directions, a ball has only its "
                                                    "centre; leave out moving.ball or --budget",
                                                    options.scene_file));
  }
  if (config.chooses_voxels) {
    throw Failure(ExitCode::kBadConfig,
                  fmt::format("{}: --budget changes the voxel edge, and still.voxel_size is missing; "
                              "compile without --budget, and state the edge that is chosen",
                              options.scene_file));
  }
  if (config.workspace) {
    throw Failure(ExitCode::kBadConfig, fmt::format("{}: --budget tries motions outside the workspace; leave out "
                                                    "[workspace], and put it back with the settings that were found",
                                                    options.scene_file));
  }
  precision::Paths paths;
  if (!options.path.empty()) paths.push_back(path::read_poses(options.path, config.settings.period));
  std::vector<precision::Variant> variants;
  for (std::uint32_t i = 0; i < format::kSolverCount; ++i) {
    const auto solver = static_cast<Solver>(i);
    if (request.only_solver.value_or(solver) == solver)
      variants.push_back({solver, config.settings.friction != 0, 1.0});
  }
  const WorkFolder work(request.output);
  const auto tried = [&] {
    godobject::command::Progress line;
    line.show("exact meshes", 0.0);
    precision::Trial trial(config, std::move(paths));
    const std::vector<precision::ImageSetting> images = precision::candidate_images(config);
    std::size_t done = 0;
    return precision::recommend(images, budget_ns, [&](const precision::ImageSetting& image) {
      line.show("trying " + precision::name(image), static_cast<double>(done++) / static_cast<double>(images.size()));
      return trial({.setting = image, .file = work.path() / "tried.scene", .only_solver = request.only_solver},
                   variants);
    });
  };
  const precision::Recommendation found = tried();
  fmt::print("{}", precision::text(found, budget_ns));
  if (!found.chosen) {
    throw Failure(ExitCode::kBadData,
                  fmt::format("--budget {}: {}", options.budget, precision::reason_for_nothing(found)));
  }
  const precision::Setting& chosen = found.tried[*found.chosen].setting;
  request.config = precision::with(config, chosen.image);
  request.config->settings.default_solver = static_cast<std::uint32_t>(chosen.solver);
  request.choice = precision::json(found, budget_ns);
}

void compile(const Options& options) {
  if (!options.path.empty() && options.budget.empty()) {
    throw Failure(ExitCode::kUsage,
                  "--path is for --budget, as the motion on which settings are tried; give --budget too");
  }
  CompileRequest request;
  request.times_left_out = !options.report.empty();
  request.scene_file = options.scene_file;
  request.output = options.output;
  if (!options.only_solver.empty()) request.only_solver = godobject::command::solver_of(options.only_solver);
  for (const std::string& output : {options.output, options.report, options.traits}) {
    if (!output.empty()) output_target(output);  // refused before the work
  }
  if (!options.budget.empty()) choose_within_budget(options, request);
  CompileReport report;
  {
    godobject::command::Progress line;
    request.progress = [&line](const char* phase, double done) { line.show(phase, done); };
    report = compile_scene(request);
  }
  if (!options.report.empty()) {
    AtomicFile file(options.report);
    file.write(full_report_json(report).dump(2) + "\n");
    file.commit();
  }
  if (!options.traits.empty()) {
    AtomicFile file(options.traits);
    file.write(traits_text(report.check.traits, options.scene_file));
    file.commit();
  }
  fmt::print("{}", report_text(report));
}

/// Runs `--inspect X.scene` or `X.scene --inspect`.
void inspect(const Options& options) {
  const std::string& image = options.inspected.empty() ? options.scene_file : options.inspected;
  if (image.empty()) throw Failure(ExitCode::kUsage, "--inspect X.scene: the image is missing; name one");
  const bool compiles = !options.output.empty() || !options.report.empty() || !options.only_solver.empty() ||
                        !options.traits.empty() || !options.budget.empty() || !options.path.empty();
  if (compiles || (!options.inspected.empty() && !options.scene_file.empty())) {
    throw Failure(ExitCode::kUsage, "--inspect takes one image and nothing else; see godobject-scenec --help");
  }
  fmt::print("{}\n", inspect_json(SceneImage::read(image)).dump(2));
}

void run_scenec(const Options& options) {
  if (options.inspects) return inspect(options);
  if (options.scene_file.empty()) throw Failure(ExitCode::kUsage, "SCENE.toml is missing; see godobject-scenec --help");
  if (options.output.empty()) throw Failure(ExitCode::kUsage, "-o OUT.scene is missing; see godobject-scenec --help");
  compile(options);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Compiles a scene file and its meshes into one scene image for the controller.", "godobject-scenec"};
  Options options;
  app.add_option("SCENE.toml", options.scene_file, "scene file: meshes and settings")->type_name("");
  app.add_option("-o,--output", options.output, "scene image to write")->type_name("OUT.scene");
  app.add_option("--report", options.report, "also write all findings, with the time that left-out data saves")
      ->type_name("REPORT.json");
  app.add_option("--only-solver", options.only_solver,
                 "contact, corrected or paper: leave out data of the others; default: all")
      ->check(CLI::IsMember(godobject::command::solver_names()))
      ->option_text("SOLVER");
  app.add_option("--traits", options.traits,
                 "also write the parts that a build for this scene needs: cmake -DGODOBJECT_SCENE=TRAITS.cmake")
      ->type_name("TRAITS.cmake");
  app.add_option("--budget", options.budget,
                 "choose the settings with the smallest error within this time of a cycle: 20us")
      ->type_name("TIME");
  app.add_option("--path", options.path, "for --budget: a motion, poses (CSV) or key frames (TOML)")->type_name("PATH");
  const CLI::Option* inspect =
      app.add_option("--inspect", options.inspected, "print the contents of a compiled image as JSON, and nothing else")
          ->expected(0, 1)
          ->type_name("X.scene");
  app.footer(fmt::format(kFooter, scene_compiler::kMostEdgesByDefault, kRefusalRule));
  return godobject::command::run(app, argc, argv, [&] {
    options.inspects = inspect->count() > 0;
    run_scenec(options);
  });
}
