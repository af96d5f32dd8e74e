#pragma once

#include "core/scene/format.h"
#include "godobject/scene.h"
#include "toolchain/report/study/bound.h"

/// The judged quantities of the chapter on stability. A bound is three to five times the largest value of the whole run
/// over several seeds; theory, a count or the requirement itself gives the others.
namespace godobject::report::stability_bound {

inline const Bound kNeededDamping{"A1", "needed damping without delay against K T/2 + |B|", "%", 0.008};
inline const Bound kNeededDelayed{"A2", "needed damping with delay against the formula", "%", 1.2e-11};
inline const Bound kNeededOfSpring{"A2", "needed damping of a spring against K (T/2 + t_d)", "%", 0.025};
inline const Bound kRule{"A3", "true/rule outside the stated range", "", 0.005};
inline const Bound kTable{"A4", "table of K_crit, computed", "N/m", 1.0};
inline const Bound kAxis{"A4", "simulated boundary against the exact one, 1 DoF", "%", 0.02};
inline const Bound kWrongSide{"A4", "0.98 K grows or 1.02 K decays", "", 0.0};
inline const Bound kNoneStable{"A4", "stiffness found stable although none is", "N/m", 0.0};
inline const Bound kRandomGrow{"A4", "random loops on the stable side that grow", "", 0.0};
inline const Bound kRandomDecay{"A4", "random loops beyond the boundary that decay", "", 0.0};
inline const Bound kArm{"A4", "simulated boundary against the exact one, arm, six axes", "%", 2.0};
inline const Bound kArmWrongSide{"A4", "arm: 0.98 K grows or 1.02 K decays", "", 0.0};
inline const Bound kDampingStated{"A5", "damping limit B T/m against the stated one", "%", 2.0};
inline const Bound kDampingExact{"A5", "damping limit against the exact one", "%", 0.5};
inline const Bound kQuantised{"A6", "passive stiffness against min(2 b/T, 2 c/h)", "%", 0.04};
inline const Bound kRestless{"A6", "masses released below the limit that do not come to rest", "", 0.0};
inline const Bound kEnergyOfSpring{"A9", "energy per cycle, B = 0", "%", 0.03};
inline const Bound kEnergyDamped{"A9", "energy per cycle, with B", "%", 0.1};
inline const Bound kDelay{"A9", "delay from this energy over T/2 + t_d", "%", 0.03};
inline const Bound kLossStated{"A10", "fall of the boundary against the stated one, share of K_crit", "%", 0.6};
inline const Bound kLossExact{"A10", "fall against that of the mean delay of the held force", "%", 5.0};
inline const Bound kLossStable{"A10", "fall at up to 10 % loss: 0.85 K_crit is stable", "%", 15.0};
inline const Bound kLaw{"A11", "energy in the exact spring that the hand did not supply, over K h^2 / 2", "", 1.0};
inline const Bound kPlate{"A11", "contact over a plate: energy in the coupling that the hand did not supply", "%", 0.0};
inline const Bound kGainsInUse{"A13", "gains in use: stiffness over its boundary", "", 1.0};
inline const Bound kLeastPassive{"A13", "work on the simulated arm along the least passive motion against the rule",
                                 "%", 2.0};
inline const Bound kBus{"bus schedule", "boundary over CAN against A4 at the plan's delay", "%", 0.6};
inline const Bound kBusDelay{"bus schedule", "longest delay of the plan", "periods", 2.0};
inline const Bound kRate{"rate", "arm at 250 Hz to 4 kHz: simulated boundary against the exact one", "%", 2.0};
inline const Bound kRatePlan{"rate", "end of a cycle on the bus", "periods", 1.0};
inline const Bound kStiffer{"rate", "stiffest stable wall at 1 kHz over that at 4 kHz", "", 0.75};
inline const Bound kControlled{"passivity controller",
                               "boundary with controller below those without it and of B + b_max", "%", 0.05};
inline const Bound kControlledForce{"passivity controller",
                                    "change of the force of a passive wall over the largest force", "%", 0.06};
inline const Bound kTilt{"k_VC,r", "largest stable k_VC,r against the exact one, by the radius of gyration", "%", 0.2};
inline const Bound kPlateExact{"Z-width", "contact: stiffest stable plate, distance from the exact boundary", "%", 0.2};

/// Returns the Z-width of a solver.
Bound z_width(format::Solver solver);

/// Returns all of them.
std::vector<Bound> all();

}  // namespace godobject::report::stability_bound
