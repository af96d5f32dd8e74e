#include "core/pipeline/contact/qp/shifted_cones.h"

namespace godobject::detail {
namespace {

constexpr double kCrawl = 0.02;

/// Tells whether no contact with friction slips in the motion `m`.
bool is_slip_free(const ContactSet& set, const Motion& m) noexcept {
  for (int k = 0; k < set.contact_count(); ++k) {
    const Contact& c = set.contact(k);
    if (c.has_friction && !(set.slip_of(c, m).speed <= set.metric().still)) return false;  // nor is NaN
  }
  return true;
}

/// The contact whose cone a motion violates most.
struct ViolatedCone {
  int contact = -1;  // -1: none by more than the limit
  Slip slip;
};

/// Returns the cone that `m` violates most, if by more than `limit` [m].
ViolatedCone most_violated_cone(const ContactSet& set, const Motion& m, double limit) noexcept {
  ViolatedCone worst;
  for (int k = 0; k < set.contact_count(); ++k) {
    const Contact& c = set.contact(k);
    const Slip slip = set.slip_of(c, m);
    // a slip below `still` has no direction: the half space that would be added is the one of no slip
    const double speed = slip.speed > set.metric().still ? slip.speed : 0.0;
    const double violation = c.required_gain + c.ratio * (speed - c.shift) - slip.approach;
    if (violation > limit) {
      limit = violation;
      worst = {k, slip};
    }
  }
  return worst;
}

/// Tells whether `m` meets all rows and cones to the rows' tolerance.
bool is_met(const ContactSet& set, const Motion& m) noexcept {
  return set.most_violated(m).row == ContactRows::kNone &&
         most_violated_cone(set, m, set.metric().tolerance).contact < 0;
}

}  // namespace

Additions meet_cones(Shift entering, ContactSet& set, double tolerance) noexcept {
  for (int i = 0; i < kMostConeAdditions && !set.work().is_spent(); ++i) {
    const Motion m = set.motion();
    const ContactRows::Violated row = set.most_violated(m);
    const bool rows_are_met = row.row == ContactRows::kNone;
    ViolatedCone cone = most_violated_cone(set, m, rows_are_met ? tolerance * set.metric().tolerance : row.violation);
    if (cone.contact < 0 && rows_are_met) return Additions::kMet;
    if (cone.contact < 0) {
      cone.contact = set.open(row.row);
      Contact& c = set.contact(cone.contact);
      cone.slip = set.slip_of(c, m);
      if (entering == Shift::kSlip) c.shift = cone.slip.speed;
    }
    const bool added = set.add(set.cone_half_space(cone.contact, cone.slip.direction));
    set.close_idle();
    if (!added) return Additions::kContradictory;
  }
  return Additions::kExhausted;
}

bool crawls(const ContactSet& set, const ConstrainedStep& step) noexcept {
  const Motion& last = set.last();
  for (std::uint32_t i = 0; i < step.force_count; ++i) {
    const ContactForce& force = step.forces[i];
    const Vector3 v = last.translation + last.rotation.cross(force.grip);
    const double speed = (v - force.normal.dot(v) * force.normal).norm();
    const double held_back = set.friction()->kinetic_ratio * force.multiplier;
    if (speed > set.metric().still + kCrawl * held_back) return false;
  }
  return true;
}

bool sticks(ContactSet& set) noexcept {
  for (int k = 0; k < set.contact_count(); ++k) set.contact(k).shift = 0.0;
  set.resolve();
  const Additions ended = meet_cones(Shift::kNone, set);
  if (ended == Additions::kContradictory) return false;
  const Motion m = set.motion();
  return set.plain_motion().allFinite() && is_slip_free(set, m) && (ended == Additions::kMet || is_met(set, m));
}

bool rests(const ContactSet& set) noexcept {
  if (set.contact_count() == 0 || !(set.plain_motion().norm() <= set.metric().tolerance)) return false;
  return is_slip_free(set, set.motion());
}

void come_to_rest(ContactSet& set) noexcept {
  if (set.contact_count() == 0 || set.plain_motion().norm() > set.metric().tolerance || rests(set)) return;
  const ContactSet::Saved found = set.save();
  if (!sticks(set) || !rests(set)) set.restore(found);
}

}  // namespace godobject::detail
