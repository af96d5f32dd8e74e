#pragma once

#include <cstdint>
#include <filesystem>

#include "toolchain/report/study/case.h"

namespace godobject::report {

/// Degenerate, duplicate, flipped triangles and an open box, compiled: what is culled, and 10^8 look-ups in all.
CaseResult bad_meshes(bool quick, const std::filesystem::path& work);

/// Two blocks with a gap of half to four voxels between them: refused or flagged where the field loses it.
CaseResult gap_near_the_voxel(bool quick, const std::filesystem::path& work);

/// The same run in scenes from 1e-3 to 1e3 m, and far from the origin: relative to the voxel the same.
CaseResult same_at_every_scale(bool quick);

/// A body that turns in contact for long, and comes back every second (1000 cycles).
CaseResult long_run(std::int64_t cycles);

/// Around a closed path without friction, by the trapezoidal rule; and a replay, to the bit.
CaseResult closed_path(bool quick);

}  // namespace godobject::report
