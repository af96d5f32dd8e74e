#include "toolchain/report/contact_quality/measure.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "toolchain/report/contact_quality/recording.h"
#include "toolchain/report/contact_quality/reference.h"
#include "toolchain/report/contact_quality/signals.h"
#include "toolchain/statistics/samples.h"

namespace godobject::report {
namespace {

constexpr double kRhoSquared = 0.025;  // k_VC,r / k_VC,x
constexpr double kMillimetre = 1e3;
constexpr double kMicrometre = 1e6;
constexpr double kPercent = 100.0;
constexpr double kDegrees = 57.29577951308232;
constexpr double kPerMicrosecond = 1e-3;

/// All runs of one solver in one scene, and their worst results.
class Study {
 public:
  Study(const SceneSpec& scene, const World& world, const World* still_world, Solver solver, const Effort& effort)
      : scene_(scene), world_(world), still_world_(still_world), solver_(solver), effort_(effort) {
    placement_ =
        touch(scene.placement, points_C(world), [&](const Vector3& p_O) { return world.distance(scene.H_WO * p_O); });
  }

  std::vector<Measurement> run() {
    const Motions& motions = scene_.motions;
    if (motions.press) smooth(press(placement_, scene_.depth));
    if (motions.turn) smooth(turn(placement_, scene_.depth, scene_.angle));
    if (motions.slide) frictionless_slide();
    if (motions.retreat) way_out();
    if (motions.slip) slip();
    if (motions.friction_slide) friction_slide();
    if (motions.tremor) hold_trembling();
    if (motions.dashes) dashes();
    timing(plain_times_, Quantity::kSolveMedian, Quantity::kSolveP99);
    timing(friction_times_, Quantity::kFrictionMedian, Quantity::kFrictionP99);
    timing(cycle_times_, Quantity::kCycleMedian, Quantity::kCycleP99);
    if (substeps_.count > 0) {
      note(Quantity::kSubstepsMean, substeps_.sum / substeps_.count);
      note(Quantity::kSubstepsMax, substeps_.most);
    }
    std::vector<Measurement> result;
    for (const auto& [quantity, value] : worst_) {
      result.push_back({scene_.name, name(scene_.kind), solver_, quantity, value});
    }
    return result;
  }

 private:
  static constexpr double kSlideSpeed = 0.1;
  static constexpr double kSlipSpeed = 1.0;

  void note(Quantity quantity, double value) {
    const auto [found, fresh] = worst_.try_emplace(quantity, value);
    if (!fresh && !(value <= found->second)) found->second = value;
  }

  double tolerance() const { return 1e-3 * *spec(scene_.tight ? Quantity::kOptimumTight : Quantity::kOptimum).target; }

  std::vector<RecordedCycle> record_in(const World& world, const Pose& H_WO, const DevicePath& path, bool friction) {
    constexpr std::size_t kTrueDepthEvery = 4;
    return record(world, world.start(solver_, friction), device_poses(world, H_WO, path.H_OC),
                  scene_.kind == WorldKind::kCompiled ? kTrueDepthEvery : 0);
  }

  /// Runs a path and notes penetration and time, which every run has.
  std::vector<RecordedCycle> run_along(const DevicePath& path, bool friction) {
    std::vector<RecordedCycle> cycles = record_in(world_, scene_.H_WO, path, friction);
    for (const RecordedCycle& c : cycles) {
      note(Quantity::kPenetration, c.good ? kMillimetre * std::max(0.0, c.depth) : std::nan(""));
      if (scene_.kind == WorldKind::kCompiled) {
        note(scene_.sharp ? Quantity::kTruePenetrationSharp : Quantity::kTruePenetrationSmooth,
             std::max(0.0, c.true_depth) / scene_.voxel_size);
      }
      if (c.contacts == 0) continue;
      (friction ? friction_times_ : plain_times_).push_back(kPerMicrosecond * static_cast<double>(c.solve_ns));
      cycle_times_.push_back(kPerMicrosecond * static_cast<double>(c.step1_ns + c.solve_ns));
      substeps_.sum += c.substeps;
      substeps_.count += 1;
      substeps_.most = std::max(substeps_.most, static_cast<double>(c.substeps));
    }
    return cycles;
  }

