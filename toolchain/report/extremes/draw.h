#pragma once

#include <cstdint>
#include <random>

#include "godobject/pose.h"

namespace godobject::report {

/// Random numbers that depend only on the seed.
class Draw {
 public:
  explicit Draw(std::uint32_t seed) : random_(seed) {}
  double between(double low, double high) { return low + (high - low) * static_cast<double>(random_()) / 4294967296.0; }
  Vector3 in_cube(double half) {
    const double x = between(-half, half);
    const double y = between(-half, half);
    return {x, y, between(-half, half)};
  }
  Vector3 direction() {
    for (;;) {
      const Vector3 v = in_cube(1.0);
      if (v.norm() < 1.0 && v.norm() > 0.1) return v.normalized();
    }
  }

 private:
  std::mt19937 random_;
};

}  // namespace godobject::report
