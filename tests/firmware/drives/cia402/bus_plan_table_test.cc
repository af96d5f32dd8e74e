#include "firmware/drives/cia402/bus_plan_table.h"

#include <gtest/gtest.h>

#include <string>

namespace godobject::firmware {
namespace {

hal::BusLayout three_on_one() {
  hal::BusLayout layout;
  layout.joint_count = 3;
  layout.read_back_interval = 100;
  for (int i = 0; i < 3; ++i) {
    hal::DriveConfig& drive = layout.drives[static_cast<std::size_t>(i)];
    drive.node = i + 1;
    drive.rated_torque = 1.76;
    drive.gear = 100;
  }
  return layout;
}

TEST(BusPlanTable, GivesWorstCasesInMicroseconds) {
  const hal::BusLayout layout = three_on_one();
  const std::string text = bus_plan_table(layout, hal::plan_buses(layout));
  EXPECT_EQ(text,
            "bus plan: CAN 1 Mbit/s, cycle 1000 us, drives answer within 0 us, computing 120 us; worst case in us\n"
            "bus joints panel   SYNC  TPDOs  RPDOs    end  with SDO  wire busy\n"
            "  0      3    no     55    405    285    995      1000     76.1 %\n"
            "samples collected 525 us after SYNC; from sample to torque at most 948 us\n"
            "joint 1: bus 0, node 1, torque in steps of 0.176 Nm, 0.35 N at 0.5 m\n"
            "joint 2: bus 0, node 2, torque in steps of 0.176 Nm, 0.35 N at 0.5 m\n"
            "joint 3: bus 0, node 3, torque in steps of 0.176 Nm, 0.35 N at 0.5 m\n");
  EXPECT_EQ(bus_plan_objection(layout, hal::plan_buses(layout)), "");
}

TEST(BusPlanTable, NamesTheBusThatDoesNotFitAndTheCure) {
  hal::BusLayout layout = three_on_one();
  layout.bus_count = 2;
  layout.panel.bus = 0;
  const hal::BusPlan plan = hal::plan_buses(layout);
  EXPECT_NE(bus_plan_table(layout, plan).find("does not fit\n  1      0"), std::string::npos);
  EXPECT_EQ(bus_plan_objection(layout, plan),
            "bus 0: a cycle needs 1065 us of 1000 with 3 joints and the panel; put fewer on it, lower "
            "loop.compute (120 us) or use CAN FD");
  layout.bit_rate = 250e3;
  EXPECT_NE(bus_plan_objection(layout, hal::plan_buses(layout)).find("put fewer on it, raise bus.bit_rate, lower"),
            std::string::npos);
}

TEST(BusPlanTable, NamesBothRatesOfCanFd) {
  hal::BusLayout layout = three_on_one();
  layout.fd = true;
  EXPECT_EQ(bus_plan_table(layout, hal::plan_buses(layout)).substr(0, 27), "bus plan: CAN FD 1/5 Mbit/s");
}

}  // namespace
}  // namespace godobject::firmware
