#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace godobject::precision {

/// Cost and error of a setting. Less is better. NaN is worse than any number.
struct Trade {
  double cost = 0.0;
  double error = 0.0;
};

/// Returns the settings that no other one beats in cost or error without losing in the other, ascending in cost,
/// descending in error; the first of equal ones.
std::vector<std::size_t> pareto_front(std::span<const Trade> trades);

/// Returns the setting with the smallest error at a cost of at most `budget`; the cheapest of equal errors. Nothing if
/// all cost more.
std::optional<std::size_t> best_within(std::span<const Trade> trades, double budget);

}  // namespace godobject::precision
