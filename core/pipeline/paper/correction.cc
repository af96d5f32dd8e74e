#include "core/pipeline/paper/correction.h"

#include <cmath>

namespace godobject {
namespace {

/// Returns the point Q_L of the force line {lever_point + mu u_f} that is nearest to the eigen ellipsoid, relative to
/// the centre of mass G. Eq (13)-(17).
Vector3 rotation_point(const Vector3& lever_point, const Vector3& u_f, const Vector3& ellipsoid) noexcept {
  const Vector3 inverse = ellipsoid.cwiseInverse();
  const double a = u_f.cwiseProduct(inverse).dot(u_f);  // (14), with u_i^2 in place of the printed u_1^2
  const double b = 2.0 * lever_point.cwiseProduct(inverse).dot(u_f);
  const double c = lever_point.cwiseProduct(inverse).dot(lever_point) - 1.0;
  const double discriminant = b * b - 4.0 * a * c;
  if (discriminant >= 0.0) {
    return lever_point + (-b - std::sqrt(discriminant)) / (2.0 * a) * u_f;  // (15): where the line enters
  }
  const double length = std::sqrt(lever_point.cwiseProduct(ellipsoid).dot(lever_point));
  const Vector3 nearest = ellipsoid.cwiseProduct(lever_point) / length;  // (16)
  return lever_point + (nearest - lever_point).dot(u_f) * u_f;           // (17)
}

}  // namespace

Correction correction(const PenaltyContacts& contacts, double safety_distance, const MassModel& mass) noexcept {
  // chosen between the rounding of V, a length of some millimetres (1e-18 m), and any depth or lever that matters (1e-9
  // m)
  constexpr double kNoForce = 1e-12;  // [m]
  constexpr double kNoLever = 1e-12;  // [m]
  Correction out;
  out.penetration = contacts.depth - safety_distance;  // (6)
  const double force = contacts.wrench_S.force.norm();
  if (force < kNoForce) return out;
  out.u_x = contacts.wrench_S.force / force;  // (5)
  const double torque = contacts.wrench_S.torque.norm();
  if (torque < kNoLever * force) return out;              // the limit delta -> 0 of (21) and (27): no correction
  const Vector3 u_t = contacts.wrench_S.torque / torque;  // (5)
  const Vector3 turned = mass.sigma * mass.inverse_inertia.cwiseProduct(u_t);  // J^-1 u_t, J = J_B / (m sigma)
  out.u_r = turned / turned.norm();                                            // (5)
  out.lever = torque / force;                                                  // (6)

  const Vector3 lever_point = out.lever * u_t.cross(out.u_x);  // (12): on the mirrored side, as printed
  out.rotation_radius = rotation_point(lever_point, out.u_x, mass.ellipsoid).norm();  // (13)
  const double r2 = out.rotation_radius * out.rotation_radius;
  const double tau = turned.dot(u_t) / turned.squaredNorm();  // (25)
  const double weight = mass.sigma * tau * out.lever * out.lever;
  out.distribution = weight / (weight + r2 * r2);  // (27), its fraction expanded by weight
  const double theta = r2 > 0.0 ? out.lever / r2 * out.penetration * (1.0 - out.distribution) : 0.0;  // (21)
  out.delta.translation = out.distribution * out.penetration * out.u_x;                               // (7)
  out.delta.rotation = theta * out.u_r;                                                               // (7)
  return out;
}

}  // namespace godobject
