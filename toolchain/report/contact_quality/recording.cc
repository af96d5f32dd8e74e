#include "toolchain/report/contact_quality/recording.h"

#include "toolchain/timing/stopwatch.h"

namespace godobject::report {
std::vector<RecordedCycle> record(const World& world, Cycle cycle, const std::vector<Pose>& H_WD,
                                  std::size_t true_depth_every) {
  std::vector<RecordedCycle> cycles;
  cycles.reserve(H_WD.size());
  CycleReport report;
  for (const Pose& pose : H_WD) {
    StepTimes times{.now_ns = timing::stopwatch()};
    const Status status = cycle(pose, report, times);
    RecordedCycle row;
    row.H_WD = pose;
    row.H_WS = report.H_WS;
    row.force_W = report.force.spring_W.force;
    row.depth = world.depth(report.H_WS);
    if (true_depth_every != 0 && cycles.size() % true_depth_every == 0) row.true_depth = world.true_depth(report.H_WS);
    row.contacts = report.contacts;
    row.substeps = report.substeps;
    row.step1_ns = times.step1_ns;
    row.solve_ns = times.solve_ns;
    row.good = status == Status::kOk;
    cycles.push_back(row);
  }
  return cycles;
}

std::vector<Pose> device_poses(const World& world, const Pose& H_WO, const std::vector<Pose>& H_OC) {
  Pose H_CB;
  H_CB.rotation = world.H_MB().rotation;
  std::vector<Pose> poses;
  poses.reserve(H_OC.size());
  for (const Pose& pose : H_OC) poses.push_back(H_WO * pose * H_CB);
  return poses;
}

std::vector<Vector3> points_C(const World& world) {
  std::vector<Vector3> points = world.points_B();
  for (Vector3& p : points) p = world.H_MB().rotation._transformVector(p);
  return points;
}

}  // namespace godobject::report
