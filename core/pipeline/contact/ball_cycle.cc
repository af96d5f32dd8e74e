#include "core/pipeline/contact/ball_cycle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "core/pipeline/contact/certificate.h"
#include "core/pipeline/contact/contact_limits.h"
#include "core/pipeline/contact/contact_result.h"
#include "core/pipeline/contact/damping.h"
#include "core/pipeline/contact/motion_share.h"
#include "core/pipeline/contact/qp/dual_active_set.h"
#include "core/pipeline/contact/second_look.h"
#include "core/pipeline/cycle/commit.h"
#include "core/pipeline/cycle/step_times.h"
#include "core/pipeline/cycle/workspace_limit.h"

namespace godobject {
namespace {

using detail::MotionShare;
using detail::Obstacle;

/// Half spaces normal . x >= gain for a motion x of the centre, in W.
struct HalfSpaces {
  static constexpr int kContacts = 1 + kMostSecondLooks;  ///< the contact at the start and the obstacles
  static constexpr int kCapacity = kContacts + 6;         ///< and the faces of the workspace
  std::array<Vector3, kCapacity> normal;                  ///< unit
  std::array<double, kCapacity> gain;                     ///< required gap increase [m]
  int count{};

  void push(const Vector3& n, double b) noexcept {
    normal[static_cast<std::size_t>(count)] = n;
    gain[static_cast<std::size_t>(count++)] = b;
  }
};

/// The active half spaces of a projection.
struct Held {
  std::array<Vector3, 3> normal;     ///< unit, in W
  std::array<double, 3> multiplier;  ///< >= 0 [m]
  std::array<int, 3> space;          ///< number of the half space
  int count{};
};

/// Projects `target` on the half spaces, to `tolerance` [m]. False: they have no common point, and `nearest` meets only
/// some of them.
bool project(const HalfSpaces& spaces, const Vector3& target, double tolerance, Vector3& nearest, Held& held) noexcept {
  held.count = 0;
  nearest = target;
  if (spaces.count == 1) {
    const double missing = spaces.gain[0] - spaces.normal[0].dot(target);
    if (!(missing > tolerance)) return true;
    nearest += missing * spaces.normal[0];
    held.normal[0] = spaces.normal[0];
    held.multiplier[0] = missing;
    held.space[0] = 0;
    held.count = 1;
    return true;
  }
  DualActiveSet<int> set;
  Vector6 wide = Vector6::Zero();
  wide.head<3>() = target;
  set.start(wide);
  bool feasible = true;
  // chosen: random polyhedra of 200 half spaces in six dimensions take fewer than four additions each
  // (dual_active_set_test)
  for (int round = 0; round < 4 * HalfSpaces::kCapacity && feasible; ++round) {
    DualActiveSet<int>::Inequality worst;
    double violation = tolerance;
    for (int i = 0; i < spaces.count; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const double missing = spaces.gain[k] - spaces.normal[k].dot(set.z().head<3>());
      if (!(missing > violation)) continue;
      violation = missing;
      worst.gradient.head<3>() = spaces.normal[k];
      worst.rhs = spaces.gain[k];
      worst.tag = i;
    }
    if (!(violation > tolerance)) break;
    feasible = set.add(worst);
  }
  nearest = set.z().head<3>();
  held.count = std::min(set.size(), 3);
  for (int i = 0; i < held.count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    held.normal[k] = set[i].gradient.head<3>();
    held.multiplier[k] = set[i].multiplier;
    held.space[k] = set[i].tag;
  }
  return feasible;
}

/// Returns the change of the contact force by the damping b_D along the active normals, over the stiffness [m].
Vector3 damped(const Held& held, const Vector3& velocity_W, double damping_over_stiffness) noexcept {
  std::array<Vector6, 3> rows;
  Vector6 load = Vector6::Zero();
  Vector6 damping = Vector6::Zero();
  damping.head<3>() = damping_over_stiffness * velocity_W;
  for (std::size_t i = 0; i < static_cast<std::size_t>(held.count); ++i) {
    rows[i] << held.normal[i], Vector3::Zero();
    load += held.multiplier[i] * rows[i];
  }
  return detail::damping_change(rows.data(), static_cast<std::uint32_t>(held.count), load, damping).head<3>();
}

/// The centre of the ball in one cycle.
class Center {
 public:
  /// `beyond`: from the goal of all functions to the device's own position; zero within the box [m].
  Center(const Voxelmap& field, const WorkspaceBox& box, const ContactLengths& lengths, const Vector3& at,
         const Vector3& beyond, WorkMeter& work) noexcept
      : field_(field), box_(box), lengths_(lengths), at_(at), beyond_(beyond), work_(work) {
    search_radius_ = std::min(lengths_.longest_search_radius, field.assured_clearance());
  }

