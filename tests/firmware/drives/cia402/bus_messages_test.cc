#include "firmware/drives/cia402/bus_messages.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace godobject::firmware {
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
  EXPECT_EQ(text.rfind("can0, joint 1: ", 0), 0u) << text;
  EXPECT_EQ(text.find("8250"), std::string::npos) << text;
}

}  // namespace
}  // namespace godobject::firmware
