#pragma once

#include <cstdint>
#include <filesystem>

#include "toolchain/report/extremes/extremes_fault.h"
#include "toolchain/report/study/case.h"

namespace godobject::report {

/// Extent of a row, and the fault that a test plants in it.
struct RowRequest {
  bool quick = false;
  std::uint32_t seed = 0;  ///< of random setups
  ExtremesFault fault = {};
  bool one_place = false;  ///< for tests: one of several meshes or places
};

/// Compiles meshes with degenerate, duplicate or flipped triangles, and an open box. Checks the reports, and 10^8
/// look-ups in total.
CaseResult bad_meshes(const RowRequest& request, const std::filesystem::path& work);

/// Compiles two blocks with a gap of half to four voxels between them. The compiler must refuse or report the gap if
/// the field loses it.
CaseResult gap_near_the_voxel(const RowRequest& request, const std::filesystem::path& work);

/// Runs the same motion in scenes from 1e-3 to 1e3 m and far from the origin; relative to the voxel the result must be
/// the same.
CaseResult same_at_every_scale(const RowRequest& request);

/// Runs a body that rotates in contact for a long time; its motion repeats every second (1000 cycles).
CaseResult long_run(std::int64_t cycles, const RowRequest& request);

/// Integrates the work along a closed path without friction by the trapezoidal rule, and compares a replay bit by bit.
CaseResult closed_path(const RowRequest& request);

}  // namespace godobject::report
