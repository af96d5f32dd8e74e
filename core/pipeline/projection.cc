#include "core/pipeline/projection.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace godobject {
namespace {

/// A wrench row (f, t) and the motion it causes per unit of multiplier, M^-1 w, with M = diag(1, Jh).
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

/// Shortens xi so that no point of the body moves farther than `room`.
bool shorten(double room, double radius, Motion& xi) noexcept {
  const double travel = xi.translation.norm() + radius * xi.rotation.norm();
  if (travel <= room) return false;
  const double share = std::max(room, 0.0) / travel;
  xi.translation *= share;
  xi.rotation *= share;
  return true;
}

/// What the single contact asks for; `has_row` false where there is none (region C, or forces that cancel).
struct ContactRow {
  bool has_row = false;
  Vector3 u = Vector3::Zero();
  Vector3 tau = Vector3::Zero();
  double g = 0.0;
};

ContactRow contact_row(const PenaltyContacts& contacts, double safety_distance, double gain) noexcept {
  ContactRow row;
  if (!contacts.has_direction()) return row;
  const double force = contacts.wrench_S.force.norm();
  const double p = contacts.depth - safety_distance;
  row.has_row = true;
  row.u = contacts.wrench_S.force / force;
  row.tau = contacts.wrench_S.torque / force;
  row.g = p > 0.0 ? -gain * p : -p;
  return row;
}

/// Region C, or a contact without direction: as far as the layer allows.
Projection follow(const Motion& unconstrained, const PenaltyContacts& contacts, double safety_distance,
                  const MassModel& mass) noexcept {
  constexpr double kLayerShare = 0.5;  // of d that one cycle may use up: 1.5 m/s at 3 mm beside the surface
  constexpr double kCreep = 0.01;      // of d a cycle where opposing contacts leave no direction
  Projection out;
  out.motion = unconstrained;
  const double room = contacts.depth <= 0.0
                          ? kLayerShare * safety_distance - contacts.depth
                          : std::max(kLayerShare * (safety_distance - contacts.depth), kCreep * safety_distance);
  out.cut = shorten(room, mass.radius, out.motion);
  return out;
}

}  // namespace

Projection project(const Motion& unconstrained, const PenaltyContacts& contacts, double safety_distance, double gain,
                   const MassModel& mass) noexcept {
  const ContactRow contact = contact_row(contacts, safety_distance, gain);
  if (!contact.has_row) return follow(unconstrained, contacts, safety_distance, mass);
  const Row normal(contact.u, contact.tau, mass);
  Projection out;
  out.motion = unconstrained;
  const double a = normal.mobility(normal);
  normal.push(std::max(0.0, -(normal.along(out.motion) + contact.g)) / a, out.motion);
  return out;
}

Projection project_with_friction(const Motion& unconstrained, const PenaltyContacts& contacts, double safety_distance,
                                 double gain, const MassModel& mass, const ProjectionFriction& friction,
                                 bool was_slipping) noexcept {
  constexpr int kRounds = 30;           // of the slip iteration; it converges geometrically
  constexpr double kConverged = 1e-12;  // relative to the multipliers
  const ContactRow contact = contact_row(contacts, safety_distance, gain);
  if (!contact.has_row) return follow(unconstrained, contacts, safety_distance, mass);
  const Row normal(contact.u, contact.tau, mass);
  Projection out;
  out.motion = unconstrained;
  const double approach = -(normal.along(unconstrained) + contact.g);
  if (approach <= 0.0) return out;

  const Vector3 rc = contact.u.cross(contact.tau);
  const Vector3 e1 = contact.u.unitOrthogonal();
  const Vector3 e2 = contact.u.cross(e1);
  const Row tangent1(e1, rc.cross(e1), mass);
  const Row tangent2(e2, rc.cross(e2), mass);

  // Stick: both tangents and the normal at rest. A is the inverse effective mass at the contact, positive definite.
  Matrix3 A;
  A << normal.mobility(normal), normal.mobility(tangent1), normal.mobility(tangent2), normal.mobility(tangent1),
      tangent1.mobility(tangent1), tangent1.mobility(tangent2), normal.mobility(tangent2), tangent1.mobility(tangent2),
      tangent2.mobility(tangent2);
  const Vector3 stick =
      A.llt().solve(Vector3(approach, -tangent1.along(unconstrained), -tangent2.along(unconstrained)));
  const double stick_tangential = std::hypot(stick.y(), stick.z());
  const double mu = was_slipping ? friction.kinetic_ratio : friction.static_ratio;
  if (stick.x() >= 0.0 && stick_tangential <= mu * stick.x()) {
    normal.push(stick.x(), out.motion);
    tangent1.push(stick.y(), out.motion);
    tangent2.push(stick.z(), out.motion);
    return out;
  }

  // Slip: |l| = mu_k nu + viscous_step * slip, against the slip; normal and tangent in turn.
  out.slipping = true;
  const double a_n = A(0, 0);
  const double a_t =
      std::max(A(1, 1), A(2, 2)) + std::fabs(A(1, 2));  // bounds the tangents' block: the iteration contracts
  const double viscous = friction.viscous_step * a_t;
  double nu = 0.0, l1 = 0.0, l2 = 0.0;
  for (int round = 0; round < kRounds; ++round) {
    const double nu_next = std::max(0.0, nu - (normal.along(out.motion) + contact.g) / a_n);
    normal.push(nu_next - nu, out.motion);
    const double wanted1 = l1 - tangent1.along(out.motion) / a_t;
    const double wanted2 = l2 - tangent2.along(out.motion) / a_t;
    const double wanted = std::hypot(wanted1, wanted2);
    const double allowed = friction.kinetic_ratio * nu_next;
    const double length = wanted <= allowed ? wanted : (allowed + viscous * wanted) / (1.0 + viscous);
    const double share = wanted > 0.0 ? length / wanted : 0.0;
    const double change = std::fabs(nu_next - nu) + std::fabs(share * wanted1 - l1) + std::fabs(share * wanted2 - l2);
    tangent1.push(share * wanted1 - l1, out.motion);
    tangent2.push(share * wanted2 - l2, out.motion);
    nu = nu_next;
    l1 = share * wanted1;
    l2 = share * wanted2;
    if (change <= kConverged * nu) break;
  }
  // the normal has the last word
  normal.push(std::max(-nu, -(normal.along(out.motion) + contact.g) / a_n), out.motion);
  return out;
}

}  // namespace godobject
