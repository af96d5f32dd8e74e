// Comparison of the god object with reference problems, solved by another method.
#include "toolchain/watch/watch.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "toolchain/watch/least_distance.h"
#include "toolchain/watch/rotation_vector.h"

namespace godobject::watch {
namespace {

/// Returns the pose after the motion (x, gyration r) in S [m].
Pose moved_by(const Pose& H_WS, const Vector6& motion, double gyration) {
  const Vector3 r = motion.tail<3>() / gyration;
  const double angle = r.norm();
  Pose moved = H_WS;
  moved.translation += H_WS.rotation._transformVector(motion.head<3>());
  if (angle > 0.0) moved.rotation = H_WS.rotation * Quaternion(Eigen::AngleAxisd(angle, r / angle));
  return moved;
}

}  // namespace

/// Not farther from the device than if the god object had stayed, or by the way out of lost margins.
void Watch::check_distance(const WatchedCycle& cycle) {
  const double now = stretch(H_WS_, cycle.H_WD).norm();
  const Vector6 to_device = stretch(H_WS_before_, cycle.H_WD);
  const double slack = 4.0 * q_.margin + session_.rounding;
  double most = to_device.norm();
  if (now > most + slack) {
    const std::vector<Touch> touches = touches_at(H_WS_before_, 1.5 * q_.voxel_size);
    most = std::max(most, (way_out(touches, q_) - to_device).norm());
  }
  judge(Property::kNotFarther, now - most, slack, [&] {
    return fmt::format("{} m from the device, {} m without motion, {} m by the shortest way out", now, to_device.norm(),
                       most);
  });
}

void Watch::check_reference(const WatchedCycle& cycle) {
  const Pose H_WD = clamped(cycle.H_WD);
  const bool is_at = is_at_device(cycle);
  nearest_ = Nearest{};
  if (is_at) stuck_ = 0;
  if (is_at && cycle_ % 4 != 0) return;  // then only the nearest point is of interest
  const std::vector<Contact> contacts = contacts_at(H_WS_, 0.125 * q_.voxel_size, 0.05 * q_.voxel_size);
  for (const Contact& contact : contacts) {
    if (contact.gap < nearest_.gap) nearest_ = {contact.gap, contact.normal_W};
  }
  if (is_at) {
    ++findings_[Property::kArrives].judged;
    return;
  }
  // the arc of a motion and the chords of its points differ by less than the clearance in motions of a voxel
  const Vector6 to_device = stretch(H_WS_before_, H_WD);
  const double away = to_device.head<3>().norm() + q_.mass.radius / gyration_ * to_device.tail<3>().norm();
  // a wider turn takes more sub-steps than a cycle has, however small the body [rad]
  constexpr double kMostTurn = 1.0;
  const bool turns_far = to_device.tail<3>().norm() > kMostTurn * gyration_;
  const bool exceeds_budget =
      cycle.report.out_of_work || (q_.point_budget > 0 && cycle.report.outcome == Outcome::kOverflow);
  if (contacts.empty() && away < q_.voxel_size && !turns_far && !session_.renders_ball && !exceeds_budget) {
    const double clearance = 0.25 * q_.voxel_size;
    judge(Property::kArrives, is_clear(H_WS_before_, H_WD, clearance) ? 1.0 : 0.0, 0.0,
          [&] { return fmt::format("{} m from the device", stretch(H_WS_, H_WD).norm()); });
  }
  check_progress(cycle);
  if (resting_ > 60) {
    check_lag(cycle);
  } else {
    behind_ = 0;
  }
  check_friction(cycle, contacts);
  check_work(cycle);
  if (findings_.touching % kReferenceEvery != 0) return;
  const bool between_planes = is_between_planes(cycle);
  check_pushes(cycle, between_planes);
  if (between_planes) check_power(cycle);
  if (between_planes && !session_.friction) check_damped_load(cycle, contacts);
  if (!session_.friction) check_optimum(cycle);
}

/// Returns the wrenches of unit pushes at the contacts, in the coupling's metric, with edges of the friction cones and
/// the faces of the workspace box.
std::vector<Vector6> Watch::rays_at(const Pose& H_WS, const std::vector<Contact>& contacts,
                                    const WatchedCycle& cycle) const {
  constexpr int kEdges = 8;
  std::vector<Vector6> rays;
  const auto add = [&](const Vector3& force, const Vector3& lever) {
    rays.push_back(stacked(force, lever.cross(force) / gyration_));
  };
  // a pyramid of eight edges around the cone
  const double ratio = q_.friction.static_ratio / std::cos(M_PI / kEdges);
  // viscous friction has no bound by the load: the whole half space
  const bool is_bounded = q_.friction.viscous == 0.0;
  for (const Contact& contact : contacts) {
    if (!session_.friction || !is_bounded) add(contact.normal_W, contact.lever_W);
    if (!session_.friction) continue;
    const Vector3 t = contact.normal_W.unitOrthogonal();
    const Vector3 u = contact.normal_W.cross(t);
    for (int edge = 0; edge < kEdges; ++edge) {
      const double angle = 2.0 * M_PI * edge / kEdges;
      const Vector3 along = std::cos(angle) * t + std::sin(angle) * u;
      add(is_bounded ? Vector3(contact.normal_W + ratio * along) : along, contact.lever_W);
    }
  }
  if (!q_.workspace.limited) return rays;
  for (int axis = 0; axis < 3; ++axis) {
    const double tolerance = 2.0 * q_.margin;
    if (H_WS.translation[axis] < q_.workspace.low[axis] + tolerance ||
        cycle.H_WD.translation[axis] < q_.workspace.low[axis])
      rays.push_back(Vector6::Unit(axis));
    if (H_WS.translation[axis] > q_.workspace.high[axis] - tolerance ||
        cycle.H_WD.translation[axis] > q_.workspace.high[axis])
      rays.push_back(-Vector6::Unit(axis));
  }
  return rays;
}

/// Returns the part of the spring's wrench that is a sum of pushes at the points that touch, at the start or at the end
/// of the last sub-step.
ConeProjection Watch::push_at(const WatchedCycle& cycle, Around places) const {
  std::vector<Vector6> rays;
  for (const Pose& H_WS : {H_WS_, H_WS_last_start_}) {
    const std::vector<Contact> contacts = contacts_at(H_WS, 0.125 * q_.voxel_size, 0.05 * q_.voxel_size, places);
    for (const Vector6& ray : rays_at(H_WS, contacts, cycle)) rays.push_back(ray);
  }
  return projection_on_cone(load(cycle.report), rays);
}

/// The spring's wrench is a sum of pushes. A point may also be held by a face that only places diagonally around it
/// show: one that ends beside the point, hardly farther than its margin. A god object that lags is pulled from where
/// the device has been, which shows with friction, too.
void Watch::check_pushes(const WatchedCycle& cycle, bool between_planes) {
  const Outcome outcome = cycle.report.outcome;
  if (outcome != Outcome::kContact || (travelled_ > 0.02 * q_.voxel_size && !between_planes)) return;
  const Vector6 w = load(cycle.report);
  const double turned = rotation_vector(H_WS_.rotation * H_WS_before_.rotation.conjugate()).norm();
  const double bound =
      (0.05 + turned) * w.norm() + q_.stiffness * q_.coupling_translation * (q_.margin + session_.rounding);
  ConeProjection pushes = push_at(cycle, Around::kAxes);
  if ((w - pushes.x).norm() > bound) pushes = push_at(cycle, Around::kDiagonals);
  const double lacks = (w - pushes.x).norm();
  if (!pushes.converged && lacks > bound) {  // a nearer sum may exist; one within the bound would be proof enough
    ++findings_.not_converged;
    return;
  }
  judge(Property::kNoPull, lacks, bound,
        [&] { return fmt::format("{} N of {} N is no push at a touching point", lacks, w.norm()); });
}

/// One cycle's motion is the one of the linear problem at its start, which non-negative least squares solve.
void Watch::check_optimum(const WatchedCycle& cycle) {
  if (cycle.report.outcome != Outcome::kContact || travelled_ > 0.25 * q_.voxel_size) return;
  const Vector6 to_device = stretch(H_WS_before_, cycle.H_WD);
  std::vector<HalfPlane> rows;
  for (const Touch& touch : touches_at(H_WS_before_, 0.5 * q_.voxel_size)) {
    HalfPlane row = row_of(touch, gyration_, q_.voxel_size);
    row.bound -= row.normal.dot(to_device);
    rows.push_back(row);
  }
  if (q_.workspace.limited) {
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3 face = H_WS_before_.rotation.conjugate()._transformVector(Vector3::Unit(axis));
      const double here = H_WS_before_.translation[axis];
      const Vector6 normal = stacked(face, Vector3::Zero());
      rows.push_back({normal, q_.workspace.low[axis] - here - normal.dot(to_device)});
      rows.push_back({-normal, here - q_.workspace.high[axis] + normal.dot(to_device)});
    }
  }
  const LeastDistance best = least_distance(rows);
  if (!best.feasible || !best.converged) {
    ++findings_.not_converged;
    return;
  }
  const Vector6 expected = best.x + to_device;
  const Vector6 moved = stretch(H_WS_before_, H_WS_);
  // The rows are those of the points within half a voxel. So this share of the motion was possible, whatever lies
  // beyond, and the motion of the cycle must end at least as near to the device. The exception is a second face at a
  // point, which the field at the point does not show: then a shorter motion counts, whose chords are clear.
  const double travel = expected.head<3>().norm() + q_.mass.radius / gyration_ * expected.tail<3>().norm();
  const double bound = 4.0 * q_.margin + 0.1 * travelled_ + session_.rounding;
  double share = std::min(1.0, 0.4 * q_.voxel_size / travel);
  const auto excess_over = [&](double part) {
    return (moved - to_device).norm() - (part * expected - to_device).norm();
  };
  while (excess_over(share) > bound &&
         !is_clear(H_WS_before_, moved_by(H_WS_before_, share * expected, gyration_), 0.0)) {
    share *= 0.5;
  }
  const double excess = excess_over(share);
  judge(Property::kOptimum, excess, bound, [&] {
    return fmt::format("{} m farther from the device than a motion of {} m", excess, share * expected.norm());
  });
  if (share < 1.0) return;
  judge(Property::kOptimum, std::min((moved - expected).norm(), 10.0 * std::max(0.0, excess)),
        0.5 * expected.norm() + 16.0 * q_.margin + session_.rounding, [&] {
          return fmt::format("moved {} m, the reference {} m, {} m apart; {} m farther from the device", moved.norm(),
                             expected.norm(), (moved - expected).norm(), excess);
        });
}

