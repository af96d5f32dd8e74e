#include "toolchain/scene_compiler/trimming/try_out.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include <time.h>

#include "toolchain/command_line/failure.h"
#include "toolchain/session/owned_god_object.h"

namespace godobject::scene_compiler {
namespace {

// Chosen: four presses touch different sides; a median needs five runs; the user waits at most some seconds.
constexpr int kPresses = 4;
constexpr int kMostTries = 60;
constexpr int kRuns = 25;
constexpr int kLeastRuns = 5;
constexpr std::chrono::seconds kLongest{4};

/// One session of the scene's own pipeline.
class Session {
 public:
  explicit Session(const SceneView& scene) {
    if (god_object_.start(scene, scene.default_solver(), scene.settings.friction != 0) != Status::kOk)
      throw command::Failure(command::ExitCode::kInternal,
                             "the image cannot run its own solver; please report this scene");
  }

  /// Runs one cycle. True if the body touches.
  bool update(const Pose& H_WM) {
    CycleReport report;
    if (god_object_->update({H_WM, Motion{}}, report) != Status::kOk)
      throw command::Failure(command::ExitCode::kInternal, "a generated pose is invalid; please report this scene");
    return report.contacts > 0 && report.penetration > -0.1 * god_object_.parameters().voxel_size;
  }
  void reset() { god_object_->reset(); }
  const Pose& H_WB() const { return god_object_.state().H_WS; }

 private:
  OwnedGodObject god_object_;
};

/// Returns the processor time that this thread has used.
double processor_ns() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Returns median and uncertainty of the savings. The standard error of a median of normal values is sqrt(pi / 2) times
/// that of the mean. Their scatter is 1.4826 times the median deviation from the median, which outliers do not change.
Saving saving_of(const std::vector<double>& saved) {
  constexpr double kScatter = 1.4826;
  const double ns = median(saved);
  std::vector<double> deviations;
  for (const double value : saved) deviations.push_back(std::abs(value - ns));
  const double runs = static_cast<double>(saved.size());
  return {ns, kScatter * median(deviations) * std::sqrt(0.5 * std::numbers::pi / runs)};
}

/// Draws random places and directions.
class Draw {
 public:
  Vector3 direction() { return Vector3(normal_(random_), normal_(random_), normal_(random_)).normalized(); }
  Vector3 within(const Vector3& low, const Vector3& high) {
    return low + Vector3(share_(random_), share_(random_), share_(random_)).cwiseProduct(high - low);
  }
  Quaternion rotation() {
    return Quaternion(normal_(random_), normal_(random_), normal_(random_), normal_(random_)).normalized();
  }

 private:
  std::mt19937 random_{1};
  std::normal_distribution<double> normal_;
  std::uniform_real_distribution<double> share_{0.0, 1.0};
};

/// Appends the motion from free space to the touch pose and deeper, along the surface back and forth, and out again.
/// The places are in voxels, along `into` and across it.
void press(const Pose& H_WB, const Vector3& into, const Vector3& along, double s, std::vector<Pose>& poses) {
  constexpr int kCycles = 100;  // of each leg
  struct Stage {
    double deep, across;
  };
  constexpr std::array kPlaces = {Stage{-25, 0}, Stage{3, 0}, Stage{3, 10}, Stage{3, -10}, Stage{3, 0}, Stage{-25, 0}};
  for (std::size_t leg = 0; leg + 1 < kPlaces.size(); ++leg) {
    const Stage& from = kPlaces[leg];
    const Stage& to = kPlaces[leg + 1];
    for (int k = 0; k < kCycles; ++k) {
      const double share = static_cast<double>(k) / kCycles;
      Pose pose = H_WB;
      pose.translation +=
          s * (std::lerp(from.deep, to.deep, share) * into + std::lerp(from.across, to.across, share) * along);
      poses.push_back(pose);
    }
  }
}

}  // namespace

std::vector<Pose> try_out_motion(const SceneView& scene) {
  constexpr double kStep = 0.25;  // voxels for each cycle of the approach
  constexpr int kMostCycles = 4000;
  const double s = scene.grid.voxel_size;
  const Vector3 still_low(scene.grid.surface_min[0], scene.grid.surface_min[1], scene.grid.surface_min[2]);
  const Vector3 still_high(scene.grid.surface_max[0], scene.grid.surface_max[1], scene.grid.surface_max[2]);
  const double around = scene.body.radius + 3.0 * s;
  const Vector3 low = scene.workspace.nearest(still_low.array() - around);
  const Vector3 high = scene.workspace.nearest(still_high.array() + around);
  Draw draw;
  Session session(scene);
  std::vector<Pose> motion;
  std::vector<Pose> flight;
  int presses = 0;
  for (int i = 0; i < kMostTries && presses < kPresses; ++i) {
    Pose H_WB;
    H_WB.rotation = draw.rotation();
    H_WB.translation = draw.within(low, high);
    const Vector3 into = (draw.within(still_low, still_high) - H_WB.translation).normalized();
    const Vector3 along = into.cross(draw.direction()).normalized();
    if (!(smallest_distance(scene.voxelmap, scene.pointshell, H_WB) > 0.0)) continue;
    session.reset();
    bool touches = false;
    int cycles = 0;
    while (!touches && cycles < kMostCycles && scene.workspace.contains(H_WB.translation)) {
      touches = session.update(H_WB * scene.H_MB.inverse());
      if (cycles++ % 16 == 0) flight.push_back(H_WB);
      if (!touches) H_WB.translation += kStep * s * into;
    }
    if (!touches) continue;
    ++presses;
    press(H_WB, into, along, s, motion);
  }
  if (motion.empty()) motion = std::move(flight);
  for (Pose& pose : motion) pose = pose * scene.H_MB.inverse();
  return motion;
}

std::vector<Pose> poses_along(const SceneView& scene, std::span<const Pose> motion) {
  Session session(scene);
  std::vector<Pose> poses;
  for (const Pose& H_WM : motion) {
    session.update(H_WM);
    poses.push_back(session.H_WB());
  }
  return poses;
}

CycleTimes time_cycles(std::span<const SceneView* const> scenes, std::span<const Pose> motion,
                       const parallel::Progress& progress) {
  std::vector<std::vector<double>> runs(scenes.size());  // mean time of a cycle [ns]
  const auto begin = std::chrono::steady_clock::now();
  for (int run = 0; run < kRuns; ++run) {
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      Session session(*scenes[i]);
      const double start = processor_ns();
      for (const Pose& H_WM : motion) session.update(H_WM);
      runs[i].push_back((processor_ns() - start) / static_cast<double>(motion.size()));
    }
    if (progress) progress((run + 1.0) / kRuns);
    if (run + 1 >= kLeastRuns && std::chrono::steady_clock::now() - begin > kLongest) break;
  }
  CycleTimes times;
  times.ns = median(runs.front());
  for (std::size_t i = 1; i < scenes.size(); ++i) {
    std::vector<double> saved;
    for (std::size_t run = 0; run < runs[i].size(); ++run) saved.push_back(runs[i - 1][run] - runs[i][run]);
    times.savings.push_back(saving_of(saved));
  }
  return times;
}

}  // namespace godobject::scene_compiler
