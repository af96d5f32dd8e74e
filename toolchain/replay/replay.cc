#include "toolchain/replay/replay.h"

#include <algorithm>
#include <array>
#include <cfenv>
#include <cmath>
#include <cstddef>
#include <vector>

#include <fmt/format.h>

#include "core/pipeline/penalty/penalty_contacts.h"
#include "toolchain/command_line/failure.h"
#include "toolchain/replay/replay_watch.h"
#include "toolchain/session/owned_god_object.h"
#include "toolchain/timing/stopwatch.h"

namespace godobject::replay {
namespace {

using command::ExitCode;
using command::Failure;

void append(std::string& row, const Vector3& v) {
  fmt::format_to(std::back_inserter(row), ",{},{},{}", v.x(), v.y(), v.z());
}

void append(std::string& row, const Pose& pose) {
  append(row, pose.translation);
  const Quaternion& q = pose.rotation;
  fmt::format_to(std::back_inserter(row), ",{},{},{},{}", q.w(), q.x(), q.y(), q.z());
}

/// Tells whether the controller must accept a pose, as GodObject::update promises.
bool is_pose(const Pose& H_WM) {
  constexpr double kUnit = 1e-3;
  constexpr double kFarthest = 1e7;  // [m]
  return H_WM.is_finite() && std::abs(H_WM.rotation.norm() - 1.0) < kUnit &&
         H_WM.translation.cwiseAbs().maxCoeff() <= kFarthest;
}

Pose body_pose(const Pose& H_WM, const Pose& H_MB) { return Pose{H_WM.rotation.normalized(), H_WM.translation} * H_MB; }

}  // namespace

const char* const kColumns =
    "t,dpx,dpy,dpz,dqw,dqx,dqy,dqz,gpx,gpy,gpz,gqw,gqx,gqy,gqz,fx,fy,fz,tx,ty,tz,point_depth,contacts,substeps,step1_"
    "ns,"
    "solve_ns,status";
const char* const kOverlapColumn = "mesh_overlap";

Summary replay(const SceneView& scene, Solver solver, bool friction, const files::PosePath& path,
               const Outputs& outputs, std::uint64_t work_budget) {
  constexpr int kWatched = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW;
  constexpr std::size_t kProgressEvery = 256;
  const bool has_budget = work_budget != WorkMeter::kUnlimited;
  OwnedGodObject god_object;
  OwnedGodObject without_budget;
  if (god_object.start(scene, solver, friction) != Status::kOk ||
      (has_budget && without_budget.start(scene, solver, friction) != Status::kOk)) {
    throw Failure(ExitCode::kBadData,
                  "the scene image was compiled without this solver or without friction; compile it without "
                  "--only-solver, or with a [friction] table");
  }
  god_object->set_work_budget(work_budget);
  if (outputs.watch != nullptr) outputs.watch->start({solver, friction, god_object.parameters()});
  Summary summary;
  std::string row = kColumns;
  if (outputs.overlap) row += std::string(",") + kOverlapColumn;
  outputs.write_row(row + "\n");
  for (std::size_t i = 0; i < path.poses.size(); ++i) {
    StepTimes times{.now_ns = timing::stopwatch()};
    CycleReport report;
    std::feclearexcept(kWatched);
    const Status status = god_object->update({path.poses[i], Motion{}}, report, &times);
    summary.float_exceptions |= std::fetestexcept(kWatched);

    if (outputs.watch != nullptr) {
      const Pose& H_WM = path.poses[i];
      outputs.watch->cycle({.H_WD = is_pose(H_WM) ? body_pose(H_WM, scene.H_MB) : H_WM,
                            .velocity_W = {},
                            .is_valid = is_pose(H_WM),
                            .status = status,
                            .report = report,
                            .path = god_object->session()->path().poses()});
    }
    if (has_budget) {
      CycleReport other;
      static_cast<void>(without_budget->update({path.poses[i], Motion{}}, other));  // refuses the same rows
      const Vector3 here = (god_object->mesh_pose() * scene.H_MB).translation;
      summary.lag.push_back((here - (without_budget->mesh_pose() * scene.H_MB).translation).norm());
    }
    ++summary.cycles;
    ++summary.by_outcome[static_cast<std::size_t>(report.outcome)];
    if (status != Status::kOk && summary.bad_rows++ == 0) summary.first_bad_line = path.lines[i];
    const ProxyState& state = god_object.state();
    // before the first valid row there is no god object to measure
    const double depth =
        state.started ? -smallest_distance(scene.voxelmap, scene.pointshell, state.H_WS) : -scene.voxelmap.band();
    summary.deepest = std::max(summary.deepest, depth);
    summary.most_dropped = std::max(summary.most_dropped, report.dropped);
    summary.unconverged += report.unconverged ? 1 : 0;
    summary.most_work = std::max(summary.most_work, report.work);
    summary.out_of_work += report.out_of_work ? 1 : 0;
    summary.peak_force = std::max(summary.peak_force, report.force.spring_W.force.norm());

    Pose device = path.poses[i];
    if (status == Status::kOk) device.rotation.normalize();
    row.clear();
    fmt::format_to(std::back_inserter(row), "{}", path.t[i]);
    append(row, device);
    append(row, god_object->mesh_pose());
    append(row, report.force.spring_W.force);
    append(row, report.force.spring_W.torque);
    fmt::format_to(std::back_inserter(row), ",{},{},{},{},{},{}", depth, report.contacts, report.substeps,
                   times.step1_ns, times.solve_ns, name(report.outcome));
    if (outputs.overlap) {
      const double overlap = state.started ? outputs.overlap(god_object->mesh_pose()) : 0.0;
      if (overlap > summary.overlap) {
        summary.overlap = overlap;
        summary.overlap_at = path.t[i];
      }
      fmt::format_to(std::back_inserter(row), ",{}", overlap);
    }
    outputs.write_row(row + "\n");
    if (i % kProgressEvery == 0) outputs.progress(static_cast<double>(i) / static_cast<double>(path.poses.size()));
  }
  return summary;
}

}  // namespace godobject::replay
