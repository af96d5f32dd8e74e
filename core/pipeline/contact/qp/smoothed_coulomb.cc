#include "core/pipeline/contact/qp/smoothed_coulomb.h"

#include <algorithm>
#include <cmath>

#include "core/pipeline/contact/qp/combined_forces.h"
#include "core/pipeline/contact/qp/small_system.h"

namespace godobject::detail {
namespace {

constexpr std::size_t kMostContacts = ContactSet::kMaxContacts;
// c of the attempts, over the inverse of the contact's own compliance. Measured on pegs in their holes: each alone
// leaves some unsolved that another solves.
constexpr std::array<double, 3> kScales = {100.0, 1.0, 1000.0};
constexpr double kShrink = 0.2;    // of the smoothing; measured on the same: 0.1 and 0.3 leave more unsolved
constexpr int kMostRounds = 40;    // of rows that enter, contacts that begin to slip, and metrics; mostly 1 to 6
constexpr double kEnd = 1e-3;      // of the smoothing, over the tolerance
constexpr double kOfForce = 0.01;  // accuracy of a force, over the tolerance
// A step counts once for each contact, since its time grows in proportion: few contacts get more steps.
constexpr int kWorkOfAttempt = kMostSmoothedSteps / static_cast<int>(kScales.size()) * ContactSet::kMaxContacts;

/// max(0, value), smoothed: it differs by at most the smoothing.
struct SmoothPart {
  double root;
  double value;
  double slope;

  SmoothPart(double at, double smoothing) noexcept : root(std::sqrt(at * at + 4.0 * smoothing * smoothing)) {
    value = at > 0.0 ? 0.5 * (at + root) : 2.0 * smoothing * smoothing / (root - at);
    slope = 0.5 * (1.0 + at / root);
  }
};

/// The smoothed projection of w on the cone w_0 >= |w_t|, and its derivative.
struct SmoothProjection {
  Vector3 value;
  Matrix3 derivative;

  SmoothProjection(const Vector3& w, double smoothing) noexcept {
    const double length = w.tail<2>().norm();
    const Eigen::Vector2d along = length > 0.0 ? Eigen::Vector2d(w.tail<2>() / length) : Eigen::Vector2d(1.0, 0.0);
    const SmoothPart low(w[0] - length, smoothing);
    const SmoothPart high(w[0] + length, smoothing);
    // (high.value - low.value) / (2 length), without the cancellation at a small length
    const double across = 0.5 + w[0] / (high.root + low.root);
    value << 0.5 * (low.value + high.value), across * w.tail<2>();
    const double both = 0.5 * (low.slope + high.slope);
    const double mixed = 0.5 * (high.slope - low.slope);
    derivative(0, 0) = both;
    derivative.block<1, 2>(0, 1) = mixed * along.transpose();
    derivative.block<2, 1>(1, 0) = mixed * along;
    derivative.block<2, 2>(1, 1) = across * Eigen::Matrix2d::Identity() + (both - across) * along * along.transpose();
  }
};

/// Returns the unit of the normal coordinate in the cone of a contact: mu. Without friction the cone is a ray, which
/// any unit fits.
double unit_of(const Contact& contact) noexcept { return contact.has_friction ? contact.ratio : 1.0; }

/// A contact in the coordinates of its cone.
struct ConeContact {
  /// Of y without |slip|, and the change of z per unit of x. Without friction only the first column is not zero.
  Eigen::Matrix<double, 6, 3> gradient = Eigen::Matrix<double, 6, 3>::Zero();
  Vector3 first = Vector3::Zero();  ///< unit, across the normal
  Vector3 second = Vector3::Zero();
  double gain{};                ///< required gain / unit_of [m]
  double scale{};               ///< c
  Vector3 x = Vector3::Zero();  ///< force over the coupling's stiffness [m]
  Vector3 y = Vector3::Zero();  ///< [m]

  double slip() const noexcept { return y.tail<2>().norm(); }
  double gap(double unit) const noexcept { return unit * (y[0] - slip()); }
};

/// The contacts of a set and the rows that its motion violates, without an active set.
class SmoothedProblem {
 public:
  explicit SmoothedProblem(ContactSet& set) noexcept : set_(set), target_(set.target()), z_(target_) {}

