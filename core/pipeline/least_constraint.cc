#include "core/pipeline/least_constraint.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "core/pipeline/dual_active_set.h"
#include "core/pipeline/small_system.h"

namespace godobject {
namespace {

constexpr int kMaxContacts = 12;

/// A half space n . v >= need (direction zero) or (n - mu d) . v >= need - shift of the contact `contact`.
struct Tag {
  std::uint32_t row = ContactRows::kNone;
  int contact = 0;  // with friction: index into Solver::contacts_
  Vector3 slip = Vector3::Zero();
};
using ActiveSet = DualActiveSet<Tag>;

/// A contact point that carries a force.
struct Contact {
  std::uint32_t row = ContactRows::kNone;
  Vector3 normal;
  Vector3 point;
  double need = 0.0;
  double ratio = 0.0;  // mu
  double shift = 0.0;  // |slip| that the cone is shifted by
  double speed = 0.0;  // |slip| at the last Newton step
  int reversals = 0;   // Newton steps in a row at which the slip went with the force
  bool slips = false;
  bool held = false;  // by three half spaces, whatever its slip was
};

struct Slip {
  double approach = 0.0;  // n . v
  double speed = 0.0;     // |slip|
  Vector3 direction = Vector3::Zero();
};

class Solver {
 public:
  Solver(ContactRows& rows, const CouplingMetric& metric, const ContactFriction* friction, const Motion& last) noexcept
      : rows_(rows), metric_(metric), friction_(friction), last_(last) {}

  /// False: infeasible.
  bool run(const Motion& wanted, ConstrainedStep& step) noexcept {
    target_ << wanted.translation, metric_.gyration * wanted.rotation;
    set_.start(transformed(target_));
    guess(step);
    bool feasible = true;
    if (friction_ == nullptr) {
      feasible = meet_rows(100);
      take(step);
      step.follows = set_.size() == 0;
    } else {
      bool converged = crawls(step) && sticks();
      if (!converged) converged = polish();
      for (int round = 0; round < kRounds && !converged; ++round) {
        meet_cones();  // with shifts that are too small the cones may contradict each other where the rows do not
        converged = polish();
      }
      if (converged) come_to_rest();
      take(step);
      step.follows = converged && set_.size() == 0;
      if (converged && rests()) step.motion = Motion{};
      step.unconverged = !converged;
      release_contacts();
      if (!converged) {
        const Vector6 reached = motion_vector();
        whitened_ = false;
        set_.start(reached);
        feasible = meet_rows(100);
        step.motion = motion();
      }
    }
    step.iterations = iterations_;
    return feasible;
  }

 private:
  static constexpr double kHalfRootThree = 0.8660254037844386;
  static constexpr int kRounds = 5;
  static constexpr int kAdditions = 24;           // a round
  static constexpr double kConeTolerance = 0.01;  // of the rows': cones are in double precision, and rest is exact

  // -- the six-dimensional space: z = (x, rho r), or L' z where viscous friction has made the metric H = L L'

  Vector6 plain(const Vector3& push, const Vector3& point) const noexcept {
    Vector6 c;
    c << push, point.cross(push) / metric_.gyration;
    return c;
  }
  Vector6 lifted(const Vector3& push, const Vector3& point) const noexcept {
    const Vector6 c = plain(push, point);
    return whitened_ ? Vector6(whiten_ * c) : c;
  }
  Vector6 transformed(const Vector6& target) const noexcept { return whitened_ ? Vector6(whiten_ * target) : target; }
  Vector6 motion_vector() const noexcept { return whitened_ ? Vector6(whiten_.transpose() * set_.z()) : set_.z(); }
  Motion motion() const noexcept {
    const Vector6 z = motion_vector();
    return {z.head<3>(), z.tail<3>() / metric_.gyration};
  }

  // -- rows

  ContactRows::Violated worst_row(const Motion& m) const noexcept { return rows_.most_violated(m, metric_.tolerance); }

  bool is_active(std::uint32_t row) const noexcept {
    for (int i = 0; i < set_.size(); ++i) {
      if (set_[i].tag.row == row) return true;
    }
    return false;
  }

  ActiveSet::Inequality normal_inequality(std::uint32_t row) const noexcept {
    ActiveSet::Inequality half_space;
    half_space.gradient = lifted(rows_.normal(row), rows_.point(row));
    half_space.rhs = static_cast<double>(rows_.need[row]);
    half_space.tag.row = row;
    return half_space;
  }

