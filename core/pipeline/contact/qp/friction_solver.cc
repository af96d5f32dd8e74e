#include "core/pipeline/contact/qp/friction_solver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/pipeline/contact/qp/combined_forces.h"
#include "core/pipeline/contact/qp/contact_forces.h"
#include "core/pipeline/contact/qp/coulomb_newton.h"
#include "core/pipeline/contact/qp/meet_rows.h"
#include "core/pipeline/contact/qp/shifted_cones.h"
#include "core/pipeline/contact/qp/smoothed_coulomb.h"

namespace godobject::detail {
namespace {

// Rounds of the convex problem: Newton's method follows in each of the first ones, and seldom in the later ones, in
// which the shifts converge by themselves. Measured with `godobject-path --shake` (the demo's peg, hands 1 to 12,
// 48,012 cycles), before there was relaxation: with 120 rounds and Newton's method in each sixteenth 11 problems are
// not solved, with these numbers 3.
constexpr int kNewtonRounds = 5;
constexpr int kRounds = 200;
constexpr int kRoundsPerNewton = 8;
// Relaxation of the shifts: the first round with shorter ways, and with longer ones. Measured with `godobject-path
// --shake`: of 156,060 cycles of the tight rectangular peg 13 are not solved, 178 with half of the way in all rounds;
// of 256,064 cycles of the demo's peg 23 and 20.
constexpr int kShorterFrom = 31;
constexpr int kLongerFrom = 62;
constexpr double kFineConeTolerance = 1e-6;         // chosen: forces then oppose slips of 0.1 mm to the tolerance
constexpr std::uint32_t kMostRoundAdditions = 768;  // no further round begins after these

// additions for: rest, Newton's method and the rounds, with all of the last one; then the rows after a failure (more
// than coming to rest takes), rest again, the rows without friction
static_assert(static_cast<int>(kMostRoundAdditions) + 2 * kMostConeAdditions + kMostNewtonSteps + kMostConeAdditions +
                  2 * kMostRowAdditions ==
              kMostFrictionAdditions);

/// Returns the contact of the row; opens it with the shift of the last motion if needed.
int contact_of_row(std::uint32_t row, ContactSet& set) noexcept {
  for (int k = 0; k < set.contact_count(); ++k) {
    if (set.contact(k).row == row) return k;
  }
  const int k = set.open(row);
  set.contact(k).shift = set.slip_of(set.contact(k), set.last()).speed;
  return k;
}

/// Solves the convex problem for the half spaces again, without shifts.
void reset_shifts(ContactSet& set) noexcept {
  for (int k = 0; k < set.contact_count(); ++k) set.contact(k).shift = 0.0;
  set.resolve();
}

/// Moves the shifts towards the slips, a share of the way in each round: Aitken's relaxation (Irons and Tuck,
/// International Journal for Numerical Methods in Engineering 1, 1969). Near a solution the ways of two rounds are
/// about in proportion, by a ratio q. Then a share w / (1 - q) leads to the solution, w being the share before. Where
/// the shifts creep, each second round goes that far. Where they overshoot (q < 0), w is half of the way.
class ShiftRelaxation {
 public:
  /// Moves the shifts of the set, and solves the convex problem for its half spaces again.
  void follow(int round, ContactSet& set) noexcept {
    const Motion m = set.motion();
    std::array<Way, ContactSet::kMaxContacts> ways{};
    const int count = set.contact_count();
    for (int k = 0; k < count; ++k) {
      const Contact& c = set.contact(k);
      ways[index(k)] = {c.row, c.has_friction ? set.slip_of(c, m).speed - c.shift : 0.0};
    }
    share_ = share_of(round, std::span(ways).first(index(count)));
    for (int k = 0; k < count; ++k) {
      Contact& c = set.contact(k);
      const double way = ways[index(k)].length;
      const double most = std::max(kPlain * std::fabs(way), kMostChange * c.shift);
      c.shift = std::max(0.0, c.shift + std::clamp(share_ * way, -most, most));
    }
    last_ = ways;
    count_ = count;
    set.resolve();
  }

 private:
  static constexpr double kPlain = 0.5;        // share of the way without relaxation
  static constexpr double kLeast = 0.1;        // chosen
  static constexpr double kMost = 16.0;        // chosen, as the share at a ratio of 31/32
  static constexpr double kMostChange = 0.25;  // of a shift, by relaxation in one round
  static constexpr double kMostRatio = 1.2;    // ways that grow by more lead nowhere