/// A cut motion must go on in the next cycle, wherever the device is: a god object that stays where it is cut is stuck.
void Watch::check_progress(const WatchedCycle& cycle) {
  constexpr double kMostCycles = 50.0;
  const bool has_work_budget = q_.work_budget != WorkMeter::kUnlimited;
  const double still = has_work_budget ? 0.0 : 1e-4;  // [voxels]; with a budget it may lag, but goes on
  const bool is_stuck = cycle.report.outcome == Outcome::kCut && travelled_ <= still * q_.voxel_size;
  stuck_ = is_stuck ? stuck_ + 1 : 0;
  judge(Property::kLag, stuck_, kMostCycles, [&] { return fmt::format("cut where it is for {} cycles", stuck_); });
}

/// Under a device at rest the god object must not be cut short for long, unless it comes nearer by a ten thousandth of
/// its distance in each cycle.
void Watch::check_lag(const WatchedCycle& cycle) {
  constexpr double kMostCycles = 50.0;
  constexpr double kLeastProgress = 1e-4;
  const double before = stretch(H_WS_before_, cycle.H_WD).norm();
  const bool approaches = stretch(H_WS_, cycle.H_WD).norm() < (1.0 - kLeastProgress) * before;
  behind_ = cycle.report.outcome == Outcome::kCut && !approaches ? behind_ + 1 : 0;
  judge(Property::kLag, behind_, kMostCycles,
        [&] { return fmt::format("cut short for {} cycles under a device at rest", behind_); });
}

}  // namespace godobject::watch
