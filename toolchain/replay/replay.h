#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "core/pipeline/god_object.h"
#include "core/scene/scene.h"
#include "core/spatial/pose.h"

namespace godobject::replay {

/// One device pose a millisecond, of the moving mesh's frame in W.
struct Path {
  std::vector<double> t;           ///< [s], as written in the file
  std::vector<Pose> poses;         ///< as read: rotations not normalised, NaN and Inf possible
  std::vector<std::size_t> lines;  ///< the file's line of each
};

/// Reads `t,px,py,pz,qw,qx,qy,qz`. Throws Failure: kNoInput, or kBadData naming the line if t does not increase by 1 ms
/// within 10 %.
Path read_path(const std::filesystem::path& file);

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
  int float_exceptions = 0;  ///< of FE_INVALID, FE_DIVBYZERO, FE_OVERFLOW: those that a cycle raised

  /// How many cycles went so.
  std::size_t count(Outcome outcome) const { return by_outcome[static_cast<std::size_t>(outcome)]; }
};

/// Names of the columns of a replay, in their order, separated by commas.
extern const char* const kColumns;

/// Runs the god object along the path, one cycle a row, and appends a CSV row a cycle to `rows` (header first).
/// Everything but the two timing columns is a function of the input alone, to the last bit.
Summary replay(const Scene& scene, Solver solver, bool friction, const Path& path,
               const std::function<void(const std::string&)>& write_row, const std::function<void(double)>& progress);

}  // namespace godobject::replay