  void timing(const std::vector<double>& times, Quantity median, Quantity p99) {
    if (times.empty()) return;
    note(median, percentile(times, 0.5));
    note(p99, percentile(times, 0.99));
  }

  OptimumProblem problem_of(const RecordedCycle& c) const {
    return {.H_WD = c.H_WD,
            .points_B = world_.points_B(),
            .pieces = [this](const Vector3& p, auto& out) { world_.pieces(p, out); },
            .edges_B = world_.edges_B(),
            .edges_W = world_.edges_W(),
            .rho_squared = kRhoSquared,
            .largest_step = scene_.voxel_size};
  }

  OptimumGap gap(const RecordedCycle& c) const { return optimum_gap(problem_of(c), c.H_WS, scene_.one_sided); }

  /// Returns the forces of the optimum, followed from cycle to cycle. A solver that keeps all sample points outside
  /// cannot chatter less.
  std::vector<Vector3> optimum_forces(const DevicePath& path, const std::vector<RecordedCycle>& cycles) const {
    std::vector<Vector3> result;
    Pose H_WS = cycles[path.begin].H_WS;
    for (std::size_t k = path.begin; k < path.end; ++k) {
      H_WS = polish(problem_of(cycles[k]), H_WS).H_WS;
      result.push_back(WorldSettings{}.stiffness * (H_WS.translation - cycles[k].H_WD.translation));
    }
    return result;
  }

  void compare_with_optimum(const DevicePath& path, const std::vector<RecordedCycle>& cycles) {
    for (const std::size_t k : path.checkpoints) {
      const OptimumGap found = gap(cycles[k]);
      if (!found.known) continue;
      note(scene_.tight ? Quantity::kOptimumTight : Quantity::kOptimum, kMillimetre * found.distance);
      note(Quantity::kExcess, kMillimetre * found.excess);
    }
  }

  static std::vector<Vector3> forces(const DevicePath& path, const std::vector<RecordedCycle>& cycles) {
    std::vector<Vector3> result;
    for (std::size_t k = path.begin; k < path.end; ++k) result.push_back(cycles[k].force_W);
    return result;
  }

  std::vector<RecordedCycle> smooth(const DevicePath& path) {
    const auto cycles = run_along(path, false);
    const Quantity quantity = scene_.plain ? Quantity::kChatterPlain : Quantity::kChatterElsewhere;
    const double felt = chatter(forces(path, cycles));
    note(quantity, felt);
    if (solver_ == Solver::kContact && felt > *spec(quantity).target) {
      note(Quantity::kChatterOptimum, chatter(optimum_forces(path, cycles)));
    }
    compare_with_optimum(path, cycles);
    if (still_world_ != nullptr) compare_with_still_world(path, cycles);
    return cycles;
  }

  void compare_with_still_world(const DevicePath& path, const std::vector<RecordedCycle>& cycles) {
    const auto still = record_in(*still_world_, Pose{}, path, false);
    for (std::size_t k = 0; k < cycles.size(); ++k) {
      const Pose expected = scene_.H_WO * still[k].H_WS;
      note(Quantity::kMovedPose, kMicrometre * metric_distance(expected, cycles[k].H_WS, kRhoSquared));
      const Vector3 force = scene_.H_WO.rotation._transformVector(still[k].force_W);
      note(Quantity::kMovedForce, 1e3 * (force - cycles[k].force_W).norm());
    }
  }

  Vector3 in_W(const Vector3& direction_O) const { return scene_.H_WO.rotation._transformVector(direction_O); }

  void frictionless_slide() {
    constexpr double kDuration_s = 0.3;
    const DevicePath path = slide(placement_, scene_.depth, kSlideSpeed, kDuration_s);
    const auto cycles = smooth(path);
    const Vector3 along = in_W(placement_.along);
    for (std::size_t k = path.begin; k < path.end; ++k) {
      note(Quantity::kDrag, std::fabs(cycles[k].force_W.dot(along)));
    }
  }

