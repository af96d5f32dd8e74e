#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <string>

#include "core/pipeline/god_object.h"
#include "core/scene/scene.h"
#include "toolchain/files/pose_path.h"

namespace godobject::replay {

/// What a replay leaves beside its rows.
struct Summary {
  std::size_t cycles = 0;
  std::array<std::size_t, static_cast<std::size_t>(Outcome::kInfeasible) + 1> by_outcome{};  ///< cycles of each
  std::size_t bad_rows = 0;                                                                  ///< poses that were none
  std::size_t first_bad_line = 0;
  double deepest =
      -std::numeric_limits<double>::infinity();  ///< largest depth of the god object, negative: the
                                                 ///< smallest gap; the field tells none beyond its band [m]
  double peak_force = 0.0;                       ///< [N]
  std::size_t unconverged = 0;                   ///< cycles whose friction was not found to the tolerance
  std::uint32_t most_dropped = 0;                ///< near points, in the cycle that had most
  int float_exceptions = 0;  ///< of FE_INVALID, FE_DIVBYZERO, FE_OVERFLOW: those that a cycle raised

  /// How many cycles went so.
  std::size_t count(Outcome outcome) const { return by_outcome[static_cast<std::size_t>(outcome)]; }
};

/// Names of the columns of a replay, in their order, separated by commas.
extern const char* const kColumns;

/// Runs the god object along the path, one cycle a row, and appends a CSV row a cycle to `rows` (header first).
/// Everything but the two timing columns is a function of the input alone, to the last bit.
Summary replay(const Scene& scene, Solver solver, bool friction, const files::PosePath& path,
               const std::function<void(const std::string&)>& write_row, const std::function<void(double)>& progress);

}  // namespace godobject::replay
