#include "toolchain/report/extremes/torque_places.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <random>
#include <string>

#include <fmt/format.h>

#include "toolchain/report/contact_quality/compiled_scene.h"
#include "toolchain/report/contact_quality/meshes.h"
#include "toolchain/report/extremes/bounds.h"
#include "toolchain/report/extremes/led_arm.h"

namespace godobject::report {
namespace {

constexpr double kMillimetre = 1e-3;
constexpr double kPlaceVoxel = 2.0 * kMillimetre;
constexpr double kMayChangeBy = 0.05;          ///< allowed change per cycle, share of a joint's torque limit
constexpr double kDepth = 40.0 * kMillimetre;  ///< of the block, its top at z = 0
constexpr int kPathCycles = 2200;

Vector3 half_of_body(Place place) {
  return kMillimetre * (place == Place::kGridBorder ? Vector3(30.0, 4.0, 4.0) : Vector3(10.0, 8.0, 6.0));
}

/// Returns half the width of the still body. A body that starts inside has its shortest way out through the top: where
/// it hangs over an edge, its god object rightly jumps when it comes free of that edge.
double half_of_still(Place place) {
  return kMillimetre * (place == Place::kStartInside || place == Place::kStartDeep ? 60.0 : 30.0);
}

Vector3 top_of_grid(const SceneView& scene) {
  const Vector3 bricks(scene.grid.bricks[0], scene.grid.bricks[1], scene.grid.bricks[2]);
  return Eigen::Map<const Vector3>(scene.grid.origin) + format::kBrickCells * scene.grid.voxel_size * bricks;
}

/// Tells if the field knows of p only that it is inside.
bool is_beyond_band(const SceneView& scene, const Vector3& p_W) {
  const FieldSample sample = scene.voxelmap.sample(p_W);
  return !sample.known && sample.distance < 0.0;
}

/// Tells if the arm is at the place in this cycle.
bool is_there(Place place, const SceneView& scene, const LedCycle& cycle) {
  const Pose& H_WM = cycle.record.H_WM;
  const Vector3& p_W = H_WM.translation;
  const bool all_rendered = cycle.record.share == 1.0;
  const bool inside_at_start = cycle.outcome == Outcome::kStartInside;
  switch (place) {
    case Place::kStartInside: return inside_at_start;
    case Place::kStartDeep: return inside_at_start && is_beyond_band(scene, p_W);
    case Place::kDeep: return all_rendered && is_beyond_band(scene, p_W);
    case Place::kOutsideGrid: return all_rendered && p_W.x() > top_of_grid(scene).x();
    case Place::kGridBorder: {
      const Vector3 end = H_WM * Vector3(half_of_body(place).x(), 0.0, 0.0);
      return all_rendered && cycle.contacts > 0 && end.x() > top_of_grid(scene).x();
    }
    case Place::kMedialAxis: return std::fabs(p_W.z()) < 0.25 * kPlaceVoxel && cycle.contacts > 0;
  }
  return false;
}

/// Returns the largest change of a joint torque from one cycle to the next, over the allowed change.
double largest_step(const ArmModel& arm, const JointVector& now, const JointVector& before) {
  double most = 0.0;
  for (int i = 0; i < arm.joint_count; ++i) {
    const double may = kMayChangeBy * arm.joints.at(static_cast<std::size_t>(i)).torque;
    const double step = std::fabs(now[i] - before[i]) / may;
    most = std::isnan(step) ? step : std::max(most, step);
    if (std::isnan(step)) break;
  }
  return most;
}

/// Raises a maximum; NaN remains.
void raise(double& most, double value) {
  if (std::isnan(value) || value > most) most = value;
}

}  // namespace

const char* const kPlaceNames[] = {"start inside",     "start beyond the band", "pressed beyond the band",
                                   "outside the grid", "border of the grid",    "medial axis of a plate"};
const std::size_t kPlaceCount = std::size(kPlaceNames);

files::SceneImage place_scene(Place place, const std::filesystem::path& work) {
  const double bottom = place == Place::kMedialAxis ? -kPlaceVoxel : -kDepth;
  const double top = place == Place::kMedialAxis ? kPlaceVoxel : 0.0;
  const Vector3 half_body = half_of_body(place);
  const double half = half_of_still(place);
  const std::filesystem::path body = work / "body.ply";
  write_ply(box_mesh(-half_body, half_body), body);
  return compile("place",
                 {.still = {.mesh = box_mesh({-half, -half, bottom}, {half, half, top})},
                  .body = body,
                  .points = 60,
                  .settings = {.voxel_size = kPlaceVoxel, .safety_distance = 1.5 * kPlaceVoxel}},
                 work);
}

std::vector<Pose> place_path(Place place, const SceneView& scene, std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto between = [&random](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
  };
  const double outside = top_of_grid(scene).x() / kMillimetre + 15.0;
  Vector3 begin(between(-12.0, 12.0), between(-12.0, 12.0), 15.0);  // [mm] until all are scaled below
  Vector3 reach(0.0, 0.0, 0.0);                                     // there and back, twice
  Vector3 most_aside(15.0, 15.0, 0.0);
  switch (place) {
    case Place::kStartInside:
      begin.z() = between(-8.0, 5.0);
      reach.z() = 25.0 - begin.z();
      break;
    case Place::kStartDeep:
      begin.z() = between(-24.0, -16.0);
      reach.z() = 20.0 - begin.z();
      break;
    case Place::kDeep: reach.z() = between(-38.0, -32.0); break;
    case Place::kOutsideGrid:
      begin.x() = outside;
      begin.z() = between(-30.0, -10.0);
      reach.x() = between(20.0, 30.0) - outside;
      break;
    case Place::kGridBorder:
      begin.x() = between(25.0, 35.0);
      reach.z() = between(-30.0, -17.0);
      most_aside = {0.0, 6.0, 0.0};  // it stays on the top: the god object rightly jumps where it slides off an edge
      break;
    case Place::kMedialAxis:
      if (seed % 2 == 0) begin.z() = 0.0;  // else through the plate and back
      reach.z() = seed % 2 == 0 ? 25.0 : -35.0;
      break;
  }
  begin *= kMillimetre;
  reach *= kMillimetre;
  most_aside *= kMillimetre;
  const Vector3 rates(between(2.0, 6.0), between(2.0, 6.0), between(2.0, 6.0));  // [rad/s]
  const Vector3 aside(between(0.0, most_aside.x()), between(0.0, most_aside.y()), 0.0);
  const Vector3 tilt(between(-0.2, 0.2), between(-0.2, 0.2), between(-0.2, 0.2));  // [rad]
  std::vector<Pose> path;
  for (int k = 0; k < kPathCycles; ++k) {
    const double t = 1e-3 * k;
    const double there = 0.5 - 0.5 * std::cos(4.0 * M_PI * k / kPathCycles);
    const Vector3 waves = (rates * t).array().sin();
    Pose H_WM;
    H_WM.translation = begin + there * reach + aside.cwiseProduct(waves);
    H_WM.rotation = exp_rotation(tilt.cwiseProduct(waves));
    path.push_back(H_WM);
  }
  return path;
}

void TorqueSteps::add(const TorqueSteps& other) {
  cycles += other.cycles;
  there += other.there;
  rendered += other.rendered;
  idle_runs += other.idle_runs;
  raise(sent, other.sent);
  raise(sent_at_once, other.sent_at_once);
  raise(computed, other.computed);
  raise(force, other.force);
}

TorqueSteps torque_steps(Place place, const SceneView& scene, const firmware::Device& device, Solver solver,
                         bool friction, const ExtremesFault& fault, std::uint32_t seed) {
  std::vector<Pose> path = place_path(place, scene, seed);
  for (std::size_t k = path.size() / 2; k < path.size(); ++k) path[k].translation.x() += fault.jump;
  const std::vector<LedCycle> cycles = lead({&scene, &device, solver, friction, fault.limits, fault.cycle}, path);
  TorqueSteps found{.cycles = static_cast<std::int64_t>(cycles.size())};
  LedCycle before = cycles.front();  // the arm's weight, which comes at once, does not count as a change
  before.sent.setZero();
  for (const LedCycle& cycle : cycles) {
    raise(found.sent, largest_step(device.model, cycle.sent, before.sent));
    raise(found.sent_at_once, largest_step(device.model, cycle.sent_at_once, before.sent_at_once));
    raise(found.computed, largest_step(device.model, cycle.computed_at_once, before.computed_at_once));
    raise(found.force, (cycle.F_B_W.force - before.F_B_W.force).norm());
    if (is_there(place, scene, cycle)) ++found.there;
    if (cycle.record.share == 1.0) ++found.rendered;
    before = cycle;
  }
  const bool stopped = cycles.back().record.fault != firmware::Fault::kNone;
  // a body that starts inside may come out on the other side; then the controller never renders
  const bool begins_inside = cycles.front().outcome == Outcome::kStartInside;
  if (stopped || found.there == 0 || (found.rendered == 0 && !begins_inside)) found.idle_runs = 1;
  return found;
}

CaseResult torque_rate(Place place, const std::filesystem::path& device_file, std::int64_t cycles,
                       const RowRequest& request, const std::filesystem::path& work) {
  const firmware::Device device = firmware::read_device_file(device_file);
  files::SceneImage image = place_scene(place, work);
  firmware::set_gains({.stiffness = 2000.0, .damping = 5.0, .rotational = 0.003}, image.scene);
  CaseResult result;
  Sheet sheet{.name = "extremes_torque",
              .columns = {"place", "solver", "friction", "cycles", "cycles_there", "cycles_rendered", "sent_of_allowed",
                          "computed_of_allowed", "force_step_N"},
              .rows = {}};
  const std::string at = kPlaceNames[static_cast<std::size_t>(place)];
  constexpr int kVariants = 2 * static_cast<int>(format::kSolverCount);
  const std::uint32_t least_runs = request.one_place ? 1 : 2;
  for (int variant = request.one_place ? kVariants - 1 : 0; variant < kVariants; ++variant) {
    const auto solver = static_cast<Solver>(variant / 2);
    const bool friction = variant % 2 == 1;
    const std::string name = format::kSolverNames[static_cast<std::size_t>(solver)];
    const std::string where = fmt::format("{}, friction {}", name, friction ? "on" : "off");
    TorqueSteps all;
    std::uint32_t worst = 0;  // seed of the largest computed change
    const std::uint32_t first = 1000 * request.seed;
    for (std::uint32_t seed = first; all.cycles * kVariants < cycles || seed < first + least_runs; ++seed) {
      const double before = all.computed;
      all.add(torque_steps(place, image.scene, device, solver, friction, request.fault, seed));
      if (all.computed != before) worst = seed;
    }
    const Bound sent = extremes_bound::sent_torque(at);
    result.findings.push_back(judged(sent, all.sent, where));
    result.findings.push_back(judged(sent, all.sent_at_once, where + ", without supervisor"));
    result.findings.push_back(judged(extremes_bound::idle_runs(at), static_cast<double>(all.idle_runs), where));
    Finding computed = judged(extremes_bound::computed_torque(at), all.computed,
                              fmt::format("{}: {:.2g} N, seed {}", where, all.force, worst));
    if (solver != Solver::kContact) {
      computed.what = "paper, corrected: the same as computed, before the torque limiter";
      computed.most.reset();
    }
    result.findings.push_back(computed);
    sheet.rows.push_back({at, name, friction ? "on" : "off", std::to_string(all.cycles), std::to_string(all.there),
                          std::to_string(all.rendered), cell(std::max(all.sent, all.sent_at_once)), cell(all.computed),
                          cell(all.force)});
  }
  result.sheets.push_back(sheet);
  return result;
}

}  // namespace godobject::report
