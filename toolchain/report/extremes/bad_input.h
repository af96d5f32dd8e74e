#pragma once

#include <cstdint>
#include <filesystem>

#include "toolchain/report/extremes/extremes_fault.h"
#include "toolchain/report/study/case.h"

namespace godobject::report {

/// Runs all solvers with and without friction in contact. An invalid input follows each valid one: NaN, infinity and
/// numbers beyond the largest coordinate in a pose, rotations that are not of unit length, NaN and infinity in a
/// velocity. `cycles`: total number of invalid inputs. The solver must refuse them without force, and go on as if they
/// had not been.
CaseResult bad_input(std::int64_t cycles, const ExtremesFault& fault, const std::filesystem::path& work);

}  // namespace godobject::report
