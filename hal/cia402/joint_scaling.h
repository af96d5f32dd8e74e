#pragma once

#include <cstdint>

#include "hal/cia402/bus_layout.h"

namespace godobject::hal::cia402 {

/// Converts a joint's numbers between wire and SI by `DriveConfig`. Real-time safe.
class JointScaling {
 public:
  JointScaling() = default;
  explicit JointScaling(const DriveConfig& drive) noexcept;

  /// Converts 6064 to a joint position [rad]. The first count is taken as the position nearest to 0 rad that it can
  /// stand for; from there differences follow the counter over its wraps.
  double position(std::int32_t count) noexcept;

  /// Converts 6077 [permille of the rated torque] to the joint's torque [Nm].
  double torque(std::int16_t permille) const noexcept { return nm_per_permille_ * permille; }

  /// Converts a torque [Nm] to 6071: rounded to the nearest, clamped to 16 bits. False: torque or scale is not finite,
  /// and `permille` is 0.
  bool permille(double torque, std::int16_t& permille) const noexcept;

 private:
  double zero_ = 0.0;
  double rad_per_count_ = 0.0;
  double nm_per_permille_ = 0.0;
  bool started_ = false;
  std::int32_t last_{};
  std::int64_t counts_{};  ///< without wraps
};

}  // namespace godobject::hal::cia402
