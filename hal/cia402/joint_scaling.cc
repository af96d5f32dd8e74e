#include "hal/cia402/joint_scaling.h"

#include <algorithm>
#include <cmath>

namespace godobject::hal::cia402 {
namespace {

constexpr double kCounter = 4294967296.0;  // counts until it wraps

}  // namespace

JointScaling::JointScaling(const DriveConfig& drive) noexcept
    : zero_(drive.zero),
      rad_per_count_(drive.sign * 2.0 * M_PI / (drive.counts * drive.gear)),
      nm_per_permille_(drive.sign * drive.gear * drive.rated_torque / 1000.0) {}

double JointScaling::position(std::int32_t count) noexcept {
  if (!started_) {
    const double wraps = std::round((zero_ / rad_per_count_ + count) / kCounter);
    counts_ = count - (std::fabs(wraps) < 1e6 ? static_cast<std::int64_t>(wraps * kCounter) : 0);
    started_ = true;
  } else {
    counts_ += static_cast<std::int32_t>(static_cast<std::uint32_t>(count) - static_cast<std::uint32_t>(last_));
  }
  last_ = count;
  return zero_ + rad_per_count_ * static_cast<double>(counts_);
}

bool JointScaling::permille(double torque, std::int16_t& permille) const noexcept {
  const double scaled = torque / nm_per_permille_;
  // after the scaling: a NaN must never become a number
  const bool finite = std::isfinite(scaled);
  permille = finite ? static_cast<std::int16_t>(std::lround(std::clamp(scaled, -32767.0, 32767.0))) : std::int16_t{0};
  return finite;
}

}  // namespace godobject::hal::cia402
