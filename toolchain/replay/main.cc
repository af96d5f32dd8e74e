#include <cfenv>
#include <optional>
#include <string>

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
#include "toolchain/replay/replay.h"

namespace {

using godobject::Solver;
using godobject::command::ExitCode;
using godobject::command::Failure;

const char* const kFooter = R"(Examples:
  godobject-replay bunny_teapot.scene bunny_teapot.csv -o contact.csv
  godobject-replay bunny_teapot.scene bunny_teapot.csv -o paper.csv --solver paper --friction off
  godobject-replay bunny_teapot.scene bunny_teapot.csv -o soft.csv --stiffness 500

Solvers: contact, the least-constraint motion over all contact points, in sub-steps that never let a point through a surface;
corrected, one projection from one wrench for all contacts; paper, the published heuristic, to compare with.

POSES.csv holds t,px,py,pz,qw,qx,qy,qz: the moving mesh's frame in the still mesh's, one row a millisecond. OUT.csv gets
one row a cycle: device pose d, god-object pose g (after the cycle), spring force f [N] and torque t [Nm] on the device
in W about the moving body's centre of mass, depth [m] of the god object's deepest sample point (positive inside, negative: a
gap; at most the stored band), contacts (contact: rows that carry a force, a point seen from two
sides has two; otherwise: points that collide), substeps, time
of the look-ups (step #1 and, with contact, its certificate) and of the rest of #2-#7, and a status:
  free          nothing holds the god object: it is the device pose
  contact       constrained; with contact: rows are active in the solution
  start_inside  the first pose penetrated and the god object is still on its way out: where the field gives a direction it
                moves out, with contact by up to a quarter of a voxel a cycle, otherwise by a fifth of its depth; where the
                field does not know the way it goes with the device, without force
  cut           the motion could not be finished in eight sub-steps, or something stood in its way: the god object goes on
                in the next cycle
  overflow      contact only: more points near the surface than the rows hold, or than the scene's point_budget allows;
                the god object moves no further than those left out are known to be free
  infeasible    contact only: the gaps asked for cannot all be had at once; none was allowed to shrink
  bad_input     the row was no pose (NaN, Inf, quaternion not of unit length): the god object was held, force and torque
                are zero, exit 65 at the end
Of several that apply in a cycle the one that stands later in this order is told: cut, overflow, infeasible, start_inside.
Forces are neither limited nor smoothed here: that is left to the controller that drives the device.
The last line printed counts the cycles of the last four, and those of contact in which friction did not reach Coulomb's law to
the tolerance (gaps are kept all the same).

Exit codes: 0 done, 64 usage, 65 bad image or path, or rows that were no pose (OUT.csv is whole then), 66 an input is missing or
may not be read, 74 cannot write, 77 no right to write, 78 --friction on for a scene without friction, or a scene
that needs what this build leaves out.)";

/// The field knows no depth, and no gap, beyond its band.
std::string depth_text(double deepest, double band) {
  if (deepest <= -band) return "nothing came near";
  if (deepest < 0.0) return fmt::format("no point inside, smallest gap {:.4f} mm", -1e3 * deepest);
  if (deepest < band) return fmt::format("deepest {:.3f} mm", 1e3 * deepest);
  return fmt::format("deepest at least {:.3f} mm (the stored band)", 1e3 * band);
}

/// How many cycles did not go as wished.
std::string outcomes_text(const godobject::replay::Summary& summary, bool contact_friction) {
  using godobject::Outcome;
  std::string text;
  for (const Outcome outcome : {Outcome::kOverflow, Outcome::kCut, Outcome::kInfeasible, Outcome::kStartInside})
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name(outcome), summary.count(outcome));
  if (summary.most_dropped > 0) text += fmt::format(", near points left out at most {}", summary.most_dropped);
  if (contact_friction) text += fmt::format(", friction not found in {} cycles", summary.unconverged);
  return text;
}

