#include "toolchain/report/assembly/tally.h"

#include <algorithm>

#include "toolchain/report/assembly/bounds.h"

namespace godobject::report {

void Tally::add(const Carried& carried) {
  all_.cycles += carried.cycles;
  all_.touching += carried.touching;
  all_.overflow += carried.overflow;
  all_.started_inside += carried.started_inside;
  all_.cut += carried.cut;
  all_.infeasible += carried.infeasible;
  all_.friction_not_found += carried.friction_not_found;
  all_.overlaps += carried.overlaps;
  all_.overlap = std::max(all_.overlap, carried.overlap);
}

void Tally::conclude(CaseResult& result) const {
  const auto count = [](std::int64_t number) { return static_cast<double>(number); };
  if (all_.overlaps > 0) result.findings.push_back(judged(assembly_bound::overlap(name_), all_.overlap / accuracy_));
  result.findings.push_back(judged(assembly_bound::overflow(name_), count(all_.overflow)));
  result.findings.push_back(judged(assembly_bound::started_inside(name_), count(all_.started_inside)));
  result.findings.push_back({.row = name_,
                             .what = "cycles in contact whose friction was not found",
                             .unit = "%",
                             .value = 100.0 * count(all_.friction_not_found) / std::max(1.0, count(all_.touching))});
  result.sheets.push_back(
      {.name = "assembly_cycles",
       .columns = {"pair", "cycles", "touching", "overflow", "start_inside", "cut", "infeasible", "friction_not_found",
                   "overlaps_measured", "overlap_m", "accuracy_m"},
       .rows = {{name_, std::to_string(all_.cycles), std::to_string(all_.touching), std::to_string(all_.overflow),
                 std::to_string(all_.started_inside), std::to_string(all_.cut), std::to_string(all_.infeasible),
                 std::to_string(all_.friction_not_found), std::to_string(all_.overlaps), cell(all_.overlap),
                 cell(accuracy_)}}});
}

}  // namespace godobject::report