  /// From a contact's shift to its slip [m].
  struct Way {
    std::uint32_t row;
    double length;
  };

  static std::size_t index(int k) noexcept { return static_cast<std::size_t>(k); }

  double share_of(int round, std::span<const Way> ways) const noexcept {
    double product = 0.0;
    double squared = 0.0;
    bool all_were_there = true;
    for (const Way& way : ways) {
      const auto* const end = last_.begin() + count_;
      const auto* const before = std::find_if(last_.begin(), end, [&](const Way& w) { return w.row == way.row; });
      all_were_there = all_were_there && before != end;
      if (before == end) continue;
      product += way.length * before->length;
      squared += before->length * before->length;
    }
    const double ratio = squared > 0.0 ? product / squared : 0.0;
    if (round >= kShorterFrom && ratio < 0.0) return std::max(kLeast, kPlain / (1.0 - ratio));
    if (round < kLongerFrom || round % 2 != 0 || !all_were_there || !(ratio > 0.0 && ratio < kMostRatio)) return kPlain;
    return ratio < 1.0 ? std::min(kMost, share_ / (1.0 - ratio)) : kMost;
  }

  std::array<Way, ContactSet::kMaxContacts> last_{};
  int count_ = 0;
  double share_{};  // of the last round
};

/// Gives contacts that slip in the set's motion kinetic friction. Tells whether none had static friction, and all
/// shifts are the slips: then the motion satisfies Coulomb's law, but for the directions of the forces.
bool begin_to_slide(ContactSet& set) noexcept {
  const Motion m = set.motion();
  const double kinetic = set.friction()->kinetic_ratio;
  bool matches = true;
  for (int k = 0; k < set.contact_count(); ++k) {
    Contact& c = set.contact(k);
    const double speed = set.slip_of(c, m).speed;
    const bool begins = speed > set.metric().still && c.ratio > kinetic;
    if (begins) c.ratio = kinetic;
    matches = matches && !begins && c.ratio * std::fabs(speed - c.shift) <= set.metric().tolerance;
  }
  return matches;
}

/// Tells whether the friction of all contacts opposes the slip, up to a slip within the tolerance: with a slip or a
/// force that differs by no more than that, it does so exactly.
bool opposes_slip(const ContactSet& set) noexcept {
  const Motion m = set.motion();
  for (int j = 0; j < set.active().size(); ++j) {
    const ActiveSet::Inequality& half_space = set.active()[j];
    const Contact& c = set.contact_of(j);
    const Slip slip = set.slip_of(c, m);
    const double smaller = std::min(slip.speed, c.ratio * half_space.multiplier);
    if (!(smaller * (slip.direction - half_space.tag.slip).norm() <= set.metric().tolerance)) return false;
  }
  return true;
}

/// Meets the cones more finely, so that the forces oppose the slip. Tells whether they do, with shifts that are the
/// slips still. Half spaces that hardly differ are exchanged without a motion: the sum of the forces may miss the
/// motion by up to a millionth of the load.
bool turns_to_slip(ContactSet& set) noexcept {
  return meet_cones(Shift::kSlip, set, kFineConeTolerance) == Additions::kMet && begin_to_slide(set) &&
         opposes_slip(set);
}

/// Solves Coulomb's law to the tolerance: steps 1 to 3 of `least_constraint`. False: the rounds did not suffice.
bool solve_friction(ContactSet& set, const ConstrainedStep& last) noexcept {
  if (crawls(set, last) && sticks(set)) return true;
  if (solve_coulomb(set)) return true;
  // viscous friction changes the metric, which only Newton's method follows
  const bool is_viscous = set.friction()->viscous_step > 0.0;
  if (!is_viscous && sticks(set)) return true;
  reset_shifts(set);
  const int rounds = is_viscous ? kNewtonRounds : kRounds;
  ShiftRelaxation relaxation;
  for (int round = 1; round <= rounds; ++round) {
    // Newton's method starts from the convex problem, whatever its result: cones with too small shifts may contradict
    // each other where the rows do not
    const bool is_met = meet_cones(Shift::kSlip, set) == Additions::kMet;
    const bool matches = !is_viscous && begin_to_slide(set) && is_met;
    if ((round <= kNewtonRounds || round % kRoundsPerNewton == 0) && solve_coulomb(set)) return true;
    if (matches && (opposes_slip(set) || turns_to_slip(set))) return true;
    relaxation.follow(round, set);
    set.work().add(Work::kExchange, static_cast<std::uint32_t>(set.active().size()));
    if (set.additions() > kMostRoundAdditions || set.work().is_spent()) return false;
  }
  return false;
}

/// Sets work aside for the rows after a failure.
class SetAside {
 public:
  explicit SetAside(const ContactSet& set) noexcept : work_(set.work()), before_(work_.aside()) {
    constexpr std::uint64_t kAdditions = 16;  // mostly 3 to 8
    const std::uint64_t addition = cost_of(Work::kScan) * set.rows().count + cost_of(Work::kExchange);
    work_.set_aside(before_ + kAdditions * addition);
  }
  SetAside(const SetAside&) = delete;
  SetAside& operator=(const SetAside&) = delete;
  ~SetAside() { release(); }

