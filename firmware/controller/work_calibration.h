#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/scene/scene_view.h"
#include "godobject/god_object.h"
#include "godobject/pose.h"
#include "hal/clock.h"

namespace godobject::firmware {

/// A unit of work costs about this much on an x86-64 processor of 3 GHz with AVX2 [s]; in virtual time it counts as
/// that, so that each run is the same.
inline constexpr double kNominalUnit = 0.25e-9;

/// The cure where the budget is too small for a scene.
inline constexpr const char* kMoreTime =
    "raise loop.compute, and loop.cycle_budget if it is set, or compile the scene with fewer points or with "
    "point_budget";

/// A motion of the moving mesh on which `contact` is timed: from the start in a straight line until its centre of mass
/// is at the middle of the still body, then back and forth across and with turns, pressed against whatever holds it.
/// Poses H_WM, a cycle each; at most some 0.5 mm a cycle on a body of 100 mm.
std::vector<Pose> calibration_path(const SceneView& scene, const Pose& start_WM);

/// The timed motion of a mesh.
struct TimedPath {
  double longest = 0.0;        ///< longest cycle [s]
  std::uint32_t cycles = 0;    ///< 0: the god object did not start
  std::uint32_t contacts = 0;  ///< cycles with contact
  std::uint32_t ended = 0;     ///< cycles that the budget ended
};

/// Times `contact` along a path with a budget of work [units], each cycle after other memory was used. A cycle counts
/// with the least of three times, so that other programs do not make it longer. `memory`: of GodObject, at least
/// memory_size(). Cost: three times that of the path, and half a second.
TimedPath time_path(const SceneView& scene, bool friction, std::span<const Pose> path, std::span<std::byte> memory,
                    std::uint64_t units, hal::Clock& clock);

/// A budget of work for a time.
struct WorkBudget {
  std::uint64_t units{};
  TimedPath with;  ///< the motion with this budget
};

/// Returns the line that tells the operator of a budget for `seconds`.
std::string describe(const WorkBudget& budget, double seconds);

/// Returns what the operator must know of a budget that does not bound the time, with the cure; empty if it does.
std::string too_long_for(const WorkBudget& budget, double seconds);

/// Returns what the operator must know of a budget that leaves the god object behind, with the cure; empty if it does
/// not. `left`: as `distance_left` [m].
std::string too_little_for(double left, double seconds);

/// Finds a budget with which no cycle of a path takes longer than `seconds`, from the nominal one down.
/// If there is none after some trials, the last one is returned: see `with.longest`. Cost: at most eight times that of
/// time_path.
WorkBudget find_budget(const SceneView& scene, bool friction, std::span<const Pose> path, std::span<std::byte> memory,
                       double seconds, hal::Clock& clock);

/// Returns how far the god object still is from the position that it reaches without a budget, after a motion with a
/// budget and a second of rest [m].
double distance_left(const SceneView& scene, bool friction, std::span<const Pose> path, std::span<std::byte> memory,
                     std::uint64_t units);

}  // namespace godobject::firmware
