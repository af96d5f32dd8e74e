#include "firmware/cycle/model_watch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/arms.h"

namespace godobject::firmware {
namespace {

/// An arm at rest, held by what is sent. Joint 1 measures what a test says.
class ModelWatchTest : public testing::Test {
 protected:
  explicit ModelWatchTest(double period = 1e-3) : period_(period), watch_(arm_.model, period) {}

  double limit() const { return arm_.model.joints[1].torque; }

  /// A cycle; true if the drive of joint 1 is found.
  bool finds(double sent, double measured, bool limited = false, std::uint32_t age = 0) {
    JointVector torque = gravity_torque(arm_.model, kinematics_);
    torque[1] = sent;
    reading_.torque = torque;
    reading_.torque[1] = measured;
    reading_.limited[1] = limited;
    reading_.age[1] = age;
    watch_.update(kinematics_, JointVector::Zero(), reading_, torque, true);
    return watch_.wrong_torque_joint() == 1;
  }

  const test::Arm arm_ = test::lwr();
  const ArmKinematics kinematics_ =
      forward_kinematics(arm_.model, (JointVector() << 0.2, -0.5, 0.3, 1.4, 0.0, -1.2, 0.0).finished());
  double period_;
  ModelWatch watch_;
  hal::JointReading reading_;
};

TEST_F(ModelWatchTest, FindsADriveThatMeasuresAnotherTorque) {
  for (const double sign : {1.0, -1.0}) {
    watch_.reset();
    const double sent = 0.2 * limit();
    int cycles = 1;
    while (!finds(sent, sent + sign * 1.2 * ModelWatch::kTorqueError * limit()) && cycles < 1000) ++cycles;
    EXPECT_GE(cycles, static_cast<int>(ModelWatch::kTorque_ms));
    EXPECT_LE(cycles, 3 * static_cast<int>(ModelWatch::kTorque_ms))
        << "the range of torques before forgets the first 0";
    for (int i = 0; i < 1000; ++i) {
      if (i > 0)
        ASSERT_FALSE(finds(sent, sent + sign * 0.99 * ModelWatch::kTorqueError * limit()));
      else
        finds(sent, sent);
    }
  }
}

/// A drive that shows its own limit now and then does not hide by it that its torque is wrong.
TEST_F(ModelWatchTest, CountsOnBetweenCyclesWithoutAComparison) {
  for (const bool by_age : {false, true}) {
    watch_.reset();
    bool found = false;
    for (int i = 0; i < 400 && !found; ++i) {
      const bool left_out = i % 2 == 0;
      found = finds(0.5 * limit(), 0.0, left_out && !by_age, left_out && by_age ? 1 : 0);
    }
    EXPECT_TRUE(found) << by_age;
    watch_.reset();
    for (int i = 0; i < 1000; ++i) ASSERT_FALSE(finds(0.5 * limit(), 0.0, !by_age, by_age ? 1 : 0)) << by_age;
  }
}

/// The torque steps by `step` of the limit and back; the drive measures it through a filter of 20 ms.
void expect_filter_is_allowed(double period, double step) {
  const test::Arm arm = test::lwr();
  const ArmKinematics kinematics = forward_kinematics(arm.model, JointVector::Zero());
  ModelWatch watch(arm.model, period);
  hal::JointReading reading;
  const double limit = arm.model.joints[1].torque;
  double measured = 0.0;
  for (int i = 0; i < static_cast<int>(2.0 / period); ++i) {
    JointVector sent = JointVector::Zero();
    sent[1] = std::fmod(i * period, 0.8) < 0.4 ? step * limit : 0.0;
    reading.torque[1] = measured;
    watch.update(kinematics, JointVector::Zero(), reading, sent, false);
    ASSERT_EQ(watch.wrong_torque_joint(), -1) << "cycle " << i << " of " << period << " s, step " << step;
    measured += (1.0 - std::exp(-period / 0.02)) * (sent[1] - measured);
  }
}

TEST(ModelWatchOfAFilter, LetsADriveMeasureThroughAFilter) {
  for (const double period : {1.25e-4, 1e-3, 1e-2}) {
    for (const double step : {0.2, 0.5, 0.9}) expect_filter_is_allowed(period, step);
  }
}

}  // namespace
}  // namespace godobject::firmware
