#include <algorithm>
#include <cmath>

#include "toolchain/report/assembly/backlash.h"
#include "toolchain/report/assembly/bounds.h"
#include "toolchain/report/assembly/carried_part.h"
#include "toolchain/report/assembly/cases.h"
#include "toolchain/report/assembly/tally.h"

namespace godobject::report {

CaseResult gear_case(const std::string& name, const Pair& pair, const GearPlace& place, const AssemblyEffort& effort) {
  constexpr double kTurn = 0.12;  // beyond the stops [rad]
  constexpr int kRamp = 240;
  constexpr int kRest = 30;
  constexpr int kOverlapEvery = 30;
  const Backlash exact = exact_backlash(level_section(pair.moving, place.section_z - place.start_z),
                                        level_section(pair.still, place.section_z));
  Tally tally(name, pair);
  double off = 0.0;
  Sheet sheet{.name = "assembly_gear", .columns = {"pair", "direction", "exact_rad", "measured_rad"}, .rows = {}};
  Pose start;
  start.translation.z() = place.start_z;
  for (const double direction : {1.0, -1.0}) {
    CarriedPart part(pair, place.friction, effort.fault);
    part.watch_overlap(kOverlapEvery);
    part.start(start);
    Pose device = start;
    for (int i = 1; i <= kRamp + kRest; ++i) {
      device.rotation = exp_rotation({0.0, 0.0, direction * kTurn * std::min(1.0, static_cast<double>(i) / kRamp)});
      part.follow(device);
    }
    const double angle = direction * log_rotation(part.pose().rotation).z();
    const double expected = direction > 0.0 ? exact.forward : exact.backward;
    off = std::max(off, std::abs(angle - expected) * place.radius / pair.accuracy);
    sheet.rows.push_back({name, cell(direction), cell(expected), cell(angle)});
    tally.add(part.carried());
  }
  CaseResult result;
  result.findings = {judged(assembly_bound::backlash(name), off)};
  result.sheets = {sheet};
  tally.conclude(result);
  return result;
}

}  // namespace godobject::report
