#include "core/pipeline/paper/proxy_filter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace godobject {

Pose filter_proxy(const Pose& H_WS_previous, const Pose& H_WS_target, const Pose& H_WD, double period) noexcept {
  // the paper gives the range of 1 to 60 Hz and one point, 20 Hz at 7 mm; the line between them is chosen
  constexpr double kLowest_Hz = 1.0;
  constexpr double kHighest_Hz = 60.0;
  constexpr double kSlope_Hz_per_m = 19.0 / 7e-3;
  constexpr double kRotationWeight = 0.025;  // [m^2] chosen: k_VC,r of the default coupling
  const Motion to_device = get_motion(H_WS_target.inverse() * H_WD);
  const double distance =
      std::sqrt(to_device.translation.squaredNorm() + kRotationWeight * to_device.rotation.squaredNorm());
  const double cutoff_Hz = std::clamp(kLowest_Hz + kSlope_Hz_per_m * distance, kLowest_Hz, kHighest_Hz);
  const double gain = -std::expm1(-2.0 * std::numbers::pi * cutoff_Hz * period);
  Motion step = get_motion(H_WS_previous.inverse() * H_WS_target);
  step.translation *= gain;
  step.rotation *= gain;
  return H_WS_previous * set_matrix(step);  // (43)
}

}  // namespace godobject
