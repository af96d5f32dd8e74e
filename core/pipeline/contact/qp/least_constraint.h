#pragma once

#include <array>
#include <cstdint>

#include "core/pipeline/contact/qp/contact_patches.h"
#include "core/pipeline/contact/qp/contact_rows.h"
#include "core/pipeline/cycle/work.h"
#include "godobject/pose.h"

namespace godobject {

/// Coulomb and viscous friction: the coefficients at every contact, and the faces whose friction acts elsewhere.
struct ContactFriction {
  double static_ratio = 0.0;         ///< mu_s [1]
  double kinetic_ratio = 0.0;        ///< mu_k <= mu_s [1]
  double viscous_step = 0.0;         ///< mu_v / (k_D k_VC,x T) [1]: the contacts share it in proportion to their loads
  double face_thickness = 0.0;       ///< of ContactPatches::grip [m]
  ContactPatches patches = {};       ///< on which friction acts elsewhere than at the points
  Motion slid = {};                  ///< in contact, of the same cycle's earlier sub-steps, in S [m, rad]
  Vector3 beyond = Vector3::Zero();  ///< part of the wanted motion that faces of the workspace hold off, in S [m]
};

/// A contact force on the god object: multiplier normal at `point`, and -multiplier ratio slip at `grip`. A ray of the
/// friction cone of a contact point, which may have several. In S.
struct ContactForce {
  std::uint32_t id = 0;              ///< of the contact point
  Vector3 point = Vector3::Zero();   ///< [m]
  Vector3 grip = Vector3::Zero();    ///< [m]
  Vector3 normal = Vector3::Zero();  ///< unit
  Vector3 slip = Vector3::Zero();    ///< unit direction of slip that it opposes; zero: the normal alone
  double ratio = 0.0;                ///< mu [1]
  double multiplier = 0.0;           ///< >= 0, as a stretch of the coupling [m]
};

/// The result of `least_constraint`, and its warm start in the next cycle.
struct ConstrainedStep {
  Motion motion;  ///< of the god object, in S [m, rad]
  /// Active forces, at most six. Their sum is motion - wanted in the coupling's metric, without viscous friction and
  /// what the workspace's faces push; also if not converged.
  std::array<ContactForce, 6> forces;
  std::uint32_t force_count = 0;
  std::uint32_t contact_count = 0;  ///< different rows of the forces
  std::uint32_t iterations = 0;     ///< inequalities added; if infeasible, in the second attempt
  bool follows = false;             ///< no force acts: the motion is the wanted one
  bool infeasible = false;          ///< the rows had no common solution; gaps were only prevented from shrinking
  bool unconverged = false;         ///< friction after the last round is not Coulomb's to the tolerance

  ConstrainedStep() noexcept = default;
  ConstrainedStep(const ConstrainedStep&) noexcept = default;
  ~ConstrainedStep() = default;
  /// Copies only the active forces: mostly there are none.
  ConstrainedStep& operator=(const ConstrainedStep& other) noexcept {
    motion = other.motion;
    for (std::uint32_t i = 0; i < other.force_count; ++i) forces[i] = other.forces[i];
    force_count = other.force_count;
    contact_count = other.contact_count;
    iterations = other.iterations;
    follows = other.follows;
    infeasible = other.infeasible;
    unconverged = other.unconverged;
    return *this;
  }

  /// Removes all forces: the step follows the wanted motion.
  void release() noexcept {
    force_count = contact_count = iterations = 0;
    follows = true;
    infeasible = unconverged = false;
  }
};

/// The scales of the problem. The defaults are those of ContactLengths at the default coupling, m = 20 um and s = 2 mm.
struct CouplingMetric {
  double gyration = 0.158;  ///< rho = sqrt(k_VC,r / k_VC,x) [m]
  double tolerance = 2e-8;  ///< a required gain counts as met within this [m]
  double still = 2e-9;      ///< a slip below this counts as rest [m]