  /// Frictionless: adds rows until all are met.
  bool meet_rows(int additions) noexcept {
    for (int i = 0; i < additions; ++i) {
      const ContactRows::Violated worst = worst_row(motion());
      if (worst.row == ContactRows::kNone || is_active(worst.row)) return true;  // active: violated by rounding only
      ++iterations_;
      if (!set_.add(normal_inequality(worst.row))) return false;
    }
    return true;
  }

  // -- contacts with friction

  Slip slip_of(const Contact& contact, const Motion& m) const noexcept {
    const Vector3 v = m.translation + m.rotation.cross(contact.point);
    Slip slip;
    slip.approach = contact.normal.dot(v);
    const Vector3 tangential = v - slip.approach * contact.normal;
    slip.speed = tangential.norm();
    if (slip.speed > metric_.still) slip.direction = tangential / slip.speed;
    return slip;
  }

  ActiveSet::Inequality cone_inequality(int contact, const Vector3& slip) const noexcept {
    const Contact& c = contacts_[static_cast<std::size_t>(contact)];
    ActiveSet::Inequality half_space;
    half_space.gradient = lifted(c.normal - c.ratio * slip, c.point);
    half_space.rhs = c.need - c.ratio * c.shift;
    half_space.tag = {c.row, contact, slip};
    return half_space;
  }

  /// Static friction for a point that did not slip in the last motion.
  double ratio_of(const Contact& c) const noexcept {
    return slip_of(c, last_).speed > metric_.still ? friction_->kinetic_ratio : friction_->static_ratio;
  }

  /// Takes a row out of the scan and gives it a cone; -1 if there is no room.
  int open_contact(std::uint32_t row, double shift) noexcept {
    if (contact_count_ == kMaxContacts) return -1;
    Contact& c = contacts_[static_cast<std::size_t>(contact_count_)];
    c.row = row;
    c.normal = rows_.normal(row).normalized();  // single precision would let a slip of nanometres lean
    c.point = rows_.point(row);
    c.need = static_cast<double>(rows_.need[row]);
    const double moved = slip_of(c, last_).speed;
    c.ratio = ratio_of(c);
    c.reversals = 0;
    c.shift = shift < 0.0 ? moved : shift;
    c.slips = false;
    c.held = false;
    rows_.need[row] = -FLT_MAX;
    return contact_count_++;
  }

  void release_contacts() noexcept {
    for (int i = 0; i < contact_count_; ++i) {
      const Contact& c = contacts_[static_cast<std::size_t>(i)];
      rows_.need[c.row] = static_cast<float>(c.need);
    }
    contact_count_ = 0;
  }

  /// Contacts without a half space in the set go back to the rows.
  void close_idle_contacts() noexcept {
    int kept = 0;
    for (int i = 0; i < contact_count_; ++i) {
      const Contact c = contacts_[static_cast<std::size_t>(i)];
      bool used = false;
      for (int j = 0; j < set_.size(); ++j) {
        if (set_[j].tag.contact != i) continue;
        used = true;
        set_.at(j).tag.contact = kept;
      }
      if (used) {
        contacts_[static_cast<std::size_t>(kept++)] = c;
      } else {
        rows_.need[c.row] = static_cast<float>(c.need);
      }
    }
    contact_count_ = kept;
  }

  /// Whether what carried the load in the last motion slipped by next to nothing of what friction held back, so that it
  /// may come to rest now.
  bool crawls(const ConstrainedStep& step) const noexcept {
    constexpr double kCrawl = 0.02;
    for (std::uint32_t i = 0; i < step.force_count; ++i) {
      const ContactForce& force = step.forces[i];
      const Vector3 v = last_.translation + last_.rotation.cross(force.point);
      const double speed = (v - force.normal.dot(v) * force.normal).norm();
      if (speed > metric_.still + kCrawl * friction_->kinetic_ratio * force.multiplier) return false;
    }
    return true;
  }

  /// Whether forces inside the cones can hold all that carries load at rest. Without shifts the convex problem says so
  /// for certain, redundant contacts or not; Coulomb's law may have solutions that slip beside it, and rest is the one
  /// to take.
  bool sticks() noexcept {
    for (int k = 0; k < contact_count_; ++k) contacts_[static_cast<std::size_t>(k)].shift = 0.0;
    resume();
    shifted_ = false;
    const bool met = meet_cones();
    shifted_ = true;
    if (!met) return false;
    const Motion m = motion();
    for (int k = 0; k < contact_count_; ++k) {
      if (slip_of(contacts_[static_cast<std::size_t>(k)], m).speed > metric_.still) return false;
    }
    return true;
  }

