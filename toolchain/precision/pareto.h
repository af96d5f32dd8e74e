#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace godobject::precision {

/// What a setting costs and how wrong it is; less of either is better. NaN is worse than any number.
struct Trade {
  double cost = 0.0;
  double error = 0.0;
};

/// The settings that no other one beats in one without losing in the other, ascending in cost, descending in error. Of
/// equal ones the first.
std::vector<std::size_t> pareto_front(std::span<const Trade> trades);

/// The smallest error at no more than `budget`; of equal errors the cheapest. Nothing where all cost more.
std::optional<std::size_t> best_within(std::span<const Trade> trades, double budget);

}  // namespace godobject::precision
