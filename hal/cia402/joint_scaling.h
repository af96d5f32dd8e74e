#pragma once

#include <cstdint>

#include "hal/cia402/bus_layout.h"

namespace godobject::hal::cia402 {

/// A joint's numbers between wire and SI, as `DriveConfig` says. Real-time safe.
class JointScaling {
 public:
  JointScaling() = default;
  explicit JointScaling(const DriveConfig& drive) noexcept;

  /// Takes 6064. The first count is taken for the position nearest to 0 rad that it can stand for; from there the
  /// counter is followed by differences, over its wraps.
  double position(std::int32_t count) noexcept;

  /// 6077 [permille of the rated torque] in Nm.
  double torque(std::int16_t permille) const noexcept { return nm_per_permille_ * permille; }

  /// 6071 for a torque [Nm]: rounded to the nearest, held to what the number takes. False: the torque is not a finite
  /// number, or the scale is not, and `permille` is 0.
  bool permille(double torque, std::int16_t& permille) const noexcept;

 private:
  double zero_ = 0.0;
  double rad_per_count_ = 0.0;
  double nm_per_permille_ = 0.0;
  bool started_ = false;
  std::int32_t last_ = 0;
  std::int64_t counts_ = 0;  ///< without wraps
};

}  // namespace godobject::hal::cia402
