#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/pipeline/contact/qp/contact_rows.h"
#include "core/pipeline/contact/qp/coupling_space.h"
#include "core/pipeline/contact/qp/dual_active_set.h"
#include "core/pipeline/contact/qp/least_constraint.h"

namespace godobject::detail {

/// The origin of a half space in the active set.
struct ContactTag {
  std::uint32_t row = ContactRows::kNone;
  int contact{};                   ///< with friction: number of the contact
  Vector3 slip = Vector3::Zero();  ///< d: unit direction of slip that the force opposes; zero: the normal alone
};
using ActiveSet = DualActiveSet<ContactTag>;

/// A contact point that carries load with friction. While it is open, its row is excluded from the scan. Its half
/// spaces
///     n . (x + r x point) - mu d . (x + r x grip) >= required gain - mu shift,   d a unit direction of slip or zero
/// represent it in the active set: one if it slips, up to three if it sticks.
struct Contact {
  std::uint32_t row = ContactRows::kNone;
  Vector3 normal;          ///< n, unit, in S
  Vector3 point;           ///< in S [m]
  Vector3 grip;            ///< the point at which friction acts, in S (ContactPatches) [m]
  double required_gain{};  ///< [m]
  bool has_friction{};     ///< not of a face of the workspace
  double ratio{};          ///< mu; 0 without friction
  double shift = 0.0;      ///< |slip| by which the cone is shifted [m]
  double speed = 0.0;      ///< Newton: |slip| in the last step [m]
  int reversals = 0;       ///< Newton: consecutive steps in which the slip had the force's direction
  bool slips = false;      ///< Newton: it has one half space, against the slip
  bool is_held = false;    ///< Newton: three half spaces hold it, even if it had slipped
};

/// The displacement of a contact point, split by its normal.
struct Slip {
  double approach{};                    ///< n . v [m]
  double speed{};                       ///< |slip| [m]
  Vector3 direction = Vector3::Zero();  ///< unit; zero at rest
};

/// The problem, the active set with its motion, and the contacts of its half spaces. Whenever a function that changes
/// the set returns, every contact has at least one half space; within solve_smoothed contacts have none.
class ContactSet {
 public:
  /// Derived: each has a half space, except the one that enters.
  static constexpr int kMaxContacts = ActiveSet::kCapacity + 1;

  /// `friction` null: there are no contacts, and half spaces are those of the rows. The arguments must outlive the set.
  /// `last`: the last motion, which decides between static and kinetic friction. `work` counts what the set does.
  ContactSet(ContactRows& rows, const Motion& wanted, const CouplingMetric& metric, const ContactFriction* friction,
             const Motion& last, WorkMeter& work) noexcept;

  const ContactRows& rows() const noexcept { return rows_; }
  const CouplingMetric& metric() const noexcept { return metric_; }
  const ContactFriction* friction() const noexcept { return friction_; }
  const Motion& last() const noexcept { return last_; }
  WorkMeter& work() const noexcept { return work_; }
  const CouplingSpace& space() const noexcept { return space_; }
  void set_space(const CouplingSpace& space) noexcept { space_ = space; }
  /// Returns the wanted motion as (x, rho r) [m].
  const Vector6& wanted() const noexcept { return wanted_; }
  /// Sets the metric with viscous friction: H = I + mu_v sum of w_i T_i' T_i, where w_i is the contact's share of the
  /// load and T_i maps the motion to the slip of the contact. `load`: of each contact [m].
  void set_viscous_metric(const std::array<double, kMaxContacts>& load) noexcept;
  /// Returns the wanted motion in the coordinates of `space` [m].
  Vector6 target() const noexcept { return space_.target(wanted_); }

  ActiveSet& active() noexcept { return active_; }
  const ActiveSet& active() const noexcept { return active_; }
  /// Returns the current motion as (x, rho r) [m], and as a Motion.
  Vector6 plain_motion() const noexcept { return space_.plain(active_.z()); }
  Motion motion() const noexcept { return space_.motion(plain_motion()); }

