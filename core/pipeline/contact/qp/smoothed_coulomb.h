#pragma once

#include "core/pipeline/contact/qp/contact_set.h"
#include "core/pipeline/contact/qp/least_constraint.h"

namespace godobject::detail {

/// Solves Coulomb's law by a smoothing Newton method. It finds solutions that solve_coulomb misses, mostly of wedged
/// bodies: their contacts press against each other with far more than the load. True: `step` has the motion and its
/// forces, and the set has no contacts. False: the set is unchanged, with its metric.
///
/// With x = (mu lambda, force across the normal) and y = ((n . v - required gain) / mu + |slip|, slip) the law says of
/// each contact: x and y lie in the cone w_0 >= |w_t|, and x . y = 0 (de Saxce and Feng, Mathematical and Computer
/// Modelling 28, 1998). That is x = P(x - c y), where P projects on the cone and c > 0 is any number. P is replaced by
/// a smooth function that differs from it by at most the smoothing (Fukushima, Luo and Tseng, SIAM Journal on
/// Optimization 12, 2002). Newton's method with a line search follows the solution while the smoothing goes to zero.
/// Then the row that the motion violates most becomes a contact, and so on until all rows are met. A contact with
/// static friction that slips gets kinetic friction. Viscous friction is part of the metric, as in solve_coulomb.
///
/// Results obey the law to the tolerance, whatever the residuals are: with little friction those tell little.
///
/// Cost: at most kMostSmoothedSteps steps of seven contacts, or more steps of fewer contacts in the same time. A step
/// of seven contacts solves 21 equations (6 us) and evaluates the residuals up to eight times. Besides, at most 120
/// scans of the rows. Mostly 10 to 40 steps of 9 to 15 equations. All steps run where the law has no solution.
/// Real-time safe.
inline constexpr int kMostSmoothedSteps = 150;
bool solve_smoothed(ContactSet& set, ConstrainedStep& step) noexcept;

}  // namespace godobject::detail
