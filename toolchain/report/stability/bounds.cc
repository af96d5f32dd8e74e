#include "toolchain/report/stability/bounds.h"

#include <fmt/format.h>

namespace godobject::report::stability_bound {

Bound z_width(format::Solver solver) {
  const double most = solver == format::Solver::kContact ? 0.2 : 2.0;
  return {"Z-width",
          fmt::format("{}: stiffest stable plate below the exact boundary",
                      format::kSolverNames[static_cast<std::size_t>(solver)]),
          "%", most};
}

std::vector<Bound> all() {
  std::vector<Bound> bounds{kNeededDamping,
                            kNeededDelayed,
                            kNeededOfSpring,
                            kRule,
                            kTable,
                            kAxis,
                            kWrongSide,
                            kNoneStable,
                            kRandomGrow,
                            kRandomDecay,
                            kArm,
                            kArmWrongSide,
                            kDampingStated,
                            kDampingExact,
                            kQuantised,
                            kRestless,
                            kEnergyOfSpring,
                            kEnergyDamped,
                            kDelay,
                            kLossStated,
                            kLossExact,
                            kLossStable,
                            kLaw,
                            kPlate,
                            kGainsInUse,
                            kRate,
                            kRatePlan,
                            kStiffer,
                            kLeastPassive,
                            kBus,
                            kBusDelay,
                            kControlled,
                            kControlledForce,
                            kTilt,
                            kPlateExact};
  for (std::uint32_t s = 0; s < format::kSolverCount; ++s) bounds.push_back(z_width(static_cast<format::Solver>(s)));
  return bounds;
}

}  // namespace godobject::report::stability_bound
