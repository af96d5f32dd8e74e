#include <cstdio>
#include <string>

#include <fmt/format.h>

#include "firmware/command/failure.h"
#include "firmware/command/run.h"
#include "firmware/command/solver_names.h"
#include "toolchain/command/atomic_file.h"
#include "toolchain/command/output_target.h"
#include "toolchain/command/progress.h"
#include "toolchain/command/scene_image.h"
#include "toolchain/scene_compiler/build_traits.h"
#include "toolchain/scene_compiler/compile_report.h"
#include "toolchain/scene_compiler/compile_scene.h"

namespace {

using namespace godobject;
using namespace godobject::command;
using namespace godobject::scene_compiler;

constexpr const char* kFooter = R"(
Examples:
  godobject-scenec teapot.toml -o teapot.scene --report teapot.json
  godobject-scenec teapot.toml -o teapot.scene --only-solver contact
  godobject-scenec teapot.toml -o teapot.scene --traits teapot.cmake
  godobject-scenec --inspect teapot.scene

A scene file (TOML; lengths in metres, values in brackets are defaults, s is voxel_size):
  [still]     mesh, scale [1], voxel_size, surface [auto|solid|shell], thickness of shells [2 s],
              field_tolerance at the surface, in voxels [0.05; large: bricks are never refined]
  [moving]    mesh, scale [1], surface [auto], points [5000], levels [7], voxel_size of its own field [s]
  [contact]   solver [contact|corrected|paper], safety_distance [1.5 s], margin [0.01 s],
              both_directions [true]: also points of the still body against the moving body's field,
              between_points [s]: how deep bodies may meet where no point sees it; points are added for it
  [friction]  static, kinetic [0.9 static], viscous [0 Ns/m]; without the table no friction
  [paper]     rotation_static [0.2], rotation_kinetic [0.9 of it], viscous [0.002]
  [coupling]  stiffness [2000 N/m], damping [20 Ns/m], rotational [0.025 m^2]
Meshes are PLY, STL or OBJ, found relative to the scene file.

Walls and gaps of the still mesh thinner than two voxels are reported. A wall of a solid is
{} (near-parallel: within 10 degrees).

Exit codes: 0 done, 64 usage, 65 bad mesh or image, 66 an input is missing or may not be read, 74 cannot write, 77 no right to
write, 78 bad scene file.)";

struct Options {
  std::string scene_file;
  std::string output;
  std::string report;
  std::string only_solver;
  std::string traits;
  bool inspects = false;
  std::string inspected;  ///< if it follows --inspect; SCENE otherwise
};

void compile(const Options& options) {
  CompileRequest request;
  request.scene_file = options.scene_file;
  request.output = options.output;
  if (!options.only_solver.empty()) request.only_solver = godobject::command::solver_of(options.only_solver);
  for (const std::string& output : {options.output, options.report, options.traits}) {
    if (!output.empty()) output_target(output);  // refused before the work, not after it
  }
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
    file.write(traits_text(report.traits, options.scene_file));
    file.commit();
  }
  fmt::print("{}", report_text(report));
}

/// `--inspect X.scene`, or `X.scene --inspect`.
void inspect(const Options& options) {
  const std::string& image = options.inspected.empty() ? options.scene_file : options.inspected;
  if (image.empty()) throw Failure(ExitCode::kUsage, "--inspect X.scene: the image is missing; name one");
  const bool compiles =
      !options.output.empty() || !options.report.empty() || !options.only_solver.empty() || !options.traits.empty();
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
  app.add_option("--report", options.report, "also write what was found and measured")->type_name("REPORT.json");
  app.add_option("--only-solver", options.only_solver,
                 "contact, corrected or paper: leave out what others read; default: hold all")
      ->check(CLI::IsMember(godobject::command::solver_names()))
      ->option_text("SOLVER");
  app.add_option("--traits", options.traits,
                 "also write what a build for this scene alone needs: cmake -DGODOBJECT_SCENE=TRAITS.cmake")
      ->type_name("TRAITS.cmake");
  const CLI::Option* inspect =
      app.add_option("--inspect", options.inspected, "print the facts of a compiled image as JSON, nothing else")
          ->expected(0, 1)
          ->type_name("X.scene");
  app.footer(fmt::format(kFooter, kRefusalRule));
  return godobject::command::run(app, argc, argv, [&] {
    options.inspects = inspect->count() > 0;
    run_scenec(options);
  });
}
