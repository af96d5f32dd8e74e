#include "hal/cia402/joint_scaling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/random.h"

namespace godobject::hal::cia402 {
namespace {

constexpr std::int32_t kLowest = std::numeric_limits<std::int32_t>::min();
constexpr std::int32_t kHighest = std::numeric_limits<std::int32_t>::max();

TEST(JointScaling, HandComputed) {
  JointScaling joint(DriveConfig{.counts = 4096, .gear = 100.0, .rated_torque = 2.0, .sign = -1.0, .zero = 0.5});
  EXPECT_DOUBLE_EQ(joint.position(0), 0.5);
  EXPECT_DOUBLE_EQ(joint.position(102400), 0.5 - M_PI / 2.0);  // 25 turns of the motor: a quarter of the joint
  EXPECT_DOUBLE_EQ(joint.position(-409600), 0.5 + 2.0 * M_PI);
  EXPECT_DOUBLE_EQ(joint.torque(1000), -200.0);
  EXPECT_DOUBLE_EQ(joint.torque(-5), 1.0);

  std::int16_t permille = 0;
  EXPECT_TRUE(joint.permille(-200.0, permille));
  EXPECT_EQ(permille, 1000);
  EXPECT_TRUE(joint.permille(0.31, permille));  // -1.55 permille
  EXPECT_EQ(permille, -2);
  EXPECT_TRUE(joint.permille(0.29, permille));
  EXPECT_EQ(permille, -1);
}

TEST(JointScaling, SaturatesAndNeverMakesANumberOfWhatIsNone) {
  JointScaling joint(DriveConfig{.rated_torque = 1.0});
  std::int16_t permille = 1;
  EXPECT_TRUE(joint.permille(1e300, permille));
  EXPECT_EQ(permille, 32767);
  EXPECT_TRUE(joint.permille(-32.768, permille));
  EXPECT_EQ(permille, -32767);
  for (const double none : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    permille = 1;
    EXPECT_FALSE(joint.permille(none, permille));
    EXPECT_EQ(permille, 0);
  }
  JointScaling without_rated_torque(DriveConfig{.rated_torque = 0.0});
  permille = 1;
  EXPECT_FALSE(without_rated_torque.permille(1.0, permille));
  EXPECT_EQ(permille, 0);
  EXPECT_FALSE(without_rated_torque.permille(0.0, permille));
  // a scale so small that a finite torque leaves the numbers
  JointScaling tiny(DriveConfig{.rated_torque = 1e-10});
  EXPECT_FALSE(tiny.permille(1e300, permille));
  EXPECT_EQ(permille, 0);
}

TEST(JointScaling, FollowsTheCounterOverItsWraps) {
  // 2^32 counts are 4096 turns
  JointScaling joint(DriveConfig{.counts = 1 << 20, .gear = 1.0});
  joint.position(kHighest - 2);
  const double before = joint.position(kHighest);
  const double after = joint.position(kLowest + 1);  // two counts further
  EXPECT_NEAR(after - before, 2 * 2.0 * M_PI / (1 << 20), 1e-10);
  EXPECT_NEAR(joint.position(kHighest), before, 1e-10);

  // round and round, both ways, against exact counting
  test::Random random(3);
  JointScaling wanderer(DriveConfig{.counts = 1 << 20, .gear = 1.0});
  std::int64_t exact = 0;
  wanderer.position(0);
  for (int k = 0; k < 100000; ++k) {
    exact += random.integer(-100000000, 101000000);
    const auto count = static_cast<std::int32_t>(static_cast<std::uint32_t>(exact));
    ASSERT_DOUBLE_EQ(wanderer.position(count), 2.0 * M_PI / (1 << 20) * static_cast<double>(exact)) << k;
  }
  EXPECT_GT(std::abs(exact), 1LL << 33);
}

TEST(JointScaling, BeginsAtThePositionNearestToZero) {
  // 2^32 counts are 10.24 turns of the joint: what is shown at -5.0 turns may as well be 5.24 turns
  const DriveConfig drive{.counts = 1 << 22, .gear = 100.0};
  const double turn = 4194304.0 * 100.0;
  JointScaling within(drive);
  EXPECT_NEAR(within.position(static_cast<std::int32_t>(-5.0 * turn)), -5.0 * 2.0 * M_PI, 1e-7);

  // the joint's zero lies just before the counter's wrap: 0.01 turns further the counter shows its lowest numbers
  DriveConfig at_wrap = drive;
  at_wrap.zero = -5.1 * 2.0 * M_PI;
  for (const double sign : {1.0, -1.0}) {
    at_wrap.sign = sign;
    at_wrap.zero = -sign * 5.1 * 2.0 * M_PI;
    JointScaling joint(at_wrap);
    const double counts = 5.13 * turn - 4294967296.0;  // beyond the wrap
    EXPECT_NEAR(joint.position(static_cast<std::int32_t>(counts)), sign * 0.03 * 2.0 * M_PI, 1e-7);
  }
}

/// A zero that is a million wraps of the counter away is no zero: the count is taken as it is. 2^28 turns of 16 counts
/// are a wrap; at these sizes a count is still more than the rounding of a double.
TEST(JointScaling, TakesNoWrapsOffAZeroOutOfProportion) {
  const double turn = 2.0 * M_PI;
  const double wrap = 268435456.0 * turn;
  for (const double sign : {1.0, -1.0}) {
    for (const double wraps : {1.05e6, 1.9e6}) {
      const double zero = sign * wraps * wrap;
      JointScaling far(DriveConfig{.counts = 16, .zero = zero});
      EXPECT_EQ(far.position(1000), zero + turn / 16 * 1000.0) << wraps;
      JointScaling none(DriveConfig{.counts = 16, .zero = sign * HUGE_VAL});
      EXPECT_EQ(none.position(1000), sign * HUGE_VAL);
    }
    for (const double wraps : {0.55e6, 0.95e6}) {
      JointScaling near(DriveConfig{.counts = 16, .zero = sign * wraps * wrap});
      EXPECT_LE(std::fabs(near.position(1000)), wrap / 2) << wraps;
    }
  }
}

}  // namespace
}  // namespace godobject::hal::cia402
