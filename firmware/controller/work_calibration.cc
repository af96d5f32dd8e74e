#include "firmware/controller/work_calibration.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include <fmt/format.h>

#include "firmware/cycle/cycles_in.h"

namespace godobject::firmware {
namespace {

constexpr double kApproach = 0.25;  // [s]
constexpr double kPressed = 0.15;   // [s]
constexpr int kPasses = 3;
constexpr int kTrials = 8;
constexpr double kReserve = 0.9;  // of the budget that the last trial suggests
constexpr int kRest = 1000;
constexpr int kWithoutBudget = 100;
constexpr double kSwing = 0.05;  // of the way to the middle
constexpr double kTurn = 0.05;   // [rad]

Pose moved(const Pose& start, const Vector3& p_MB, const Vector3& way_W, const Vector3& turn_W) {
  const Vector3 G = start.translation + start.rotation * p_MB + way_W;
  Pose H;
  H.rotation = (exp_rotation(turn_W) * start.rotation).normalized();
  H.translation = G - H.rotation * p_MB;
  return H;
}

/// Other memory, as large as a processor's second cache: in the loop the god object finds little of its own there after
/// a millisecond of other programs.
class OtherMemory {
 public:
  void use() noexcept {
    for (std::size_t i = 0; i < bytes_.size(); i += 64) bytes_[i] = static_cast<unsigned char>(bytes_[i] + 1);
  }

 private:
  std::vector<unsigned char> bytes_ = std::vector<unsigned char>(std::size_t{2} << 20);
};

/// Runs the path; calls before() and after(cycle, report) for each cycle.
template <class Before, class After>
void run(GodObject& god_object, std::span<const Pose> path, const Before& before, const After& after) {
  CycleReport report;
  for (std::size_t k = 0; k < path.size(); ++k) {
    before();
    static_cast<void>(god_object.update({path[k], Motion{}}, report));  // the poses are finite
    after(k, report);
  }
}

}  // namespace

std::vector<Pose> calibration_path(const SceneView& scene, const Pose& start_WM) {
  const Vector3& p_MB = scene.H_MB.translation;
  const format::Grid& grid = scene.grid;
  Vector3 middle;
  for (int axis = 0; axis < 3; ++axis) middle[axis] = 0.5 * (grid.surface_min[axis] + grid.surface_max[axis]);
  const Vector3 way = middle - (start_WM.translation + start_WM.rotation * p_MB);
  const double length = way.norm();
  const Vector3 along = length > 0.0 ? Vector3(way / length) : Vector3(Vector3::UnitZ());
  const Vector3 across = along.unitOrthogonal();
  std::vector<Pose> path;
  const std::uint32_t approach = cycles_in(kApproach, scene.settings.period);
  for (std::uint32_t k = 0; k <= approach; ++k) {
    path.push_back(moved(start_WM, p_MB, static_cast<double>(k) / approach * way, Vector3::Zero()));
  }
  const std::uint32_t pressed = cycles_in(kPressed, scene.settings.period);
  for (std::uint32_t k = 1; k <= pressed; ++k) {
    const double phase = 4.0 * std::acos(-1.0) * k / pressed;
    path.push_back(moved(start_WM, p_MB, way + kSwing * length * std::sin(phase) * across,
                         kTurn * (std::sin(phase) * along + std::sin(0.5 * phase) * across)));
  }
  return path;
}

TimedPath time_path(const SceneView& scene, bool friction, std::span<const Pose> path, std::span<std::byte> memory,
                    std::uint64_t units, hal::Clock& clock) {
  TimedPath timed;
  OtherMemory other;
  std::vector<double> least(path.size(), std::numeric_limits<double>::infinity());
  for (int pass = 0; pass < kPasses; ++pass) {
    GodObject god_object;  // again from the start, so that each pass does the same work
    if (god_object.start(Scene::of(scene), Solver::kContact, friction, memory) != Status::kOk) return {};
    god_object.set_work_budget(units);
    timed = {.cycles = static_cast<std::uint32_t>(path.size())};
    std::int64_t begin_ns = 0;
    const auto before = [&]() {
      other.use();
      begin_ns = clock.now_ns();
    };
    run(god_object, path, before, [&](std::size_t k, const CycleReport& report) {
      least[k] = std::min(least[k], 1e-9 * static_cast<double>(clock.now_ns() - begin_ns));
      timed.contacts += report.contacts > 0 ? 1 : 0;
      timed.ended += report.out_of_work ? 1 : 0;
    });
  }
  for (const double time : least) timed.longest = std::max(timed.longest, time);
  return timed;
}

std::string describe(const WorkBudget& budget, double seconds) {
  const TimedPath& with = budget.with;
  return fmt::format(
      "budget: {:.0f} us a cycle for the god object, {} units. With them the longest cycle of a test motion takes "
      "{:.0f} us; they end {} of {} cycles, {} of which have contact",
      1e6 * seconds, budget.units, 1e6 * with.longest, with.ended, with.cycles, with.contacts);
}

std::string too_long_for(const WorkBudget& budget, double seconds) {
  if (!(budget.with.longest > seconds)) return "";
  return fmt::format(
      "no budget of work keeps cycles within {:.3g} us: the longest of a test motion takes {:.3g} us; {}",
      1e6 * seconds, 1e6 * budget.with.longest, kMoreTime);
}

std::string too_little_for(double left, double seconds) {
  constexpr double kMostLeft = 1e-4;  // [m], chosen: a god object that comes no nearer counts as held
  if (!(left > kMostLeft)) return "";
  return fmt::format(
      "with {:.0f} us a cycle the god object stops on the way: after a test motion it is still {:.3g} mm from the "
      "position that it reaches without a budget; {}",
      1e6 * seconds, 1e3 * left, kMoreTime);
}

WorkBudget find_budget(const SceneView& scene, bool friction, std::span<const Pose> path, std::span<std::byte> memory,
                       double seconds, hal::Clock& clock) {
  double units = seconds / kNominalUnit;
  WorkBudget found;
  for (int trial = 0; trial < kTrials; ++trial) {
    found.units = static_cast<std::uint64_t>(std::max(1.0, units));
    found.with = time_path(scene, friction, path, memory, found.units, clock);
    if (!(found.with.longest > seconds)) break;
    units *= kReserve * seconds / found.with.longest;
  }
  return found;
}

double distance_left(const SceneView& scene, bool friction, std::span<const Pose> path, std::span<std::byte> memory,
                     std::uint64_t units) {
  GodObject god_object;
  if (god_object.start(Scene::of(scene), Solver::kContact, friction, memory) != Status::kOk) return 0.0;
  god_object.set_work_budget(units);
  run(
      god_object, path, [] {}, [](std::size_t, const CycleReport&) {});
  CycleReport report;
  const auto rest = [&](int cycles) -> Vector3 {
    for (int k = 0; k < cycles; ++k) static_cast<void>(god_object.update({path.back(), Motion{}}, report));
    return god_object.mesh_pose() * scene.H_MB.translation;
  };
  const Vector3 held = rest(kRest);
  god_object.set_work_budget(GodObject::kNoBudget);
  return (rest(kWithoutBudget) - held).norm();
}

}  // namespace godobject::firmware