  const Vector3& at() const noexcept { return at_; }
  /// Looks up the field at the centre, for the other functions.
  const FieldSample& look() noexcept {
    work_.add(Work::kBall);
    return here_ = field_.sample(at_);
  }
  bool is_out_of_work() const noexcept { return work_.is_spent(); }

  /// Tells whether the clearance covers the motion to `goal`.
  bool is_free(const Vector3& goal) const noexcept { return (goal - at_).norm() + lengths_.margin <= here_.clearance; }
  bool is_near() const noexcept { return here_.clearance < search_radius_; }

  /// Moves the centre to `goal` without a test.
  void go(const Vector3& goal) noexcept {
    at_ = goal;
    held.count = 0;
    cut = outdated = is_provisional = false;
  }

  /// Runs one sub-step towards `goal`. False: no attempt was certified, and the centre stays.
  bool step(const Vector3& goal) noexcept;

  Held held;
  bool cut{};               ///< the motion was shortened so as not to jump over the surface
  bool outdated{};          ///< came nearer, but the half spaces do not hold there: past an edge, or the surface turned
  bool is_provisional{};    ///< another motion may follow at once, as in ContactSubsteps
  bool infeasible = false;  ///< the half spaces had no common point
  bool lacks_work = false;  ///< the budget of work has shortened or ended the motion

 private:
  void push_contact() noexcept;
  bool leads_far_away(const Vector3& aim) const noexcept;
  void constrain(const Vector3& aim) noexcept;
  bool certify(const Vector3& end, double least_gap) noexcept;
  bool push_obstacle(const Vector3& end) noexcept;
  double overshoot(const Vector3& motion) noexcept;
  bool look_again(const Vector3& end, const Vector3& aim, MotionShare& share) noexcept;
  bool has_work(MotionShare& share) noexcept;

