#include "hal/cia402/can_drives.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/hal/can_drives_bench.h"
#include "tests/support/allocation_guard.h"
#include "tests/support/random.h"

namespace godobject::hal {
namespace {

TEST_F(CanDrivesTest, SyncIsTheFirstFrameAndThenOneRpdoAJoint) {
  EXPECT_EQ(drives_.collect_ns(), 500'000);
  EXPECT_EQ(drives_.delay(), 0.7e-3);
  drives_.request();
  EXPECT_EQ(bus_.take_sent(), (std::vector<CanFrame>{frame(0x080, {}), frame(0x77F, {0x05})}));
  answer_all(kEnabled);
  receive();
  JointCommand command;
  command.power = PowerRequest::kEnable;
  command.torque[0] = 3.21;  // 20 Nm a 1000 permille: 160.5, away from zero 161 = 0x00A1
  command.torque[1] = 0.5;   // -5 Nm a 1000 permille: -100 = 0xFF9C
  EXPECT_TRUE(drives_.send(command));
  const std::vector<CanFrame> expected = {frame(0x205, {0x0F, 0x00, 0xA1, 0x00}),
                                          frame(0x203, {0x0F, 0x00, 0x9C, 0xFF})};
  EXPECT_EQ(bus_.sent, expected);
}

TEST_F(CanDrivesTest, NothingFollowsSyncWhileDrivesTakeTheirTimeToAnswer) {
  BusLayout slow = layout();
  slow.answer = 100e-6;
  CanDrives drives(slow, wires_, {});
  int heartbeats = 0;
  int requests = 0;
  for (int k = 0; k < 200; ++k) {
    drives.request();
    EXPECT_EQ(bus_.take_sent(), (std::vector<CanFrame>{frame(0x080, {})}));
    answer_all(kOff);
    drives.receive(reading_);
    for (const CanFrame& sent : bus_.take_sent()) {  // while the torques are computed
      heartbeats += sent == frame(0x77F, {0x05}) ? 1 : 0;
      requests += sent.id == 0x603 || sent.id == 0x605 ? 1 : 0;
    }
    drives.send({});
    EXPECT_EQ(bus_.take_sent().size(), 2u);
  }
  EXPECT_EQ(heartbeats, 10);
  EXPECT_GE(requests, 2);
}

/// A bus whose second drive tells its temperature, and whose drives answer for their parameters as the start left them.
class CanDrivesTemperatureTest : public CanDrivesTest {
 protected:
  static BusLayout with_temperature() {
    BusLayout warm = layout();
    warm.drives[1].temperature = {.index = 0x2310, .subindex = 2, .scale = 0.1, .warn = 70.0, .stop = 85.0};
    return warm;
  }

  void step(PowerRequest power = PowerRequest::kOff) {
    drives.request();
    if (++cycles_ % 20 == 0) heartbeats();
    answer_all(kOff);
    drives.receive(reading_);
    drives.send({JointVector::Zero(), power});
    for (const CanFrame& sent : bus_.take_sent()) {
      if (sent.id == 0x603 || sent.id == 0x605) answer(sent);
    }
  }

  void answer(const CanFrame& request) {
    const int index = request.data[1] | request.data[2] << 8;
    const int sub = request.data[3];
    const auto reply = [&](int command, int low, int high = 0, int last = 0) {
      bus_.receive_next(frame(static_cast<std::uint16_t>(request.id - 0x80),
                              {command, request.data[1], request.data[2], sub, low, high, last, 0}));
    };
    if (index == 0x2310) {
      EXPECT_EQ(request.id, 0x603) << "the other drive has none";
      ++asked;
      if (answers) reply(0x4B, tenths & 0xFF, tenths >> 8 & 0xFF);
      return;
    }
    if (index == 0x1016) return reply(0x43, 0x32, 0x00, 0x7F);
    if (index == 0x1400 && sub == 2) return reply(0x4F, 255);
    if (index == 0x6061) return reply(0x4F, 10);
    reply(0x4B, index == 0x1400 ? 4 : index == 0x6007 ? 3 : 2);
  }

  /// Steps until `done`, at most so many cycles. Returns their number.
  template <class Done>
  int steps_until(int most, Done&& done) {
    int k = 0;
    while (k < most && !done()) {
      step();
      ++k;
    }
    return k;
  }

  CanDrives drives{with_temperature(), wires_, {}};
  int tenths = 300;
  bool answers = true;
  int asked = 0;
};

TEST_F(CanDrivesTemperatureTest, IsReadOnceASecondAndStopsTheArmUntilItHasCooled) {
  for (int k = 0; k < 10'000; ++k) step();
  EXPECT_GE(asked, 10);
  EXPECT_LE(asked, 20);
  EXPECT_EQ(reading_.alarm, Alarm::kNone);
  EXPECT_FALSE(reading_.warm[1] || reading_.temperature_lost[1]);
  EXPECT_EQ(drives.statistics().hottest_joint, 1);
  EXPECT_NEAR(drives.statistics().hottest, 30.0, 1e-9);
  tenths = 700;
  EXPECT_LT(steps_until(1100, [&] { return reading_.warm[1]; }), 1000);
  EXPECT_EQ(reading_.alarm, Alarm::kNone) << "it is a warning";
  tenths = 850;
  EXPECT_LT(steps_until(1100, [&] { return reading_.alarm != Alarm::kNone; }), 1000);
  EXPECT_EQ(reading_.alarm, Alarm::kTooHot);
  EXPECT_EQ(reading_.alarm_joint, 1);
  EXPECT_EQ(drives.alarm_detail().index, 0x2310);
  EXPECT_EQ(drives.alarm_detail().subindex, 2);
  EXPECT_NEAR(drives.alarm_detail().celsius, 85.0, 1e-9);
  for (int k = 0; k < 100; ++k) step(PowerRequest::kReset);
  EXPECT_EQ(reading_.alarm, Alarm::kTooHot) << "a reset does not cool it";
  tenths = 690;
  for (int k = 0; k < 1100; ++k) step();
  EXPECT_EQ(reading_.alarm, Alarm::kTooHot) << "it stays until it is reset";
  step(PowerRequest::kReset);
  step();
  EXPECT_EQ(reading_.alarm, Alarm::kNone);
  EXPECT_FALSE(reading_.warm[1]);
  EXPECT_NEAR(drives.statistics().hottest, 85.0, 1e-9);
}

TEST_F(CanDrivesTemperatureTest, ThatIsNotAnsweredIsAWarningAndThenAnAlarm) {
  steps_until(2000, [&] { return asked == 1; });
  answers = false;
  const int to_warning = steps_until(3000, [&] { return reading_.temperature_lost[1]; });
  EXPECT_LT(to_warning, 1100);
  EXPECT_EQ(reading_.alarm, Alarm::kNone);
  EXPECT_LT(to_warning + steps_until(3000, [&] { return reading_.alarm != Alarm::kNone; }), 3100);
  EXPECT_EQ(reading_.alarm, Alarm::kTemperatureLost);
  EXPECT_EQ(reading_.alarm_joint, 1);
  EXPECT_EQ(asked, 4);
  answers = true;
  for (int k = 0; k < 1100; ++k) step();
  EXPECT_FALSE(reading_.temperature_lost[1]);
  step(PowerRequest::kReset);
  step();
  EXPECT_EQ(reading_.alarm, Alarm::kNone);
}

/// A lost sample keeps the bit of the last one.
TEST_F(CanDrivesTest, TellsTheInternalLimitOfEachDrive) {
  cycle(kEnabled);
  EXPECT_FALSE(reading_.limited[0] || reading_.limited[1]);
  drives_.request();
  bus_.receive_next(tpdo(5, kEnabled | 0x0800, 0, 0));
  bus_.receive_next(tpdo(3, kEnabled, 0, 0));
  EXPECT_TRUE(receive().limited[0]);
  EXPECT_FALSE(reading_.limited[1]);
  drives_.request();
  bus_.receive_next(tpdo(3, kEnabled | 0x0800, 0, 0));
  EXPECT_TRUE(receive().limited[0]) << "its sample is lost";
  EXPECT_TRUE(reading_.limited[1]);
  cycle(kEnabled);
  EXPECT_FALSE(reading_.limited[0] || reading_.limited[1]);
}

TEST_F(CanDrivesTest, ReadsPositionTorqueAndState) {
  count_0_ = 2500;   // of 10 000 a turn
  count_1_ = -1000;  // a quarter turn, the other way round
  cycle(kEnabled);
  EXPECT_NEAR(reading_.position[0], M_PI / 2, 1e-12);
  EXPECT_NEAR(reading_.position[1], 1.0 + M_PI / 2, 1e-12);
  EXPECT_NEAR(reading_.torque[0], 2.0, 1e-12);
  EXPECT_NEAR(reading_.torque[1], 0.25, 1e-12);
  EXPECT_EQ(reading_.age[0], 0u);
  EXPECT_EQ(reading_.age[1], 0u);
  EXPECT_EQ(reading_.state[0], DriveState::kEnabled);
  EXPECT_EQ(reading_.alarm, Alarm::kNone);
  cycle(kEnabled);
  EXPECT_EQ(drives_.statistics().round_trip_ns, 300'000);  // three frames behind SYNC
}

TEST_F(CanDrivesTest, FollowsACounterOverItsWrap) {
  count_1_ = std::numeric_limits<std::int32_t>::max() - 9;
  cycle(kOff);
  const double before = reading_.position[1];
  count_1_ = std::numeric_limits<std::int32_t>::min() + 10;
  cycle(kOff);
  EXPECT_NEAR(reading_.position[1] - before, -20 * 2 * M_PI / 4000, 1e-9);
}

TEST_F(CanDrivesTest, StatesAreUnavailableUntilSomethingComes) {
  EXPECT_EQ(receive().state[0], DriveState::kUnavailable);
  EXPECT_TRUE(reading_.emergency_stop);
  EXPECT_FALSE(reading_.enable_switch);
  for (const auto& [statusword, state] :
       {std::pair(kOff, DriveState::kOff), std::pair(kReady, DriveState::kOff),
        std::pair(kSwitchedOn, DriveState::kOff), std::pair(kEnabled, DriveState::kEnabled),
        std::pair(kBrakeOpens, DriveState::kEnabled),  // nobody asked for it
        std::pair(kQuickStopActive, DriveState::kQuickStop), std::pair(kFault, DriveState::kFault),
        std::pair(0x021F, DriveState::kFault), std::pair(0x0000, DriveState::kUnavailable)}) {
    cycle(statusword);
    EXPECT_EQ(reading_.state[1], state) << std::hex << statusword;
  }
}

TEST_F(CanDrivesTest, ASampleIsFreshOnlyBehindItsOwnSyncsEcho) {
  cycle(kOff);
  // late ones of the cycle before, in front of the echo
  bus_.receive_next(tpdo(5, kOff, 77, 0));
  drives_.request();
  bus_.receive_next(tpdo(3, kOff, 400, 0));
  receive();
  EXPECT_EQ(reading_.age[0], 1u);
  EXPECT_EQ(reading_.age[1], 0u);
  EXPECT_EQ(reading_.position[0], 0.0);
  EXPECT_EQ(drives_.statistics().late[0], 1u);
  EXPECT_EQ(drives_.statistics().lost[0], 1u);
  // somebody else's SYNC does not count as the echo, and a sample without an echo is late
  bus_.echoes = false;
  drives_.request();
  bus_.receive_next(frame(0x080, {}));
  bus_.receive_next(tpdo(5, kOff, 88, 0));
  EXPECT_EQ(receive().age[0], 2u);
  // the echo comes a cycle later: what follows it belongs to the cycle before, and no other SYNC was sent behind it
  bus_.take_sent();
  drives_.request();
  EXPECT_TRUE(bus_.take_sent().empty());
  bus_.receive_next(frame(0x080, {}), true);
  bus_.receive_next(tpdo(5, kOff, 99, 0));
  EXPECT_EQ(receive().age[0], 3u);
  // in step again
  bus_.echoes = true;
  drives_.request();
  bus_.receive_next(tpdo(5, kOff, 1000, 0));
  EXPECT_EQ(receive().age[0], 0u);
  EXPECT_NEAR(reading_.position[0], 2 * M_PI / 10, 1e-12);
}

TEST_F(CanDrivesTest, ASampleAfterAFailedSyncIsLate) {
  cycle(kOff);
  bus_.result = SendResult::kFull;
  drives_.request();
  bus_.result = SendResult::kSent;
  answer_all(kOff);
  EXPECT_EQ(receive().age[0], 1u);
  EXPECT_FALSE(drives_.send({}));
  EXPECT_EQ(drives_.statistics().full, 1u);
}

TEST_F(CanDrivesTest, NewestSampleWins) {
  drives_.request();
  bus_.receive_next(tpdo(5, kOff, 1000, 0));
  bus_.receive_next(tpdo(5, kOff, 2000, 0));
  EXPECT_NEAR(receive().position[0], 4 * M_PI / 10, 1e-12);
  drives_.request();
  bus_.receive_next(tpdo(5, kOff, 2000, 0));
  bus_.receive_next(tpdo(5, kOff, 2000, 0));  // a duplicate changes nothing
  EXPECT_NEAR(receive().position[0], 4 * M_PI / 10, 1e-12);
}

TEST_F(CanDrivesTest, StepsThroughThePowerStates) {
  const auto enable = PowerRequest::kEnable;
  EXPECT_EQ(controlwords(cycle(kOff)), std::pair(0x00, 0x00));
  EXPECT_EQ(controlwords(cycle(kOff, enable)), std::pair(0x06, 0x06));
  EXPECT_EQ(controlwords(cycle(kReady, enable)), std::pair(0x07, 0x07));
  EXPECT_EQ(controlwords(cycle(kSwitchedOn, enable)), std::pair(0x0F, 0x0F));
  EXPECT_EQ(controlwords(cycle(kBrakeOpens, enable)), std::pair(0x0F, 0x0F));
  EXPECT_EQ(reading_.state[0], DriveState::kOff);  // not before it follows
  EXPECT_EQ(controlwords(cycle(kEnabled, enable)), std::pair(0x0F, 0x0F));
  EXPECT_EQ(reading_.state[0], DriveState::kEnabled);
  EXPECT_EQ(controlwords(cycle(kEnabled, PowerRequest::kQuickStop)), std::pair(0x02, 0x02));
  EXPECT_EQ(controlwords(cycle(kQuickStopActive, PowerRequest::kQuickStop)), std::pair(0x02, 0x02));
  EXPECT_EQ(controlwords(cycle(kQuickStopActive, PowerRequest::kOff)), std::pair(0x00, 0x00));
}

TEST_F(CanDrivesTest, OnlyEnabledDrivesAreSentTorques) {
  const auto torque = [](const std::vector<CanFrame>& sent) { return sent.at(0).data[2] | sent.at(0).data[3] << 8; };
  EXPECT_EQ(torque(cycle(kEnabled, PowerRequest::kEnable, 1.0)), 50);
  for (const PowerRequest power : {PowerRequest::kOff, PowerRequest::kQuickStop, PowerRequest::kReset}) {
    EXPECT_EQ(torque(cycle(kEnabled, power, 1.0)), 0);
  }
}

TEST_F(CanDrivesTest, WithholdsRpdosOnlyWhereNoPowerIsAskedFor) {
  drives_.withhold(0);
  const std::vector<CanFrame> sent = cycle(kOff);
  EXPECT_EQ(std::ranges::count(sent, frame(0x205, {0, 0, 0, 0})), 0);
  EXPECT_EQ(std::ranges::count(sent, frame(0x203, {0, 0, 0, 0})), 1);
  EXPECT_TRUE(sent_);
  for (const PowerRequest power : {PowerRequest::kEnable, PowerRequest::kQuickStop, PowerRequest::kReset}) {
    EXPECT_EQ(cycle(kOff, power).at(0).id, 0x205);
  }
  drives_.withhold(-1);
  EXPECT_EQ(cycle(kOff).at(0).id, 0x205);
}

TEST_F(CanDrivesTest, NeverEnablesADriveAgainByItself) {
  const auto enable = PowerRequest::kEnable;
  cycle(kOff, enable);
  cycle(kEnabled, enable);
  EXPECT_EQ(controlwords(cycle(kQuickStopActive, enable, 1.0)), std::pair(0x02, 0x02));
  for (int k = 0; k < 100; ++k) {
    const std::vector<CanFrame> sent = cycle(kOff, enable, 1.0);
    EXPECT_EQ(controlwords(sent), std::pair(0x02, 0x02));
    EXPECT_EQ(sent.at(0), frame(0x205, {0x02, 0, 0, 0}));
  }
  cycle(kOff, PowerRequest::kOff);
  EXPECT_EQ(controlwords(cycle(kOff, enable)), std::pair(0x06, 0x06));
}

TEST_F(CanDrivesTest, ADriveThatNeverFollowedIsNotEnabledAgainEither) {
  const auto enable = PowerRequest::kEnable;
  cycle(kBrakeOpens, enable);
  cycle(kBrakeOpens, enable);  // in operation, not yet in its mode
  EXPECT_EQ(controlwords(cycle(kOff, enable)), std::pair(0x02, 0x02));
  EXPECT_EQ(controlwords(cycle(kReady, enable)), std::pair(0x02, 0x02));
}

TEST_F(CanDrivesTest, EachEnablingHasItsOwnTimeToFollow) {
  const auto enable = PowerRequest::kEnable;
  cycle(kOff, enable);
  cycle(kEnabled, enable);
  cycle(kEnabled, PowerRequest::kQuickStop);
  cycle(kOff, PowerRequest::kOff);
  for (int k = 0; k < 5; ++k) cycle(kBrakeOpens, enable);
  EXPECT_EQ(reading_.alarm, Alarm::kNone) << "it followed before the stop, not since";
  cycle(kEnabled, enable);
  cycle(kBrakeOpens, enable);
  EXPECT_EQ(reading_.alarm, Alarm::kWrongMode);
}

TEST_F(CanDrivesTest, ResetsAFaultByRisingEdgesOnly) {
  cycle(kFault, PowerRequest::kOff);
  int edges = 0;
  int last = 0;
  int high = 0;
  for (int k = 0; k < 64; ++k) {
    const int word = controlwords(cycle(kFault, PowerRequest::kReset)).first;
    ASSERT_TRUE(word == 0x00 || word == 0x80);
    edges += word == 0x80 && last == 0x00 ? 1 : 0;
    high += word == 0x80 ? 1 : 0;
    if (k == 0) {
      EXPECT_EQ(word, 0x00);  // whatever was sent before: an edge comes
    }
    last = word;
  }
  EXPECT_EQ(edges, 4);
  EXPECT_EQ(high, 32);
  EXPECT_EQ(controlwords(cycle(kOff, PowerRequest::kReset)).first, 0x00);
  // nothing else resets a fault
  for (const PowerRequest power : {PowerRequest::kOff, PowerRequest::kEnable, PowerRequest::kQuickStop}) {
    EXPECT_EQ(controlwords(cycle(kFault, power)).first, 0x00);
  }
}

TEST_F(CanDrivesTest, ATorqueThatIsNoNumberBecomesZeroAndAFailure) {
  for (const double none : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    const std::vector<CanFrame> sent = cycle(kEnabled, PowerRequest::kEnable, none);
    EXPECT_EQ(sent.at(0), frame(0x205, {0x0F, 0, 0, 0}));
    EXPECT_EQ(sent.at(1), frame(0x203, {0x0F, 0, 0, 0}));
    EXPECT_FALSE(sent_);
  }
  EXPECT_EQ(cycle(kEnabled, PowerRequest::kEnable, 1e9).at(0), frame(0x205, {0x0F, 0, 0xFF, 0x7F}));
  EXPECT_TRUE(sent_);
  EXPECT_EQ(cycle(kEnabled, PowerRequest::kEnable, 1e9).at(1), frame(0x203, {0x0F, 0, 0x01, 0x80}));
}

TEST_F(CanDrivesTest, AFullQueueIsCountedAndTold) {
  cycle(kOff);
  EXPECT_TRUE(sent_);
  drives_.request();
  answer_all(kOff);
  receive();
  bus_.result = SendResult::kFull;
  EXPECT_FALSE(drives_.send({}));
  EXPECT_EQ(drives_.statistics().full, 2u);
  EXPECT_EQ(receive().alarm, Alarm::kNone);
}

TEST_F(CanDrivesTest, ADriveThatIsSilentKeepsItsStateForATimeOnly) {
  cycle(kEnabled, PowerRequest::kEnable);
  for (std::uint32_t age = 1; age <= 60; ++age) {
    drives_.request();
    if (age % 10 == 0) heartbeats();
    bus_.receive_next(frame(0x1A0, {0x03}));
    receive();
    EXPECT_EQ(reading_.age[0], age);
    EXPECT_EQ(reading_.state[0], age > 50 ? DriveState::kUnavailable : DriveState::kEnabled);
    JointCommand command;
    command.power = PowerRequest::kEnable;
    drives_.send(command);
  }
  EXPECT_EQ(reading_.alarm, Alarm::kNone);
  EXPECT_EQ(drives_.statistics().lost[0], 60u);
}

TEST_F(CanDrivesTest, WrongFramesCountAsLostAndThreeInARowAreAnAlarm) {
  const std::vector<CanFrame> wrong = {
      frame(0x185, {0x50, 0x02, 0, 0, 0, 0, 0}),  // seven bytes
      frame(0x185, {}),
      tpdo(5, 0x0207 | 0x40, 0, 0),  // a state that the standard does not have
      tpdo(5, 0x0001, 0, 0),
      frame(0x185, {0x50, 0x02, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}),
  };
  for (const CanFrame& bad : wrong) {
    cycle(kOff);
    for (int k = 1; k <= 2; ++k) {
      drives_.request();
      bus_.receive_next(bad);
      bus_.receive_next(frame(0x1A0, {0x03}));
      receive();
      EXPECT_EQ(reading_.age[0], static_cast<std::uint32_t>(k));
      EXPECT_EQ(reading_.alarm, Alarm::kNone);
      drives_.send({});
    }
  }
  drives_.request();
  bus_.receive_next(wrong[2]);
  receive();
  EXPECT_EQ(reading_.alarm, Alarm::kBadFrames);
  EXPECT_EQ(reading_.alarm_joint, 0);
  EXPECT_EQ(drives_.statistics().malformed, 11u);
}

TEST_F(CanDrivesTest, BadFramesBeforeAResetDoNotCountAfterIt) {
  const auto bad = [this](PowerRequest power) {
    drives_.request();
    bus_.receive_next(frame(0x185, {0x50, 0x02}));
    bus_.receive_next(tpdo(3, kOff, 0, 0));
    bus_.receive_next(frame(0x1A0, {0x03}));
    receive();
    drives_.send({JointVector::Zero(), power});
  };
  cycle(kOff);
  bad(PowerRequest::kOff);
  bad(PowerRequest::kReset);
  bad(PowerRequest::kReset);
  bad(PowerRequest::kReset);
  EXPECT_EQ(reading_.alarm, Alarm::kNone);
  bad(PowerRequest::kReset);
  EXPECT_EQ(reading_.alarm, Alarm::kBadFrames);
}

TEST_F(CanDrivesTest, APanelThatNeverToldItsInputsIsSilentNotLost) {
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(reading_.alarm, Alarm::kNone);
    drives_.request();
    bus_.receive_next(tpdo(5, kOff, 0, 0));
    bus_.receive_next(tpdo(3, kOff, 0, 0));
    receive();
    drives_.send({});
  }
  EXPECT_EQ(reading_.alarm, Alarm::kPanelSilent);
  EXPECT_TRUE(reading_.emergency_stop);
}

TEST_F(CanDrivesTest, PanelBits) {
  for (int inputs = 0; inputs < 8; ++inputs) {
    panel_inputs_ = inputs;
    cycle(kOff);
    EXPECT_EQ(reading_.emergency_stop, (inputs & 1) == 0);
    EXPECT_EQ(reading_.enable_switch, (inputs & 2) != 0);
    EXPECT_EQ(reading_.clutch_open, (inputs & 4) != 0);
  }
}

TEST_F(CanDrivesTest, ThreeCyclesWithoutThePanelAreAnEmergencyStop) {
  cycle(kOff);
  for (int lost = 1; lost <= 3; ++lost) {
    EXPECT_FALSE(reading_.emergency_stop);
    drives_.request();
    bus_.receive_next(tpdo(5, kOff, 0, 0));
    bus_.receive_next(tpdo(3, kOff, 0, 0));
    if (lost == 2) bus_.receive_next(frame(0x1A0, {0x03, 0x03}));  // wrong length
    receive();
    drives_.send({});
  }
  EXPECT_TRUE(reading_.emergency_stop);
  EXPECT_FALSE(reading_.enable_switch);
  EXPECT_EQ(reading_.alarm, Alarm::kPanelLost);
  EXPECT_EQ(reading_.alarm_joint, -1);
}

TEST_F(CanDrivesTest, WithoutAPanelNothingIsHeldOrPressed) {
  BusLayout without = layout();
  without.panel.bus = -1;
  CanDrives drives(without, wires_, {});
  for (int k = 0; k < 10; ++k) {
    drives.request();
    drives.receive(reading_);
  }
  EXPECT_FALSE(reading_.enable_switch);
  EXPECT_FALSE(reading_.emergency_stop);
  EXPECT_EQ(reading_.alarm, Alarm::kNone);
}

struct AlarmCase {
  CanFrame frame;
  Alarm alarm;
  int joint;
};

TEST_F(CanDrivesTest, AlarmsOfSingleFrames) {
  const std::vector<AlarmCase> cases = {
      {frame(0x705, {0x00}), Alarm::kNodeReset, 0},
      {frame(0x703, {0x7F}), Alarm::kWrongMode, 1},
      {frame(0x703, {0x04}), Alarm::kWrongMode, 1},
      {frame(0x703, {0x05}), Alarm::kNone, -1},
      {frame(0x704, {0x00}), Alarm::kNone, -1},  // none of ours
      {frame(0x720, {0x00}), Alarm::kNodeReset, -1},
      {frame(0x083, {0x50, 0x82, 0x11, 0, 0, 0, 0, 0}), Alarm::kDriveError, 1},
      {frame(0x083, {0x10, 0x81, 0x11, 0, 0, 0, 0, 0}), Alarm::kNone, -1},  // warnings
      {frame(0x083, {0x20, 0x81, 0x11, 0, 0, 0, 0, 0}), Alarm::kNone, -1},
      {frame(0x083, {0x00, 0x00, 0x00, 0, 0, 0, 0, 0}), Alarm::kNone, -1},
      {frame(0x083, {0x30, 0x81, 0x11, 0, 0, 0, 0, 0}), Alarm::kDriveError, 1},
      {frame(0x080, {}), Alarm::kForeignMaster, -1},
      {frame(0x205, {0x0F, 0x00, 0x00, 0x00}), Alarm::kForeignMaster, -1},
      {frame(0x77F, {0x05}), Alarm::kForeignMaster, -1},
      {frame(0x605, {0x40, 0x41, 0x60, 0, 0, 0, 0, 0}), Alarm::kForeignMaster, 0},
      {frame(0x605, {0x2B, 0x05, 0x14, 0x05, 0, 0, 0, 0}), Alarm::kForeignWrite, 0},
      {frame(0x603, {0xC6, 0x05, 0x14, 0x05, 0, 0, 0, 0}), Alarm::kForeignWrite, 1},
      {frame(0x000, {0x80, 0x03}), Alarm::kForeignWrite, 1},
      {frame(0x000, {0x80, 0x00}), Alarm::kForeignWrite, -1},
      {frame(0x281, {1, 2, 3}), Alarm::kNone, -1},
      {frame(0x7FF, {1, 2, 3}), Alarm::kNone, -1},
  };
  for (const AlarmCase& one : cases) {
    CanDrives drives(layout(), wires_, {});
    drives.request();
    answer_all(kOff);
    bus_.receive_next(one.frame);
    drives.receive(reading_);
    EXPECT_EQ(reading_.alarm, one.alarm) << one.frame;
    EXPECT_EQ(reading_.alarm_joint, one.joint) << one.frame;
    EXPECT_EQ(drives.alarm_detail().id, one.alarm == Alarm::kNone ? 0 : one.frame.id);
    bus_.take_sent();
  }
}

TEST_F(CanDrivesTest, EmergencyCodeIsKept) {
  alarm_of(frame(0x083, {0x10, 0x23, 0x03, 0, 0, 0, 0, 0}));
  EXPECT_EQ(drives_.alarm_detail().found, 0x2310u);
}

TEST_F(CanDrivesTest, FirstAlarmStaysUntilAReset) {
  EXPECT_EQ(alarm_of(frame(0x083, {0x10, 0x23, 0x03, 0, 0, 0, 0, 0})), Alarm::kDriveError);
  EXPECT_EQ(alarm_of(frame(0x205, {0, 0, 0, 0})), Alarm::kDriveError);
  cycle(kOff, PowerRequest::kOff);
  EXPECT_EQ(reading_.alarm, Alarm::kDriveError);
  cycle(kOff, PowerRequest::kReset);
  cycle(kOff, PowerRequest::kReset);
  EXPECT_EQ(reading_.alarm, Alarm::kNone);
  // one that comes while the reset goes on stays
  drives_.request();
  answer_all(kOff);
  bus_.receive_next(frame(0x205, {0, 0, 0, 0}));
  receive();
  drives_.send({JointVector::Zero(), PowerRequest::kReset});
  cycle(kOff, PowerRequest::kReset);
  EXPECT_EQ(reading_.alarm, Alarm::kForeignMaster);
}

TEST_F(CanDrivesTest, WhatOnlyANewStartMendsOutlivesAReset) {
  alarm_of(frame(0x083, {0x10, 0x23, 0x03, 0, 0, 0, 0, 0}));
  EXPECT_EQ(alarm_of(frame(0x705, {0x00})), Alarm::kDriveError);  // the first one is told
  cycle(kOff, PowerRequest::kReset);
  cycle(kOff);
  EXPECT_EQ(reading_.alarm, Alarm::kNodeReset);
  cycle(kOff, PowerRequest::kReset);
  cycle(kOff);
  EXPECT_EQ(reading_.alarm, Alarm::kNodeReset);
  EXPECT_EQ(reading_.alarm_joint, 0);
}

TEST_F(CanDrivesTest, HeartbeatLostAfterItsTimeout) {
  int first_alarm = 0;
  for (int k = 1; k <= 60 && first_alarm == 0; ++k) {
    drives_.request();
    if (k == 1) heartbeats();
    if (k > 1 && k % 20 == 0) bus_.receive_next(frame(0x705, {0x05}));
    answer_all(kOff);
    if (receive().alarm != Alarm::kNone) first_alarm = k;
    drives_.send({});
  }
  EXPECT_EQ(reading_.alarm, Alarm::kHeartbeatLost);
  EXPECT_EQ(reading_.alarm_joint, 1);
  EXPECT_EQ(first_alarm, 52);  // 51 ms after the last one
}

TEST_F(CanDrivesTest, ADriveThatNoLongerFollowsIsInTheWrongMode) {
  cycle(kBrakeOpens, PowerRequest::kEnable);
  cycle(kBrakeOpens, PowerRequest::kEnable);
  EXPECT_EQ(reading_.alarm, Alarm::kNone);
  cycle(kEnabled, PowerRequest::kEnable);
  cycle(kBrakeOpens, PowerRequest::kEnable);
  EXPECT_EQ(reading_.alarm, Alarm::kWrongMode);
  EXPECT_EQ(reading_.state[0], DriveState::kOff);
}

TEST_F(CanDrivesTest, AModeToldByTpdo2IsAnAlarmInTheCycleInWhichItComes) {
  for (int k = 0; k < 3; ++k) cycle(kEnabled, PowerRequest::kEnable);
  bus_.receive_next(frame(0x283, {0x0A}));
  cycle(kEnabled, PowerRequest::kEnable);
  EXPECT_EQ(reading_.alarm, Alarm::kNone);
  drives_.request();
  answer_all(kEnabled);  // bit 12 stays
  bus_.receive_next(frame(0x283, {0x08}));
  receive();
  EXPECT_EQ(reading_.alarm, Alarm::kWrongMode);
  EXPECT_EQ(reading_.alarm_joint, 1);
  EXPECT_EQ(drives_.alarm_detail().index, 0x6061);
  EXPECT_EQ(drives_.alarm_detail().expected, 10u);
  EXPECT_EQ(drives_.alarm_detail().found, 8u);
  drives_.send({});
  // a reset does not hide what is still so, whether it is told again or not
  for (int k = 0; k < 3; ++k) cycle(kOff, PowerRequest::kReset);
  EXPECT_EQ(reading_.alarm, Alarm::kWrongMode);
  bus_.receive_next(frame(0x283, {0x0A}));
  cycle(kOff);
  cycle(kOff, PowerRequest::kReset);
  cycle(kOff);
  EXPECT_EQ(reading_.alarm, Alarm::kNone);
}

TEST_F(CanDrivesTest, AModeOfAnotherLengthOrNodeIsPassedOver) {
  cycle(kOff);
  for (const CanFrame& other : {frame(0x283, {}), frame(0x283, {8, 0}), frame(0x284, {8}), frame(0x2A0, {8})}) {
    EXPECT_EQ(alarm_of(other), Alarm::kNone) << other;
  }
  EXPECT_EQ(drives_.statistics().malformed, 2u);
}

TEST_F(CanDrivesTest, FramesOfAFewCyclesMayBeOnTheirWay) {
  bus_.state = {.unreturned = 32};
  EXPECT_EQ(receive().alarm, Alarm::kNone);
}

TEST_F(CanDrivesTest, ADeadBusIsAnAlarm) {
  for (const BusHealth& health : {BusHealth{.down = true}, BusHealth{.bus_off = true}, BusHealth{.unreturned = 33}}) {
    CanDrives drives(layout(), wires_, {});
    bus_.state = health;
    drives.receive(reading_);
    EXPECT_EQ(reading_.alarm, Alarm::kBusDown);
  }
  bus_.state = BusHealth();
  bus_.result = SendResult::kDown;
  drives_.request();
  EXPECT_EQ(receive().alarm, Alarm::kBusDown);
  EXPECT_FALSE(drives_.send({}));
}

TEST_F(CanDrivesTest, HeartbeatOfTheControllerGoesWithTheCycles) {
  int heartbeats = 0;
  for (int k = 0; k < 200; ++k) {
    const std::vector<CanFrame> sent = cycle(kOff);
    const auto count = std::ranges::count(sent, frame(0x77F, {0x05}));
    EXPECT_EQ(count, k % 20 == 0 ? 1 : 0) << k;
    heartbeats += static_cast<int>(count);
  }
  EXPECT_EQ(heartbeats, 10);
}

/// Answers the read-backs of `cycles` cycles as the start left the objects, but for one; returns how many there were.
class ReadBackTest : public CanDrivesTest {
 protected:
  int run(int cycles, std::uint16_t changed, std::uint32_t value) {
    int reads = 0;
    for (int k = 0; k < cycles; ++k) {
      int extra = 0;
      for (const CanFrame& sent : cycle(kOff)) {
        if (sent.id >= 0x600 && sent.id < 0x680) {
          ++reads;
          ++extra;
          answer(sent, changed, value);
        } else if (sent.id == 0x77F) {
          ++extra;
        }
      }
      EXPECT_LE(extra, 1);  // never heartbeat and SDO in one cycle
      if (reading_.alarm != Alarm::kNone) break;
    }
    return reads;
  }

  void answer(const CanFrame& request, std::uint16_t changed, std::uint32_t value) {
    EXPECT_EQ(request.data[0], 0x40);
    const int index = request.data[1] | request.data[2] << 8;
    asked_.push_back({request.id - 0x600, index});
    std::uint32_t present = 0;
    int command = 0x4B;
    switch (index) {
      case 0x1400:
        present = request.data[3] == 5 ? 4 : 255;
        command = request.data[3] == 5 ? 0x4B : 0x4F;
        break;
      case 0x1016:
        present = 0x007F0032;
        command = 0x43;
        break;
      case 0x6007: present = 3; break;
      case 0x605A: present = 2; break;
      case 0x6061:
        present = 10;
        command = 0x4F;
        break;
      default: ADD_FAILURE() << index;
    }
    if (index == changed && request.id == 0x603) present = value;
    if (silent_) return;
    const auto byte = [present](int i) { return static_cast<int>(present >> (8 * i) & 0xFF); };
    bus_.receive_next(
        frame(static_cast<std::uint16_t>(request.id - 0x80),
              {command, request.data[1], request.data[2], request.data[3], byte(0), byte(1), byte(2), byte(3)}));
  }

  std::vector<std::pair<int, int>> asked_;
  bool silent_ = false;
};

TEST_F(ReadBackTest, ReadsAllWatchedObjectsOfAllDrivesWithinASecond) {
  EXPECT_GE(run(1000, 0, 0), 19);  // a request that would fall beside a heartbeat waits
  EXPECT_EQ(reading_.alarm, Alarm::kNone);
  for (const int node : {3, 5}) {
    for (const int index : {0x1400, 0x1016, 0x6007, 0x605A, 0x6061}) {
      EXPECT_TRUE(std::ranges::count(asked_, std::pair(node, index)) > 0) << std::hex << index;
    }
  }
}

TEST_F(ReadBackTest, AChangedParameterIsAnAlarm) {
  run(1000, 0x6007, 0);
  EXPECT_EQ(reading_.alarm, Alarm::kParameterChanged);
  EXPECT_EQ(reading_.alarm_joint, 1);
  EXPECT_EQ(drives_.alarm_detail().index, 0x6007);
  EXPECT_EQ(drives_.alarm_detail().expected, 3u);
  EXPECT_EQ(drives_.alarm_detail().found, 0u);
}

TEST_F(ReadBackTest, AnotherModeIsTheWrongMode) {
  run(1000, 0x6061, 8);
  EXPECT_EQ(reading_.alarm, Alarm::kWrongMode);
}

TEST_F(ReadBackTest, FiveSilentReadBacksOfADriveAreAnAlarm) {
  silent_ = true;
  EXPECT_EQ(run(2000, 0, 0), 10);
  EXPECT_EQ(reading_.alarm, Alarm::kParameterChanged);
}

TEST_F(ReadBackTest, AnAnswerToAnotherQuestionIsPassedOver) {
  cycle(kOff);
  bus_.receive_next(frame(0x583, {0x4B, 0x07, 0x60, 0x00, 0, 0, 0, 0}));
  bus_.receive_next(frame(0x584, {0x80, 0x07, 0x60, 0x00, 0, 0, 0, 0}));
  cycle(kOff);
  EXPECT_EQ(reading_.alarm, Alarm::kNone);
}

TEST_F(CanDrivesTest, AFloodIsDrainedSixtyFourFramesACycle) {
  for (int k = 0; k < 200; ++k) bus_.receive_next(frame(0x7FF, {1}));
  drives_.request();
  answer_all(kOff);
  receive();
  EXPECT_EQ(bus_.waiting.size(), 205u - 64u);  // with SYNC, heartbeat and three samples
  EXPECT_EQ(reading_.age[0], 1u);
  EXPECT_EQ(drives_.statistics().floods, 1u);
  // the samples that come to light three cycles later are late
  for (int k = 0; k < 3; ++k) {
    drives_.request();
    receive();
  }
  EXPECT_EQ(reading_.age[0], 4u);
  EXPECT_EQ(drives_.statistics().late[0], 1u);
  drives_.request();
  answer_all(kOff);
  EXPECT_EQ(receive().age[0], 0u);
}

TEST_F(CanDrivesTest, GetsIntoStepAgainByItselfWhenAnEchoWasLost) {
  cycle(kOff);
  bus_.echoes = false;
  cycle(kOff);
  bus_.echoes = true;
  int silent = 0;
  for (int k = 0; k < 20 && reading_.age[0] != 0; ++k) {
    drives_.request();
    if (std::ranges::count(bus_.take_sent(), frame(0x080, {})) == 0) ++silent;
    answer_all(kOff);
    receive();
    EXPECT_EQ(drives_.send({}), reading_.age[0] == 0);
    bus_.take_sent();
  }
  EXPECT_EQ(reading_.age[0], 0u);
  EXPECT_EQ(silent, CanDrives::kHeldCycles - 1);
  // the panel was away for longer than it may; it is back, and a reset finds it so
  EXPECT_EQ(reading_.alarm, Alarm::kPanelLost);
  EXPECT_FALSE(reading_.emergency_stop);
  cycle(kOff, PowerRequest::kReset);
  cycle(kOff);
  EXPECT_EQ(reading_.alarm, Alarm::kNone);
}

TEST_F(CanDrivesTest, QueuesNothingOnAWireThatTakesNothing) {
  for (int k = 0; k < 30; ++k) cycle(kEnabled, PowerRequest::kEnable, 1.0);
  bus_.echoes = false;  // frames are taken, and stay in the queue
  bus_.sent.clear();
  std::size_t queued = 0;
  for (int k = 0; k < CanDrives::kHeldCycles - 1; ++k) {
    drives_.request();
    receive();
    JointCommand command;
    command.power = PowerRequest::kEnable;
    EXPECT_FALSE(drives_.send(command));
    const std::vector<CanFrame> sent = bus_.take_sent();
    EXPECT_TRUE(std::ranges::none_of(sent, [](const CanFrame& f) { return f.id == 0x203 || f.id == 0x205; }));
    queued += sent.size();
  }
  EXPECT_LE(queued, 2u);  // a SYNC, and a heartbeat or a request behind it
}

TEST_F(CanDrivesTest, StopsTheNodesAtTheEnd) {
  drives_.stop_nodes();
  EXPECT_EQ(bus_.sent, (std::vector<CanFrame>{frame(0x000, {0x02, 0x00})}));
}

TEST_F(CanDrivesTest, LeavesTheNodesOfASecondMasterAlone) {
  SleepingClock clock;
  bus_.receive_next(frame(0x080, {}));
  EXPECT_EQ(drives_.bring_up(clock).status, BringUpStatus::kSecondMaster);
  drives_.stop_nodes();
  EXPECT_TRUE(bus_.sent.empty());
  // nothing was sent yet: nobody knows whose they are
  const std::atomic<bool> end{true};
  EXPECT_EQ(drives_.bring_up(clock, &end).status, BringUpStatus::kEnded);
  drives_.stop_nodes();
  EXPECT_TRUE(bus_.sent.empty());
  // nobody else is there: they are ours, though none has booted
  EXPECT_EQ(drives_.bring_up(clock).status, BringUpStatus::kNoBootUp);
  bus_.take_sent();
  drives_.stop_nodes();
  EXPECT_EQ(bus_.sent, (std::vector<CanFrame>{frame(0x000, {0x02, 0x00})}));
}

TEST_F(CanDrivesTest, WithFdOnlySyncAndTorquesAreFdFrames) {
  BusLayout fd = layout();
  fd.fd = true;
  CanDrives drives(fd, wires_, {});
  drives.request();
  drives.receive(reading_);
  drives.send({});
  for (const CanFrame& sent : bus_.sent) EXPECT_EQ(sent.fd, sent.id != 0x77F) << sent;
  EXPECT_EQ(bus_.sent.size(), 4u);
}

TEST_F(CanDrivesTest, TakesThePanelAsFreshOnlyBehindItsOwnSyncsEcho) {
  panel_inputs_ = 0x01;  // released
  cycle(kOff);
  bus_.receive_next(frame(0x1A0, {0x03}));  // held, of the cycle before
  drives_.request();
  receive();
  EXPECT_FALSE(reading_.enable_switch);
}

TEST_F(CanDrivesTest, ADriveThatAnswersOnlyAfterTheNextSyncIsAnAlarm) {
  SleepingClock clock;
  for (const bool late : {false, true}) {
    EXPECT_EQ(drives_.bring_up(clock).status, BringUpStatus::kNoBootUp);
    bus_.waiting.clear();
    bool owed = false;
    for (int k = 0; k < 2 * CanDrives::kProbeCycles; ++k) {
      bus_.take_sent();
      drives_.request();
      const bool asked = std::ranges::count(bus_.sent, frame(0x080, {})) == 1;
      if (late ? owed : asked) answer_all(kOff);
      owed = asked;
      heartbeats();
      receive();
      EXPECT_EQ(reading_.state[0] == DriveState::kUnavailable, k < CanDrives::kProbeCycles) << k;
      drives_.send({});
    }
    EXPECT_EQ(reading_.alarm, late ? Alarm::kAnswersLate : Alarm::kNone);
    EXPECT_EQ(reading_.state[0], DriveState::kOff);
  }
}

TEST(CanDrivesOnTwoBuses, KeepsThemApart) {
  BusLayout layout;
  layout.bus_count = 2;
  layout.joint_count = 2;
  layout.drives[0] = {.bus = 1, .node = 5, .counts = 1000, .gear = 1.0, .rated_torque = 2.0};
  layout.drives[1] = {.bus = 0, .node = 5, .counts = 1000, .gear = 1.0, .rated_torque = 2.0};
  layout.panel = {.bus = 1, .node = 32};
  std::array<FakeBus, 2> buses;
  std::array<CanBus*, 2> wires = {&buses[0], &buses[1]};
  CanDrives drives(layout, wires, {});
  JointReading reading;
  JointCommand command;
  command.torque.head(2) << 1.0, -1.0;
  command.power = PowerRequest::kEnable;
  for (int k = 0; k < 5; ++k) {
    for (FakeBus& bus : buses) bus.take_sent();
    drives.request();
    buses[1].receive_next(tpdo(5, kEnabled, 250, 0));
    buses[0].receive_next(tpdo(5, kEnabled, -250, 0));
    buses[1].receive_next(frame(0x1A0, {0x03}));
    drives.receive(reading);
    drives.send(command);
  }
  EXPECT_NEAR(reading.position[0], M_PI / 2, 1e-12);
  EXPECT_NEAR(reading.position[1], -M_PI / 2, 1e-12);
  EXPECT_EQ(buses[1].sent.back(), frame(0x205, {0x0F, 0x00, 0xF4, 0x01}));  // 500 permille
  EXPECT_EQ(buses[0].sent.back(), frame(0x205, {0x0F, 0x00, 0x0C, 0xFE}));
  // an echo that is missing on one bus does not touch the other
  buses[0].echoes = false;
  drives.request();
  buses[1].receive_next(tpdo(5, kEnabled, 0, 0));
  buses[0].receive_next(tpdo(5, kEnabled, 0, 0));
  drives.receive(reading);
  EXPECT_EQ(reading.age[0], 0u);
  EXPECT_EQ(reading.age[1], 1u);
  for (FakeBus& bus : buses) bus.take_sent();
  EXPECT_FALSE(drives.send(command));
  EXPECT_EQ(buses[1].sent.size(), 1u);
  EXPECT_TRUE(buses[0].sent.empty());
}

class CountingTap final : public FrameTap {
 public:
  void on_frame(int bus, const ReceivedFrame& received) noexcept override {
    EXPECT_EQ(bus, 0);
    own += received.own ? 1 : 0;
    others += received.own ? 0 : 1;
  }
  int own = 0;
  int others = 0;
};

TEST_F(CanDrivesTest, ShowsEveryFrameToTheTap) {
  CountingTap tap;
  CanDrives drives(layout(), wires_, {}, &tap);
  drives.request();
  answer_all(kOff);
  drives.receive(reading_);
  EXPECT_EQ(tap.own, 2);
  EXPECT_EQ(tap.others, 3);
}

/// A bus of random frames: endless, so that only the drain's limit ends a cycle.
class RandomBus final : public CanBus {
 public:
  explicit RandomBus(unsigned seed) : random_(seed) {}

  SendResult send(const CanFrame& frame) noexcept override {
    if (frame.id >= 0x200 && frame.id < 0x280) ++rpdos;
    const int chance = random_.integer(0, 99);
    if (chance < 2) return SendResult::kFull;
    if (chance == 2) return SendResult::kDown;
    if (frame.id == 0x080) echoes_ += 1;
    return SendResult::kSent;
  }

  bool receive(ReceivedFrame& received) noexcept override {
    ++frames;
    if (random_.integer(0, 199) == 0) return false;
    received = ReceivedFrame();
    CanFrame& frame = received.frame;
    constexpr std::array<int, 14> kLikely = {0x000, 0x080, 0x083, 0x085, 0x183, 0x185, 0x1A0,
                                             0x203, 0x583, 0x585, 0x605, 0x703, 0x705, 0x720};
    const int which = random_.integer(0, 19);
    frame.id =
        static_cast<std::uint16_t>(which < 14 ? kLikely[static_cast<std::size_t>(which)] : random_.integer(0, 0x7FF));
    frame.length = static_cast<std::uint8_t>(random_.integer(0, 3) == 0 ? random_.integer(0, 64) : 8);
    for (std::uint8_t& byte : frame.data) byte = static_cast<std::uint8_t>(random_.integer(0, 255));
    if (echoes_ > 0 && random_.integer(0, 9) == 0) {
      --echoes_;
      frame.id = 0x080;
      received.own = true;
    }
    received.time_ns = random_.integer(-1'000'000'000, 1'000'000'000);
    return true;
  }

  BusHealth health() const noexcept override { return {}; }

  std::int64_t frames = 0;
  std::int64_t rpdos = 0;

 private:
  test::Random random_;
  int echoes_ = 0;
};

TEST(CanDrives, AMillionRandomFramesGiveNoNaNAndAskForNoMemory) {
  BusLayout layout;
  layout.joint_count = 2;
  layout.drives[0] = {.bus = 0, .node = 5, .counts = 1000, .gear = 10.0, .rated_torque = 2.0};
  layout.drives[1] = {.bus = 0, .node = 3, .counts = 4000, .gear = 1.0, .rated_torque = 5.0, .sign = -1.0};
  layout.panel = {.bus = 0, .node = 32};
  RandomBus bus(1);
  const std::array<CanBus*, 1> wires = {&bus};
  CanDrives drives(layout, wires, {});
  test::Random random(2);
  JointReading reading;
  std::int64_t cycles = 0;
  std::int64_t fresh = 0;
  const test::AllocationGuard guard;
  for (; bus.frames < 1'000'000; ++cycles) {
    const std::int64_t before = bus.frames;
    drives.request();
    drives.receive(reading);
    ASSERT_LE(bus.frames - before, CanDrives::kMostFrames);
    ASSERT_TRUE(reading.position.allFinite() && reading.torque.allFinite());
    ASSERT_LE(reading.torque.cwiseAbs().maxCoeff(), 20.0 * 32.768);
    fresh += reading.age[0] == 0 ? 1 : 0;
    JointCommand command;
    command.power = static_cast<PowerRequest>(random.integer(0, 3));
    command.torque[0] = random.integer(0, 9) == 0 ? std::nan("") : random.between(-1e3, 1e3);
    const bool sent = drives.send(command);
    ASSERT_FALSE(sent && std::isnan(command.torque[0]));
  }
  EXPECT_TRUE(guard.allocations() == 0 || !test::AllocationGuard::works());
  EXPECT_LE(bus.rpdos, 2 * cycles);  // none while an echo is missing
  EXPECT_GT(bus.rpdos, cycles);
  EXPECT_GT(fresh, 100);
  EXPECT_NE(reading.alarm, Alarm::kNone);
}

}  // namespace
}  // namespace godobject::hal
