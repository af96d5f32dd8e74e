#include <cfenv>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "toolchain/command_line/failure.h"
#include "toolchain/command_line/in_build.h"
#include "toolchain/command_line/progress.h"
#include "toolchain/command_line/run.h"
#include "toolchain/command_line/solver_names.h"
#include "toolchain/files/atomic_file.h"
#include "toolchain/files/output_target.h"
#include "toolchain/files/scene_image.h"
#include "toolchain/files/stiffness.h"
#include "toolchain/precision/mesh_overlap.h"
#include "toolchain/replay/replay.h"
#include "toolchain/replay/replay_watch.h"
#include "toolchain/scene_compiler/image_meshes.h"
#include "toolchain/scene_compiler/scene_config.h"
#include "toolchain/statistics/samples.h"

namespace {

using godobject::Solver;
using godobject::Vector3;
using godobject::command::ExitCode;
using godobject::command::Failure;
using godobject::precision::MeshOverlap;
using godobject::replay::ReplayWatch;
using godobject::scene_compiler::SceneConfig;

const char* const kFooter = R"(Examples:
  godobject-replay bunny_teapot.scene bunny_teapot.csv -o contact.csv
  godobject-replay bunny_teapot.scene bunny_teapot.csv -o paper.csv --solver paper --friction off
  godobject-replay bunny_teapot.scene bunny_teapot.csv -o soft.csv --stiffness 500
  godobject-replay bunny_teapot.scene bunny_teapot.csv -o bounded.csv --work-budget 400000
  godobject-replay bunny_teapot.scene bunny_teapot.csv -o exact.csv --meshes bunny_teapot.toml
  godobject-replay bunny_teapot.scene bunny_teapot.csv -o seen.csv --watch bunny_teapot.toml

Solvers: contact, the least-constraint motion over all contact points, in sub-steps that never let a point cross a
surface; corrected, one projection from one wrench for all contacts; paper, the published heuristic, for comparison.

POSES.csv has the columns t,px,py,pz,qw,qx,qy,qz: the moving mesh's frame in the still mesh's, one row for each period
of the scene: coupling.period of its file, 1 ms by default. OUT.csv gets one row for each cycle: device pose d;
god-object pose g after the cycle; spring force f [N] and torque t [Nm] on the device in W about the moving body's
centre of mass; point_depth [m] of the god object's deepest sample point in the stored distances (positive inside,
negative: no sample point is inside and the nearest is that far from the surface; at most the stored band); contacts
(contact: rows that carry a force, two for a point seen from two sides; otherwise: colliding points); substeps; time of
the look-ups (step #1 and, with contact, its certificate) and of the other steps #2-#7; and a status:
  free          nothing holds the god object: it is at the device pose
  contact       constrained; with contact: rows are active in the solution
  start_inside  the first pose penetrated and the god object is still moving out, or with --work-budget the first search
                has not ended. Where the field has a direction it
                moves out, with contact by up to a quarter of a voxel in a cycle, otherwise by a fifth of its depth.
                Where the field has no direction it follows the device without force
  cut           the motion did not end in eight sub-steps, or an obstacle stopped it: it continues in the next cycle
  overflow      contact only: more near points or near pairs of sharp edges than there is room for, or more near points
                than the scene's point_budget allows; the god object moves only as far as the other ones are known to
                be free
  infeasible    contact only: the required gaps cannot all be reached at once; none was allowed to shrink
  bad_input     the row was no pose (NaN, Inf, quaternion not of unit length): the god object was held, force and torque
                are zero, exit code 65 at the end
If several of cut, overflow, infeasible and start_inside apply in a cycle, the status is the last of them in this order.
Where no sample point is inside, edges and faces between the points may still overlap, by as much as the compiler's
report says. With --meshes the column mesh_overlap follows: the largest depth [m] of any point of either mesh, on its
faces and edges too, in the other one, within a thousandth of a voxel or a hundredth; 0 if they do not overlap. That
takes some milliseconds for each cycle near contact.
With --watch every cycle is judged by properties that any correct solver has, by code that shares none with solver,
search and certificate: no chord of any point meets the stored surface or the meshes, forces are pushes at touching
points, the god object is as near to the device as another method comes, and others. Lines that begin with "watch:" tell
how often each was judged and violated. That takes seconds for a thousand cycles, more where whole faces touch.
Forces are neither limited nor smoothed here; the controller that drives the device does that.
The last line printed counts the cycles with these four, and with contact the cycles whose friction did not converge to
Coulomb's law within the tolerance; their gaps hold all the same. It also says the largest work of a cycle, and how many
cycles their --work-budget ended: there the god object may stay behind, but it crosses nothing. Work is counted, not
timed: it is the same in each replay. With a budget a line before tells how far the god object stays behind one without.

Exit codes: 0 done, 64 usage, 65 bad image or path, or rows that were no pose (OUT.csv is complete then), 66 an input is
missing or cannot be read, 70 --watch found a violation (before 65; OUT.csv is complete then), 74 cannot write, 77 no
permission to write, 78 --friction on for a scene without friction, --meshes or --watch with a bad scene file or that of
another scene, or a scene that needs a part that this build leaves out.)";

