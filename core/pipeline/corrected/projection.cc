#include "core/pipeline/corrected/projection.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace godobject {
namespace {

/// A wrench row w = (f, t) and its motion per unit of multiplier, M^-1 w, with M = diag(1, Jh).
struct Row {
  Vector3 force;
  Vector3 torque;
  Vector3 turn;

  Row(const Vector3& f, const Vector3& t, const MassModel& mass) noexcept
      : force(f), torque(t), turn(mass.inverse_inertia.cwiseProduct(t)) {}

  double along(const Motion& xi) const noexcept { return force.dot(xi.translation) + torque.dot(xi.rotation); }
  double mobility(const Row& other) const noexcept { return force.dot(other.force) + torque.dot(other.turn); }
  void push(double multiplier, Motion& xi) const noexcept {
    xi.translation += multiplier * force;
    xi.rotation += multiplier * turn;
  }
};

constexpr double kLayerShare = 0.5;  // of d that a motion may use up at once

/// Shortens xi so that no point of the body is displaced by more than `room` [m]. Tells whether it had to.
bool shorten(double room, double radius, Motion& xi) noexcept {
  const double travel = xi.translation.norm() + radius * xi.rotation.norm();
  if (travel <= room) return false;
  const double share = std::max(room, 0.0) / travel;
  xi.translation *= share;
  xi.rotation *= share;
  return true;
}

/// The constraint of the single contact: w xi + g >= 0.
struct Contact {
  Row normal;   ///< w = (u, tau)
  Vector3 u;    ///< unit direction of the force
  Vector3 tau;  ///< torque per force [m]
  double g;     ///< -eta p, or -p where p < 0 [m]

  Contact(const PenaltyContacts& contacts, double safety_distance, double gain, const MassModel& mass) noexcept
      : normal(contacts.wrench_S.force.normalized(), contacts.wrench_S.torque / contacts.wrench_S.force.norm(), mass),
        u(normal.force),
        tau(normal.torque),
        g(0.0) {
    const double p = contacts.depth - safety_distance;
    g = p > 0.0 ? -gain * p : -p;
  }