  /// All contacts stick, and the tolerances explain what is left of the motion: then it is none, or rest would creep.
  bool rests() const noexcept {
    const Motion m = motion();
    if (contact_count_ == 0 || motion_vector().norm() > metric_.tolerance) return false;
    for (int k = 0; k < contact_count_; ++k) {
      if (slip_of(contacts_[static_cast<std::size_t>(k)], m).speed > metric_.still) return false;
    }
    return true;
  }

  /// A motion that the tolerances may explain ends, if forces inside the cones can hold it.
  void come_to_rest() noexcept {
    if (contact_count_ == 0 || motion_vector().norm() > metric_.tolerance || rests()) return;
    const Found found = save();
    if (!sticks()) restore(found);
  }

  struct Found {
    ActiveSet set;
    std::array<Contact, kMaxContacts> contacts;
    int contact_count;
  };

  Found save() const noexcept { return {set_, contacts_, contact_count_}; }

  void restore(const Found& found) noexcept {
    release_contacts();
    set_ = found.set;
    contacts_ = found.contacts;
    contact_count_ = found.contact_count;
    for (int k = 0; k < contact_count_; ++k) rows_.need[contacts_[static_cast<std::size_t>(k)].row] = -FLT_MAX;
  }

  /// With the shifts held: adds half spaces until all rows and cones are met.
  bool meet_cones() noexcept {
    for (int i = 0; i < kAdditions; ++i) {
      const Motion m = motion();
      const ContactRows::Violated worst = worst_row(m);
      double largest = worst.row == ContactRows::kNone ? kConeTolerance * metric_.tolerance : worst.violation;
      int in_cone = -1;
      Slip slip;
      for (int k = 0; k < contact_count_; ++k) {
        const Contact& c = contacts_[static_cast<std::size_t>(k)];
        const Slip s = slip_of(c, m);
        const double violation = c.need + c.ratio * (s.speed - c.shift) - s.approach;
        if (violation > largest) {
          largest = violation;
          in_cone = k;
          slip = s;
        }
      }
      if (in_cone < 0 && worst.row == ContactRows::kNone) return true;
      ++iterations_;
      if (in_cone < 0) {
        in_cone = open_contact(worst.row, 0.0);
        if (in_cone < 0) return true;
        Contact& c = contacts_[static_cast<std::size_t>(in_cone)];
        slip = slip_of(c, m);
        c.shift = shifted_ ? slip.speed : 0.0;
      }
      const bool added = set_.add(cone_inequality(in_cone, slip.direction));
      close_idle_contacts();
      if (!added) return false;
    }
    return true;
  }

  /// Newton's method on Coulomb's law itself, for contacts that each slip (one half space, the force opposes the slip,
  /// the gap is met exactly) or stick (half spaces as equalities):
  ///     z = z_d + sum f_j lambda_j,   g_j z = rhs_j,   f_j = n - mu d_j,   g_j = n (slipping) or f_j (sticking)
  /// d_j = slip / |slip| turns with z: to first order a force -(mu lambda / |slip|) (slip across d_j), which goes into
  /// the metric and vanishes at the solution. A contact whose force would pull leaves, the row violated most enters.
  /// True if it ended where all is met; the half spaces, with the shifts that belong to the motion, are then the set.
  /// Otherwise the set is the old one, with other shifts for the convex problem to go on from.
  bool polish() noexcept {
    constexpr int kSteps = 24;
    constexpr int kPatience = 2;
    const Found found = save();
    Motion m = motion();
    bool fits = false;
    for (int step = 0; step < kSteps; ++step) {
      gather(m);
      const Newton result = newton_step(fits || step >= kPatience, m);
      if (result == Newton::kFailed) break;
      fits = result != Newton::kOn;
      if (result == Newton::kOn) continue;
      const ContactRows::Violated worst = worst_row(m);
      if (worst.row == ContactRows::kNone && result == Newton::kSettled) continue;
      if (worst.row == ContactRows::kNone) {
        const int size = set_.size();
        for (int k = 0; k < contact_count_; ++k) {
          Contact& c = contacts_[static_cast<std::size_t>(k)];
          c.shift = c.slips ? slip_of(c, m).speed : 0.0;
        }
        resume();
        const Motion held = motion();
        const double moved = (held.translation - m.translation).squaredNorm() +
                             (metric_.gyration * (held.rotation - m.rotation)).squaredNorm();
        if (set_.size() == size && moved <= metric_.tolerance * metric_.tolerance) return true;
        break;
      }
      const int entering = set_.size() < ActiveSet::kCapacity ? open_contact(worst.row, 0.0) : -1;
      if (entering < 0) break;
      ++iterations_;
      set_.guess(cone_inequality(entering, slip_of(contacts_[static_cast<std::size_t>(entering)], m).direction));
    }
    restore(found);
    for (int k = 0; k < contact_count_; ++k) {
      Contact& c = contacts_[static_cast<std::size_t>(k)];
      c.shift = failures_ == 0 ? 0.0 : 0.5 * (c.shift + slip_of(c, motion()).speed);
    }
    ++failures_;
    resume();
    return false;
  }

