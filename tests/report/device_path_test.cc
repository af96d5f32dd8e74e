#include "toolchain/report/contact_quality/device_path.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace godobject::report {
namespace {

Placement touching() {
  Placement placement;
  placement.H_OC.translation = Vector3(0.01, 0.02, 0.03);
  placement.along = Vector3::UnitY();
  return placement;
}

double speed(const DevicePath& path, std::size_t k) {
  return (path.H_OC[k].translation - path.H_OC[k - 1].translation).norm() / 1e-3;
}

TEST(Touch, FindsTheFirstContact) {
  Placement placement = touching();
  placement.into = Vector3(0.6, 0.0, -0.8);
  const std::vector<Vector3> points = {Vector3(0.0, 0.0, -0.01), Vector3(0.002, 0.0, -0.012)};
  const Placement found = touch(placement, points, [](const Vector3& p) { return p.z(); });
  EXPECT_NEAR(found.H_OC.translation.z(), 0.012, 1e-12);
  EXPECT_NEAR(found.H_OC.translation.x(), 0.01 + 0.018 * 0.6 / 0.8, 1e-12);
  EXPECT_THROW(touch(placement, points, [](const Vector3& p) { return p.z() + 1.0; }), std::runtime_error);
  EXPECT_THROW(touch(placement, points, [](const Vector3& p) { return p.z() - 1.0; }), std::runtime_error);
}

TEST(DevicePath, PressesAndHolds) {
  const DevicePath path = press(touching(), 0.007);
  EXPECT_NEAR(path.H_OC.front().translation.z(), 0.032, 1e-12);
  EXPECT_NEAR(path.H_OC.back().translation.z(), 0.023, 1e-12);
  EXPECT_EQ(speed(path, path.H_OC.size() - 1), 0.0);
}

TEST(DevicePath, SlidesAtTheSpeedAskedFor) {
  const DevicePath path = slide(touching(), 0.007, 0.1, 0.3);
  EXPECT_EQ(path.end - path.begin, 300u);
  for (std::size_t k = path.begin; k < path.end; ++k) ASSERT_NEAR(speed(path, k), 0.1, 1e-9);
}

TEST(DevicePath, SlipsOverTheEdge) {
  const DevicePath path = slip_off(touching(), 0.007, 1.0);
  EXPECT_NEAR(path.H_OC[path.begin].translation.y(), 0.01, 1e-3);  // 10 mm before the placement
  EXPECT_NEAR(speed(path, path.begin), 1.0, 1e-9);
  EXPECT_NEAR(path.H_OC.back().translation.y(), 0.06, 1e-9);
}

TEST(DevicePath, EndsRetreatsClear) {
  const DevicePath path = retreat(touching(), 0.007);
  EXPECT_NEAR(path.H_OC.back().translation.z(), 0.032, 1e-9);
  for (std::size_t k = path.begin + 1; k < path.end; ++k) ASSERT_LE(speed(path, k), 0.2 + 1e-9);
}

TEST(DevicePath, TremblesInEncoderSteps) {
  const DevicePath path = tremor(touching(), 0.007, 2.0);
  const Vector3 rest = touching().H_OC.translation - 0.007 * Vector3::UnitZ();
  double largest = 0.0;
  for (std::size_t k = path.begin; k < path.end; ++k) {
    const Vector3 steps = (path.H_OC[k].translation - rest) / 5e-6;
    ASSERT_LT((steps - steps.array().round().matrix()).norm(), 1e-6);
    largest = std::max(largest, steps.norm() * 5e-6);
  }
  EXPECT_GT(largest, 1e-4);
  EXPECT_LT(largest, 1e-3);
  for (std::size_t k = path.begin; k + 1000 < path.end; ++k) {  // periodic, so that the means differ by the drift
    ASSERT_LT((path.H_OC[k].translation - path.H_OC[k + 1000].translation).norm(), 6e-6);
  }
}

TEST(DevicePath, DashesThroughThePlaneAndBack) {
  std::mt19937 random(5);
  double fastest = 0.0;
  double fastest_turn = 0.0;
  for (int i = 0; i < 100; ++i) {
    const DevicePath path = dash(0.05, random);
    double lowest = 1.0;
    for (std::size_t k = 0; k < path.H_OC.size(); ++k) {
      lowest = std::min(lowest, path.H_OC[k].translation.z());
      if (k == 0) continue;
      fastest = std::max(fastest, speed(path, k));
      fastest_turn =
          std::max(fastest_turn, get_motion(path.H_OC[k - 1].inverse() * path.H_OC[k]).rotation.norm() / 1e-3);
    }
    EXPECT_LE(lowest, -0.05);
    EXPECT_GE(path.H_OC.back().translation.z(), 0.05);
  }
  EXPECT_LE(fastest, 7.0 + 1e-9);
  EXPECT_GT(fastest, 6.0);
  EXPECT_LE(fastest_turn, 90.0 + 1e-9);
  EXPECT_GT(fastest_turn, 80.0);
}

}  // namespace
}  // namespace godobject::report