  void way_out() {
    const DevicePath path = retreat(placement_, scene_.depth);
    const auto cycles = run_along(path, false);
    const Vector3 into = in_W(placement_.into);
    for (std::size_t k = path.begin; k < path.end; ++k) {
      note(Quantity::kPull, std::max(0.0, cycles[k].force_W.dot(into)));
    }
  }

  void slip() {
    const DevicePath path = slip_off(placement_, scene_.depth, kSlipSpeed);
    const auto cycles = run_along(path, false);
    std::vector<double> distances;
    for (const std::size_t k : path.checkpoints) distances.push_back(gap(cycles[k]).distance);
    note(Quantity::kSlipTime, static_cast<double>(longest_above(distances, tolerance())));
  }

  void friction_slide() {
    constexpr double kDuration_s = 0.3;
    const DevicePath path = slide(placement_, scene_.depth, kSlideSpeed, kDuration_s);
    const auto cycles = run_along(path, true);
    const Vector3 normal = in_W(placement_.into);
    const Vector3 against = -in_W(placement_.along);
    for (std::size_t k = path.begin; k < path.end; ++k) {
      const Vector3& force = cycles[k].force_W;
      // in a groove the force across the motion comes from the walls' normal forces, if the device is off the middle
      const double tangential = scene_.groove ? std::fabs(force.dot(against)) : across(force, normal).norm();
      const double error = tangential / std::fabs(force.dot(normal)) / scene_.friction_ratio - 1.0;
      note(scene_.groove ? Quantity::kRatioGroove : Quantity::kRatio, kPercent * std::fabs(error));
      if (!scene_.groove) note(Quantity::kDirection, kDegrees * angle_between(across(force, normal), against));
    }
  }

  void hold_trembling() {
    constexpr std::size_t kTremorPeriod = 1000;  // cycles
    const DevicePath path = tremor(placement_, scene_.depth, effort_.tremor_s);
    const auto cycles = run_along(path, true);
    std::vector<Vector3> positions;
    for (std::size_t k = path.begin; k < path.end; ++k) positions.push_back(cycles[k].H_WS.translation);
    note(Quantity::kDrift, kMicrometre * drift(positions, kTremorPeriod));
  }

  void dashes() {
    constexpr double kClear_m = 0.01;
    double radius = 0.0;
    for (const Vector3& p : world_.points_B()) radius = std::max(radius, p.norm());
    std::mt19937 random(20161);
    const Pose H_OW = scene_.H_WO.inverse();
    double crossings = 0.0;
    for (int i = 0; i < effort_.dashes; ++i) {
      const auto cycles = run_along(dash(radius + kClear_m, random), false);
      for (std::size_t k = 1; k < cycles.size(); ++k) {
        const Pose before = H_OW * cycles[k - 1].H_WS;
        const Pose after = H_OW * cycles[k].H_WS;
        for (const Vector3& p : world_.points_B()) {
          if (scene_.barrier->is_pierced(before * p, after * p)) crossings += 1.0;
        }
      }
    }
    note(Quantity::kCrossings, crossings);
  }

  struct Substeps {
    double sum = 0.0;
    double count = 0.0;
    double most = 0.0;
  };

  const SceneSpec& scene_;
  const World& world_;
  const World* still_world_;
  Solver solver_;
  Effort effort_;
  Placement placement_;
  std::map<Quantity, double> worst_;
  std::vector<double> plain_times_;
  std::vector<double> friction_times_;
  std::vector<double> cycle_times_;
  Substeps substeps_;
};

}  // namespace

std::vector<Measurement> measure(const SceneSpec& scene, const World& world, const World* still_world, Solver solver,
                                 const Effort& effort) {
  if (!world.start(solver, false)) return {};
  return Study(scene, world, still_world, solver, effort).run();
}

}  // namespace godobject::report
