// Checks of the displayed wrench: spring, damping and friction.
#include "toolchain/watch/watch.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "toolchain/watch/least_distance.h"
#include "toolchain/watch/rotation_vector.h"

namespace godobject::watch {

/// Spring (44)-(46) and #7; damping takes power and is bounded.
void Watch::check_wrench(const WatchedCycle& cycle) {
  const CycleReport& report = cycle.report;
  const double k = q_.stiffness * q_.coupling_translation;
  const double k_rotation = q_.stiffness * q_.coupling_rotation;
  const Vector3 force = k * (report.H_WS.translation - cycle.H_WD.translation);
  // both rotations leave the axis as it is, so that D's and S's frame give the same vector in W
  const Vector3 turn =
      cycle.H_WD.rotation._transformVector(rotation_vector(cycle.H_WD.rotation.conjugate() * report.H_WS.rotation));
  const Vector3 torque = session_.renders_ball ? Vector3(Vector3::Zero()) : Vector3(k_rotation * turn);
  const double rounding = 1e-9 * k * q_.mass.radius + 4.0 * k * session_.rounding;
  judge(Property::kSpring, (report.force.spring_W.force - force).norm(), 1e-9 * force.norm() + rounding, [&] {
    return fmt::format("{} N where stiffness times stretch is {} N, {} N apart", report.force.spring_W.force.norm(),
                       force.norm(), (report.force.spring_W.force - force).norm());
  });
  // at half a turn the axis has two directions
  if (turn.norm() < 3.14) {
    judge(Property::kSpring, (report.force.spring_W.torque - torque).norm(),
          1e-8 * torque.norm() + 1e-9 * k_rotation + gyration_ * rounding, [&] {
            return fmt::format("{} Nm where stiffness times stretch is {} Nm", report.force.spring_W.torque.norm(),
                               torque.norm());
          });
  }
  if (session_.solver != Solver::kContact) return check_heuristic_damping(cycle);
  const Vector6 damping = stacked(report.force.total_W.force - report.force.spring_W.force,
                                  (report.force.total_W.torque - report.force.spring_W.torque) / gyration_);
  const Vector6 velocity = stacked(cycle.velocity_W.translation, gyration_ * cycle.velocity_W.rotation);
  const double most = q_.damping * q_.coupling_translation * velocity.norm() * (report.outside ? 2.0 : 1.0);
  const double tiny = 1e-6 * most + 1e-9 * stacked(force, torque / gyration_).norm() + rounding;
  judge(Property::kDamper, damping.norm(), most + tiny,
        [&] { return fmt::format("the damping is {} N, at most {} N", damping.norm(), most); });
  judge(Property::kDamper, damping.dot(velocity), 1e-4 * most * velocity.norm() + tiny * velocity.norm(),
        [&] { return fmt::format("the damping adds {} W", damping.dot(velocity)); });
}

/// `paper` and `corrected` reduce force and torque each by the damping along them, never below zero.
void Watch::check_heuristic_damping(const WatchedCycle& cycle) {
  if (cycle.report.outside) return;
  const auto check = [&](const Vector3& spring, const Vector3& total, const Vector3& velocity, double damping) {
    const double size = spring.norm();
    if (size < 1e-9) return;
    const Vector3 along = spring / size;
    const Vector3 expected = std::max(0.0, size - damping * velocity.dot(along)) * along;
    judge(Property::kDamping, (total - expected).norm(), 1e-9 * (size + damping * velocity.norm()),
          [&] { return fmt::format("{} where {} is right", total.norm(), expected.norm()); });
  };
  const DeviceForce& force = cycle.report.force;
  check(force.spring_W.force, force.total_W.force, cycle.velocity_W.translation, q_.damping * q_.coupling_translation);
  check(force.spring_W.torque, force.total_W.torque, cycle.velocity_W.rotation, q_.damping * q_.coupling_rotation);
}

/// Returns the spring's wrench in the coupling's metric: the sum of the contact forces on the god object [N].
Vector6 Watch::load(const CycleReport& report) const {
  return stacked(report.force.spring_W.force, report.force.spring_W.torque / gyration_);
}

/// Returns the nearest of the touching points if they, and the points about to touch, had one normal all through the
/// cycle, and no face of the workspace carries force; null otherwise. `count`: the touching points.
const Watch::Contact* Watch::one_normal(const WatchedCycle& cycle, const std::vector<Contact>& contacts,
                                        int& count) const {
  const CycleReport& report = cycle.report;
  if (report.outcome != Outcome::kContact || report.unconverged || report.outside || cycle.path.size() > 1)
    return nullptr;
  if (travelled_ > 0.125 * q_.voxel_size) return nullptr;
  const double touching = 2.0 * q_.margin;
  const Contact* first = nullptr;
  count = 0;
  for (const Contact& contact : contacts) {
    if (first != nullptr && (contact.normal_W - first->normal_W).norm() > 1e-6) return nullptr;
    if (first == nullptr || contact.gap < first->gap) first = &contact;
    count += contact.gap < touching ? 1 : 0;
  }
  if (count == 0) return nullptr;
  for (const Contact& contact : contacts_at(H_WS_before_, 0.25 * q_.voxel_size, 0.1 * q_.voxel_size)) {
    if ((contact.normal_W - first->normal_W).norm() > 1e-3) return nullptr;
  }
  return may_touch_the_box(report) ? nullptr : first;
}

/// Tells whether a face of the workspace box may carry force.
bool Watch::may_touch_the_box(const CycleReport& report) const {
  if (!q_.workspace.limited) return false;
  const Vector3& p = report.H_WS.translation;
  return std::min((p - q_.workspace.low).minCoeff(), (q_.workspace.high - p).minCoeff()) < q_.margin;
}

/// Contacts that all have one normal: size of the friction. One contact that slips: its direction, and the damping.
void Watch::check_friction(const WatchedCycle& cycle, const std::vector<Contact>& contacts) {
  int count = 0;
  const Contact* const first = one_normal(cycle, contacts, count);
  if (first == nullptr) return;
  const CycleReport& report = cycle.report;
  const Vector3& n = first->normal_W;
  const Vector3& F = report.force.spring_W.force;
  const double normal = n.dot(F);
  const Vector3 tangential = F - normal * n;
  const double tiny = q_.stiffness * q_.coupling_translation * (0.1 * q_.margin + 4.0 * session_.rounding);
  const Vector3 turn = rotation_vector(report.H_WS.rotation * H_WS_before_.rotation.conjugate());
  // the law holds for the linear motion, by the lever at the start; a turn bends the path of the point by this much
  const Vector3 lever = H_WS_before_.rotation._transformVector(first->point_S);
  const Vector3 moved = report.H_WS.translation - H_WS_before_.translation + turn.cross(lever);
  const Vector3 slip = moved - n.dot(moved) * n;
  const double bend = turn.squaredNorm() * lever.norm();
  const double per_slip = session_.friction ? q_.friction.viscous / q_.period : 0.0;
  const double ratio = session_.friction ? q_.friction.static_ratio : 0.0;
  judge(Property::kFriction, -normal, tiny, [&] { return fmt::format("the only contact pulls by {} N", -normal); });
  const bool slips_elsewhere = count > 1 && per_slip > 0.0;
  if (!slips_elsewhere) {
    const double viscous = per_slip * (slip.norm() + 2.0 * bend);
    judge(Property::kFriction, tangential.norm(), 1.02 * ratio * normal + 1.2 * viscous + 0.01 * normal + tiny, [&] {
      return fmt::format("{} N along a face that carries {} N, ratio {}", tangential.norm(), normal, ratio);
    });
  }
  if (count != 1 || report.contacts != 1) return;
  check_damping(cycle, *first, turn.norm());
  if (!session_.friction || slip.norm() < 0.5 * q_.margin + 20.0 * bend) return;
  const Vector3 expected = -(q_.friction.kinetic_ratio * normal * slip.normalized() + per_slip * slip);
  judge(Property::kFriction, (tangential - expected).norm(), 0.1 * expected.norm() + 0.02 * normal + tiny, [&] {
    return fmt::format("friction of a point that slips is {} N from {} N against the slip",
                       (tangential - expected).norm(), expected.norm());
  });
}

/// One contact: the damped load is the load less b_D v, projected on the contact's normal, and never below zero.
void Watch::check_damping(const WatchedCycle& cycle, const Contact& contact, double turned) {
  const CycleReport& report = cycle.report;
  const Vector6 ray = stacked(contact.normal_W, contact.lever_W.cross(contact.normal_W) / gyration_);
  const Vector6 change = stacked(report.force.total_W.force, report.force.total_W.torque / gyration_) - load(report);
  const Vector6 velocity = stacked(cycle.velocity_W.translation, gyration_ * cycle.velocity_W.rotation);
  const double b = q_.damping * q_.coupling_translation;
  const double normal = contact.normal_W.dot(report.force.spring_W.force);
  const double damped = std::max(0.0, normal - b * ray.dot(velocity) / ray.squaredNorm());
  // the solver's normal and lever are those of the cycle's start, turned with the body
  const double turns_away = 0.02 + 2.0 * turned * (1.0 + contact.lever_W.norm() / gyration_);
  const double bound = turns_away * (b * velocity.norm() + normal * ray.norm()) + 1e-9 * q_.stiffness * q_.mass.radius;
  judge(Property::kDamping, (change - (damped - normal) * ray).norm(), bound, [&] {
    return fmt::format("a contact of {} N is damped by {} N, {} N is right", normal, change.norm(),
                       (damped - normal) * ray.norm());
  });
}

/// The contact force may push the god object out of lost margins, but drives it nowhere in the last sub-step. (In a
/// cycle that passes edges the whole motion may turn round a corner, so that it ends along the force.)
void Watch::check_work(const WatchedCycle& cycle) {
  if (travelled_ > 0.25 * q_.voxel_size || cycle.report.outside) return;
  const Vector6 w = load(cycle.report);
  const Vector3 turn = rotation_vector(cycle.report.H_WS.rotation * H_WS_last_start_.rotation.conjugate());
  const Vector6 moved = stacked(cycle.report.H_WS.translation - H_WS_last_start_.translation, gyration_ * turn);
  judge(Property::kNoWork, w.dot(moved), w.norm() * (0.5 * moved.norm() + 6.0 * q_.margin + session_.rounding),
        [&] { return fmt::format("{} J in the last sub-step, by a wrench of {} N", w.dot(moved), w.norm()); });
}

/// Tells whether the cycle had one short motion between planes: the normals near the god object are the same before and
/// after it.
bool Watch::is_between_planes(const WatchedCycle& cycle) const {
  constexpr double kSame = 1e-3;
  const CycleReport& report = cycle.report;
  if (report.outcome != Outcome::kContact || report.outside || cycle.path.size() > 1) return false;
  if (travelled_ > 0.125 * q_.voxel_size) return false;
  const auto lacks = [](const std::vector<Contact>& some, const Contact& contact) {
    return std::none_of(some.begin(), some.end(),
                        [&](const Contact& other) { return (other.normal_W - contact.normal_W).norm() < kSame; });
  };
  const std::vector<Contact> before = contacts_at(H_WS_before_, 0.25 * q_.voxel_size, 0.1 * q_.voxel_size);
  const std::vector<Contact> after = contacts_at(H_WS_, 0.25 * q_.voxel_size, 0.1 * q_.voxel_size);
  return std::none_of(before.begin(), before.end(), [&](const Contact& each) { return lacks(after, each); }) &&
         std::none_of(after.begin(), after.end(), [&](const Contact& each) { return lacks(before, each); });
}

/// Between planes the contact force takes power: that of friction is negative, that of the normals only regains lost
/// margins. So friction along the slip shows, whatever the number of normals.
void Watch::check_power(const WatchedCycle& cycle) {
  const CycleReport& report = cycle.report;
  const Vector6 w = load(report);
  const Vector3 turn = rotation_vector(report.H_WS.rotation * H_WS_before_.rotation.conjugate());
  const Vector6 moved = stacked(report.H_WS.translation - H_WS_before_.translation, gyration_ * turn);
  const double bound = (0.05 + 2.0 * turn.norm()) * moved.norm() + q_.margin + session_.rounding;
  judge(Property::kNoWork, w.dot(moved), w.norm() * bound,
        [&] { return fmt::format("{} J between planes, by a wrench of {} N", w.dot(moved), w.norm()); });
}

/// Between planes, without friction: the damped load is the projection of the load less b_D v on the cone of the
/// normals that carry it. So what the projection takes off is not larger than b_D v, and at right angles to what it
/// leaves. The box's faces are not damped, and contacts that oppose each other carry a load of rounding.
void Watch::check_damped_load(const WatchedCycle& cycle, const std::vector<Contact>& contacts) {
  const CycleReport& report = cycle.report;
  if (may_touch_the_box(report)) return;
  for (const Contact& one : contacts) {
    for (const Contact& other : contacts) {
      if (one.normal_W.dot(other.normal_W) < -0.9) return;
    }
  }
  const Vector6 damped = stacked(report.force.total_W.force, report.force.total_W.torque / gyration_);
  const Vector6 damping = q_.damping * q_.coupling_translation *
                          stacked(cycle.velocity_W.translation, gyration_ * cycle.velocity_W.rotation);
  const Vector6 taken = load(report) - damping - damped;
  // the load is that of the normals at the start of the cycle and of the linear motion
  const double turned = rotation_vector(report.H_WS.rotation * H_WS_before_.rotation.conjugate()).norm();
  const double error = q_.stiffness * q_.coupling_translation * (0.1 * q_.margin + 4.0 * session_.rounding) +
                       2.0 * turned * (1.0 + q_.mass.radius / gyration_) * load(report).norm();
  judge(Property::kDamping, std::abs(taken.dot(damped)),
        0.02 * damping.norm() * damped.norm() + error * (taken.norm() + damped.norm()), [&] {
          return fmt::format("of a load of {} N damping leaves {} N, and {} N of what it takes lie along that",
                             load(report).norm(), damped.norm(), std::abs(taken.dot(damped)) / damped.norm());
        });
  judge(Property::kDamping, taken.norm(), 1.01 * damping.norm() + error,
        [&] { return fmt::format("{} N are taken off beside a damping of {} N", taken.norm(), damping.norm()); });
}

}  // namespace godobject::watch