  /// Brings the half spaces up to date with the contacts' ratios and shifts.
  void resume() noexcept {
    for (int j = 0; j < set_.size(); ++j) {
      set_.at(j) = cone_inequality(set_[j].tag.contact, Vector3(set_[j].tag.slip));
    }
    set_.resolve(transformed(target_));
    close_idle_contacts();
  }

  int half_spaces_of(int contact) const noexcept {
    int count = 0;
    for (int j = 0; j < set_.size(); ++j) count += set_[j].tag.contact == contact ? 1 : 0;
    return count;
  }

  /// One half space a slipping contact, against the force that its half spaces give: near rest that is known far better
  /// than the direction of slip. Kinetic friction for what slips.
  void gather(const Motion& m) noexcept {
    constexpr double kKnown = 0.1;
    for (int k = 0; k < contact_count_; ++k) {
      Contact& c = contacts_[static_cast<std::size_t>(k)];
      const Slip slip = slip_of(c, m);
      const bool begins = !c.slips && !c.held && slip.speed > metric_.still;
      if (begins) {
        c.slips = true;
        c.speed = slip.speed;
        c.ratio = friction_->kinetic_ratio;
      }
      if (!begins) {
        c.held = !c.slips && half_spaces_of(k) == 3;
        continue;
      }
      int first = -1;
      Vector3 pull = Vector3::Zero();
      double load = 0.0;
      for (int j = 0; j < set_.size(); ++j) {
        if (set_[j].tag.contact != k) continue;
        pull += set_[j].multiplier * set_[j].tag.slip;
        load += set_[j].multiplier;
        if (first < 0) {
          first = j;
        } else {
          set_.erase(j--);
        }
      }
      if (first < 0) continue;
      const double length = pull.norm();
      set_.at(first).multiplier = load;
      set_.at(first).tag.slip = length > kKnown * load ? Vector3(pull / length) : slip.direction;
    }
  }

  /// kSettled: the motion is found, the directions of slip are not.
  enum class Newton { kConverged, kSettled, kOn, kFailed };

