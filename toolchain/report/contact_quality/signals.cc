#include "toolchain/report/contact_quality/signals.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace godobject::report {
namespace {

/// High-pass filter of second order by the bilinear transform, on three channels.
class HighPass {
 public:
  HighPass(double corner_hz, double quality, double rate_hz) {
    const double k = std::tan(std::numbers::pi * corner_hz / rate_hz);
    const double norm = 1.0 / (1.0 + k / quality + k * k);
    gain_ = norm;
    a1_ = 2.0 * (k * k - 1.0) * norm;
    a2_ = (1.0 - k / quality + k * k) * norm;
  }

  Vector3 operator()(const Vector3& x) {
    const Vector3 y = gain_ * (x - 2.0 * x1_ + x2_) - a1_ * y1_ - a2_ * y2_;
    x2_ = x1_;
    x1_ = x;
    y2_ = y1_;
    y1_ = y;
    return y;
  }

 private:
  double gain_, a1_, a2_;
  Vector3 x1_ = Vector3::Zero(), x2_ = Vector3::Zero(), y1_ = Vector3::Zero(), y2_ = Vector3::Zero();
};

Vector3 mean(std::span<const Vector3> values) {
  Vector3 sum = Vector3::Zero();
  for (const Vector3& v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

}  // namespace

double chatter(std::span<const Vector3> signal) {
  constexpr double kCorner_hz = 100.0;
  constexpr double kRate_hz = 1000.0;
  constexpr std::size_t kSettle = 50;
  if (signal.size() <= kSettle) return 0.0;
  HighPass first(kCorner_hz, 0.541196100146197, kRate_hz);  // the poles of Butterworth's fourth order
  HighPass second(kCorner_hz, 1.306562964876377, kRate_hz);
  double sum = 0.0;
  for (std::size_t k = 0; k < signal.size(); ++k) {
    const Vector3 y = second(first(signal[k] - signal.front()));
    if (k >= kSettle) sum += y.squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(signal.size() - kSettle));
}

double drift(std::span<const Vector3> positions, std::size_t window) {
  return (mean(positions.last(window)) - mean(positions.first(window))).norm();
}

Vector3 across(const Vector3& v, const Vector3& unit) { return v - v.dot(unit) * unit; }

double angle_between(const Vector3& a, const Vector3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

bool Rectangle::is_pierced(const Vector3& a, const Vector3& b) const {
  if ((a.z() > 0.0) == (b.z() > 0.0)) return false;
  const Vector3 at = a + a.z() / (a.z() - b.z()) * (b - a);
  return std::fabs(at.x()) < half_x && std::fabs(at.y()) < half_y;
}

}  // namespace godobject::report
