#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/pipeline/contact/qp/contact_rows.h"
#include "core/pipeline/contact/qp/least_constraint.h"
#include "tests/support/decompositions.h"

namespace godobject::test {

using SixVector = Eigen::Matrix<double, 6, 1>;

/// One contact of the problem in z = (x, rho r), for the slow and simple reference solutions below. The numbers are the
/// single-precision numbers of the solver's rows.
struct SlowContact {
  Eigen::Matrix<double, 3, 6> velocity;  ///< times z: velocity of the point, x + r x P
  Vector3 normal;
  SixVector gradient;  ///< of normal . velocity, with the torque arm of the row
  double required_gain = 0.0;
};

inline std::vector<SlowContact> slow_contacts(const ContactRows& rows, double gyration) {
  std::vector<SlowContact> contacts(rows.count);
  for (std::uint32_t i = 0; i < rows.count; ++i) {
    SlowContact& c = contacts[i];
    const Vector3 p(rows.point_x[i], rows.point_y[i], rows.point_z[i]);
    Matrix3 turn;
    turn << 0.0, p.z(), -p.y(), -p.z(), 0.0, p.x(), p.y(), -p.x(), 0.0;
    c.velocity << Matrix3::Identity(), turn / gyration;
    c.normal = Vector3(rows.normal_x[i], rows.normal_y[i], rows.normal_z[i]);
    c.gradient << c.normal, Vector3(rows.torque_x[i], rows.torque_y[i], rows.torque_z[i]) / gyration;
    c.required_gain = static_cast<double>(rows.required_gain[i]);
  }
  return contacts;
}

/// Returns the point nearest to `target` with gradient . z >= required_gain for all contacts, or nullopt if there is no
/// such point. Tries every subset of up to six contacts as equalities, which suits up to about 12 contacts.
inline std::optional<SixVector> nearest_by_enumeration(const SixVector& target,
                                                       const std::vector<SlowContact>& contacts, double tolerance) {
  const auto count = static_cast<int>(contacts.size());
  std::optional<SixVector> best;
  for (unsigned subset = 0; subset < 1u << count; ++subset) {
    std::vector<int> members;
    for (int i = 0; i < count; ++i) {
      if ((subset >> i & 1u) != 0u) members.push_back(i);
    }
    const auto size = static_cast<Eigen::Index>(members.size());
    if (size > 6) continue;
    Eigen::MatrixXd A(size, 6);
    Eigen::VectorXd b(size);
    for (Eigen::Index k = 0; k < size; ++k) {
      const SlowContact& c = contacts[static_cast<std::size_t>(members[static_cast<std::size_t>(k)])];
      A.row(k) = c.gradient.transpose();
      b[k] = c.required_gain;
    }
    SixVector z = target;
    if (size > 0) z += least_squares(A, b - A * target);
    bool meets_all = true;
    for (const SlowContact& c : contacts) meets_all &= c.gradient.dot(z) >= c.required_gain - tolerance;
    if (meets_all && (!best || (z - target).norm() < (*best - target).norm())) best = z;
  }
  return best;
}

/// Returns the same point for any number of contacts, by Hildreth's method (coordinate ascent on the multipliers).
/// Returns nullopt if each of `sweeps` sweeps changes a multiplier by `settled` or more.
inline std::optional<SixVector> nearest_by_ascent(const SixVector& target, const std::vector<SlowContact>& contacts,
                                                  double settled, int sweeps) {
  std::vector<double> multiplier(contacts.size(), 0.0);
  SixVector z = target;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    double largest = 0.0;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const SlowContact& c = contacts[i];
      const double change = std::max(-multiplier[i], (c.required_gain - c.gradient.dot(z)) / c.gradient.squaredNorm());
      multiplier[i] += change;
      z += change * c.gradient;
      largest = std::max(largest, std::fabs(change));
    }
    if (largest < settled) return z;
  }
  return std::nullopt;
}

/// Returns the projection of a force on the cone |t| <= ratio n.
inline Vector3 on_cone(const Vector3& force, const Vector3& normal, double ratio) {
  const double n = normal.dot(force);
  const Vector3 t = force - n * normal;
  const double size = t.norm();
  if (size <= ratio * n) return force;
  if (ratio * size <= -n) return Vector3::Zero();
  const double load = (n + ratio * size) / (1.0 + ratio * ratio);
  return load * (normal + ratio / size * t);
}

struct SlowFriction {
  SixVector z;
  std::vector<Vector3> forces;
  double residual = 0.0;  ///< largest change of a force in the last iteration [m]
};

/// Solves Coulomb's law with one friction ratio at all contacts, by the fixed point of de Saxce and Feng. One after the
/// other, each force becomes the projection of force - step (velocity - required_gain n + ratio |slip| n) on its cone;
/// the contact's own inertia determines the step.
inline SlowFriction coulomb_by_fixed_point(const SixVector& target, const std::vector<SlowContact>& contacts,
                                           double ratio, double settled, int sweeps) {
  SlowFriction out;
  out.z = target;
  out.forces.assign(contacts.size(), Vector3::Zero());
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    out.residual = 0.0;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const SlowContact& c = contacts[i];
      const Vector3 v = c.velocity * out.z;
      const double approach = c.normal.dot(v);
      const double slip = (v - approach * c.normal).norm();
      const double step = 0.5 / (c.velocity * c.velocity.transpose()).trace();
      const Vector3 moved = out.forces[i] - step * (v + (ratio * slip - c.required_gain) * c.normal);
      const Vector3 change = on_cone(moved, c.normal, ratio) - out.forces[i];
      out.forces[i] += change;
      out.z += c.velocity.transpose() * change;
      out.residual = std::max(out.residual, change.norm());
    }
    if (out.residual < settled) break;
  }
  return out;
}

}  // namespace godobject::test