  void release() const noexcept { work_.set_aside(before_); }

 private:
  WorkMeter& work_;
  std::uint64_t before_;
};

/// Ends with the set's motion, which satisfies Coulomb's law.
void conclude(ContactSet& set, ConstrainedStep& step) noexcept {
  take_forces(set, step);
  step.follows = step.force_count == 0;
  step.unconverged = false;
  step.motion = rests(set) ? Motion{} : set.motion();
  set.close_all();
}

/// Solves Coulomb's law by the smoothing method and concludes. A motion within the tolerance comes to rest, if forces
/// inside the cones can hold the body. False: it was not solved.
bool conclude_smoothed(ContactSet& set, ConstrainedStep& step) noexcept {
  const ContactSet::Saved found = set.save();
  const CouplingSpace space = set.space();
  if (!solve_smoothed(set, step)) return false;
  if (set.metric().squared(step.motion) > set.metric().tolerance * set.metric().tolerance) return true;
  set.set_space(space);
  set.restore(found);
  if (sticks(set) && rests(set)) {
    conclude(set, step);
  } else {
    set.close_all();
  }
  return true;
}

/// Ends with the nearest motion that meets all rows, since Coulomb's law was not solved. False: infeasible.
bool conclude_with_rows(ContactSet& set, ConstrainedStep& step) noexcept {
  take_forces(set, step);
  step.follows = false;
  step.unconverged = true;
  set.restart_from_motion();
  const bool feasible = meet_rows(set) != Additions::kContradictory;
  add_forces(set, step);
  step.motion = set.motion();
  return feasible;
}

/// Ends with the motion without friction, after conclude_with_rows. False: infeasible.
bool conclude_without_friction(ContactSet& set, ConstrainedStep& step) noexcept {
  set.restart();
  const bool feasible = meet_rows(set) != Additions::kContradictory;
  take_forces(set, step);
  step.motion = set.motion();
  return feasible;
}

/// Tells whether the current motion is farther from the wanted one than rest is, by more than lost gaps require. In the
/// metric without viscous friction.
bool leads_away(const ContactSet& set) noexcept {
  const Vector6 wanted = set.target();
  Vector6 followed = wanted;  // without what faces of the workspace hold off
  followed.head<3>() -= set.friction()->beyond;
  const double farther = (set.plain_motion() - wanted).squaredNorm() - wanted.squaredNorm();
  return farther > kMostByGaps * followed.squaredNorm();
}

}  // namespace

void guess_cone(std::uint32_t row, const ContactForce& force, ContactSet& set) noexcept {
  const int k = contact_of_row(row, set);
  const Vector3& normal = set.contact(k).normal;
  const Vector3 slip = force.slip - normal.dot(force.slip) * normal;
  const double length = slip.norm();
  set.active().guess(set.cone_half_space(k, length > 0.5 ? Vector3(slip / length) : Vector3::Zero()));
}

bool solve_with_friction(ContactSet& set, ConstrainedStep& step) noexcept {
  const SetAside for_rows(set);
  if (solve_friction(set, step)) {
    come_to_rest(set);
    conclude(set, step);
    return true;
  }
  if (conclude_smoothed(set, step)) return true;
  for_rows.release();
  const ContactSet::Saved found = set.save();
  const bool feasible = conclude_with_rows(set, step);
  // without a force there is nothing that the motion could differ for
  if (!feasible || (step.force_count > 0 && !leads_away(set))) return feasible;
  // Shifts that differ from the slip allow forces of any size. Without shifts the cones may hold the body at rest. If
  // they do not, the motion without friction is the nearest one that meets all rows.
  set.restore(found);
  if (!sticks(set)) return conclude_without_friction(set, step);
  conclude(set, step);
  return true;
}

}  // namespace godobject::detail
