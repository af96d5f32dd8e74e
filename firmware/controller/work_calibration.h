#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/scene/scene_view.h"
#include "godobject/god_object.h"
#include "godobject/pose.h"
#include "hal/clock.h"

namespace godobject::firmware {

/// A unit of work costs about this much on an x86-64 processor of 3 GHz with AVX2 [s]; in virtual time it counts as
/// that, so that each run is the same.
inline constexpr double kNominalUnit = 0.25e-9;

/// A motion of the moving mesh on which `contact` is timed: from the start in a straight line until its centre of mass
/// is at the middle of the still body, then back and forth across and with turns, pressed against whatever holds it.
/// Poses H_WM, a cycle each; at most some 0.5 mm a cycle on a body of 100 mm.
std::vector<Pose> calibration_path(const SceneView& scene, const Pose& start_WM);

/// The cost of `contact` on this machine.
struct WorkCost {
  double unit = 0.0;           ///< cost of a unit of work in the worst cycle [s]
  double longest = 0.0;        ///< longest cycle [s]
  std::uint32_t contacts = 0;  ///< cycles with contact
};

/// Times `contact` along a path without a budget, each cycle after other memory was used. A cycle counts with the least
/// of three times, so that other programs do not make it longer. `memory`: of GodObject, at least memory_size(). Cost:
/// three times that of the path, some seconds at most.
WorkCost measure_work(const SceneView& scene, bool friction, std::span<const Pose> path, std::span<std::byte> memory,
                      hal::Clock& clock);

/// The effect of a budget on the motion of a path.
struct BudgetTrial {
  std::uint32_t cycles = 0;
  std::uint32_t ended = 0;  ///< cycles that the budget ended
  double short_by = 0.0;    ///< way that the god object still has to go when it does not come nearer any more [m]
};

/// Tries a budget of work [units] along a path. At its end the device rests for a second, then the budget is taken
/// away, and the god object goes on if the budget held it.
BudgetTrial try_budget(const SceneView& scene, bool friction, std::span<const Pose> path, std::span<std::byte> memory,
                       std::uint64_t units);

}  // namespace godobject::firmware
