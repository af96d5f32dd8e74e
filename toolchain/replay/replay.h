#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <string>

#include "core/scene/scene_view.h"
#include "godobject/god_object.h"
#include "toolchain/files/pose_path.h"

namespace godobject::replay {

/// The summary of a replay, beside its rows.
struct Summary {
  std::size_t cycles = 0;
  std::array<std::size_t, static_cast<std::size_t>(Outcome::kInfeasible) + 1> by_outcome{};  ///< cycles of each outcome
  std::size_t bad_rows = 0;                                                                  ///< rows that were no pose
  std::size_t first_bad_line = 0;
  /// Largest depth of the god object; negative: the smallest gap. Limited to the stored band [m].
  double deepest = -std::numeric_limits<double>::infinity();
  double peak_force = 0.0;         ///< [N]
  std::size_t unconverged = 0;     ///< cycles whose friction did not converge to the tolerance
  std::uint32_t most_dropped = 0;  ///< largest number of near points left out in a cycle
  int float_exceptions = 0;        ///< FE_INVALID, FE_DIVBYZERO, FE_OVERFLOW that any cycle raised

  /// Returns the number of cycles with this outcome.
  std::size_t count(Outcome outcome) const { return by_outcome[static_cast<std::size_t>(outcome)]; }
};

/// The names of a replay's columns, in their order, separated by commas.
extern const char* const kColumns;

/// Runs the god object along the path, one cycle for each pose. Passes the header and then one CSV row for each cycle
/// to `write_row`. Everything except the two timing columns depends on the input alone, to the last bit. Throws Failure
/// (kBadData) if the image lacks the solver or friction.
Summary replay(const SceneView& scene, Solver solver, bool friction, const files::PosePath& path,
               const std::function<void(const std::string&)>& write_row, const std::function<void(double)>& progress);

}  // namespace godobject::replay
