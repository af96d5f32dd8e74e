#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/pipeline/contact/qp/contact_rows.h"
#include "core/pipeline/contact/qp/coupling_space.h"
#include "core/pipeline/contact/qp/dual_active_set.h"
#include "core/pipeline/contact/qp/least_constraint.h"

namespace godobject::detail {

/// What a half space of the active set belongs to.
struct ContactTag {
  std::uint32_t row = ContactRows::kNone;
  int contact = 0;                 ///< with friction: number of the contact
  Vector3 slip = Vector3::Zero();  ///< d: unit direction of slip that it resists; zero: the normal alone
};
using ActiveSet = DualActiveSet<ContactTag>;

/// A contact point that carries load with friction. While it is open its row is out of the scan, and its half spaces
///     (n - mu d) . v >= need - mu shift,   v = x + r x point,   d a unit direction of slip or zero
/// stand for it in the active set: one if it slips, up to three if it sticks.
struct Contact {
  std::uint32_t row = ContactRows::kNone;
  Vector3 normal;        ///< n, unit, in S
  Vector3 point;         ///< in S [m]
  double required_gain = 0.0;  ///< [m]
  double ratio = 0.0;    ///< mu
  double shift = 0.0;    ///< |slip| that the cone is shifted by [m]
  double speed = 0.0;    ///< Newton: |slip| at the last step [m]
  int reversals = 0;     ///< Newton: steps in a row at which the slip went with the force
  bool slips = false;    ///< Newton: one half space, against the slip
  bool is_held = false;  ///< Newton: by three half spaces, whatever its slip was
};

/// Velocity of a contact point, in its own directions.
struct Slip {
  double approach = 0.0;                ///< n . v [m]
  double speed = 0.0;                   ///< |slip| [m]
  Vector3 direction = Vector3::Zero();  ///< unit; zero at rest
};

/// The problem, the active set with the motion that it stands for, and the contacts that its half spaces belong to.
/// Every contact has at least one half space whenever a function that changes the set returns.
class ContactSet {
 public:
  /// `friction` null: no contacts, half spaces are the rows' own. References are kept.
  ContactSet(ContactRows& rows, const Motion& wanted, const CouplingMetric& metric, const ContactFriction* friction,
             const Motion& last) noexcept;

  const ContactRows& rows() const noexcept { return rows_; }
  const CouplingMetric& metric() const noexcept { return metric_; }
  const ContactFriction* friction() const noexcept { return friction_; }
  const Motion& last() const noexcept { return last_; }
  CouplingSpace& space() noexcept { return space_; }
  const CouplingSpace& space() const noexcept { return space_; }
  /// The wanted motion, in the coordinates of `space`.
  Vector6 target() const noexcept { return space_.target(wanted_); }

  ActiveSet& active() noexcept { return active_; }
  const ActiveSet& active() const noexcept { return active_; }
  /// (x, rho r) of the motion found so far, and the motion itself.
  Vector6 plain_motion() const noexcept { return space_.plain(active_.z()); }
  Motion motion() const noexcept { return space_.motion(plain_motion()); }

  int contact_count() const noexcept { return contact_count_; }
  Contact& contact(int k) noexcept { return contacts_[static_cast<std::size_t>(k)]; }
  const Contact& contact(int k) const noexcept { return contacts_[static_cast<std::size_t>(k)]; }
  /// The one that the half space `j` of the active set belongs to.
  Contact& contact_of(int j) noexcept { return contact(active_[j].tag.contact); }
  const Contact& contact_of(int j) const noexcept { return contact(active_[j].tag.contact); }

  /// The row that `m` violates most, of those that are not contacts.
  ContactRows::Violated most_violated(const Motion& m) const noexcept {
    return rows_.most_violated(m, metric_.tolerance);
  }
  Slip slip_of(const Contact& contact, const Motion& m) const noexcept {
    const Vector3 v = m.translation + m.rotation.cross(contact.point);
    Slip slip;
    slip.approach = contact.normal.dot(v);
    const Vector3 tangential = v - slip.approach * contact.normal;
    slip.speed = tangential.norm();
    if (slip.speed > metric_.still) slip.direction = tangential / slip.speed;
    return slip;
  }
  /// mu_s for a point that did not slip in the last motion, mu_k for the others.
  double ratio_of(const Contact& contact) const noexcept;

  /// n . v >= need of a row.
  ActiveSet::Inequality row_half_space(std::uint32_t row) const noexcept;
  /// (n - mu d) . v >= need - mu shift.
  ActiveSet::Inequality cone_half_space(int contact, const Vector3& slip) const noexcept;

  /// Makes the row a contact, without shift, and gives its number. A half space of it must follow.
  int open(std::uint32_t row) noexcept;
  /// Contacts without a half space become rows again.
  void close_idle() noexcept;
  /// All contacts become rows again; the active set stays.
  void close_all() noexcept;

  /// Adds a half space that the motion violates. False: it contradicts the others.
  bool add(const ActiveSet::Inequality& half_space) noexcept {
    ++additions_;
    return active_.add(half_space);
  }
  /// Makes the row a contact that slips as `m` says, for Newton's method. False: the active set is full.
  bool enter(std::uint32_t row, const Motion& m) noexcept;
  std::uint32_t additions() const noexcept { return additions_; }

  /// Brings the half spaces up to date with the contacts' ratios and shifts and solves for them; what pulls leaves.
  void resolve() noexcept;
  /// From now on the point nearest to the wanted motion, in the plain metric and without contacts.
  void restart() noexcept;
  /// From now on the point nearest to the motion found, in the plain metric and without contacts.
  void restart_from_motion() noexcept;

  struct Saved;
  Saved save() const noexcept;
  void restore(const Saved& saved) noexcept;

 private:
  // each contact but the one that enters has a half space
  static constexpr int kMaxContacts = ActiveSet::kCapacity + 1;

  ContactRows& rows_;
  const CouplingMetric& metric_;
  const ContactFriction* friction_;
  const Motion& last_;
  Vector6 wanted_;  // (x, rho r)
  CouplingSpace space_;
  ActiveSet active_;
  std::array<Contact, kMaxContacts> contacts_;
  int contact_count_ = 0;
  std::uint32_t additions_ = 0;
};

/// The active set and its contacts; not the metric.
struct ContactSet::Saved {
  ActiveSet active;
  std::array<Contact, kMaxContacts> contacts;
  int contact_count;
};

}  // namespace godobject::detail
