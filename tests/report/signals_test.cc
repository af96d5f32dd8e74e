#include "toolchain/report/contact_quality/signals.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace godobject::report {
namespace {

std::vector<Vector3> wave(double hertz, double amplitude, double offset = 0.0) {
  std::vector<Vector3> signal;
  for (int k = 0; k < 1000; ++k) {
    signal.push_back(Vector3(offset + amplitude * std::sin(2.0 * std::numbers::pi * hertz * 1e-3 * k), offset, 0.0));
  }
  return signal;
}

/// |H| of Butterworth's fourth order behind the bilinear transform, at a frequency.
double high_pass_gain(double hertz) {
  const double ratio = std::tan(std::numbers::pi * 100.0 / 1000.0) / std::tan(std::numbers::pi * hertz / 1000.0);
  return 1.0 / std::sqrt(1.0 + std::pow(ratio, 8));
}

TEST(Chatter, IsTheRmsOfAFastSine) {
  for (const double hertz : {90.0, 100.0, 150.0, 250.0, 400.0}) {
    const double expected = 0.3 * high_pass_gain(hertz) / std::sqrt(2.0);
    EXPECT_NEAR(chatter(wave(hertz, 0.3)), expected, 0.01 * expected) << hertz;
  }
}

TEST(Chatter, DoesNotSeeWhatIsSlow) {
  EXPECT_LT(chatter(wave(10.0, 1.0)), 1.1e-4);  // (10/100)^4
  EXPECT_LT(chatter(wave(0.0, 0.0, 14.0)), 1e-12);
  std::vector<Vector3> ramp;
  for (int k = 0; k < 600; ++k) ramp.push_back(0.05 * k * Vector3::UnitZ());  // 50 N/s
  EXPECT_LT(chatter(ramp), 1e-4);
}

TEST(Chatter, AddsChannelsInSquares) {
  std::vector<Vector3> signal = wave(250.0, 0.3);
  for (Vector3& f : signal) f.z() = f.x();
  EXPECT_NEAR(chatter(signal), std::sqrt(2.0) * chatter(wave(250.0, 0.3)), 1e-9);
}

TEST(Drift, IsThatOfTheMeans) {
  // a tremor of whole periods leaves no drift; 1 um a second does
  std::vector<Vector3> positions;
  for (int k = 0; k < 5000; ++k) {
    const double t = 1e-3 * k;
    positions.push_back(Vector3(1e-6 * t, 0.0, 0.0) +
                        1e-4 * std::sin(2.0 * std::numbers::pi * 9.0 * t) * Vector3::UnitY());
  }
  EXPECT_NEAR(drift(positions, 1000), 4e-6, 1e-12);
}

TEST(Across, SplitsAForce) {
  const Vector3 force(0.18, 0.0, 1.0);
  EXPECT_NEAR(across(force, Vector3::UnitZ()).norm(), 0.18, 1e-15);
  EXPECT_NEAR(angle_between(across(force, Vector3::UnitZ()), Vector3(1.0, 1e-9, 0.0)), 1e-9, 1e-15);
  EXPECT_NEAR(angle_between(Vector3::UnitX(), -Vector3::UnitX()), std::numbers::pi, 1e-15);
}

TEST(Rectangle, IsPiercedByChordsThatChangeSidesWithinIt) {
  const Rectangle plate{.half_x = 0.1, .half_y = 0.2};
  EXPECT_TRUE(plate.is_pierced(Vector3(0.0, 0.0, 0.01), Vector3(0.0, 0.0, -0.01)));
  EXPECT_TRUE(plate.is_pierced(Vector3(0.0, 0.0, -0.01), Vector3(0.0, 0.0, 0.01)));
  EXPECT_FALSE(plate.is_pierced(Vector3(0.0, 0.0, 0.01), Vector3(0.0, 0.0, 0.001)));
  // meets the plane a quarter of the way: at x = 0.09 within, at x = 0.11 beside it
  EXPECT_TRUE(plate.is_pierced(Vector3(0.05, 0.0, 0.01), Vector3(0.21, 0.0, -0.03)));
  EXPECT_FALSE(plate.is_pierced(Vector3(0.07, 0.0, 0.01), Vector3(0.23, 0.0, -0.03)));
  EXPECT_TRUE(plate.is_pierced(Vector3(0.0, 0.15, 0.01), Vector3(0.0, 0.15, -0.01)));
}

}  // namespace
}  // namespace godobject::report