  int contact_count() const noexcept { return contact_count_; }
  Contact& contact(int k) noexcept { return contacts_[static_cast<std::size_t>(k)]; }
  const Contact& contact(int k) const noexcept { return contacts_[static_cast<std::size_t>(k)]; }
  /// Returns the contact of half space `j` of the active set.
  Contact& contact_of(int j) noexcept { return contact(active_[j].tag.contact); }
  const Contact& contact_of(int j) const noexcept { return contact(active_[j].tag.contact); }

  /// Returns the row that `m` violates most; rows of contacts are excluded.
  ContactRows::Violated most_violated(const Motion& m) const noexcept {
    work_.add(Work::kScan, rows_.count);
    return rows_.most_violated(m, metric_.tolerance);
  }
  /// Returns the displacement in the motion `m`: along the normal that of the contact point, across it that of its
  /// grip.
  Slip slip_of(const Contact& contact, const Motion& m) const noexcept {
    Slip slip;
    slip.approach = contact.normal.dot(m.translation + m.rotation.cross(contact.point));
    const Vector3 v = m.translation + m.rotation.cross(contact.grip);
    const Vector3 tangential = v - contact.normal.dot(v) * contact.normal;
    slip.speed = tangential.norm();
    if (slip.speed > metric_.still) slip.direction = tangential / slip.speed;
    return slip;
  }
  /// Returns mu_s if the point did not slip in the last motion, otherwise mu_k; 0 without friction.
  double ratio_of(const Contact& contact) const noexcept;

  /// Returns the half space n . v >= required gain of a row.
  ActiveSet::Inequality row_half_space(std::uint32_t row) const noexcept;
  /// Returns the half space of a contact's cone for d = `slip`.
  ActiveSet::Inequality cone_half_space(int contact, const Vector3& slip) const noexcept;

  /// Makes the row a contact without shift and returns its number. The caller must add a half space of it, or close it.
  int open(std::uint32_t row) noexcept;
  /// Makes a contact without half spaces a row again; the last contact takes its number.
  void close(int contact) noexcept;
  /// Makes contacts without a half space rows again.
  void close_idle() noexcept;
  /// Makes all contacts rows again; the active set stays.
  void close_all() noexcept;

  /// Adds a half space that the motion violates. False: it contradicts the others.
  bool add(const ActiveSet::Inequality& half_space) noexcept {
    ++additions_;
    work_.add(Work::kExchange);
    return active_.add(half_space);
  }
  /// Makes the row a contact that slips as in the motion `m`, for Newton's method. False: the active set is full.
  bool enter(std::uint32_t row, const Motion& m) noexcept;
  /// Returns the number of half spaces that were added so far.
  std::uint32_t additions() const noexcept { return additions_; }

  /// Updates the half spaces to the contacts' ratios and shifts and solves for them; half spaces that would pull leave.
  void resolve() noexcept;
  /// Restarts at the wanted motion, in the metric without viscous friction and without contacts.
  void restart() noexcept;
  /// Restarts at the current motion, in the metric without viscous friction and without contacts.
  void restart_from_motion() noexcept;

  struct Saved;
  Saved save() const noexcept;
  void restore(const Saved& saved) noexcept;

 private:
  ContactRows& rows_;
  const CouplingMetric& metric_;
  const ContactFriction* friction_;
  const Motion& last_;
  WorkMeter& work_;
  Vector6 wanted_;  // (x, rho r)
  CouplingSpace space_;
  ActiveSet active_;
  std::array<Contact, kMaxContacts> contacts_;
  int contact_count_ = 0;
  std::uint32_t additions_ = 0;
};

/// A copy of the active set and its contacts, without the metric: after a change of it the caller restores that, too.
struct ContactSet::Saved {
  ActiveSet active;
  std::array<Contact, kMaxContacts> contacts;
  int contact_count;
};

}  // namespace godobject::detail
