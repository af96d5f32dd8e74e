#pragma once

#include <array>
#include <cstdint>

#include "core/pipeline/contact/qp/contact_rows.h"
#include "godobject/pose.h"

namespace godobject {

/// Coulomb and viscous friction at every contact.
struct ContactFriction {
  double static_ratio = 0.0;   ///< mu_s
  double kinetic_ratio = 0.0;  ///< mu_k <= mu_s
  double viscous_step = 0.0;   ///< mu_v / (k_D k_VC,x T): shared by the contacts as they share the load [1]
};

/// One of the forces that hold the god object back, multiplier (normal - ratio slip) at `point`: a ray of the friction
/// cone of a contact point, which may have several. In S.
struct ContactForce {
  std::uint32_t id = 0;              ///< of the contact point
  Vector3 point = Vector3::Zero();   ///< [m]
  Vector3 normal = Vector3::Zero();  ///< unit
  Vector3 slip = Vector3::Zero();    ///< unit direction of slip that it resists; zero: the normal alone
  double ratio = 0.0;                ///< mu
  double multiplier = 0.0;           ///< >= 0, in units of the coupling's stretch [m]
};

/// What `least_constraint` finds; also what it starts from in the next cycle.
struct ConstrainedStep {
  Motion motion;  ///< of the god object, in S
  /// Active, at most six: motion - wanted is their sum in the coupling's metric, viscous friction aside; converged or
  /// not.
  std::array<ContactForce, 6> forces;
  std::uint32_t force_count = 0;
  std::uint32_t contact_count = 0;  ///< different rows among them
  std::uint32_t iterations = 0;     ///< inequalities added; where infeasible, by the second attempt
  bool follows = false;             ///< nothing holds it: the motion is the wanted one
  bool infeasible = false;          ///< not all needs could be met; gaps were only kept from shrinking
  bool unconverged = false;         ///< friction after the last round is not Coulomb's to the tolerance

  ConstrainedStep() noexcept = default;
  ConstrainedStep(const ConstrainedStep&) noexcept = default;
  ~ConstrainedStep() = default;
  /// Of the forces only those that are there: mostly none.
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

  /// Nothing holds it.
  void release() noexcept {
    force_count = contact_count = iterations = 0;
    follows = true;
    infeasible = unconverged = false;
  }
};

/// Scales of the problem.
struct CouplingMetric {
  double gyration = 0.158;  ///< rho = sqrt(k_VC,r / k_VC,x) [m]
  double tolerance = 2e-8;  ///< a need met up to this is met [m]
  double still = 2e-9;      ///< slip below this is rest [m]
};

/// Most inequalities that one attempt of `least_constraint` adds, without and with friction.
inline constexpr int kMostAdditions = 100;
inline constexpr int kMostFrictionAdditions = 512;

/// The motion (x, r) nearest to `wanted` in the metric of the virtual coupling, |x|^2 + rho^2 |r|^2, that meets all
/// rows (Gauss' principle of least constraint; the multipliers are then the contact forces that the device displays,
/// over its stiffness).
///
/// Without friction: a convex quadratic programme in six variables, solved by a dual active set; the row that is
/// violated most enters next. Rows that nobody can meet together lose what they need to gain: then no motion at all
/// is a solution.
///
/// With friction (`friction` not null): Coulomb's law is the complementarity of the cone |t| <= mu lambda and the
/// *shifted* velocity (n . v - need + mu |slip|, slip) in the dual cone (de Saxce and Feng, Mathematical and Computer
/// Modelling 28, 1998). With the shift mu |slip| held fixed this is the projection of `wanted` on the intersection of
/// the cones n . v >= need - shift + mu |slip|, again convex; each cone is the intersection of the half spaces
/// (n - mu d) . v >= need - shift over all directions d, and only those that are violated are ever made, so it runs
/// through the same active set: a contact that slips has one such half space, one that sticks has up to three. Static
/// friction holds for a point that did not slip in the motion `last`, kinetic friction for the others and for those
/// that begin to slip now. In this order:
///
/// 1. Rest. If what carried the load slipped by next to nothing, the cones without shifts say whether forces can hold
///    it where it is; if so they do.
/// 2. Newton's method on Coulomb's law itself, from the active set. A slipping contact whose slip goes with its force
///    twice in a row is held by three half spaces; a held one whose force leaves the cone is released to slip. On the
///    way from one set of forces to the next the first that vanishes is dropped, so that contacts leave one at a time;
///    a row that is violated enters.
/// 3. Where that fails: the convex problem with other shifts, first none, then halfway towards the slip, and Newton's
///    method from its solution; five rounds. With the shifts held the convex problem alone would converge to the law by
///    mu^2 / (1 + mu^2) a round.
/// 4. A motion that the tolerances may explain comes to rest if the cones without shifts can hold it.
/// 5. If the rounds do not suffice (`unconverged`), the normals have the last word: all rows are met, and the
///    forces are those of the cones and of these rows together.
/// 6. If that has led farther from the wanted motion than rest is, as no friction does, the cones without shifts, if
/// they
///    hold it at rest, and otherwise the motion without friction: no other that meets all rows is nearer.
///
/// Bounded: at most 100 additions without and 512 with friction (kMostAdditions, kMostFrictionAdditions), twice that
/// where infeasible (seen in random problems: up to 27 and 196); an addition is one scan of the rows and at most
/// seven exchanges. Newton's method takes at most 144 steps, each a scan and a system of at most twelve equations. No
/// allocation. `rows.required_gain` is restored but for infeasible rows. `step` holds the last cycle's result as the warm start;
/// of several rows with its id a force goes to the one whose normal fits best.
///
/// Time in the recorded scenes, warm: 20 rows 0.3 to 0.4 us without (99 %: 0.7 us), 1.1 to 2 us with friction (99 %: 4
/// us, against a handle's rim 27 us); 1100 rows 2.5 us and 7 us (99 %: 15 us and 40 us).
void least_constraint(ContactRows& rows, const Motion& wanted, const CouplingMetric& metric,
                      const ContactFriction* friction, const Motion& last, ConstrainedStep& step) noexcept;

}  // namespace godobject