  /// Takes the forces of the set's half spaces.
  void take_forces_of_set() noexcept {
    for (int k = 0; k < count(); ++k) {
      double load = 0.0;
      Vector3 pull = Vector3::Zero();
      for (int j = 0; j < set_.active().size(); ++j) {
        if (set_.active()[j].tag.contact != k) continue;
        load += set_.active()[j].multiplier;
        pull += set_.active()[j].multiplier * set_.active()[j].tag.slip;
      }
      set_frame(k);
      if (!set_.contact(k).has_friction) pull.setZero();
      at(k).x = unit_of(set_.contact(k)) * Vector3(load, -at(k).first.dot(pull), -at(k).second.dot(pull));
    }
  }

  /// Solves from the forces so far. False: it does not converge, or there are too many contacts.
  bool solve(double scale) noexcept {
    scale_ = scale;
    work_left_ = kWorkOfAttempt;
    for (int round = 0; round < kMostRounds; ++round) {
      for (int k = 0; k < count(); ++k) set_gradient(k);
      if (!converge()) return false;
      if (change_viscous_metric() || begin_to_slip()) continue;
      const ContactRows::Violated worst = set_.most_violated(motion());
      if (worst.row == ContactRows::kNone) return true;
      if (!open(worst.row)) return false;
    }
    return false;
  }

  /// Sets all forces to zero. The contacts stay, those that slipped with kinetic friction.
  void release() noexcept {
    for (int k = 0; k < count(); ++k) at(k).x.setZero();
  }

  /// Returns the forces on the cones: a slipping contact has one, a sticking one three.
  Forces forces() const noexcept {
    constexpr double kSineOfThird = 0.8660254037844386;
    Forces found;
    for (int k = 0; k < set_.contact_count(); ++k) {
      const ConeContact& cone = cones_[static_cast<std::size_t>(k)];
      const double load = cone.x[0];
      if (!carries(k)) continue;
      const double length = cone.x.tail<2>().norm();
      const Vector3 pull = -(cone.x[1] * cone.first + cone.x[2] * cone.second);
      const Vector3 along = length > 0.0 ? Vector3(pull / length) : cone.first;
      const Vector3 across = set_.contact(k).normal.cross(along);
      const double share = std::min(1.0, length / load);
      const double tolerance = set_.metric().tolerance;
      const bool sticks =
          set_.contact(k).has_friction && length < load - kOfForce * tolerance && !(cone.slip() > tolerance);
      const double third = load_on(k) / 3.0;
      found.add(force(k, along, sticks ? third * (1.0 + 2.0 * share) : 3.0 * third));
      if (!sticks) continue;
      found.add(force(k, -0.5 * along + kSineOfThird * across, third * (1.0 - share)));
      found.add(force(k, -0.5 * along - kSineOfThird * across, third * (1.0 - share)));
    }
    return found;
  }

  /// Tells whether the step can have these forces. Fewer with the same sum would share viscous friction otherwise, and
  /// without a force the motion is the wanted one.
  bool can_have(const Forces& found) const noexcept {
    if (!all_obey_law()) return false;
    if (found.count == 0) return (plain() - set_.wanted()).isZero(0.1 * set_.metric().tolerance);
    return !is_viscous() || found.count <= ActiveSet::kCapacity;
  }

  /// Stores the solution. False: the step cannot have it, and only its forces have changed.
  bool store(ConstrainedStep& step) const noexcept {
    const Forces found = forces();
    if (!can_have(found)) return false;
    if (!(store_sum(found, set_.metric().gyration, step) <= 0.1 * set_.metric().tolerance)) return false;
    if (step.force_count == 0 && found.count > 0) return false;  // forces that balance each other
    step.follows = step.force_count == 0;
    step.unconverged = false;
    step.motion = step.follows ? set_.space().motion(set_.wanted()) : motion();
    return true;
  }

  Vector6 plain() const noexcept { return set_.space().plain(z_); }
  Motion motion() const noexcept { return set_.space().motion(plain()); }

 private:
  using System = SmallSystem<3 * kMostContacts>;

  int count() const noexcept { return set_.contact_count(); }
  bool is_viscous() const noexcept { return set_.friction()->viscous_step > 0.0; }
  ConeContact& at(int k) noexcept { return cones_[static_cast<std::size_t>(k)]; }
  const ConeContact& at(int k) const noexcept { return cones_[static_cast<std::size_t>(k)]; }

  bool all_obey_law() const noexcept {
    for (int k = 0; k < count(); ++k) {
      if (!obeys_law(k)) return false;
    }
    return true;
  }

  /// Tells whether the forces that cancel each other are not much larger than the others. Where a body jams they may
  /// grow without end, and then their rounding moves it.
  bool has_moderate_forces() const noexcept {
    constexpr double kMost = 10.0;  // of the wanted motion; chosen
    for (int k = 0; k < count(); ++k) {
      if (load_on(k) > kMost * target_.norm()) return false;
    }
    return true;
  }

