#include "core/pipeline/contact/ball_cycle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/pipeline/contact/contact_cycle.h"
#include "core/pipeline/contact/qp/dual_active_set.h"
#include "core/pipeline/cycle/workspace_limit.h"

namespace godobject {
namespace {

constexpr int kSecondLooks = 6;  // at what stood in the way
constexpr int kAttempts = 14;
constexpr double kOvershoot = 0.5;

/// Half spaces normal . x >= need that a motion x of the centre must stay in, in W.
struct HalfSpaces {
  static constexpr int kCapacity = 1 + kSecondLooks;
  std::array<Vector3, kCapacity> normal;  ///< unit
  std::array<double, kCapacity> need;     ///< [m]
  int count = 0;

  void push(const Vector3& n, double b) noexcept {
    normal[static_cast<std::size_t>(count)] = n;
    need[static_cast<std::size_t>(count++)] = b;
  }
};

/// Those that hold back what is projected on all of them.
struct Held {
  std::array<Vector3, 3> normal;
  std::array<double, 3> multiplier;
  int count = 0;
};

/// The point of all half spaces that is nearest to `target`; false: there is none, and `nearest` meets some of them.
bool project(const HalfSpaces& spaces, const Vector3& target, double tolerance, Vector3& nearest, Held& held) noexcept {
  held.count = 0;
  nearest = target;
  if (spaces.count == 1) {
    const double missing = spaces.need[0] - spaces.normal[0].dot(target);
    if (!(missing > tolerance)) return true;
    nearest += missing * spaces.normal[0];
    held.normal[0] = spaces.normal[0];
    held.multiplier[0] = missing;
    held.count = 1;
    return true;
  }
  struct NoTag {};
  DualActiveSet<NoTag> set;
  Vector6 wide = Vector6::Zero();
  wide.head<3>() = target;
  set.start(wide);
  bool feasible = true;
  for (int round = 0; round < 4 * HalfSpaces::kCapacity && feasible; ++round) {
    DualActiveSet<NoTag>::Inequality worst;
    double violation = tolerance;
    for (int i = 0; i < spaces.count; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const double missing = spaces.need[k] - spaces.normal[k].dot(set.z().head<3>());
      if (!(missing > violation)) continue;
      violation = missing;
      worst.gradient.head<3>() = spaces.normal[k];
      worst.rhs = spaces.need[k];
    }
    if (!(violation > tolerance)) break;
    feasible = set.add(worst);
  }
  nearest = set.z().head<3>();
  for (int i = 0; i < std::min(set.size(), 3); ++i) {
    if (!(set[i].multiplier > 0.0)) continue;
    held.normal[static_cast<std::size_t>(held.count)] = set[i].gradient.head<3>();
    held.multiplier[static_cast<std::size_t>(held.count++)] = set[i].multiplier;
  }
  return feasible;
}

/// The damping b_D along what holds, as `contact_cycle` has it: the change of the load that lets no contact pull.
Vector3 damped(const Held& held, const Vector3& velocity_W, double damping_over_stiffness) noexcept {
  const Vector3 asked = damping_over_stiffness * velocity_W;
  HalfSpaces cone;
  Vector3 load = Vector3::Zero();
  for (int i = 0; i < held.count; ++i) {
    cone.push(held.normal[static_cast<std::size_t>(i)], 0.0);
    load += held.multiplier[static_cast<std::size_t>(i)] * held.normal[static_cast<std::size_t>(i)];
  }
  Vector3 allowed;
  Held pushing;
  project(cone, asked - load, 1e-12 * (asked.norm() + load.norm()), allowed, pushing);
  constexpr double kRoundedUp = 1.0 + 1e-9;
  const Vector3 change = allowed - asked;
  return change.norm() <= kRoundedUp * asked.norm() ? change : Vector3(Vector3::Zero());
}

/// One cycle's centre.
class Center {
 public:
  Center(const Voxelmap& field, const Parameters& q, const Vector3& at) noexcept
      : field_(field), box_(q.workspace), lengths_(ContactLengths::make(q)), at_(at) {
    reach_ = std::min(lengths_.longest_reach, field.assured_clearance());
  }

