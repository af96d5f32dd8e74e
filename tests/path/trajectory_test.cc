#include "toolchain/path/trajectory.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace godobject::path {
namespace {

constexpr double kPi = std::numbers::pi;

Keyframes quarter_turn() {
  Keyframes motion;
  motion.keyframes.push_back({.t = 0.0, .position = Vector3(0, 0, 0)});
  motion.keyframes.push_back(
      {.t = 1.0, .position = Vector3(0.1, 0, 0), .rotation = exp_rotation(Vector3(0, 0, kPi / 2))});
  motion.keyframes.push_back(
      {.t = 1.5, .position = Vector3(0.1, 0.2, 0), .rotation = exp_rotation(Vector3(0, 0, kPi / 2))});
  return motion;
}

TEST(MinimumJerk, HasItsHandComputedValues) {
  EXPECT_EQ(minimum_jerk(-1.0), 0.0);
  EXPECT_EQ(minimum_jerk(0.0), 0.0);
  EXPECT_DOUBLE_EQ(minimum_jerk(0.25), 0.103515625);  // 10/64 - 15/256 + 6/1024
  EXPECT_DOUBLE_EQ(minimum_jerk(0.5), 0.5);
  EXPECT_EQ(minimum_jerk(1.0), 1.0);
  EXPECT_EQ(minimum_jerk(2.0), 1.0);
}

TEST(Trajectory, PassesItsKeyframesAndMidpoints) {
  const Keyframes motion = quarter_turn();
  EXPECT_TRUE(pose_at(motion, -1.0).translation.isZero(0.0));
  EXPECT_TRUE(pose_at(motion, 0.5).translation.isApprox(Vector3(0.05, 0, 0)));
  EXPECT_NEAR(pose_at(motion, 0.5).rotation.angularDistance(exp_rotation(Vector3(0, 0, kPi / 4))), 0.0, 1e-7);
  EXPECT_TRUE(pose_at(motion, 1.0).translation.isApprox(Vector3(0.1, 0, 0)));
  EXPECT_TRUE(pose_at(motion, 1.25).translation.isApprox(Vector3(0.1, 0.1, 0)));
  EXPECT_TRUE(pose_at(motion, 9.0).translation.isApprox(Vector3(0.1, 0.2, 0)));
}

TEST(Trajectory, TurnsAboutThePivot) {
  Keyframes motion = quarter_turn();
  motion.pivot = Vector3(0.03, 0, 0);
  const Pose end = pose_at(motion, 1.0);
  EXPECT_TRUE((end * motion.pivot).isApprox(Vector3(0.1, 0, 0)));
  EXPECT_TRUE(end.translation.isApprox(Vector3(0.1, -0.03, 0)));
}

TEST(Trajectory, HasOneUnitPoseAMillisecond) {
  const std::vector<Sample> samples = sample(quarter_turn());
  ASSERT_EQ(samples.size(), 1501u);
  EXPECT_DOUBLE_EQ(samples.front().t, 0.0);
  EXPECT_DOUBLE_EQ(samples.back().t, 1.5);
  for (const Sample& s : samples) EXPECT_NEAR(s.pose.rotation.norm(), 1.0, 1e-14);
}

TEST(Trajectory, HasAPoseForEachPeriod) {
  for (const double period : {0.125e-3, 0.25e-3, 2e-3, 10e-3}) {
    Keyframes motion;
    motion.period = period;
    motion.keyframes = {{.t = 0.5}, {.t = 1.5}};
    const std::vector<Sample> samples = sample(motion);
    ASSERT_EQ(samples.size(), static_cast<std::size_t>(std::lround(1.0 / period)) + 1) << period;
    EXPECT_NEAR(samples[1].t - samples[0].t, period, 1e-12);
    EXPECT_NEAR(samples.back().t, 1.5, 1e-12);
  }
}

TEST(Trajectory, IsSmoothToTheSecondDerivative) {
  Keyframes motion = quarter_turn();
  motion.oscillations.push_back({.from = 0.2,
                                 .to = 1.3,
                                 .frequency = 8.0,
                                 .phase = 1.0,
                                 .fade = 0.1,
                                 .translation = Vector3(0, 0, 0.001),
                                 .rotation = Vector3(0, 0.02, 0)});
  // The third difference is T^3 x jerk wherever acceleration is continuous; a step of it would leave T^2 x that step.
  // Largest jerk: 60 x 0.2 m / (0.5 s)^3 = 96 m/s^3, and of the fade 60 x 0.001 / 0.1^3 = 60 and its products with the
  // sine.
  const std::vector<Sample> s = sample(motion);
  double largest = 0.0;
  for (std::size_t i = 3; i < s.size(); ++i) {
    const Vector3 third = s[i].pose.translation - 3.0 * s[i - 1].pose.translation + 3.0 * s[i - 2].pose.translation -
                          s[i - 3].pose.translation;
    largest = std::max(largest, third.norm());
  }
  EXPECT_LT(largest, 1e-9 * 500.0);
}

TEST(Trajectory, OscillationHasItsAmplitudeFrequencyAndPhase) {
  Keyframes motion;
  motion.keyframes = {{.t = 0.0}, {.t = 2.0}};
  motion.oscillations.push_back({.from = 0.0,
                                 .to = 2.0,
                                 .frequency = 5.0,
                                 .phase = 0.0,
                                 .fade = 0.1,
                                 .translation = Vector3(0.002, 0, 0),
                                 .rotation = Vector3::Zero()});
  motion.oscillations.push_back({.from = 0.0,
                                 .to = 2.0,
                                 .frequency = 5.0,
                                 .phase = kPi / 2,
                                 .fade = 0.1,
                                 .translation = Vector3(0, 0.002, 0),
                                 .rotation = Vector3::Zero()});
  EXPECT_TRUE(pose_at(motion, 0.0).translation.isZero(0.0));
  EXPECT_TRUE(pose_at(motion, 2.0).translation.isZero(0.0));
  EXPECT_NEAR(pose_at(motion, 1.05).translation.x(), 0.002, 1e-12);  // a quarter period after a whole one
  for (double t = 0.1; t <= 1.9; t += 0.013) EXPECT_NEAR(pose_at(motion, t).translation.norm(), 0.002, 1e-12) << t;
}

}  // namespace
}  // namespace godobject::path