  /// Tells whether the contact obeys the law to the tolerance, which a slip must exceed to have a direction. Small
  /// residuals alone do not tell that: c may be small.
  bool obeys_law(int k) const noexcept {
    const double tolerance = set_.metric().tolerance;
    const ConeContact& cone = at(k);
    const double gap = cone.gap(unit_of(set_.contact(k)));
    const double load = load_on(k);
    if (!(gap >= -tolerance) || !(load >= -0.1 * tolerance)) return false;
    const double length = cone.x.tail<2>().norm();
    if (!carries(k)) return load <= 0.1 * tolerance && length <= kOfForce * tolerance;
    const double friction = cone.x[0];
    const double speed = cone.slip();
    if (!(length <= friction + kOfForce * tolerance)) return false;
    if (!(speed > tolerance)) return true;
    if (!(length >= friction - kOfForce * tolerance)) return false;
    const double off = (cone.x.tail<2>() + friction / speed * cone.y.tail<2>()).norm();
    return off <= tolerance || speed * off <= tolerance * friction;
  }

  /// Tells whether the contact carries load: not one whose force is rounding.
  bool carries(int k) const noexcept {
    return at(k).x[0] > 0.0 && at(k).gap(unit_of(set_.contact(k))) <= set_.metric().tolerance;
  }

  double load_on(int k) const noexcept { return at(k).x[0] / unit_of(set_.contact(k)); }

  void set_frame(int k) noexcept {
    at(k).first = set_.contact(k).normal.unitOrthogonal();
    at(k).second = set_.contact(k).normal.cross(at(k).first);
  }

  void set_gradient(int k) noexcept {
    const Contact& c = set_.contact(k);
    ConeContact& cone = at(k);
    cone.gradient.col(0) = set_.space().gradient(c.normal, c.point) / unit_of(c);
    if (c.has_friction) {
      cone.gradient.col(1) = set_.space().gradient(cone.first, c.grip);
      cone.gradient.col(2) = set_.space().gradient(cone.second, c.grip);
    }
    cone.gain = c.required_gain / unit_of(c);
    cone.scale = scale_ / cone.gradient.squaredNorm();
  }

  /// Sets the metric with viscous friction to the shares of the load. True: the solution is no longer one.
  bool change_viscous_metric() noexcept {
    if (!is_viscous()) return false;
    const Vector6 before = plain();
    std::array<double, kMostContacts> load{};
    for (int k = 0; k < count(); ++k) {
      if (carries(k)) load[static_cast<std::size_t>(k)] = load_on(k);
    }
    set_.set_viscous_metric(load);
    target_ = set_.target();
    for (int k = 0; k < count(); ++k) set_gradient(k);
    residual(kEnd * set_.metric().tolerance);
    return !((plain() - before).norm() < 0.1 * set_.metric().tolerance);
  }

  /// Makes the row a contact without force, in place of another without force if there is no room. False: no room.
  bool open(std::uint32_t row) noexcept {
    if (count() == static_cast<int>(kMostContacts)) {
      int idle = 0;
      for (int k = 1; k < count(); ++k) {
        if (load_on(k) < load_on(idle)) idle = k;
      }
      if (load_on(idle) > set_.metric().tolerance) return false;
      at(idle) = at(count() - 1);
      set_.close(idle);
    }
    const int k = set_.open(row);
    at(k) = ConeContact{};
    set_frame(k);
    return true;
  }

  /// Gives kinetic friction to contacts with static friction that slip. True: there were some.
  bool begin_to_slip() noexcept {
    bool any = false;
    const double kinetic = set_.friction()->kinetic_ratio;
    for (int k = 0; k < count(); ++k) {
      Contact& c = set_.contact(k);
      if (!(c.ratio > kinetic) || !(at(k).slip() > set_.metric().still)) continue;
      at(k).x *= kinetic / c.ratio;
      c.ratio = kinetic;
      any = true;
    }
    return any;
  }

  /// Computes z, y of all contacts, and the residuals x - P(x - c y); returns their norm [m].
  double residual(double smoothing) noexcept {
    z_ = target_;
    for (int k = 0; k < count(); ++k) z_ += at(k).gradient * at(k).x;
    double square = 0.0;
    for (int k = 0; k < count(); ++k) {
      ConeContact& cone = at(k);
      cone.y = cone.gradient.transpose() * z_;
      cone.y[0] += cone.slip() - cone.gain;
      const Vector3 here = cone.x - SmoothProjection(cone.x - cone.scale * cone.y, smoothing).value;
      square += here.squaredNorm();
      for (int i = 0; i < 3; ++i) system_.rhs[3 * k + i] = -here[i];
    }
    return std::sqrt(square);
  }