  /// Returns by how much xi violates the row [m]; positive if it does.
  double violation(const Motion& xi) const noexcept { return -(normal.along(xi) + g); }
};

/// Returns the motion in region C, or at contacts without a direction: as far as the safety layer allows.
Projection follow(const Motion& unconstrained, const PenaltyContacts& contacts, double safety_distance,
                  const MassModel& mass) noexcept {
  constexpr double kCreep = 0.01;  // of d, where opposing contacts leave no direction
  Projection out;
  out.motion = unconstrained;
  const double left = kLayerShare * (safety_distance - contacts.depth);
  const double room =
      contacts.depth <= 0.0 ? kLayerShare * safety_distance - contacts.depth : std::max(left, kCreep * safety_distance);
  out.cut = shorten(room, mass.radius, out.motion);
  return out;
}

/// Changes xi so that the normal and both tangents are at rest. False, with xi unchanged: that force lies outside the
/// cone of `mu`.
bool stick(const Contact& contact, const Row& tangent1, const Row& tangent2, double mu, Motion& xi) noexcept {
  const Row& normal = contact.normal;
  Matrix3 A;  // inverse effective mass at the contact, positive definite
  A << normal.mobility(normal), normal.mobility(tangent1), normal.mobility(tangent2),       //
      normal.mobility(tangent1), tangent1.mobility(tangent1), tangent1.mobility(tangent2),  //
      normal.mobility(tangent2), tangent1.mobility(tangent2), tangent2.mobility(tangent2);
  const Vector3 force = A.llt().solve(Vector3(contact.violation(xi), -tangent1.along(xi), -tangent2.along(xi)));
  if (!(force.x() >= 0.0 && std::hypot(force.y(), force.z()) <= mu * force.x())) return false;
  normal.push(force.x(), xi);
  tangent1.push(force.y(), xi);
  tangent2.push(force.z(), xi);
  return true;
}

/// Changes xi by the forces of a slipping contact: the friction force |l| = mu_k nu + viscous_step * slip opposes the
/// slip. Iterates over normal and tangents in turn.
void slip(const Contact& contact, const Row& tangent1, const Row& tangent2, const ProjectionFriction& friction,
          Motion& xi) noexcept {
  constexpr int kRounds = 30;           // enough but for slender bodies on long levers: there the ratio may be off
  constexpr double kConverged = 1e-12;  // relative to the multipliers
  const Row& normal = contact.normal;
  const double a_n = normal.mobility(normal);
  // an upper bound of the tangents' block, so that a round cannot overshoot
  const double a_t =
      std::max(tangent1.mobility(tangent1), tangent2.mobility(tangent2)) + std::fabs(tangent1.mobility(tangent2));
  const double viscous = friction.viscous_step * a_t;
  double nu = 0.0, l1 = 0.0, l2 = 0.0;
  for (int round = 0; round < kRounds; ++round) {
    const double nu_next = std::max(0.0, nu + contact.violation(xi) / a_n);
    normal.push(nu_next - nu, xi);
    const double wanted1 = l1 - tangent1.along(xi) / a_t;
    const double wanted2 = l2 - tangent2.along(xi) / a_t;
    const double wanted = std::hypot(wanted1, wanted2);
    const double allowed = friction.kinetic_ratio * nu_next;
    const double length = wanted <= allowed ? wanted : (allowed + viscous * wanted) / (1.0 + viscous);
    const double share = wanted > 0.0 ? length / wanted : 0.0;
    const double change = std::fabs(nu_next - nu) + std::fabs(share * wanted1 - l1) + std::fabs(share * wanted2 - l2);
    tangent1.push(share * wanted1 - l1, xi);
    tangent2.push(share * wanted2 - l2, xi);
    nu = nu_next;
    l1 = share * wanted1;
    l2 = share * wanted2;
    if (change <= kConverged * nu) break;
  }
  normal.push(std::max(-nu, contact.violation(xi) / a_n), xi);  // ends with the normal's constraint met
}

/// Returns the product of two motions in the metric of the mass [m^2].
double energy(const Motion& a, const Motion& b, const MassModel& mass) noexcept {
  return a.translation.dot(b.translation) + a.rotation.dot(mass.inertia.cwiseProduct(b.rotation));
}

/// Returns the share of the wanted motion to take: less if it reverses the last one, otherwise more than the last
/// share.
double relaxed(const Motion& wanted, const ProjectionState& before, double safety_distance,
               const MassModel& mass) noexcept {
  constexpr double kShrink = 0.5;
  constexpr double kGrow = 1.25;  // below 2: a swing is met again before it can grow
  constexpr double kLeast = 1.0 / 64.0;
  constexpr double kStill = 1e-5;  // of d: smaller swings are left alone
  const bool moves = energy(wanted, wanted, mass) > kStill * safety_distance * kStill * safety_distance;
  const bool reverses = moves && energy(wanted, before.wanted, mass) < 0.0;
  return reverses ? std::max(kLeast, kShrink * before.relaxation) : std::min(1.0, kGrow * before.relaxation);
}

}  // namespace

Projection project(const Motion& unconstrained, const PenaltyContacts& contacts, double safety_distance, double gain,
                   const MassModel& mass, const ProjectionFriction* friction, const ProjectionState& before) noexcept {
  if (!contacts.has_direction()) return follow(unconstrained, contacts, safety_distance, mass);
  const Contact contact(contacts, safety_distance, gain, mass);
  Projection out;
  out.motion = unconstrained;
  const double violation = contact.violation(unconstrained);
  if (violation <= 0.0) {
    out.cut = shorten(kLayerShare * safety_distance, mass.radius, out.motion);
    return out;
  }
  if (friction == nullptr) {
    contact.normal.push(violation / contact.normal.mobility(contact.normal), out.motion);
  } else {
    const Vector3 rc = contact.u.cross(contact.tau);
    const Vector3 e1 = contact.u.unitOrthogonal();
    const Vector3 e2 = contact.u.cross(e1);
    const Row tangent1(e1, rc.cross(e1), mass);
    const Row tangent2(e2, rc.cross(e2), mass);
    const double mu = before.slipping ? friction->kinetic_ratio : friction->static_ratio;
    out.next.slipping = !stick(contact, tangent1, tangent2, mu, out.motion);
    if (out.next.slipping) slip(contact, tangent1, tangent2, *friction, out.motion);
  }
  out.next.wanted = out.motion;
  out.next.relaxation = relaxed(out.motion, before, safety_distance, mass);
  out.motion.translation *= out.next.relaxation;
  out.motion.rotation *= out.next.relaxation;
  out.cut = shorten(kLayerShare * safety_distance, mass.radius, out.motion);
  out.motion.translation +=
      std::max(0.0, contact.violation(out.motion)) * contact.u;  // a = 1 for a translation along u
  return out;
}

}  // namespace godobject