  /// From the motion `m` to the next. Unknowns: the multipliers, and for each slipping contact the force tau across its
  /// slip, with tau = -(mu lambda / |slip|) (slip across).
  Newton newton_step(bool fits, Motion& m) noexcept {
    constexpr std::size_t kMost = 2 * ActiveSet::kCapacity;
    const int n = set_.size();
    if (friction_->viscous_step > 0.0) follow_viscous();
    const Vector6 target = transformed(target_);
    std::array<Vector6, kMost> force;  // of unit size, in columns
    std::array<Vector6, ActiveSet::kCapacity> row;
    SmallSystem<kMost> system;
    system.size = n;
    std::array<int, ActiveSet::kCapacity> across{};  // column of tau
    std::array<double, ActiveSet::kCapacity> compliance{};
    for (int j = 0; j < n; ++j) {
      const auto at = static_cast<std::size_t>(j);
      const Contact& c = contacts_[static_cast<std::size_t>(set_[j].tag.contact)];
      const Vector3& slip = set_[j].tag.slip;
      force[at] = lifted(c.normal - c.ratio * slip, c.point);
      row[at] = c.slips ? lifted(c.normal, c.point) : force[at];
      across[at] = -1;
      const double stiffness = c.ratio * set_[j].multiplier;
      if (c.slips && stiffness > 0.0) {
        across[at] = system.size;
        compliance[at] = c.speed / stiffness;
        force[static_cast<std::size_t>(system.size++)] = lifted(c.normal.cross(slip), c.point);
      }
    }
    for (int j = 0; j < n; ++j) {
      const auto at = static_cast<std::size_t>(j);
      const Contact& c = contacts_[static_cast<std::size_t>(set_[j].tag.contact)];
      for (int k = 0; k < system.size; ++k) system.matrix[j][k] = row[at].dot(force[static_cast<std::size_t>(k)]);
      system.rhs[j] = c.need - row[at].dot(target);
      if (across[at] < 0) continue;
      const int i = across[at];
      const Vector6& e = force[static_cast<std::size_t>(i)];
      for (int k = 0; k < system.size; ++k) system.matrix[i][k] = e.dot(force[static_cast<std::size_t>(k)]);
      system.matrix[i][i] += compliance[at];
      system.rhs[i] = -e.dot(target);
    }
    if (!system.solve()) return Newton::kFailed;
    Vector6 z = target;
    for (int k = 0; k < system.size; ++k) z += system.rhs[k] * force[static_cast<std::size_t>(k)];
    if (whitened_) z = whiten_.transpose() * z;
    const double* const multiplier = system.rhs;
    if (!z.allFinite()) return Newton::kFailed;
    // a pull means that a contact is not there, unless the directions of slip do not fit yet
    if (fits && drop_first_to_vanish(multiplier)) return Newton::kOn;
    // a motion that stands still is found, whatever direction a slip of nanometres may have
    const bool settled =
        (z.head<3>() - m.translation).squaredNorm() + (z.tail<3>() - metric_.gyration * m.rotation).squaredNorm() <=
        metric_.tolerance * metric_.tolerance;
    m = {z.head<3>(), z.tail<3>() / metric_.gyration};
    // the shares of viscous friction are those of the step before
    Newton result = settled || !(friction_->viscous_step > 0.0) ? Newton::kConverged : Newton::kOn;
    for (int j = 0; j < n; ++j) {
      const double changed = std::fabs(multiplier[j] - set_[j].multiplier);
      if (friction_->viscous_step > 0.0 && changed > metric_.tolerance) result = Newton::kOn;
      set_.at(j).multiplier = multiplier[j];
      Contact& c = contacts_[static_cast<std::size_t>(set_[j].tag.contact)];
      const Slip slip = slip_of(c, m);
      if (!c.slips) {
        if (slip.speed > metric_.still && !settled) result = Newton::kOn;
        continue;
      }
      // where the force of this step pointed, for the same reason
      const Vector3 old = set_[j].tag.slip;
      const double along = slip.speed * slip.direction.dot(old);
      Vector3 pull = c.speed * old + (slip.speed * slip.direction - along * old);
      pull -= c.normal.dot(pull) * c.normal;  // rounding grows where the slip is much larger than the speed it had
      const Vector3 direction = pull.normalized();
      const bool turned = c.ratio * multiplier[j] * (direction - slip.direction).norm() > metric_.tolerance ||
                          c.ratio * multiplier[j] * (direction - old).norm() > metric_.tolerance;
      if (turned && !(settled && slip.speed <= metric_.tolerance)) result = settled ? Newton::kSettled : Newton::kOn;
      set_.at(j).tag.slip = direction;
      const double speed = slip.speed * slip.direction.dot(direction);
      c.speed = speed > 0.25 * c.speed ? speed : 0.25 * c.speed;
      c.reversals = speed < 0.0 ? c.reversals + 1 : 0;
    }
    bool switched = false;
    for (int k = 0; k < contact_count_; ++k) switched = hold_or_release(k) || switched;
    if (switched) {
      close_idle_contacts();
      return Newton::kOn;
    }
    if (result != Newton::kOn && drop_first_to_vanish(multiplier)) return Newton::kOn;
    return result;
  }

