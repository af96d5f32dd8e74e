#include "firmware/drives/cia402/bus_plan_table.h"

#include <gtest/gtest.h>

#include <string>

namespace godobject::firmware::bus_plan_table_test {
namespace {

hal::BusLayout three_on_one() {
  hal::BusLayout layout;
  layout.joint_count = 3;
  layout.read_back_interval = 0.1;
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
            "loop.compute (120 us), use CAN FD (bus.fd) or raise bus.period");
  layout.bit_rate = 250e3;
  EXPECT_NE(bus_plan_objection(layout, hal::plan_buses(layout)).find("put fewer on it, raise bus.bit_rate, lower"),
            std::string::npos);
}

TEST(BusPlanTable, NamesBothRatesOfCanFd) {
  hal::BusLayout layout = three_on_one();
  layout.fd = true;
  EXPECT_EQ(bus_plan_table(layout, hal::plan_buses(layout)).substr(0, 27), "bus plan: CAN FD 1/5 Mbit/s");
}

/// A plan of hand-made numbers: each stands in the place of its name.
TEST(BusPlanTable, HasEachNumberInItsPlace) {
  hal::BusLayout layout;
  layout.bus_count = 2;
  layout.joint_count = 2;
  layout.fd = true;
  layout.bit_rate = 500e3;
  layout.data_rate = 2e6;
  layout.period = 2e-3;
  layout.answer = 30e-6;
  layout.compute = 250e-6;
  layout.drives[0].bus = 1;
  layout.drives[0].node = 9;
  layout.drives[1].bus = 0;
  layout.drives[1].node = 8;
  hal::BusPlan plan;
  hal::BusLoad& first = plan.buses[0];
  first.joints = 1;
  first.panel = true;
  first.sync_ns = 51'000;
  first.samples_ns = 102'000;
  first.torques_ns = 203'000;
  first.end_ns = 504'000;
  first.slot_ns = 605'000;
  first.utilisation = 0.25;
  first.fits = true;
  plan.buses[1] = first;
  plan.buses[1].panel = false;
  plan.buses[1].end_ns = 2'504'000;
  plan.buses[1].fits = false;
  plan.timing.collect_ns = 321'000;
  plan.timing.delay_s = 1.5e-3;
  plan.torque_step[0] = 0.25;
  plan.torque_step[1] = 0.125;
  EXPECT_EQ(bus_plan_table(layout, plan),
            "bus plan: CAN FD 0.5/2 Mbit/s, cycle 2000 us, drives answer within 30 us, computing 250 us; worst case "
            "in us\n"
            "bus joints panel   SYNC  TPDOs  RPDOs    end  with SDO  wire busy\n"
            "  0      1   yes     51    102    203    504       605     25.0 %\n"
            "  1      1    no     51    102    203   2504       605     25.0 %  does not fit\n"
            "samples collected 321 us after SYNC; from sample to torque at most 1500 us\n"
            "joint 1: bus 1, node 9, torque in steps of 0.25 Nm, 0.5 N at 0.5 m\n"
            "joint 2: bus 0, node 8, torque in steps of 0.125 Nm, 0.25 N at 0.5 m\n");
  EXPECT_EQ(bus_plan_objection(layout, plan),
            "bus 1: a cycle needs 2504 us of 2000 with 1 joint; raise bus.bit_rate, lower loop.compute (250 us), "
            "set bus.fd_services or raise bus.period");
  layout.fd_services = true;
  plan.buses[1].slot_ns = 2'600'000;
  plan.buses[1].joints = 0;
  layout.bit_rate = 1e6;
  EXPECT_EQ(bus_plan_objection(layout, plan),
            "bus 1: a cycle needs 2600 us of 2000 with 0 joints; lower loop.compute (250 us), raise bus.data_rate or "
            "raise bus.period");
  layout.data_rate = 8e6;
  EXPECT_EQ(bus_plan_objection(layout, plan),
            "bus 1: a cycle needs 2600 us of 2000 with 0 joints; lower loop.compute (250 us), or raise bus.period");
  plan.buses[0].fits = false;
  EXPECT_EQ(bus_plan_objection(layout, plan).substr(0, 52), "bus 0: a cycle needs 605 us of 2000 with 1 joint and");
}

}  // namespace
}  // namespace godobject::firmware::bus_plan_table_test
