#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "core/pipeline/cycle/work.h"
#include "core/scene/scene_view.h"
#include "godobject/god_object.h"
#include "toolchain/files/pose_path.h"

namespace godobject::replay {

class ReplayWatch;

/// The summary of a replay, beside its rows.
struct Summary {
  std::size_t cycles = 0;
  std::array<std::size_t, static_cast<std::size_t>(Outcome::kInfeasible) + 1> by_outcome{};  ///< cycles of each outcome
  std::size_t bad_rows = 0;                                                                  ///< rows that were no pose
  std::size_t first_bad_line = 0;
  /// Largest depth of a sample point of the god object in the stored distances; negative: none is inside, the smallest
  /// distance. Limited to the stored band [m].
  double deepest = -std::numeric_limits<double>::infinity();
  double overlap = 0.0;            ///< largest depth at which the meshes overlap, if it is measured [m]
  double overlap_at = 0.0;         ///< its time [s]
  double peak_force = 0.0;         ///< [N]
  std::size_t unconverged = 0;     ///< cycles whose friction did not converge to the tolerance
  std::uint32_t most_dropped = 0;  ///< largest number of near points left out in a cycle
  std::uint64_t most_work = 0;     ///< largest work of a cycle [units]
  std::size_t out_of_work = 0;     ///< cycles that the budget of work ended
  /// With a budget of work: distance of the centre of mass from that of a god object without, for each cycle [m].
  std::vector<double> lag;
  int float_exceptions = 0;  ///< FE_INVALID, FE_DIVBYZERO, FE_OVERFLOW that any cycle raised

  /// Returns the number of cycles with this outcome.
  std::size_t count(Outcome outcome) const { return by_outcome[static_cast<std::size_t>(outcome)]; }
};

/// The names of a replay's columns, in their order, separated by commas; kOverlapColumn follows if it is measured.
extern const char* const kColumns;
extern const char* const kOverlapColumn;

/// Where the results of a replay go, and what is measured beside them.
struct Outputs {
  std::function<void(const std::string&)> write_row;  ///< the header, and then one CSV row for each cycle
  std::function<void(double)> progress;               ///< 0 .. 1
  /// Returns the depth at which the meshes overlap at a pose of the moving mesh's frame [m]; may be empty.
  std::function<double(const Pose&)> overlap;
  ReplayWatch* watch = nullptr;  ///< judges every cycle; may be null
};

/// Runs the god object along the path, one cycle for each pose. Everything except the two timing columns depends on the
/// input alone, to the last bit. `work_budget`: of each cycle [units]; with one a second god object runs beside
/// without. Throws Failure (kBadData) if the image lacks the solver or friction.
Summary replay(const SceneView& scene, Solver solver, bool friction, const files::PosePath& path,
               const Outputs& outputs, std::uint64_t work_budget = WorkMeter::kUnlimited);

}  // namespace godobject::replay
