#include "toolchain/report/assembly/jamming.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/LU>

namespace godobject::report {
namespace {

using Eigen::Vector3d;

Vector3d wrench(const Vector2& point, const Vector2& force) {
  return {force.x(), force.y(), point.y() * force.x() - point.x() * force.y()};
}

/// Tells if non-negative multiples of the generators sum up to the target: three of them do, if any number does
/// (Caratheodory).
bool in_cone(const std::vector<Vector3d>& generators, const Vector3d& target) {
  constexpr double kRounding = 1e-12;
  for (std::size_t i = 0; i < generators.size(); ++i) {
    for (std::size_t j = i + 1; j < generators.size(); ++j) {
      for (std::size_t k = j + 1; k < generators.size(); ++k) {
        Eigen::Matrix3d matrix;
        matrix << generators[i], generators[j], generators[k];
        if (std::abs(matrix.determinant()) < kRounding * kRounding) continue;
        const Vector3d multiples = matrix.inverse() * target;
        if ((multiples.array() >= -kRounding).all()) return true;
      }
    }
  }
  return false;
}

bool holds(std::span<const PlaneContact> contacts, const PlaneLoad& load, double friction) {
  constexpr double kMillimetre = 1e-3;  // unit of moments, so that all numbers are near one
  std::vector<Vector3d> generators;
  for (const PlaneContact& contact : contacts) {
    const Vector2 along(-contact.normal.y(), contact.normal.x());
    for (const double sign : {-1.0, 1.0}) {
      generators.push_back(wrench(contact.point / kMillimetre, contact.normal + sign * friction * along));
    }
  }
  return in_cone(generators, {-load.force.x(), -load.force.y(), -load.moment / kMillimetre});
}

}  // namespace

double holding_friction(std::span<const PlaneContact> contacts, const PlaneLoad& load, double most) {
  if (!holds(contacts, load, most)) return std::numeric_limits<double>::infinity();
  double moves = 0.0;
  double held = most;
  while (held - moves > 1e-9) {
    const double middle = 0.5 * (moves + held);
    (holds(contacts, load, middle) ? held : moves) = middle;
  }
  return held;
}

double wedging_friction(const std::array<PlaneContact, 2>& contacts) {
  const Vector2 across = contacts[1].point - contacts[0].point;
  double most = 0.0;
  for (const auto& [normal, away] : {std::pair{contacts[0].normal, across}, {contacts[1].normal, Vector2(-across)}}) {
    const double along = normal.dot(away);
    if (along <= 0.0) return std::numeric_limits<double>::infinity();
    most = std::max(most, std::abs(normal.x() * away.y() - normal.y() * away.x()) / along);
  }
  return most;
}

double whitney_friction(double depth, double diameter, double force_ratio, double moment_ratio) {
  // with t = depth / d: mu^2 F + mu (m + t F) - t = 0
  const double t = depth / diameter;
  if (force_ratio == 0.0) return t / moment_ratio;
  const double half = 0.5 * (moment_ratio + t * force_ratio);
  return (std::sqrt(half * half + force_ratio * t) - half) / force_ratio;
}

}  // namespace godobject::report