  /// Writes the derivatives of the residuals by all x.
  void assemble(double smoothing) noexcept {
    constexpr double kRedundant = 1e-10;  // contacts that share a load at will
    system_.size = 3 * count();
    for (int k = 0; k < count(); ++k) {
      const ConeContact& cone = at(k);
      const Matrix3 projection = SmoothProjection(cone.x - cone.scale * cone.y, smoothing).derivative;
      Matrix3 by_y = Matrix3::Identity();
      if (cone.slip() > 0.0) by_y.block<1, 2>(0, 1) = cone.y.tail<2>().transpose() / cone.slip();
      const Matrix3 by_lengths = cone.scale * projection * by_y;
      for (int other = 0; other < count(); ++other) {
        Matrix3 block = by_lengths * (cone.gradient.transpose() * at(other).gradient);
        if (other == k) block += (1.0 + kRedundant) * Matrix3::Identity() - projection;
        for (int i = 0; i < 3; ++i) {
          for (int j = 0; j < 3; ++j) system_.matrix[3 * k + i][3 * other + j] = block(i, j);
        }
      }
    }
  }

  /// Runs one step of Newton's method from the residuals of norm `norm`; returns the norm after it, or NaN.
  double newton_step(double smoothing, double norm) noexcept {
    constexpr int kHalvings = 7;
    assemble(smoothing);
    if (!system_.solve()) return NAN;
    std::array<Vector3, kMostContacts> from;
    std::array<Vector3, kMostContacts> change;
    for (int k = 0; k < count(); ++k) {
      const auto i = static_cast<std::size_t>(k);
      from[i] = at(k).x;
      change[i] = Vector3(system_.rhs[3 * k], system_.rhs[3 * k + 1], system_.rhs[3 * k + 2]);
    }
    double share = 1.0;
    double found = NAN;
    for (int halving = 0; halving <= kHalvings; ++halving, share *= 0.5) {
      for (int k = 0; k < count(); ++k)
        at(k).x = from[static_cast<std::size_t>(k)] + share * change[static_cast<std::size_t>(k)];
      found = residual(smoothing);
      if (found < (1.0 - 0.1 * share) * norm) break;
    }
    return found;
  }

  /// Follows the solution to the end of the smoothing. Where a contact hardly slips that takes many steps; when they
  /// are used up, a motion that obeys the law is good enough.
  bool converge() noexcept {
    const double tolerance = set_.metric().tolerance;
    double smoothing = std::max(0.1 * target_.norm(), tolerance);
    double norm = residual(smoothing);
    while (norm >= 1e-3 * tolerance || smoothing > kEnd * tolerance) {
      if (norm < 0.5 * smoothing) {
        smoothing = std::max(kShrink * smoothing, kEnd * tolerance);
        norm = residual(smoothing);
        continue;
      }
      if (set_.work().is_spent()) return false;
      work_left_ -= count();
      set_.work().add(Work::kSmoothed, static_cast<std::uint32_t>(count()));
      if (work_left_ < 0) return all_obey_law() && has_moderate_forces();
      norm = newton_step(smoothing, norm);
      if (!std::isfinite(norm)) return false;
    }
    return true;
  }

  ContactForce force(int k, const Vector3& slip, double multiplier) const noexcept {
    const Contact& c = set_.contact(k);
    return {.id = set_.rows().id[c.row],
            .point = set_.rows().point(c.row),
            .grip = c.grip,
            .normal = c.normal,
            .slip = slip,
            .ratio = c.ratio,
            .multiplier = multiplier};
  }

  ContactSet& set_;
  Vector6 target_;
  Vector6 z_;
  double scale_{};
  int work_left_{};
  std::array<ConeContact, kMostContacts> cones_;
  System system_;
};

}  // namespace

bool solve_smoothed(ContactSet& set, ConstrainedStep& step) noexcept {
  if (!(set.friction()->kinetic_ratio > 0.0) || set.work().is_spent()) return false;
  const ContactSet::Saved found = set.save();
  const CouplingSpace space = set.space();
  SmoothedProblem problem(set);
  problem.take_forces_of_set();
  for (const double scale : kScales) {
    if (problem.solve(scale) && problem.store(step)) {
      set.close_all();
      return true;
    }
    problem.release();
  }
  set.set_space(space);
  set.restore(found);
  return false;
}

}  // namespace godobject::detail