  /// On the way from the forces of the set to the new ones, stops where the first of them vanishes and lets it go.
  /// False if none does. A contact that is held has one force.
  bool drop_first_to_vanish(const double* multiplier) noexcept {
    int first = -1;
    double way = 1.0;
    for (int j = 0; j < set_.size(); ++j) {
      double from = set_[j].multiplier;
      double to = multiplier[j];
      if (contacts_[static_cast<std::size_t>(set_[j].tag.contact)].held) {
        from = to = 0.0;
        for (int i = 0; i < set_.size(); ++i) {
          if (set_[i].tag.contact != set_[j].tag.contact) continue;
          from += set_[i].multiplier;
          to += multiplier[i];
        }
      }
      if (!(to < 0.0)) continue;
      from = std::max(0.0, from);
      const double vanishes = from / (from - to);
      if (first < 0 || vanishes < way) {
        first = j;
        way = vanishes;
      }
    }
    if (first < 0) return false;
    for (int j = 0; j < set_.size(); ++j) {
      const double from = std::max(0.0, set_[j].multiplier);
      set_.at(j).multiplier = std::max(0.0, from + way * (multiplier[j] - from));
    }
    const int contact = set_[first].tag.contact;
    const bool held = contacts_[static_cast<std::size_t>(contact)].held;
    for (int j = set_.size() - 1; j >= 0; --j) {
      if (j == first || (held && set_[j].tag.contact == contact)) set_.erase(j);
    }
    close_idle_contacts();
    return true;
  }

  /// A contact whose slip goes with its force instead of against it sticks: three half spaces hold it. One that is held
  /// by a force outside of the cone begins to slip. True if either has happened.
  bool hold_or_release(int contact) noexcept {
    constexpr int kReversals = 2;
    Contact& c = contacts_[static_cast<std::size_t>(contact)];
    if (c.slips) {
      if (c.reversals < kReversals || set_.size() + 2 > ActiveSet::kCapacity) return false;
      int at = 0;
      while (set_[at].tag.contact != contact) ++at;
      const Vector3 along = set_[at].tag.slip;
      const double load = set_[at].multiplier;
      const Vector3 across = c.normal.cross(along);
      c.slips = false;
      c.held = true;
      c.reversals = 0;
      c.ratio = ratio_of(c);
      set_.at(at) = cone_inequality(contact, along);
      set_.at(at).multiplier = load;
      (void)set_.guess(cone_inequality(contact, -0.5 * along + kHalfRootThree * across));
      (void)set_.guess(cone_inequality(contact, -0.5 * along - kHalfRootThree * across));
      return true;
    }
    return spread(contact);
  }

  /// The force of a contact that is held by three half spaces: where it lies in the cone, as three pushes about it;
  /// else the contact begins to slip, and the answer is true.
  bool spread(int contact) noexcept {
    std::array<int, 3> at{};
    std::size_t count = 0;
    double load = 0.0;
    Vector3 pull = Vector3::Zero();
    for (int j = 0; j < set_.size(); ++j) {
      if (set_[j].tag.contact != contact) continue;
      if (count == at.size()) return false;
      at[count++] = j;
      load += set_[j].multiplier;
      pull += set_[j].multiplier * set_[j].tag.slip;
    }
    const double length = pull.norm();
    Contact& c = contacts_[static_cast<std::size_t>(contact)];
    if (count < at.size()) return false;
    if (!(load > 0.0)) {  // it would have to pull
      for (std::size_t i = at.size(); i-- > 0;) set_.erase(at[i]);
      return true;
    }
    const Vector3 along = length > 0.0 ? Vector3(pull / length) : Vector3(set_[at[0]].tag.slip);
    if (length > load) {
      set_.erase(at[2]);
      set_.erase(at[1]);
      c.slips = true;
      c.held = false;
      c.speed = metric_.still;
      c.ratio = friction_->kinetic_ratio;
      set_.at(at[0]).tag.slip = along;
      set_.at(at[0]).multiplier = load;
      return true;
    }
    const Vector3 across = c.normal.cross(along);
    const double share = length / load;
    for (std::size_t i = 0; i < at.size(); ++i) {
      constexpr std::array<double, 3> kSine = {0.0, kHalfRootThree, -kHalfRootThree};
      constexpr std::array<double, 3> kCosine = {1.0, -0.5, -0.5};
      set_.at(at[i]).tag.slip = kCosine[i] * along + kSine[i] * across;
      set_.at(at[i]).multiplier = load * (i == 0 ? 1.0 + 2.0 * share : 1.0 - share) / 3.0;
    }
    return false;
  }