  /// Returns the squared length of a motion, |x|^2 + rho^2 |r|^2 [m^2].
  double squared(const Motion& motion) const noexcept {
    return motion.translation.squaredNorm() + gyration * gyration * motion.rotation.squaredNorm();
  }
};

/// Most inequalities that one attempt of `least_constraint` adds, without and with friction. The second is derived in
/// friction_solver.cc; random problems take up to 27 and some 800 (least_constraint_test).
inline constexpr int kMostAdditions = 100;
inline constexpr int kMostFrictionAdditions = 1064;

/// Computes the motion (x, r) nearest to `wanted` in the metric of the virtual coupling, |x|^2 + rho^2 |r|^2, that
/// meets all rows: Gauss' principle of least constraint. The multipliers are then the contact forces that the device
/// displays, over its stiffness.
///
/// `wanted`: the motion to the device, in S. `friction` null: none; rows of the workspace's faces never have any.
/// `last`: the last motion, in S. `step`: on entry the last cycle's result as warm start; of several rows with one id a
/// force belongs to the one whose normal is closest. `rows` is unchanged afterwards, except for the required gains of
/// infeasible rows, and for rounding with `slid`.
///
/// Without friction: a convex quadratic programme in six variables, solved by a dual active set; the row violated most
/// enters next. Rows that are infeasible together drop their required gap increase; then the zero motion is feasible.
///
/// With friction: Coulomb's law is the complementarity of the cone |t| <= mu lambda and the *shifted* velocity
/// (n . v - required gain + mu |slip|, slip) in the dual cone (de Saxce and Feng, Mathematical and Computer Modelling
/// 28, 1998). With a fixed shift mu |slip| the solution is the projection of `wanted` on the intersection of the cones
/// n . v >= required gain - shift + mu |slip|, which is convex. Each cone is the intersection of the half spaces
/// (n - mu d) . v >= required gain - shift over all directions d. Only violated half spaces are generated, so the same
/// active set solves the problem: a slipping contact has one half space, a sticking one up to three. Static friction
/// applies to a point that did not slip in the motion `last`, kinetic friction to the others and to those that begin to
/// slip. Friction opposes the slip of the whole cycle, that of `slid` and of the motion together: otherwise a later
/// sub-step, in which the body only drops by micrometres, would turn away the friction of the cycle's slip. Where that
/// problem is not solved, or its solution is farther from `wanted` than rest, `slid` does not count. The steps are:
///
/// 1. Rest. If the loaded points hardly slipped in the last motion, the cones without shifts decide whether forces can
///    hold the body at rest; then they do.
/// 2. Newton's method on Coulomb's law, from the active set. A slipping contact whose slip has its force's direction
///    in two consecutive steps is held by three half spaces; a held contact whose force leaves the cone begins to slip.
///    Between two sets of forces the first that vanishes is dropped, so that contacts leave one at a time; a violated
///    row enters.
/// 3. After a failure: rest as in step 1, also of points that slid, with kinetic friction. Then rounds of the convex
///    problem with other shifts, first none, then nearer to the slip: by half of the way, and in later rounds by
///    Aitken's relaxation. After each of the first five rounds, and then after each eighth, Newton's method starts from
///    the round's solution. At the border between sticking and slipping, where Newton's method changes back and forth,
///    the shifts converge by themselves: where they match the slips, and the forces oppose these, the motion obeys the
///    law. With viscous friction there is no rest, and only the first five rounds run.
/// 4. After these rounds: the smoothing Newton method of solve_smoothed, which is slower and fails less often.
/// 5. A motion within the tolerances comes to rest if the cones without shifts can hold the body.
/// 6. If all of that fails (`unconverged`), mostly because the law has no solution, the motion is projected on all
///    rows. They are met, and the forces are those of the cones and of these rows.
/// 7. If that motion is farther from the wanted one than rest is, which no friction explains, it is replaced by rest if
///    the cones without shifts can hold the body, and otherwise by the motion without friction, the nearest that meets
///    all rows.
///
/// Cost: at most 100 additions without and 1064 with friction (kMostAdditions, kMostFrictionAdditions), twice that if
/// infeasible; an addition is one scan of the rows and at most seven exchanges. Newton's method takes at most 744
/// steps, each a scan and a system of at most twelve equations, the smoothing method at most 150, each a system of at
/// most 21 equations. Real-time safe.
///
/// All rounds run if the law has no solution, as between points that face each other and have lost their gaps. Then a
/// call takes longest. A problem with `slid` may be solved twice.
///
/// If the budget of `work` is spent, the solver ends early: the motion may not meet all rows, and friction may be
/// `unconverged`. Friction leaves enough for the last two steps.
///
/// Time in the demo's scenes, warm-started: 20 rows 0.3 to 0.4 us without (99 %: 0.7 us), 1.1 to 2 us with friction (99
/// %: 4 us, against a handle's rim 27 us); 1100 rows 2.5 us and 7 us (99 %: 15 us and 40 us).
void least_constraint(ContactRows& rows, const Motion& wanted, const CouplingMetric& metric,
                      const ContactFriction* friction, const Motion& last, WorkMeter& work,
                      ConstrainedStep& step) noexcept;

}  // namespace godobject
