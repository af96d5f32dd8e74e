#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace godobject {

/// Returns the nearest-rank percentile: of n sorted values the ceil(share n)-th, at least the first. `share`: 0 .. 1.
/// NaN without values. Cost: linear in the number of values.
double percentile(std::vector<double> values, double share);

/// Returns the number of values above `limit`.
std::size_t count_above(std::span<const double> values, double limit);

/// Returns the length of the longest run of values above `limit`, in samples.
std::size_t longest_above(std::span<const double> values, double limit);

}  // namespace godobject