struct Options {
  std::string scene, poses, output;
  std::string solver, friction;  ///< empty: the scene's
  std::string meshes;            ///< scene file; empty: the overlap is not measured
  std::string watch;             ///< scene file; empty: the cycles are not judged
  std::optional<double> stiffness;
  std::uint64_t work_budget = godobject::WorkMeter::kUnlimited;
};

/// Returns the text on the deepest sample point. The field stores no distance beyond its band.
std::string point_text(double deepest, double band) {
  if (deepest <= -band) return "no sample point within the stored band";
  if (deepest < 0.0)
    return fmt::format("no sample point inside, the nearest {:.4f} mm from the surface", -1e3 * deepest);
  if (deepest < band) return fmt::format("deepest sample point {:.3f} mm inside", 1e3 * deepest);
  return fmt::format("deepest sample point at least {:.3f} mm inside (the stored band)", 1e3 * band);
}

std::string overlap_text(const Options& options, const godobject::replay::Summary& summary) {
  if (options.meshes.empty()) return "";
  if (summary.overlap <= 0.0) return ", the meshes do not overlap";
  return fmt::format(", the meshes overlap by up to {:.4f} mm, at {:.3f} s", 1e3 * summary.overlap, summary.overlap_at);
}

/// Returns a scene file, if its meshes are those of the image.
SceneConfig scene_file_of(const Options& options, const std::string& file, const godobject::SceneView& scene) {
  godobject::scene_compiler::VoxelSizes of_image{scene.voxelmap.voxel_size(), {}};
  if (scene.has_features()) of_image.moving = scene.body_map.voxel_size();
  SceneConfig config = godobject::scene_compiler::read_scene_config(file, of_image);
  const std::string difference = godobject::scene_compiler::difference_of_meshes(scene, config);
  if (difference.empty()) return config;
  throw Failure(ExitCode::kBadConfig, fmt::format("{}: is not the scene file of {}: {}; name the one that was compiled",
                                                  file, options.scene, difference));
}

/// Throws Failure (kInternal) if the watch found a violation.
void require_no_violation(const Options& options, const godobject::watch::Findings& findings) {
  if (findings.violations() == 0) return;
  throw Failure(ExitCode::kInternal,
                fmt::format("{}: the watch found {} violations along {}, the first: {}; the solver or the scene image "
                            "is at fault, unless a mesh or the scene file has changed since it was compiled",
                            options.scene, findings.violations(), options.poses, findings.first()));
}

/// Returns the number of cycles with each outcome that limits the motion.
std::string outcomes_text(const godobject::replay::Summary& summary, bool contact_friction) {
  using godobject::Outcome;
  std::string text;
  for (const Outcome outcome : {Outcome::kOverflow, Outcome::kCut, Outcome::kInfeasible, Outcome::kStartInside})
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name(outcome), summary.count(outcome));
  if (summary.most_dropped > 0) text += fmt::format(", at most {} near points left out", summary.most_dropped);
  if (contact_friction) text += fmt::format(", friction not found in {} cycles", summary.unconverged);
  if (summary.most_work > 0) text += fmt::format(", work of a cycle at most {} units", summary.most_work);
  if (summary.out_of_work > 0) text += fmt::format(", ended by the budget in {} cycles", summary.out_of_work);
  return text;
}

