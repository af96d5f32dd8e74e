#include "hal/cia402/joint_channel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "tests/hal/frames.h"

namespace godobject::hal::cia402 {
namespace {

constexpr int kOff = 0x0250;
constexpr int kEnabled = 0x1237;     // follows the torque
constexpr int kBrakeOpens = 0x0237;  // does not yet
constexpr int kQuickStopActive = 0x0217;
constexpr int kFault = 0x0218;

/// 4000 counts and 2 Nm at the joint.
class JointChannelTest : public testing::Test {
 protected:
  bool take(int statusword, int count = 0, int permille = 0) {
    const auto byte = [](int value, int i) {
      return static_cast<int>(static_cast<std::uint32_t>(value) >> (8 * i) & 0xFF);
    };
    return channel_.take(frame(0x189, {byte(statusword, 0), byte(statusword, 1), byte(count, 0), byte(count, 1),
                                       byte(count, 2), byte(count, 3), byte(permille, 0), byte(permille, 1)}));
  }

  int controlword(PowerRequest power) {
    CanFrame rpdo;
    EXPECT_TRUE(channel_.command(power, 0.0, rpdo));
    return rpdo.data[0] | rpdo.data[1] << 8;
  }

  JointChannel channel_{DriveConfig{.node = 9, .counts = 4000, .gear = 1.0, .rated_torque = 2.0}, false, 1e-3};
};

TEST_F(JointChannelTest, ReadsEveryByteOfASample) {
  ASSERT_TRUE(take(kEnabled, 1000, -250));
  EXPECT_DOUBLE_EQ(channel_.position(), M_PI / 2.0);
  EXPECT_DOUBLE_EQ(channel_.torque(), -0.5);
  ASSERT_TRUE(take(kEnabled, 1000 + 0x01020304, 0x0102));
  EXPECT_DOUBLE_EQ(channel_.position(), 2.0 * M_PI / 4000 * (1000 + 0x01020304));
  EXPECT_DOUBLE_EQ(channel_.torque(), 0.002 * 0x0102);
}

TEST_F(JointChannelTest, AnInvalidSampleChangesNothing) {
  ASSERT_TRUE(take(kEnabled, 1000, 100));
  EXPECT_FALSE(take(0x0001, 2000, 200)) << "a state that the standard does not have";
  EXPECT_FALSE(channel_.take(frame(0x189, {0x50, 0x02, 0, 0, 0, 0, 0})));
  EXPECT_FALSE(channel_.take(frame(0x189, {0x50, 0x02, 0, 0, 0, 0, 0, 0, 0})));
  EXPECT_DOUBLE_EQ(channel_.position(), M_PI / 2.0);
  EXPECT_DOUBLE_EQ(channel_.torque(), 0.2);
  EXPECT_EQ(channel_.state(), DriveState::kEnabled);
}

/// Bit 11 in each state, whatever the other bits are; an invalid sample does not change it.
TEST_F(JointChannelTest, ReadsTheInternalLimit) {
  EXPECT_FALSE(channel_.limited());
  for (const int state : {kOff, kBrakeOpens, kEnabled, kQuickStopActive, kFault}) {
    ASSERT_TRUE(take(state | 0x0800));
    EXPECT_TRUE(channel_.limited()) << state;
    EXPECT_FALSE(channel_.take(frame(0x189, {0, 0})));
    EXPECT_TRUE(channel_.limited()) << state;
    ASSERT_TRUE(take(state | 0x2480));  // the bits beside it
    EXPECT_FALSE(channel_.limited()) << state;
  }
}

TEST_F(JointChannelTest, MakesFramesOfTheBusFormat) {
  CanFrame rpdo;
  JointChannel fd(DriveConfig{.node = 9, .rated_torque = 2.0}, true, 1e-3);
  EXPECT_TRUE(fd.command(PowerRequest::kOff, 1.0, rpdo));
  EXPECT_TRUE(rpdo.fd);
  EXPECT_EQ(rpdo.id, 0x209);
  ASSERT_TRUE(take(kEnabled));
  EXPECT_TRUE(channel_.command(PowerRequest::kEnable, -2.0 * 0.258, rpdo));
  EXPECT_EQ(rpdo, frame(0x209, {0x0F, 0x00, 0xFE, 0xFE}));  // -258 permille
  for (std::size_t i = 4; i < rpdo.data.size(); ++i) EXPECT_EQ(rpdo.data[i], 0);
}

/// A torque that is no number is told even where it is not sent.
TEST_F(JointChannelTest, TellsATorqueThatIsNotFiniteInEveryState) {
  for (const int statusword : {kOff, kEnabled, kQuickStopActive, kFault}) {
    for (const PowerRequest power :
         {PowerRequest::kOff, PowerRequest::kEnable, PowerRequest::kQuickStop, PowerRequest::kReset}) {
      ASSERT_TRUE(take(statusword));
      CanFrame rpdo;
      EXPECT_FALSE(channel_.command(power, std::nan(""), rpdo));
      EXPECT_EQ(rpdo.data[2], 0);
      EXPECT_EQ(rpdo.data[3], 0);
    }
  }
}

/// A drive that was in operation for itself, before the controller asked for power, is enabled as any other.
TEST_F(JointChannelTest, CountsOperationOnlySincePowerWasRequested) {
  take(kEnabled);
  controlword(PowerRequest::kOff);
  take(kEnabled);
  EXPECT_FALSE(channel_.left_torque_mode());
  EXPECT_EQ(controlword(PowerRequest::kEnable), 0x0F);
  take(kOff);  // by the command before
  EXPECT_EQ(controlword(PowerRequest::kEnable), 0x06) << "it was never enabled";
  take(kBrakeOpens);
  EXPECT_FALSE(channel_.left_torque_mode()) << "nor has it followed";
  EXPECT_EQ(controlword(PowerRequest::kEnable), 0x0F);
  take(kEnabled);
  EXPECT_FALSE(channel_.left_torque_mode());
  take(kBrakeOpens);
  EXPECT_TRUE(channel_.left_torque_mode());
}

TEST_F(JointChannelTest, ADriveMayBeEnabledByTheFirstRequest) {
  take(kOff);
  EXPECT_EQ(controlword(PowerRequest::kEnable), 0x06);
}

/// Outside operation bit 12 tells nothing of the mode.
TEST_F(JointChannelTest, LeavesTorqueModeOnlyInOperation) {
  controlword(PowerRequest::kEnable);
  take(kEnabled);
  for (const int statusword : {kQuickStopActive, kFault, kOff, 0x0231, 0x0233}) {
    take(statusword);
    EXPECT_FALSE(channel_.left_torque_mode()) << std::hex << statusword;
  }
  take(kBrakeOpens);
  EXPECT_TRUE(channel_.left_torque_mode());
}

/// Every reset begins with eight cycles of a low bit, however the one before ended.
TEST_F(JointChannelTest, EveryResetHoldsTheBitLowAndThenHighForEightCycles) {
  take(kFault);
  for (const int cycles : {16, 3, 8, 12, 16, 20, 40}) {
    for (int k = 0; k < cycles; ++k) {
      EXPECT_EQ(controlword(PowerRequest::kReset), k / 8 % 2 == 1 ? 0x80 : 0x00) << k << " of " << cycles;
    }
    EXPECT_EQ(controlword(PowerRequest::kOff), 0x00);
  }
}

/// Eight milliseconds of any period, and at least a cycle.
TEST(JointChannelReset, HoldsTheBitForATimeAndNotForACount) {
  for (const auto& [period, hold] : {std::pair{0.125e-3, 64}, {0.25e-3, 32}, {2e-3, 4}, {10e-3, 1}, {20e-3, 1}}) {
    JointChannel channel(DriveConfig{.node = 9, .counts = 4000, .rated_torque = 2.0}, false, period);
    ASSERT_TRUE(channel.take(frame(0x189, {0x18, 0x02, 0, 0, 0, 0, 0, 0})));
    for (int k = 0; k < 4 * hold; ++k) {
      CanFrame rpdo;
      ASSERT_TRUE(channel.command(PowerRequest::kReset, 0.0, rpdo));
      ASSERT_EQ(rpdo.data[0], k / hold % 2 == 1 ? 0x80 : 0x00) << period << ' ' << k;
    }
  }
}

}  // namespace
}  // namespace godobject::hal::cia402
