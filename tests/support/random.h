#pragma once

#include <random>

#include "godobject/pose.h"

namespace godobject::test {

/// Generates reproducible random numbers, vectors and motions.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double between(double a, double b) { return std::uniform_real_distribution<double>(a, b)(engine_); }
  int integer(int first, int last) { return std::uniform_int_distribution<int>(first, last)(engine_); }
  Vector3 in_cube(double half) { return {between(-half, half), between(-half, half), between(-half, half)}; }
  Vector3 direction() {
    for (;;) {
      const Vector3 v = in_cube(1.0);
      if (v.norm() < 1.0 && v.norm() > 0.1) return v.normalized();
    }
  }
  Motion motion(double length, double angle) {
    return {between(0.0, length) * direction(), between(0.0, angle) * direction()};
  }

 private:
  std::mt19937 engine_;
};

}  // namespace godobject::test