/// k_D in place of the scene's.
double checked_stiffness(double stiffness) {
  const auto& range = godobject::files::kStiffness;
  if (stiffness >= range.low && stiffness <= range.high) return stiffness;
  throw Failure(ExitCode::kUsage, fmt::format("--stiffness {:g}: must be from {:g} to {:g} N/m, such as 2000",
                                              stiffness, range.low, range.high));
}

std::string float_exceptions(int raised) {
  std::string names;
  if (raised & FE_INVALID) names += " invalid";
  if (raised & FE_DIVBYZERO) names += " divide-by-zero";
  if (raised & FE_OVERFLOW) names += " overflow";
  return names.empty() ? " none" : names;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Runs the god object along a recorded device path, open loop: one 1 ms cycle for each row.",
               "godobject-replay");
  app.footer(kFooter);
  std::string scene_path, poses_path, out_path, solver_name, friction_name;
  std::optional<double> stiffness;
  app.add_option("X.scene", scene_path, "scene image, made by godobject-scenec")->required()->type_name("");
  app.add_option("POSES.csv", poses_path, "device path, one row a millisecond")->required()->type_name("");
  app.add_option("-o,--output", out_path, "cycles to write, one row each")->required()->type_name("OUT.csv");
  app.add_option("--solver", solver_name, "contact, corrected or paper; default: the scene's")
      ->check(CLI::IsMember(godobject::command::solver_names()))
      ->option_text("SOLVER");
  app.add_option("--friction", friction_name, "on or off; default: on if the scene has a friction table")
      ->check(CLI::IsMember({"on", "off"}))
      ->option_text("on|off");
  app.add_option("--stiffness", stiffness, "k_D [N/m], 1e-6 to 1e8, in place of the scene's coupling.stiffness")
      ->type_name("NUMBER");

  return godobject::command::run(app, argc, argv, [&] {
    godobject::files::output_target(out_path);  // refused before anything is read
    auto image = godobject::files::SceneImage::read(scene_path);
    if (stiffness) image.scene.settings.stiffness = checked_stiffness(*stiffness);
    const godobject::Scene& scene = image.scene;
    const Solver solver = solver_name.empty() ? scene.default_solver() : *godobject::command::solver_of(solver_name);
    const bool has_friction = scene.settings.friction != 0;
    const bool friction = friction_name.empty() ? has_friction : friction_name == "on";
    if (friction && !has_friction) {
      throw Failure(
          ExitCode::kBadConfig,
          fmt::format("{}: --friction on, but the scene has no [friction] table; add one and compile it again",
                      scene_path));
    }
    if (!scene.holds(solver)) {
      throw Failure(ExitCode::kBadData,
                    fmt::format("{}: was compiled without the solver {}; compile it again without --only-solver",
                                scene_path, solver_name));
    }
    godobject::command::require_in_build(scene_path, scene, solver, friction);
    const godobject::files::PosePath path = godobject::files::read_pose_path(poses_path);
    godobject::files::AtomicFile out(out_path);
    godobject::replay::Summary summary;
    {
      godobject::command::Progress progress;
      summary = godobject::replay::replay(
          scene, solver, friction, path, [&](const std::string& row) { out.write(row); },
          [&](double share) { progress.show("replay", share); });
    }
    out.commit();
    const bool contact_friction = friction && solver == Solver::kContact;
    fmt::print("{}: {} cycles, {}, peak force {:.2f} N; {}; floating-point exceptions:{}\n", out_path, summary.cycles,
               depth_text(summary.deepest, scene.voxelmap.band()), summary.peak_force,
               outcomes_text(summary, contact_friction), float_exceptions(summary.float_exceptions));
    if (summary.bad_rows > 0) {
      throw Failure(ExitCode::kBadData, fmt::format("{}:{}: not a pose (NaN, Inf or quaternion not of unit length), "
                                                    "the first of {} such rows; the god object was "
                                                    "held there",
                                                    poses_path, summary.first_bad_line, summary.bad_rows));
    }
  });
}
