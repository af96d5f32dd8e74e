#include "firmware/drives/cia402/bus_messages.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "firmware/cycle/fault.h"

namespace godobject::firmware::bus_messages_test {
namespace {

const std::vector<std::string> kNames{"can0", "can1"};

std::string of_emergency(std::uint32_t code) {
  return explain({.alarm = hal::Alarm::kDriveError, .bus = 1, .joint = 2, .id = 0x083, .found = code}, kNames);
}

TEST(BusMessages, AnEmergencyIsToldWithItsPlaceAndCode) {
  const std::string text = of_emergency(0x2310);
  EXPECT_EQ(text.rfind("can1, joint 3: ", 0), 0u) << text;
  EXPECT_NE(text.find("COB-ID 083, error code 2310)"), std::string::npos) << text;
  EXPECT_EQ(text.find("doctor"), std::string::npos) << text;
}

TEST(BusMessages, TheDeadlineOfTorquesPointsToTheLoop) {
  const std::string text = of_emergency(0x8250);
  EXPECT_NE(text.find("error code 8250"), std::string::npos) << text;
  EXPECT_NE(text.find("the loop was late"), std::string::npos) << text;
  EXPECT_NE(text.find("run godobject-controller doctor"), std::string::npos) << text;
}

TEST(BusMessages, OtherAlarmsKeepTheirFindings) {
  const std::string text =
      explain({.alarm = hal::Alarm::kHeartbeatLost, .bus = 0, .joint = 0, .found = 0x8250}, kNames);
  EXPECT_EQ(text, std::string("can0, joint 1: ") + describe(hal::Alarm::kHeartbeatLost));
}

/// The words of a status or an alarm, which other tests check.
std::string words(hal::BringUpStatus status) { return hal::describe(status); }
std::string words(hal::Alarm alarm) { return describe(alarm); }

TEST(BusMessages, AStartThatFailsIsToldWithItsPlaceAndNumbers) {
  using hal::BringUpStatus;
  hal::BringUpResult result{.status = BringUpStatus::kWrongValue, .bus = 1, .node = 5, .joint = 0};
  result.index = 0x6076;
  result.subindex = 2;
  result.expected = 0xAB;
  result.found = 300;
  result.ratio_expected = 0.5;
  result.ratio_found = 123.456789;
  const std::string where = "can1, node 5, joint 1, object 6076:2: ";
  const auto told = [&](BringUpStatus status) {
    result.status = status;
    return explain(result, kNames);
  };
  EXPECT_EQ(told(BringUpStatus::kSecondMaster), where + words(BringUpStatus::kSecondMaster) + " (COB-ID 12C)");
  EXPECT_EQ(told(BringUpStatus::kRefused), where + words(BringUpStatus::kRefused) + " (abort code 0000012C)");
  EXPECT_EQ(told(BringUpStatus::kWrongSize), where + words(BringUpStatus::kWrongSize) + " (300 bytes instead of 171)");
  EXPECT_EQ(told(BringUpStatus::kWrongValue), where + words(BringUpStatus::kWrongValue) + " (0x12C instead of 0xAB)");
  EXPECT_EQ(told(BringUpStatus::kTooLow), where + words(BringUpStatus::kTooLow) + " (300, at least 171)");
  EXPECT_EQ(told(BringUpStatus::kWrongRatio),
            where + words(BringUpStatus::kWrongRatio) + " (123.456789 instead of 0.5)");
  for (const BringUpStatus status :
       {BringUpStatus::kOk, BringUpStatus::kBusDown, BringUpStatus::kCannotSend, BringUpStatus::kNoBootUp,
        BringUpStatus::kStartedAnew, BringUpStatus::kNoAnswer, BringUpStatus::kEnded, BringUpStatus::kNotOperational,
        BringUpStatus::kModeNotTold}) {
    EXPECT_EQ(told(status), where + words(status)) << "no number belongs to it";
  }
}

/// The field, both numbers, and the joints of a swap with the cure. Serial numbers are decimal, as on a label.
TEST(BusMessages, AWrongDriveIsToldWithItsFieldAndNumbers) {
  using hal::BringUpStatus;
  hal::BringUpResult result{.status = BringUpStatus::kWrongDrive, .bus = 0, .node = 5, .joint = 1, .index = 0x1018};
  result.expected = 171;
  result.found = 300;
  const auto told = [&](BringUpStatus status, std::uint8_t subindex) {
    result.status = status;
    result.subindex = subindex;
    return explain(result, kNames);
  };
  const std::string wrong = words(BringUpStatus::kWrongDrive);
  EXPECT_EQ(told(BringUpStatus::kWrongDrive, 1),
            "can0, node 5, joint 2, object 1018:1: " + wrong + " (vendor 0x12C instead of 0xAB)");
  EXPECT_EQ(told(BringUpStatus::kWrongDrive, 2),
            "can0, node 5, joint 2, object 1018:2: " + wrong + " (product 0x12C instead of 0xAB)");
  EXPECT_EQ(told(BringUpStatus::kWrongDrive, 3),
            "can0, node 5, joint 2, object 1018:3: " + wrong + " (revision 0x12C instead of 0xAB)");
  EXPECT_EQ(told(BringUpStatus::kWrongDrive, 4),
            "can0, node 5, joint 2, object 1018:4: " + wrong + " (serial 300 instead of 171)");
  EXPECT_EQ(told(BringUpStatus::kNoIdentity, 4),
            "can0, node 5, joint 2, object 1018:4: " + words(BringUpStatus::kNoIdentity) + " (serial 171)");
  result.other_joint = 6;
  EXPECT_EQ(told(BringUpStatus::kDrivesSwapped, 4),
            "can0, node 5, joint 2, object 1018:4: the drives of joints 2 and 7 are swapped, or their cables or node "
            "numbers; swap them back, or correct identity in the device file (serial 300 instead of 171)");
  EXPECT_EQ(told(BringUpStatus::kDriveElsewhere, 4),
            "can0, node 5, joint 2, object 1018:4: is not the drive that the device file names; that drive answers as "
            "the one of joint 7; exchange the drives, their cables or their node numbers, or correct identity in the "
            "device file (serial 300 instead of 171)");
}

TEST(BusMessages, ATemperatureIsToldWithItsLimit) {
  const std::string numbers = " (86.3 degrees Celsius, the arm stops at 85)";
  EXPECT_EQ(
      explain(
          {.alarm = hal::Alarm::kTooHot, .bus = 1, .joint = 2, .index = 0x2310, .celsius = 86.26, .most_celsius = 85.0},
          kNames),
      "can1, joint 3, object 2310:0: " + words(hal::Alarm::kTooHot) + numbers);
  EXPECT_EQ(explain({.alarm = hal::Alarm::kTemperatureLost, .bus = 1, .joint = 2, .index = 0x2310}, kNames),
            "can1, joint 3, object 2310:0: " + words(hal::Alarm::kTemperatureLost));
  hal::BringUpResult result{.status = hal::BringUpStatus::kTooHot, .bus = 0, .node = 4, .joint = 2, .index = 0x2310};
  result.celsius = 86.26;
  result.most_celsius = 85.0;
  EXPECT_EQ(explain(result, kNames),
            "can0, node 4, joint 3, object 2310:0: " + words(hal::BringUpStatus::kTooHot) + numbers);
  hal::CanStatistics statistics;
  EXPECT_EQ(bus_summary(statistics, 3).find("temperature"), std::string::npos);
  statistics.hottest = 71.26;
  statistics.hottest_joint = 1;
  EXPECT_TRUE(
      bus_summary(statistics, 3).ends_with("us\ntemperature of the drives: at most 71.3 degrees Celsius, joint 2\n"));
}

/// Each part of a place alone, and none.
TEST(BusMessages, APlaceHasOnlyThePartsThatAreKnown) {
  const std::string what = words(hal::BringUpStatus::kNoAnswer);
  hal::BringUpResult result{.status = hal::BringUpStatus::kNoAnswer};
  EXPECT_EQ(explain(result, kNames), what);
  result.bus = 0;
  EXPECT_EQ(explain(result, kNames), "can0: " + what);
  result.bus = 1;
  EXPECT_EQ(explain(result, kNames), "can1: " + what);
  result.bus = 2;
  EXPECT_EQ(explain(result, kNames), what) << "a bus without a name";
  result.bus = -1;
  result.node = 1;
  EXPECT_EQ(explain(result, kNames), "node 1: " + what);
  result.node = 0;
  result.joint = 6;
  EXPECT_EQ(explain(result, kNames), "joint 7: " + what);
  result.joint = -1;
  result.index = 1;
  EXPECT_EQ(explain(result, kNames), "object 0001:0: " + what);
}

TEST(BusMessages, AnAlarmIsToldWithItsPlaceAndNumbers) {
  using hal::Alarm;
  const auto told = [](Alarm alarm, std::uint16_t id, std::uint16_t index) {
    hal::cia402::AlarmDetail detail{.alarm = alarm, .bus = 0, .joint = 1, .id = id, .index = index, .subindex = 3};
    detail.expected = 10;
    detail.found = 0xFFFFFFFF;
    return explain(detail, kNames);
  };
  const std::string joint = "can0, joint 2: ";
  const std::string object = "can0, joint 2, object 6061:3: ";
  for (const Alarm alarm :
       {Alarm::kBusDown, Alarm::kBadFrames, Alarm::kNodeReset, Alarm::kHeartbeatLost, Alarm::kForeignMaster,
        Alarm::kForeignWrite, Alarm::kAnswersLate, Alarm::kPanelLost, Alarm::kPanelSilent}) {
    EXPECT_EQ(told(alarm, 0, 0), joint + words(alarm));
    EXPECT_EQ(told(alarm, 1, 0), joint + words(alarm) + " (COB-ID 001)");
    EXPECT_EQ(told(alarm, 0x181, 0x6061), object + words(alarm) + " (COB-ID 181)");
  }
  EXPECT_EQ(told(Alarm::kWrongMode, 0, 0), joint + words(Alarm::kWrongMode)) << "the state, not the mode, is wrong";
  EXPECT_EQ(told(Alarm::kWrongMode, 0x281, 0x6061),
            object + words(Alarm::kWrongMode) + " (COB-ID 281, mode -1 instead of 10)");
  EXPECT_EQ(told(Alarm::kWrongMode, 0, 1),
            "can0, joint 2, object 0001:3: " + words(Alarm::kWrongMode) + " (mode -1 instead of 10)");
  EXPECT_EQ(told(Alarm::kParameterChanged, 0, 0x6061),
            object + words(Alarm::kParameterChanged) + " (0xFFFFFFFF instead of 0xA)");
  EXPECT_EQ(told(Alarm::kDriveError, 0x81, 0),
            joint + words(Alarm::kDriveError) + " (COB-ID 081, error code FFFFFFFF)");
}

TEST(BusMessages, ASummaryHasTheCountsOfTheJointsThatAreThere) {
  hal::CanStatistics statistics;
  statistics.sent = 11;
  statistics.received = 12;
  statistics.malformed = 13;
  statistics.full = 14;
  statistics.floods = 15;
  statistics.longest_round_trip_ns = 234'567;
  for (std::size_t i = 0; i < kMaxJoints; ++i) {
    statistics.lost[i] = 1 + i;          // 1, 2, 3, ..
    statistics.late[i] = 100 * (1 + i);  // 100, 200, 300, ..
  }
  EXPECT_EQ(bus_summary(statistics, 3),
            "buses: 11 frames sent, 12 received; samples lost 6, late 600; malformed 13, queue full 14, floods 15\n"
            "round trip of all joints: at most 235 us\n");
  EXPECT_NE(bus_summary(statistics, 7).find("samples lost 28, late 2800;"), std::string::npos);
}

}  // namespace
}  // namespace godobject::firmware::bus_messages_test