/// Returns a line about how far the god object stays behind, or "" without a budget of work.
std::string lag_text(const std::vector<double>& lag) {
  constexpr double kSmall = 50e-6;  // [m], chosen: a hand does not feel it
  if (lag.empty()) return "";
  return fmt::format(
      "behind a god object without a budget: p50 {:.4f} mm, p99.9 {:.4f} mm, largest {:.4f} mm; "
      "more than {:g} mm in {} cycles, at most {} in a row\n",
      1e3 * godobject::percentile(lag, 0.5), 1e3 * godobject::percentile(lag, 0.999),
      1e3 * godobject::percentile(lag, 1.0), 1e3 * kSmall, godobject::count_above(lag, kSmall),
      godobject::longest_above(lag, kSmall));
}

/// Returns k_D from the command line.
double checked_stiffness(double stiffness) {
  const auto& range = godobject::files::kStiffness;
  if (stiffness >= range.low && stiffness <= range.high) return stiffness;
  throw Failure(ExitCode::kUsage,
                fmt::format("--stiffness {:g} is out of range; choose {:g} to {:g} N/m, for example 2000", stiffness,
                            range.low, range.high));
}

std::string float_exceptions(int raised) {
  std::string names;
  if (raised & FE_INVALID) names += " invalid";
  if (raised & FE_DIVBYZERO) names += " divide-by-zero";
  if (raised & FE_OVERFLOW) names += " overflow";
  return names.empty() ? " none" : names;
}

/// The pipeline that the options and the scene select.
struct Pipeline {
  Solver solver;
  bool friction;
};

Pipeline pipeline_of(const Options& options, const godobject::SceneView& scene) {
  const bool has_friction = scene.settings.friction != 0;
  const Pipeline pipeline{
      options.solver.empty() ? scene.default_solver() : *godobject::command::solver_of(options.solver),
      options.friction.empty() ? has_friction : options.friction == "on"};
  if (pipeline.friction && !has_friction) {
    throw Failure(ExitCode::kBadConfig,
                  fmt::format("{}: --friction on, but the scene has no [friction] table; add one and compile it again",
                              options.scene));
  }
  if (!scene.holds(pipeline.solver)) {
    throw Failure(ExitCode::kBadData,
                  fmt::format("{}: was compiled without the solver {}; compile it again without --only-solver",
                              options.scene, options.solver));
  }
  godobject::command::require_in_build(options.scene, scene, pipeline.solver, pipeline.friction);
  return pipeline;
}

/// Returns a line for a path that leads farther from the still mesh than anybody works, or "". A path in millimetres
/// does.
std::string far_path_note(const std::string& poses, const godobject::files::PosePath& path,
                          const godobject::SceneView& scene) {
  constexpr double kFar = 30.0;  // times the diagonal of the stored field
  const auto& grid = scene.grid;
  const Vector3 extent =
      godobject::format::kBrickCells * grid.voxel_size * Vector3(grid.bricks[0], grid.bricks[1], grid.bricks[2]);
  const Vector3 centre = Eigen::Map<const Vector3>(grid.origin) + 0.5 * extent;
  for (std::size_t i = 0; i < path.poses.size(); ++i) {
    const double away = (path.poses[i].translation - centre).norm();
    if (!std::isfinite(away) || away <= kFar * extent.norm()) continue;
    return fmt::format(
        "{}:{}: the moving mesh is {:.3g} m away from the still one, whose field is {:.3g} m long; "
        "positions are in metres: check the unit\n",
        poses, path.lines[i], away, extent.norm());
  }
  return "";
}

