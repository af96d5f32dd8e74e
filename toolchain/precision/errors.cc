#include "toolchain/precision/errors.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace godobject::precision {
namespace {

double squared(const Wrench& wrench, double squared_gyration) {
  return wrench.force.squaredNorm() + wrench.torque.squaredNorm() / squared_gyration;
}

}  // namespace

WrenchError wrench_error(std::span<const Wrench> wrenches, std::span<const Wrench> reference, double squared_gyration) {
  constexpr double kPushing = 0.01;
  const auto count = static_cast<double>(std::max<std::size_t>(1, reference.size()));
  double largest = 0.0;
  for (const Wrench& wrench : reference) largest = std::max(largest, wrench.force.norm());
  double difference = 0.0;
  double whole = 0.0;
  double magnitude = 0.0;
  double force = 0.0;
  double whole_force = 0.0;
  double torque = 0.0;
  double whole_torque = 0.0;
  double angle = 0.0;
  double pushing = 0.0;
  for (std::size_t k = 0; k < reference.size(); ++k) {
    const Vector3& f = wrenches[k].force;
    const Vector3& f_ref = reference[k].force;
    difference += squared({f - f_ref, wrenches[k].torque - reference[k].torque}, squared_gyration);
    whole += squared(reference[k], squared_gyration);
    force += (f - f_ref).squaredNorm();
    whole_force += f_ref.squaredNorm();
    torque += (wrenches[k].torque - reference[k].torque).squaredNorm();
    whole_torque += reference[k].torque.squaredNorm();
    magnitude += std::pow(f.norm() - f_ref.norm(), 2);
    if (std::min(f.norm(), f_ref.norm()) <= kPushing * largest) continue;
    angle += std::pow(std::atan2(f.cross(f_ref).norm(), f.dot(f_ref)), 2);
    pushing += 1.0;
  }
  WrenchError error;
  error.rms = std::sqrt(difference / count);
  error.relative = std::sqrt(difference / whole);
  error.magnitude = std::sqrt(magnitude / count);
  error.force = std::sqrt(force / whole_force);
  error.torque = std::sqrt(torque / whole_torque);
  error.direction = pushing > 0.0 ? std::sqrt(angle / pushing) : 0.0;
  return error;
}

PenetrationError penetration_error(const ExactScene& exact, std::span<const TracedCycle> cycles, std::size_t stride) {
  PenetrationError error;
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t k = 0; k < cycles.size(); k += stride, ++count) {
    const double depth = exact.penetration(cycles[k].H_WM);
    error.deepest = std::max(error.deepest, depth);
    sum += depth * depth;
  }
  error.rms = count > 0 ? std::sqrt(sum / static_cast<double>(count)) : 0.0;
  return error;
}

}  // namespace godobject::precision
