#include "toolchain/precision/pareto.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace godobject::precision {
namespace {

double or_infinity(double value) { return std::isnan(value) ? std::numeric_limits<double>::infinity() : value; }

}  // namespace

std::vector<std::size_t> pareto_front(std::span<const Trade> trades) {
  std::vector<std::size_t> by_cost;
  for (std::size_t i = 0; i < trades.size(); ++i) {
    if (!std::isnan(trades[i].cost) && !std::isnan(trades[i].error)) by_cost.push_back(i);
  }
  std::stable_sort(by_cost.begin(), by_cost.end(), [&](std::size_t a, std::size_t b) {
    return trades[a].cost < trades[b].cost || (trades[a].cost == trades[b].cost && trades[a].error < trades[b].error);
  });
  std::vector<std::size_t> front;
  for (const std::size_t i : by_cost) {
    if (front.empty() || trades[i].error < trades[front.back()].error) front.push_back(i);
  }
  return front;
}

std::optional<std::size_t> best_within(std::span<const Trade> trades, double budget) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < trades.size(); ++i) {
    if (!(trades[i].cost <= budget)) continue;
    const double error = or_infinity(trades[i].error);
    const double least = best ? or_infinity(trades[*best].error) : error;
    if (!best || error < least || (error == least && trades[i].cost < trades[*best].cost)) best = i;
  }
  return best;
}

}  // namespace godobject::precision