void replay_file(const Options& options) {
  godobject::files::output_target(options.output);  // refused before anything is read
  auto image = godobject::files::SceneImage::read(options.scene);
  if (options.stiffness) image.scene.settings.stiffness = checked_stiffness(*options.stiffness);
  const godobject::SceneView& scene = image.scene;
  const Pipeline pipeline = pipeline_of(options, scene);
  const godobject::files::PosePath path = godobject::files::read_pose_path(options.poses, scene.settings.period);
  std::optional<MeshOverlap> meshes;
  if (!options.meshes.empty()) meshes.emplace(scene_file_of(options, options.meshes, scene));
  std::optional<ReplayWatch> watch;
  if (!options.watch.empty()) watch.emplace(image, scene_file_of(options, options.watch, scene));
  fmt::print(stderr, "{}", far_path_note(options.poses, path, scene));
  godobject::files::AtomicFile out(options.output);
  godobject::replay::Summary summary;
  {
    godobject::command::Progress progress;
    godobject::replay::Outputs outputs{.write_row = [&](const std::string& row) { out.write(row); },
                                       .progress = [&](double share) { progress.show("replay", share); },
                                       .overlap = {},
                                       .watch = watch ? &*watch : nullptr};
    if (meshes) outputs.overlap = [&](const godobject::Pose& H_WM) { return meshes->depth(H_WM); };
    summary = godobject::replay::replay(scene, pipeline.solver, pipeline.friction, path, outputs, options.work_budget);
  }
  out.commit();
  if (watch) fmt::print("{}", godobject::replay::findings_text(watch->findings()));
  fmt::print("{}", lag_text(summary.lag));
  const bool contact_friction = pipeline.friction && pipeline.solver == Solver::kContact;
  fmt::print("{}: {} cycles, {}{}, peak force {:.2f} N; {}; floating-point exceptions:{}\n", options.output,
             summary.cycles, point_text(summary.deepest, scene.voxelmap.band()), overlap_text(options, summary),
             summary.peak_force, outcomes_text(summary, contact_friction), float_exceptions(summary.float_exceptions));
  if (watch) require_no_violation(options, watch->findings());
  if (summary.bad_rows == 0) return;
  throw Failure(ExitCode::kBadData,
                fmt::format("{}:{}: not a pose (NaN, Inf or quaternion not of unit length), the first of {} such rows, "
                            "at which the god object was held; correct or remove these rows",
                            options.poses, summary.first_bad_line, summary.bad_rows));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Runs the god object along a recorded device path, open loop: one cycle for each row.",
               "godobject-replay");
  app.footer(kFooter);
  Options options;
  app.add_option("X.scene", options.scene, "scene image, made by godobject-scenec")->required()->type_name("");
  app.add_option("POSES.csv", options.poses, "device path, one row for each cycle")->required()->type_name("");
  app.add_option("-o,--output", options.output, "cycles to write, one row each")->required()->type_name("OUT.csv");
  app.add_option("--solver", options.solver, "contact, corrected or paper; default: the scene's")
      ->check(CLI::IsMember(godobject::command::solver_names()))
      ->option_text("SOLVER");
  app.add_option("--friction", options.friction, "on or off; default: on if the scene has a friction table")
      ->check(CLI::IsMember({"on", "off"}))
      ->option_text("on|off");
  app.add_option("--work-budget", options.work_budget,
                 "work of a cycle [units], 1 or more; a microsecond is some 4000; default: no limit")
      ->type_name("NUMBER")
      ->check(CLI::PositiveNumber.description(""));
  app.add_option("--stiffness", options.stiffness, "k_D [N/m], 1e-6 to 1e8; default: the scene's coupling.stiffness")
      ->type_name("NUMBER");
  app.add_option("--meshes", options.meshes, "scene file of X.scene: also measure how deep its meshes overlap")
      ->type_name("SCENE.toml");
  app.add_option("--watch", options.watch,
                 "scene file of X.scene: also judge every cycle by properties that any correct solver has")
      ->type_name("SCENE.toml");
  return godobject::command::run(app, argc, argv, [&] { replay_file(options); });
}