  /// Where it is, and how the surface looks from there.
  const Vector3& at() const noexcept { return at_; }
  const FieldSample& look() noexcept { return here_ = field_.sample(at_); }

  /// Nothing is in the way to `goal`.
  bool is_free(const Vector3& goal) const noexcept { return (goal - at_).norm() + lengths_.margin <= here_.clearance; }

  void go(const Vector3& goal) noexcept {
    at_ = goal;
    held.count = 0;
    cut = opened = false;
  }

  /// One sub-step towards `goal`: false where it is held for good.
  bool step(const Vector3& goal) noexcept;

  double shortest_reach() const noexcept { return lengths_.shortest_reach; }
  bool is_near() const noexcept { return here_.clearance < reach_; }

  Held held;
  bool cut = false;     ///< shortened so as not to jump over the surface
  bool opened = false;  ///< it came round an edge, where what held it holds no longer
  bool infeasible = false;

 private:
  void aim(const Vector3& way) noexcept;
  bool certify(const Vector3& end, double kept) noexcept;
  bool see_obstacle(const Vector3& end) noexcept;
  double overshoot(const Vector3& motion) noexcept;

  const Voxelmap& field_;
  const WorkspaceBox& box_;
  const ContactLengths lengths_;
  Vector3 at_;
  double reach_;
  FieldSample here_, there_;
  Vector3 motion_ = Vector3::Zero();
  HalfSpaces spaces_;
  detail::Obstacle obstacle_;
  detail::Budget budget_;
};

/// The motion nearest to `way` that all half spaces and the workspace allow; half spaces that contradict each other
/// lose what they need to gain.
void Center::aim(const Vector3& way) noexcept {
  const auto end_of = [&](const Vector3& push) noexcept {
    const Vector3 wanted = way - push;
    if (!project(spaces_, wanted, lengths_.metric.tolerance, motion_, held)) {
      infeasible = true;
      for (double& need : spaces_.need) need = std::min(need, 0.0);
      project(spaces_, wanted, lengths_.metric.tolerance, motion_, held);
    }
    return Vector3(at_ + motion_);
  };
  if (box_.limited) {
    push_within(box_, lengths_.metric.tolerance, end_of);
  } else {
    end_of(Vector3::Zero());
  }
}

/// The chord to `end` meets no surface, and the gap does not shrink below `kept`.
bool Center::certify(const Vector3& end, double kept) noexcept {
  obstacle_.exhausted = false;
  there_ = field_.sample(end);
  if (here_.distance <= 0.0 || (end - at_).norm() + kept <= here_.clearance) return true;
  if (!detail::chord_is_free(field_, at_, here_.clearance, end, there_.clearance, budget_, obstacle_)) return false;
  obstacle_.way = 1.0;
  obstacle_.sample = there_;
  return there_.distance > 0.0 && there_.distance + lengths_.rounding >= std::min(here_.distance, kept);
}

/// The surface as it looks from the obstacle as one more half space; false if there is no room or no gradient.
bool Center::see_obstacle(const Vector3& end) noexcept {
  const FieldSample& seen = obstacle_.sample;
  const double steepness = seen.gradient.norm();
  if (spaces_.count == HalfSpaces::kCapacity || !seen.known || !(steepness > detail::kFlat)) return false;
  const double need = (lengths_.margin - seen.distance + seen.gradient.dot(obstacle_.way * (end - at_))) / steepness;
  spaces_.push(seen.gradient / steepness,
               std::min(need, std::max(0.0, detail::kRecovery * (lengths_.margin - here_.distance))));
  return true;
}

/// As detail::arrive has it, of the one point; tells `opened`.
double Center::overshoot(const Vector3& motion) noexcept {
  const double steepness = there_.gradient.norm();
  opened = held.count > 0 && there_.distance > lengths_.margin + lengths_.opening;
  if (!(steepness > detail::kFlat)) return 0.0;
  double rise = 0.0;
  for (int i = 0; i < held.count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    rise -= held.multiplier[k] * (there_.gradient / steepness - held.normal[k]).dot(motion);
  }
  return rise > 0.0 ? rise / motion.squaredNorm() : 0.0;
}

bool Center::step(const Vector3& goal) noexcept {
  const Vector3 way = goal - at_;
  spaces_.count = 0;
  const double steepness = here_.gradient.norm();
  if (is_near() && here_.known && steepness > detail::kFlat) {
    double need = (lengths_.margin - here_.distance) / steepness;
    if (std::fabs(need) <= lengths_.metric.tolerance) need = 0.0;  // it touches: what rests stays where it is
    if (need > 0.0) need = std::min(detail::kRecovery * need, lengths_.largest_gain);
    spaces_.push(here_.gradient / steepness, need);
  }
  held.count = 0;
  motion_ = way;
  if (spaces_.count > 0) aim(way);
  double share = 1.0;
  int looks = kSecondLooks;
  bool shortened = false;
  opened = false;
  for (int attempt = 0;; ++attempt) {
    if (attempt == kAttempts) return cut = true, false;
    const Vector3 motion = share * motion_;
    const bool unheld = share == 1.0 && held.count == 0;
    const Vector3 end = unheld ? goal : box_.nearest(at_ + motion);
    if (certify(end, looks > 0 ? lengths_.wanted_margin : lengths_.least_margin)) {
      if (share == 1.0 && held.count > 0 && motion.norm() > lengths_.metric.tolerance) {
        if (const double over = overshoot(motion); over > kOvershoot) {
          share = 1.0 / (1.0 + over);
          shortened = true;
          continue;
        }
      }
      at_ = end;
      cut = share < 1.0 && !shortened;
      return true;
    }
    shortened = false;
    if (obstacle_.exhausted) {
      share *= attempt < kSecondLooks ? obstacle_.way : std::min(obstacle_.way, 0.25);
      continue;
    }
    looks = looks > 0 && see_obstacle(end) ? looks - 1 : 0;
    if (looks > 0) {
      aim(way);
      share = 1.0;
    } else {
      share *= attempt < kSecondLooks ? 0.5 : 0.25;
    }
  }
}

}  // namespace

Status ball_cycle(const Voxelmap& field, const Parameters& q, const CycleInput& input, State& state,
                  CycleReport& report, StepTimes* times) noexcept {
  detail::begin(times);
  const Vector3& goal = input.H_WD.translation;
  Center center(field, q, state.H_WS.translation);
  bool inside = state.inside;
  double smallest = std::numeric_limits<double>::infinity();
  std::uint32_t substeps = 0;
  do {
    const FieldSample& here = center.look();
    inside = inside && here.distance <= 0.0;
    if (center.is_free(goal)) {
      center.go(goal);
      break;
    }
    smallest = center.is_near() ? here.distance : std::numeric_limits<double>::infinity();
    ++substeps;
    if (inside && !here.known) {  // nobody knows the way out: with the device
      center.go(goal);
      break;
    }
    if (!center.step(goal)) break;
  } while ((center.cut || center.opened) && !inside && substeps < kMaxSubsteps);
  detail::end(times, &StepTimes::step1_ns);

  DeviceForce force;
  const double stiffness = q.stiffness * q.coupling_translation;
  force.spring_W.force = stiffness * (center.at() - goal);  // #6 (44)-(46), #7
  force.total_W = force.spring_W;
  if (center.held.count > 0) {
    force.total_W.force += stiffness * damped(center.held, input.velocity_W.translation, q.damping / q.stiffness);
  }
  if (!center.at().allFinite() || !force.total_W.force.allFinite()) return Status::kNotFinite;

  state.H_WS = {input.H_WD.rotation, center.at()};
  state.inside = inside;
  state.started = true;
  report = CycleReport{};
  report.H_WS = state.H_WS;
  report.force = force;
  report.penetration = -std::min(smallest, center.shortest_reach());
  report.contacts = static_cast<std::uint32_t>(center.held.count);
  report.substeps = std::max(1u, substeps);
  report.outcome = center.held.count > 0 ? Outcome::kContact : Outcome::kFree;
  if (center.cut) report.outcome = Outcome::kCut;
  if (center.infeasible) report.outcome = Outcome::kInfeasible;
  if (inside) report.outcome = Outcome::kStartInside;
  detail::end(times, &StepTimes::solve_ns);
  return Status::kOk;
}

}  // namespace godobject