  const Voxelmap& field_;
  const WorkspaceBox& box_;
  const ContactLengths& lengths_;
  Vector3 at_;
  const Vector3 beyond_;
  double search_radius_;
  FieldSample here_, there_;
  Vector3 motion_ = Vector3::Zero();
  HalfSpaces spaces_;
  Obstacle obstacle_;
  WorkMeter& work_;
  detail::Budget budget_{work_};
  int last_looks_ = 0;                // attempts since the budget was spent
  bool is_proven_{};                  // the chords of the rest of this sub-step's attempts are parts of `proven_`
  Vector3 proven_ = Vector3::Zero();  // part of the last chord that was not proved to its end [m]
};

/// Adds the half space of the contact at the start of the sub-step. Where the field has no gradient there is none: deep
/// inside, the centre follows the device.
void Center::push_contact() noexcept {
  spaces_.count = 0;
  const double steepness = here_.gradient.norm();
  if (!is_near() || !here_.known || !(steepness > kFlat)) return;
  const double lost = (lengths_.margin - here_.distance) / steepness;
  spaces_.push(here_.gradient / steepness, lengths_.gap_law().required_gain(lost));
}

/// Tells whether the motion ends farther from `aim` than rest, by much more than any gap has to grow (kMostLever).
/// Faces of the workspace hold off `beyond_`, beside which a sideways motion would hardly count.
bool Center::leads_far_away(const Vector3& aim) const noexcept {
  double most = lengths_.metric.tolerance;
  for (int i = 0; i < spaces_.count; ++i) most = std::max(most, spaces_.gain[static_cast<std::size_t>(i)]);
  const double farther = (motion_ - aim).squaredNorm() - aim.squaredNorm();
  const double rest = (aim - beyond_).norm();
  return farther > 0.0 && std::sqrt(rest * rest + farther) > rest + kMostLever * most;
}

/// Computes the motion nearest to `aim` that all half spaces and the workspace allow. Half spaces that contradict each
/// other drop their required gap increase.
void Center::constrain(const Vector3& aim) noexcept {
  const auto solve = [&]() noexcept {
    if (project(spaces_, aim, lengths_.metric.tolerance, motion_, held) && !leads_far_away(aim)) return;
    infeasible = true;
    for (double& gain : std::span(spaces_.gain).first(static_cast<std::size_t>(spaces_.count))) {
      gain = std::min(gain, 0.0);
    }
    project(spaces_, aim, lengths_.metric.tolerance, motion_, held);
  };
  const bool is_outside = !beyond_.isZero(0.0);
  if (!is_outside) solve();
  if (!is_outside && (!box_.limited || box_.contains(at_ + motion_))) return;
  const int contacts = spaces_.count;
  push_faces(box_, {Quaternion::Identity(), at_},
             [&](const Vector3& normal, double gain) noexcept { spaces_.push(normal, gain); });
  solve();
  spaces_.count = contacts;
  int kept = 0;  // the faces are no contacts
  for (int i = 0; i < held.count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (held.space[k] >= contacts) continue;
    const auto to = static_cast<std::size_t>(kept++);
    held.normal[to] = held.normal[k];
    held.multiplier[to] = held.multiplier[k];
  }
  held.count = kept;
}

/// Tells whether the chord to `end` meets no surface and the gap does not shrink below `least_gap`.
bool Center::certify(const Vector3& end, double least_gap) noexcept {
  obstacle_.exhausted = false;
  work_.add(Work::kAttempt);
  there_ = field_.sample(end);
  const auto keeps_gap = [&]() noexcept {
    obstacle_.share = 1.0;
    obstacle_.sample = there_;
    return there_.distance > 0.0 && there_.distance + lengths_.rounding >= std::min(here_.distance, least_gap);
  };
  if (is_proven_) return keeps_gap();
  if (here_.distance <= 0.0 || (end - at_).norm() + least_gap <= here_.clearance) return true;
  const bool is_free = detail::chord_is_free(field_, at_, here_.clearance, end, there_.clearance, budget_, obstacle_);
  if (obstacle_.exhausted) proven_ = obstacle_.share * (end - at_);
  return is_free && keeps_gap();
}

/// Adds the half space of the second look. False: there is no room, or the field has no gradient at the obstacle.
bool Center::push_obstacle(const Vector3& end) noexcept {
  const FieldSample& seen = obstacle_.sample;
  const double steepness = seen.gradient.norm();
  if (spaces_.count == HalfSpaces::kContacts || !seen.known || !(steepness > kFlat)) return false;
  const Vector3 displacement = obstacle_.share * (end - at_);
  spaces_.push(seen.gradient / steepness,
               detail::second_look_gain(lengths_, seen, displacement, here_.distance, steepness, 0.0));
  return true;
}

/// Returns the overshoot of the whole motion of a held ball as ContactSubsteps does, and sets `outdated`.
double Center::overshoot(const Vector3& motion) noexcept {
  const double steepness = there_.gradient.norm();
  outdated = there_.distance > lengths_.margin + lengths_.opening;
  if (!(steepness > kFlat)) return 0.0;
  double turn = std::numeric_limits<double>::infinity();  // from the nearest normal, as `least_turn`
  double rise = 0.0;
  double lost = 0.0;
  for (int i = 0; i < held.count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    turn = std::min(turn, (there_.gradient / steepness - held.normal[k]).norm());
    rise -= held.multiplier[k] * (there_.gradient / steepness - held.normal[k]).dot(motion);
    const double increase = steepness * held.normal[k].dot(motion);
    const double expected = detail::expected_distance(lengths_, here_.distance, increase);
    lost += 2.0 * held.multiplier[k] * (expected - there_.distance) / steepness;
  }
  outdated |= turn > kMostTurn;
  const double square = motion.squaredNorm();
  return rise > kMostOvershoot * square ? lost / square : 0.0;
}

/// Solves again with the half space of the obstacle. False: there is none, it changes nothing, or no second look is
/// left.
bool Center::look_again(const Vector3& end, const Vector3& aim, MotionShare& share) noexcept {
  if (share.looks_left() == 0 || !push_obstacle(end)) return false;
  const Vector3 tried = motion_;
  constrain(aim);
  if (!((motion_ - tried).norm() > lengths_.metric.tolerance)) return false;
  is_proven_ = false;
  share.look_again(1.0);
  return true;
}

/// Tells whether another attempt may follow. Once the budget is spent some more do, which look up little: the motion is
/// then the part of the last chord that is proved free, or a quarter of the motion if no chord is. Else the next cycle
/// would begin at the same place and spend its budget on the same motion again.
bool Center::has_work(MotionShare& share) noexcept {
  constexpr int kMostLastLooks = 5;  // chosen: a second look, and a proven chord that is halved twice
  constexpr double kWithin = 0.999;  // of a proven chord, because of rounding
  if (!work_.is_spent()) return true;
  lacks_work = true;
  if (last_looks_++ == kMostLastLooks) return false;
  if (obstacle_.exhausted) {
    is_proven_ = true;
    motion_ = proven_;
    share.restart(kWithin);
  } else if (!is_proven_) {
    share.limit_to(0.25 * share.value());
  }
  return true;
}

bool Center::step(const Vector3& goal) noexcept {
  const Vector3 aim = goal + beyond_ - at_;
  push_contact();
  held.count = 0;
  motion_ = goal - at_;
  if (spaces_.count > 0) constrain(aim);
  outdated = false;
  MotionShare share(1.0);
  obstacle_.exhausted = is_proven_ = false;
  while (share.next() && has_work(share)) {
    const Vector3 motion = share.value() * motion_;
    const bool follows = share.is_whole() && held.count == 0;
    const Vector3 end = follows ? goal : box_.nearest(at_ + motion);
    if (certify(end, share.least_gap(lengths_))) {
      if (share.is_whole() && share.has_next() && held.count > 0 && motion.norm() > lengths_.metric.tolerance) {
        if (const double over = overshoot(motion); over > kMostOvershoot) {
          outdated = false;
          obstacle_.share = 1.0;
          obstacle_.sample = there_;
          if (!look_again(end, aim, share)) share.stop_at(1.0 / (1.0 + over));
          continue;
        }
      }
      at_ = end;
      cut = share.is_cut();
      const bool is_nearer = (motion_ - aim).squaredNorm() < aim.squaredNorm();
      outdated = outdated && is_nearer;
      is_provisional =
          (share.looks_left() < kMostSecondLooks || share.is_stopped()) && is_nearer && motion.norm() > lengths_.margin;
      return true;
    }
    if (obstacle_.exhausted) {
      share.shrink_to(obstacle_.share);
    } else if (!look_again(end, aim, share)) {
      share.shrink_at_obstacle();
    }
  }
  return cut = true, false;
}

/// The result of the sub-steps of one cycle, as ContactResult.
struct BallResult {
  bool inside;
  double smallest = std::numeric_limits<double>::infinity();  ///< stored distance at the last sub-step's start [m]
  std::uint32_t substeps = 0;
};

/// Runs the sub-steps of one cycle from the god object to the device at `goal`.
BallResult advance(Center& center, const Vector3& goal, const Quaternion& rotation, bool inside,
                   SubstepPath& path) noexcept {
  BallResult result{.inside = inside};
  while (true) {
    const FieldSample& here = center.look();
    result.inside = result.inside && here.distance <= 0.0;
    result.smallest = center.is_near() ? here.distance : std::numeric_limits<double>::infinity();
    if (center.is_free(goal)) {
      center.go(goal);
      path.push({rotation, goal});
      break;
    }
    ++result.substeps;
    const bool has_moved = center.step(goal);
    path.push({rotation, center.at()});
    if (!has_moved) break;
    const bool is_unfinished = center.cut || center.outdated || center.is_provisional;
    if (!is_unfinished || result.inside || result.substeps == kMaxSubsteps) break;
    center.lacks_work = center.lacks_work || center.is_out_of_work();
    if (center.is_out_of_work()) break;
  }
  return result;
}

}  // namespace

Status ball_cycle(const Voxelmap& field, const Parameters& q, const ContactLengths& lengths, const CycleInput& input,
                  SubstepPath& path, WorkMeter& work, ProxyState& state, CycleReport& report,
                  StepTimes* times) noexcept {
  detail::begin(times);
  const Vector3& goal = input.H_WD.translation;
  work.start(q.work_budget);
  work.add(Work::kCycle);
  Center center(field, q.workspace, lengths, state.H_WS.translation, input.beyond_W, work);
  path.clear();
  const BallResult result = advance(center, goal, input.H_WD.rotation, state.inside, path);
  detail::end(times, &StepTimes::step1_ns);

  DeviceForce force;
  const double stiffness = q.stiffness * q.coupling_translation;
  force.spring_W.force = stiffness * (center.at() - goal);  // #6 (44)-(46), #7
  force.total_W = force.spring_W;
  if (center.held.count > 0) {
    force.total_W.force += stiffness * damped(center.held, input.velocity_W.translation, q.damping / q.stiffness);
  }
  const Status status = commit(input, {input.H_WD.rotation, center.at()}, force, result.inside, state, report);
  if (status != Status::kOk) return status;
  report.penetration = -std::min(result.smallest, lengths.shortest_search_radius);
  report.contacts = static_cast<std::uint32_t>(center.held.count);
  report.dropped = 0;
  report.substeps = std::max(1u, result.substeps);
  report.unconverged = false;
  report.work = work.spent();
  report.out_of_work = center.lacks_work && !(center.at() == goal);
  report.outcome = detail::outcome_of({.held = center.held.count > 0,
                                       .cut = center.cut,
                                       .dropped = false,
                                       .infeasible = center.infeasible,
                                       .inside = result.inside});
  detail::end(times, &StepTimes::solve_ns);
  return Status::kOk;
}

}  // namespace godobject
