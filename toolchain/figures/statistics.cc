#include "toolchain/figures/statistics.h"

#include <algorithm>

#include "toolchain/statistics/samples.h"

namespace godobject::figures {
namespace {

constexpr double kUs_ns = 1e3;
constexpr double kMillisecond_ns = 1e6;

Times times(const std::vector<double>& values_ns) {
  if (values_ns.empty()) return {};
  return {.p50 = percentile(values_ns, 0.50) / kUs_ns,
          .p99 = percentile(values_ns, 0.99) / kUs_ns,
          .max = percentile(values_ns, 1.0) / kUs_ns};
}

}  // namespace

Statistics statistics(const ReplayLog& log, double band) {
  Statistics result;
  result.cycles = log.size();
  std::vector<double> step1;
  std::vector<double> solve;
  double sum = 0.0;
  const ReplayRow* previous = nullptr;
  for (const ReplayRow& row : log) {
    const double force_step = previous == nullptr ? 0.0 : (row.wrench.force - previous->wrench.force).norm();
    previous = &row;
    if (force_step > result.force_step) {
      result.force_step = force_step;
      result.force_step_at = row.t;
    }
    result.cut += row.status == "cut" ? 1u : 0u;
    result.overflow += row.status == "overflow" ? 1u : 0u;
    result.infeasible += row.status == "infeasible" ? 1u : 0u;
    if (row.step1_ns + row.solve_ns > kMillisecond_ns) ++result.over_1ms;
    if (row.contacts <= 0.0 && row.depth <= 0.0) continue;
    ++result.contact_cycles;
    step1.push_back(row.step1_ns);
    solve.push_back(row.solve_ns);
    sum += std::max(row.depth, 0.0);
    if (result.contact_cycles == 1 || row.depth > result.penetration_max) {
      result.penetration_max = row.depth;
      result.penetration_at = row.t;
    }
    result.peak_force = std::max(result.peak_force, row.wrench.force.norm());
    result.peak_contacts = std::max(result.peak_contacts, row.contacts);
  }
  if (result.contact_cycles > 0) result.penetration_mean = sum / static_cast<double>(result.contact_cycles);
  result.depth_is_bound = result.penetration_max >= (1.0 - 1e-6) * band;
  result.step1 = times(step1);
  result.solve = times(solve);
  return result;
}

}  // namespace godobject::figures
