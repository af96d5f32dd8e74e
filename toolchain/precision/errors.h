#pragma once

#include <cstddef>
#include <span>

#include "godobject/pose.h"
#include "toolchain/precision/exact_scene.h"
#include "toolchain/precision/trace.h"

namespace godobject::precision {

/// The error of a setting's wrenches against the reference, over all compared cycles. A torque counts by the coupling's
/// metric: |F|^2 = |f|^2 + |t|^2 / rho^2, which is (k_D k_VC,x times the distance between the two god objects)^2.
struct WrenchError {
  double rms = 0.0;        ///< of the difference [N]
  double relative = 0.0;   ///< the same over the rms of the reference; infinity if the reference never pushes
  double magnitude = 0.0;  ///< rms of |f| - |f_ref| [N]
  double force = 0.0;      ///< rms of the difference of the forces over the rms of the reference's
  double torque = 0.0;     ///< the same of the torques
  double direction = 0.0;  ///< rms of the angle between the forces where both are above 1 % of the largest [rad]
};

/// Returns the error. `squared_gyration`: rho^2 = k_VC,r / k_VC,x [m^2]. Both spans have the same length.
WrenchError wrench_error(std::span<const Wrench> wrenches, std::span<const Wrench> reference, double squared_gyration);

struct PenetrationError {
  double deepest = 0.0;  ///< [m]
  double rms = 0.0;      ///< over all checked cycles [m]
};

/// Measures every `stride`-th cycle against the exact meshes.
PenetrationError penetration_error(const ExactScene& exact, std::span<const TracedCycle> cycles, std::size_t stride);

}  // namespace godobject::precision