  /// Viscous friction as part of the metric: H = I + mu_v sum of w_i T_i' T_i, w_i the contact's share of the load, T_i
  /// the slip of the contact.
  void follow_viscous() noexcept {
    double load = 0.0;
    for (int j = 0; j < set_.size(); ++j) load += set_[j].multiplier;
    Matrix6 H = Matrix6::Identity();
    for (int k = 0; k < contact_count_ && load > 0.0; ++k) {
      const Contact& c = contacts_[static_cast<std::size_t>(k)];
      double share = 0.0;
      for (int j = 0; j < set_.size(); ++j) {
        if (set_[j].tag.contact == k) share += set_[j].multiplier / load;
      }
      Matrix3 cross;  // v = x + r x P = x - P x r
      cross << 0.0, -c.point.z(), c.point.y(), c.point.z(), 0.0, -c.point.x(), -c.point.y(), c.point.x(), 0.0;
      Eigen::Matrix<double, 3, 6> velocity;
      velocity << Matrix3::Identity(), -cross / metric_.gyration;
      const Eigen::Matrix<double, 3, 6> tangential = velocity - c.normal * (c.normal.transpose() * velocity);
      H += friction_->viscous_step * share * tangential.transpose() * tangential;
    }
    whiten_ = Eigen::LLT<Matrix6>(H).matrixL().solve(Matrix6::Identity());
    whitened_ = true;
  }

  // -- from the last cycle, to the next

  void guess(const ConstrainedStep& step) noexcept {
    for (std::uint32_t i = 0; i < step.force_count; ++i) {
      const ContactForce& force = step.forces[i];
      const std::uint32_t* const end = rows_.id + rows_.count;
      const std::uint32_t* const found = std::find(static_cast<const std::uint32_t*>(rows_.id), end, force.id);
      if (found == end) continue;
      const auto row = static_cast<std::uint32_t>(found - rows_.id);
      if (friction_ == nullptr) {
        set_.guess(normal_inequality(row));
        continue;
      }
      int contact = -1;
      for (int k = 0; k < contact_count_; ++k) {
        if (contacts_[static_cast<std::size_t>(k)].row == row) contact = k;
      }
      if (contact < 0) contact = open_contact(row, -1.0);
      if (contact < 0) continue;
      const Vector3& normal = contacts_[static_cast<std::size_t>(contact)].normal;
      Vector3 slip = force.slip - normal.dot(force.slip) * normal;
      const double length = slip.norm();
      slip = length > 0.5 ? Vector3(slip / length) : Vector3::Zero();
      set_.guess(cone_inequality(contact, slip));
    }
    set_.resolve();
    if (friction_ != nullptr) close_idle_contacts();
  }

  void take(ConstrainedStep& step) const noexcept {
    step.motion = motion();
    step.force_count = static_cast<std::uint32_t>(set_.size());
    step.contact_count = 0;
    for (int j = 0; j < set_.size(); ++j) {
      ContactForce& force = step.forces[static_cast<std::size_t>(j)];
      const std::uint32_t row = set_[j].tag.row;
      bool counted = false;
      for (int i = 0; i < j; ++i) counted |= set_[i].tag.row == row;
      step.contact_count += counted ? 0 : 1;
      force.id = rows_.id[row];
      force.slip = set_[j].tag.slip;
      force.point = rows_.point(row);
      force.normal = rows_.normal(row);
      force.ratio = friction_ == nullptr ? 0.0 : contacts_[static_cast<std::size_t>(set_[j].tag.contact)].ratio;
      force.multiplier = set_[j].multiplier;
    }
  }

  ContactRows& rows_;
  const CouplingMetric& metric_;
  const ContactFriction* friction_;
  const Motion& last_;
  Vector6 target_ = Vector6::Zero();
  ActiveSet set_;
  std::array<Contact, kMaxContacts> contacts_;
  int contact_count_ = 0;
  std::uint32_t iterations_ = 0;
  int failures_ = 0;
  bool shifted_ = true;
  bool whitened_ = false;
  Matrix6 whiten_ = Matrix6::Identity();
};

}  // namespace

void least_constraint(ContactRows& rows, const Motion& wanted, const CouplingMetric& metric,
                      const ContactFriction* friction, const Motion& last, ConstrainedStep& step) noexcept {
  step.infeasible = false;
  step.unconverged = false;
  if (rows.count == 0) {
    step = ConstrainedStep{};
    step.motion = wanted;
    step.follows = true;
    return;
  }
  Solver solver(rows, metric, friction, last);
  if (solver.run(wanted, step)) return;
  for (std::uint32_t i = 0; i < rows.count; ++i) rows.need[i] = std::min(rows.need[i], 0.0f);
  step.force_count = 0;
  Solver again(rows, metric, friction, last);
  again.run(wanted, step);
  step.infeasible = true;
}

}  // namespace godobject
