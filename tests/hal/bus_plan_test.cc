#include "hal/cia402/bus_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace godobject::hal {
namespace {

/// `joints[b]` joints on bus b, at 1 Mbit/s: a bit is a microsecond.
BusLayout layout_of(const std::vector<int>& joints) {
  BusLayout layout;
  layout.bus_count = static_cast<int>(joints.size());
  for (std::size_t bus = 0; bus < joints.size(); ++bus) {
    for (int i = 0; i < joints[bus]; ++i) {
      DriveConfig& drive = layout.drives[static_cast<std::size_t>(layout.joint_count)];
      drive.bus = static_cast<int>(bus);
      drive.node = ++layout.joint_count;
      drive.rated_torque = 1.0;
    }
  }
  return layout;
}

std::int64_t cyclic_us(const BusLoad& load) { return (load.sync_ns + load.samples_ns + load.torques_ns) / 1000; }

// ---------------------------------------------------------------- frames

/// Bits of a classical data frame from SOF to the end of the CRC, which are the stuffed ones.
std::vector<bool> classical_bits(std::uint16_t id, const std::vector<std::uint8_t>& data) {
  std::vector<bool> bits;
  const auto put = [&](std::uint32_t value, int count) {
    for (int bit = count - 1; bit >= 0; --bit) bits.push_back(((value >> bit) & 1u) != 0);
  };
  put(0, 1);
  put(id, 11);
  put(0, 3);  // RTR, IDE, r0
  put(static_cast<std::uint32_t>(data.size()), 4);
  for (const std::uint8_t byte : data) put(byte, 8);
  std::uint32_t crc = 0;
  for (const bool bit : bits) {
    const bool next = bit != ((crc >> 14 & 1u) != 0);
    crc = crc << 1 & 0x7FFFu;
    if (next) crc ^= 0x4599u;
  }
  put(crc, 15);
  return bits;
}

/// With stuffing counted bit by bit, the ten bits of end of frame and acknowledge and three of gap.
int length_on_the_wire(const std::vector<bool>& bits) {
  int run = 0;
  bool last = true;
  int stuffed = 0;
  for (const bool bit : bits) {
    run = bit == last ? run + 1 : 1;
    last = bit;
    if (run < 5) continue;
    ++stuffed;
    last = !bit;
    run = 1;
  }
  return static_cast<int>(bits.size()) + stuffed + 10 + 3;
}

TEST(FrameLength, ClassicalIs55BitsAnd10AByte) {
  const BusLayout layout;
  for (int bytes = 0; bytes <= 8; ++bytes) EXPECT_EQ(longest_frame_ns(bytes, false, layout), 1000 * (55 + 10 * bytes));
  for (int bytes = 0; bytes <= 8; ++bytes) EXPECT_EQ(shortest_frame_ns(bytes, false, layout), 1000 * (47 + 8 * bytes));
}

TEST(FrameLength, BoundsEveryClassicalFrame) {
  const BusLayout layout;
  std::mt19937 random(1);
  int longest_seen = 0;
  for (int i = 0; i < 200'000; ++i) {
    std::vector<std::uint8_t> data(random() % 9);
    const bool flat = random() % 2 == 0;  // long runs of equal bits, where stuffing is at its worst
    for (std::uint8_t& byte : data) {
      byte = flat ? static_cast<std::uint8_t>(random() % 2 == 0 ? 0x00 : 0x1F) : static_cast<std::uint8_t>(random());
    }
    const auto id = static_cast<std::uint16_t>(random() % 0x800);
    const int bits = length_on_the_wire(classical_bits(id, data));
    const int bytes = static_cast<int>(data.size());
    ASSERT_LE(bits, 55 + 10 * bytes);
    ASSERT_GE(bits, 47 + 8 * bytes);
    if (bytes == 8) longest_seen = std::max(longest_seen, bits);
  }
  EXPECT_GE(longest_seen, 125);  // the bound is not far from what is possible
}

/// An FD frame's fields as ISO 11898-1 lists them, for 1 Mbit/s and 5 Mbit/s [ns].
std::int64_t fd_by_fields(int bytes) {
  const int arbitration = 1 /*SOF*/ + 11 /*ID*/ + 1 /*RRS*/ + 1 /*IDE*/ + 1 /*FDF*/ + 1 /*res*/ + 1 /*BRS*/;
  const int tail = 1 /*CRC delimiter*/ + 1 /*ACK*/ + 1 /*its delimiter*/ + 7 /*EOF*/ + 3 /*gap*/;
  const int control = 1 /*ESI*/ + 4 /*DLC*/;
  const int stuffed = arbitration + control + 8 * bytes;
  const int crc = bytes <= 16 ? 17 : 21;
  const int fixed = static_cast<int>(std::ceil((4 + crc) / 4.0));  // before the stuff count and after each four bits
  const int stuff_all = (stuffed - 1) / 4;
  const int stuff_nominal = (arbitration - 1) / 4;
  return 1000 * (arbitration + stuff_nominal + tail) +
         200 * (control + 8 * bytes + stuff_all - stuff_nominal + 4 + crc + fixed);
}

TEST(FrameLength, FdIsTheSumOfItsFields) {
  const BusLayout layout;
  for (const int bytes : {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 20, 24, 32, 48, 64}) {
    EXPECT_EQ(longest_frame_ns(bytes, true, layout), fd_by_fields(bytes)) << bytes;
    EXPECT_LT(shortest_frame_ns(bytes, true, layout), fd_by_fields(bytes)) << bytes;
  }
  EXPECT_EQ(longest_frame_ns(0, true, layout), 40'600);
}

/// Without the stuff bits that depend on the contents: 17 bits from SOF to BRS and 13 from the CRC delimiter to the gap
/// at 1 Mbit/s; ESI, DLC, data, stuff count and a CRC of 17 bits with 6 fixed stuff bits, or 21 with 7, at 5 Mbit/s.
TEST(FrameLength, ShortestFdByHand) {
  const BusLayout layout;
  for (const int bytes : {0, 1, 8, 12, 16}) {
    EXPECT_EQ(shortest_frame_ns(bytes, true, layout), 30'000 + 200 * (1 + 4 + 8 * bytes + 4 + 17 + 6)) << bytes;
  }
  for (const int bytes : {20, 24, 32, 48, 64}) {
    EXPECT_EQ(shortest_frame_ns(bytes, true, layout), 30'000 + 200 * (1 + 4 + 8 * bytes + 4 + 21 + 7)) << bytes;
  }
}

TEST(FrameLength, GroupedFdFramesOfSixAndSevenJoints) {
  // one torque frame of 16 bytes for all joints, 12 bytes a sample
  const BusLayout layout;
  const std::int64_t shared = longest_frame_ns(0, true, layout) + longest_frame_ns(16, true, layout);
  EXPECT_NEAR(1e-3 * static_cast<double>(shared + 6 * longest_frame_ns(12, true, layout)), 501, 0.5);
  EXPECT_NEAR(1e-3 * static_cast<double>(shared + 7 * longest_frame_ns(12, true, layout)), 565, 0.5);
}

TEST(FrameLength, GoesWithTheBitRate) {
  BusLayout layout;
  layout.bit_rate = 500e3;
  EXPECT_EQ(longest_frame_ns(8, false, layout), 270'000);
  layout.bit_rate = 800e3;
  EXPECT_EQ(longest_frame_ns(0, false, layout), 68'750);
}

// ---------------------------------------------------------------- plans

TEST(BusPlan, CyclicFramesOfOneClassicalBus) {
  struct Row {
    int joints;
    int bits;
  };
  for (const Row row : {Row{2, 515}, Row{3, 745}, Row{4, 975}, Row{6, 1435}, Row{7, 1665}}) {
    EXPECT_EQ(cyclic_us(plan_buses(layout_of({row.joints})).buses[0]), row.bits) << row.joints;
  }
}

TEST(BusPlan, OtherLayoutsOfTheSameFrameLengths) {
  // torque 2 B, status and position 6 B; grouped torque 8 B a four joints with samples of 8 B
  const BusLayout layout;
  const auto us = [&](int bytes) { return longest_frame_ns(bytes, false, layout) / 1000; };
  const std::array<std::array<std::int64_t, 2>, 5> narrow = {{{2, 435}, {3, 625}, {4, 815}, {6, 1195}, {7, 1385}}};
  for (const auto& [joints, bits] : narrow) EXPECT_EQ(us(0) + joints * (us(2) + us(6)), bits);
  const std::array<std::array<std::int64_t, 3>, 5> grouped = {
      {{2, 4, 420}, {3, 6, 575}, {4, 8, 730}, {6, 8 + 4, 1095}, {7, 8 + 6, 1250}}};
  for (const auto& [joints, bytes, bits] : grouped) {
    const std::int64_t torques = bytes <= 8 ? us(static_cast<int>(bytes)) : us(8) + us(static_cast<int>(bytes) - 8);
    EXPECT_EQ(us(0) + joints * us(8) + torques, bits) << joints;
  }
}

TEST(BusPlan, ThreeJointsFitExactly) {
  const BusPlan plan = plan_buses(layout_of({3}));
  const BusLoad& load = plan.buses[0];
  EXPECT_EQ(load.sync_ns, 55'000);
  EXPECT_EQ(load.samples_ns, 405'000);
  EXPECT_EQ(load.torques_ns, 285'000);
  EXPECT_EQ(load.blocking_ns, 65'000);
  EXPECT_EQ(plan.timing.collect_ns, 525'000);       // 65 + 55 + 405
  EXPECT_EQ(load.end_ns, 995'000);                  // + 120 + 65 + 285
  EXPECT_EQ(load.slot_ns, 1'000'000);               // 525 + 120 + 135 + 285 - 65
  EXPECT_EQ(load.late_ns, 70'000);                  // an SDO frame before SYNC is 70 longer than a heartbeat
  EXPECT_NEAR(plan.timing.delay_s, 948e-6, 1e-12);  // 995 - 47
  EXPECT_NEAR(load.utilisation, 0.745 + 4 * 65 / 20e3 + 3 * 65 / 1000e3 + 270 / 50e3, 1e-12);
  EXPECT_TRUE(plan.fits);

  BusLayout slower = layout_of({3});
  slower.compute = 120.001e-6;
  EXPECT_FALSE(plan_buses(slower).fits);
}

TEST(BusPlan, SevenJointsFitOnThreeBuses) {
  BusLayout layout = layout_of({3, 2, 2});
  layout.panel = {2, 0x20};
  const BusPlan plan = plan_buses(layout);
  EXPECT_TRUE(plan.fits);
  EXPECT_EQ(plan.buses[0].end_ns, 995'000);
  EXPECT_EQ(plan.buses[1].end_ns, 900'000);  // collected with the others
  EXPECT_EQ(plan.buses[1].late_ns, 0);
  EXPECT_EQ(plan.buses[2].samples_ns, (2 * 135 + 65) * 1000);
  EXPECT_EQ(plan.buses[2].slot_ns, (525 + 120 + 135 + 190 - 65) * 1000);
  EXPECT_EQ(plan.timing.collect_ns, 525'000);
}

TEST(BusPlan, AddsTheDrivesOwnDelayToThatOfTheWireOnly) {
  BusLayout layout = layout_of({3});
  layout.drive_delay = 1.25e-3;
  const BusPlan plan = plan_buses(layout);
  EXPECT_NEAR(plan.timing.delay_s, (948 + 1250) * 1e-6, 1e-12);
  EXPECT_EQ(plan.timing.collect_ns, 525'000);
  EXPECT_EQ(plan.buses[0].end_ns, 995'000);
  EXPECT_EQ(plan.unblocked_ns[2], plan_buses(layout_of({3})).unblocked_ns[2]) << "of the wire";
  EXPECT_TRUE(plan.fits);
}

TEST(BusPlan, CountsTheTimeInWhichDrivesAnswer) {
  BusLayout layout = layout_of({2});
  const BusPlan at_once = plan_buses(layout);
  layout.answer = 150e-6;
  const BusPlan plan = plan_buses(layout);
  EXPECT_EQ(plan.timing.collect_ns, (65 + 55 + 150 + 65 + 270) * 1000);  // a frame may begin in the idle time
  EXPECT_EQ(plan.buses[0].end_ns, (605 + 120 + 65 + 190) * 1000);
  EXPECT_EQ(plan.buses[0].slot_ns, (605 + 120 + 135 + 190 - 65) * 1000);
  EXPECT_EQ(plan.buses[0].late_ns, (135 + 55 + 150 + 270 - 605) * 1000);
  EXPECT_NEAR(plan.timing.delay_s - at_once.timing.delay_s, 215e-6, 1e-12);
  EXPECT_EQ(plan.unblocked_ns[0] - at_once.unblocked_ns[0], 215'000);
  EXPECT_EQ(plan.buses[0].utilisation, at_once.buses[0].utilisation) << "an idle wire";
  EXPECT_TRUE(plan.fits);
  layout.answer = 171e-6;  // 605 + 21 + 120 + 65 + 190 = 1001
  EXPECT_FALSE(plan_buses(layout).fits);
  BusLayout three = layout_of({3});
  three.answer = 1e-6;
  EXPECT_FALSE(plan_buses(three).fits) << "there is no room for any";
}

TEST(BusPlan, RefusesWhatDoesNotFit) {
  EXPECT_FALSE(plan_buses(layout_of({7})).fits);
  EXPECT_FALSE(plan_buses(layout_of({4, 3})).fits);
  EXPECT_FALSE(plan_buses(layout_of({4})).fits);  // 975 and no time to compute
  BusLayout with_panel = layout_of({3, 3});
  EXPECT_TRUE(plan_buses(with_panel).fits);
  with_panel.panel.bus = 0;
  EXPECT_FALSE(plan_buses(with_panel).fits);
  EXPECT_FALSE(plan_buses(with_panel).buses[0].fits);
  BusLayout slow = layout_of({2});
  EXPECT_TRUE(plan_buses(slow).fits);
  slow.bit_rate = 500e3;
  EXPECT_FALSE(plan_buses(slow).fits);
}

TEST(BusPlan, OneBusOfCanFdCarriesSixJointsAndSeven) {
  BusLayout six = layout_of({6});
  six.fd = true;
  BusLayout seven = layout_of({7});
  seven.fd = true;
  EXPECT_NEAR(static_cast<double>(plan_buses(six).buses[0].sync_ns + plan_buses(six).buses[0].samples_ns +
                                  plan_buses(six).buses[0].torques_ns),
              672e3, 500);
  EXPECT_NEAR(static_cast<double>(plan_buses(seven).buses[0].sync_ns + plan_buses(seven).buses[0].samples_ns +
                                  plan_buses(seven).buses[0].torques_ns),
              777e3, 500);
  EXPECT_TRUE(plan_buses(six).fits);     // 671.8 + 120 + 130
  EXPECT_FALSE(plan_buses(seven).fits);  // 776.8 + 120 + 130
  seven.compute = 85e-6;
  EXPECT_TRUE(plan_buses(seven).fits);
}

TEST(BusPlan, UnblockedDelayOfEachJointFollowsTheOrderOfTheTorques) {
  const BusPlan plan = plan_buses(layout_of({3, 2}));
  EXPECT_EQ(plan.unblocked_ns[0], (525 + 120 + 95 - 55) * 1000);
  EXPECT_EQ(plan.unblocked_ns[2], (525 + 120 + 285 - 55) * 1000);
  EXPECT_EQ(plan.unblocked_ns[3], plan.unblocked_ns[0]);
  EXPECT_EQ(plan.unblocked_ns[4], (525 + 120 + 190 - 55) * 1000);
}

TEST(BusPlan, TorqueStepIsAPermilleOfTheRatedTorqueAtTheJoint) {
  BusLayout layout = layout_of({1});
  layout.drives[0].rated_torque = 1.76;
  layout.drives[0].gear = -100.0;
  EXPECT_NEAR(plan_buses(layout).torque_step[0], 0.176, 1e-15);
  EXPECT_EQ(plan_buses(layout).torque_step[1], 0.0);
}

TEST(BusPlan, RoundsTimesUpToANanosecond) {
  BusLayout layout = layout_of({1});
  const std::int64_t end_ns = plan_buses(layout).buses[0].end_ns;
  layout.compute = 120e-6 + 0.0005e-9;
  EXPECT_EQ(plan_buses(layout).buses[0].end_ns, end_ns + 1);
  layout.compute = 120e-6 + 1e-9;
  EXPECT_EQ(plan_buses(layout).buses[0].end_ns, end_ns + 1);
  layout.compute = 120e-6 * (1.0 + 1e-15);  // a rounding error
  EXPECT_EQ(plan_buses(layout).buses[0].end_ns, end_ns);
}

/// A heartbeat is a classical frame of 65 bits. A mode is an FD frame: 34 us + 43 bits at the data rate.
TEST(BusPlan, TheLongerOfHeartbeatAndModeBlocks) {
  BusLayout layout = layout_of({1});
  layout.fd = true;
  EXPECT_EQ(plan_buses(layout).buses[0].blocking_ns, 65'000);
  layout.data_rate = 1e6;
  EXPECT_EQ(plan_buses(layout).buses[0].blocking_ns, 77'000);
}

/// FD frames without a higher data rate: SYNC 34 + 33, sample 34 + 113, torque 34 + 73, mode 34 + 43 us. The torques of
/// a cycle then end later than those after an SDO frame of 135 us, less the blocking.
TEST(BusPlan, TheTorquesMayEndWithThePeriodButNotLater) {
  BusLayout layout = layout_of({1});
  layout.fd = true;
  layout.data_rate = 1e6;
  layout.compute = 525e-6;
  const BusPlan plan = plan_buses(layout);
  EXPECT_EQ(plan.timing.collect_ns, (77 + 67 + 147) * 1000);
  EXPECT_EQ(plan.buses[0].end_ns, (291 + 525 + 77 + 107) * 1000);
  EXPECT_EQ(plan.buses[0].slot_ns, (291 + 525 + 135 + 107 - 77) * 1000);
  EXPECT_TRUE(plan.buses[0].fits);
  EXPECT_TRUE(plan.fits);
  layout.compute = 525.001e-6;
  EXPECT_LT(plan_buses(layout).buses[0].slot_ns, 1'000'000);
  EXPECT_FALSE(plan_buses(layout).buses[0].fits);
  EXPECT_FALSE(plan_buses(layout).fits);
}

/// A cycle: SYNC 55, two samples 270, the panel's 65, two torques 190 us. Heartbeats of two drives, the panel and the
/// controller each 40 ms; two modes each 250 ms; an SDO exchange of two frames each 25 ms.
TEST(BusPlan, UtilisationCountsEveryFrame) {
  BusLayout layout = layout_of({2});
  layout.panel.bus = 0;
  layout.drive_heartbeat = 40e-3;
  layout.mode_refresh = 0.25;
  layout.read_back_interval = 25e-3;
  EXPECT_NEAR(plan_buses(layout).buses[0].utilisation, 0.580 + 4 * 65 / 40e3 + 2 * 65 / 250e3 + 270 / 25e3, 1e-12);
  layout.period = 2e-3;
  EXPECT_NEAR(plan_buses(layout).buses[0].utilisation, 0.290 + 4 * 65 / 40e3 + 2 * 65 / 250e3 + 270 / 25e3, 1e-12);
}

/// 4 kHz: one joint a bus, all messages as FD frames at 1 and 8 Mbit/s. A frame has 34 bits at 1 Mbit/s and, with n
/// bytes, 33 + 10 n at 8: SYNC 38.125, sample 48.125, torque 43.125, heartbeat 39.375, SDO 48.125 us. Rounded up to
/// whole nanoseconds, with 40 us of computing: end 39.375 + 38.125 + 48.125 + 40 + 39.375 + 43.125 = 248.125 us.
TEST(BusPlan, FitsIntoAQuarterOfAMillisecondWithFdFramesAlone) {
  BusLayout layout = layout_of({1});
  layout.period = 0.25e-3;
  layout.compute = 40e-6;
  layout.fd = layout.fd_services = true;
  layout.data_rate = 8e6;
  const BusPlan plan = plan_buses(layout);
  EXPECT_EQ(plan.buses[0].sync_ns, 38'125);
  EXPECT_EQ(plan.buses[0].samples_ns, 48'125);
  EXPECT_EQ(plan.buses[0].torques_ns, 43'125);
  EXPECT_EQ(plan.buses[0].blocking_ns, 39'375);
  EXPECT_EQ(plan.buses[0].end_ns, 248'125);
  EXPECT_EQ(plan.buses[0].slot_ns, 125'625 + 40'000 + 48'125 + 43'125 - 39'375);
  EXPECT_TRUE(plan.fits);
  for (const double compute : {41e-6, 42e-6}) {
    layout.compute = compute;
    EXPECT_EQ(plan_buses(layout).fits, compute < 41.9e-6);
  }
  layout.compute = 0.0;  // 208.125 us without computing: 4.8 kHz at most
  for (const double rate : {4800.0, 4810.0}) {
    layout.period = 1.0 / rate;
    EXPECT_EQ(plan_buses(layout).fits, rate < 4805.0);
  }
  layout.period = 0.25e-3;
  layout.compute = 40e-6;
  layout.fd_services = false;  // a classical heartbeat takes 65 us, an SDO frame 135
  EXPECT_EQ(plan_buses(layout).buses[0].blocking_ns, 65'000);
  EXPECT_FALSE(plan_buses(layout).fits);
}

TEST(BusPlan, FitsOnlyIfEveryBusFits) {
  for (const auto& joints : {std::vector{3, 1}, std::vector{1, 3}, std::vector{1, 3, 1}}) {
    BusLayout layout = layout_of(joints);
    layout.compute = 120.001e-6;
    const BusPlan plan = plan_buses(layout);
    EXPECT_FALSE(plan.fits);
    for (std::size_t bus = 0; bus < joints.size(); ++bus) EXPECT_EQ(plan.buses[bus].fits, joints[bus] < 3);
  }
}

TEST(BusPlan, HasNothingOnBusesThatTheLayoutLacks) {
  const BusPlan plan = plan_buses(layout_of({3, 2}));
  for (std::size_t bus = 2; bus < plan.buses.size(); ++bus) {
    const BusLoad& load = plan.buses[bus];
    EXPECT_EQ(load.joints, 0);
    EXPECT_FALSE(load.panel || load.fits);
    EXPECT_EQ(load.sync_ns, 0);
    EXPECT_EQ(load.samples_ns, 0);
    EXPECT_EQ(load.torques_ns, 0);
    EXPECT_EQ(load.blocking_ns, 0);
    EXPECT_EQ(load.end_ns, 0);
    EXPECT_EQ(load.slot_ns, 0);
    EXPECT_EQ(load.late_ns, 0);
    EXPECT_EQ(load.utilisation, 0.0);
  }
  for (std::size_t joint = 5; joint < plan.unblocked_ns.size(); ++joint) EXPECT_EQ(plan.unblocked_ns[joint], 0);
  EXPECT_FALSE(BusPlan().fits) << "nobody has planned";
}

TEST(BusPlan, WithoutJointsOnlyTheDrivesDelayRemains) {
  BusLayout layout;
  layout.panel.bus = 0;
  layout.drive_delay = 0.5e-3;
  const BusPlan plan = plan_buses(layout);
  EXPECT_EQ(plan.timing.delay_s, 0.5e-3);
  EXPECT_TRUE(plan.fits);
  EXPECT_EQ(plan.buses[0].samples_ns, 65'000);
}

// ---------------------------------------------------------------- the plan against a wire

/// A frame that waits for the wire from `ready_ns` on; the smaller the identifier, the earlier its turn.
struct Waiting {
  std::int64_t ready_ns;
  int id;
  std::int64_t length_ns;
  int cycle;
};

/// Non-preemptive arbitration, written from what a wire does: whenever it is idle, the smallest identifier of those
/// that wait goes. Returns the end of each frame.
std::vector<std::int64_t> run_wire(const std::vector<Waiting>& frames) {
  std::vector<std::int64_t> ends(frames.size(), -1);
  std::int64_t now = 0;
  for (std::size_t done = 0; done < frames.size(); ++done) {
    std::size_t next = frames.size();
    std::int64_t earliest = INT64_MAX;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      if (ends[i] < 0) earliest = std::min(earliest, frames[i].ready_ns);
    }
    now = std::max(now, earliest);
    for (std::size_t i = 0; i < frames.size(); ++i) {
      if (ends[i] >= 0 || frames[i].ready_ns > now) continue;
      if (next == frames.size() || frames[i].id < frames[next].id) next = i;
    }
    now += frames[next].length_ns;
    ends[next] = now;
  }
  return ends;
}

/// Random heartbeats at their rates against the cycle of one bus: no sample after its collection, no torque after
/// `end_ns`, no delay beyond the plan's.
TEST(BusPlan, HoldsOnAWireWithHeartbeatsAtAnyTime) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 60; ++trial) {
    const int joints = 1 + trial % 3;
    BusLayout layout = layout_of({joints});
    if (joints < 3 && trial % 2 == 1) layout.answer = 160e-6;  // some drives answer at once, some as late as they may
    const auto answer_ns = std::llround(1e9 * layout.answer);
    const BusPlan plan = plan_buses(layout);
    ASSERT_TRUE(plan.fits);
    std::vector<Waiting> frames;
    constexpr int kCycles = 40;
    std::vector<std::int64_t> sync_end(kCycles);
    for (int node = 0; node <= joints; ++node) {
      for (auto at = static_cast<std::int64_t>(random() % 20'000'000); at < kCycles * 1'000'000; at += 20'000'000) {
        frames.push_back({at, 0x700 + node, 65'000, -1});
      }
      for (auto at = static_cast<std::int64_t>(random() % 1'000'000'000); node > 0 && at < kCycles * 1'000'000;
           at += 1'000'000'000) {
        frames.push_back({at, 0x280 + node, 65'000, -1});
      }
    }
    // samples are ready when SYNC has ended: a first pass gives those ends
    for (int k = 0; k < kCycles; ++k) {
      const std::int64_t begin = k * 1'000'000LL;
      std::vector<Waiting> so_far = frames;
      so_far.push_back({begin, 0x80, plan.buses[0].sync_ns, k});
      sync_end[static_cast<std::size_t>(k)] = run_wire(so_far).back();
      frames.push_back(so_far.back());
      for (int j = 0; j < joints; ++j) {
        const std::int64_t takes_ns = random() % 2 == 0 ? answer_ns : 0;
        frames.push_back({sync_end[static_cast<std::size_t>(k)] + takes_ns, 0x181 + j, 135'000, k});
        frames.push_back({begin + plan.timing.collect_ns + 120'000, 0x201 + j, 95'000, k});
      }
    }
    const std::vector<std::int64_t> ends = run_wire(frames);
    for (std::size_t i = 0; i < frames.size(); ++i) {
      if (frames[i].cycle < 0) continue;
      const std::int64_t begin = frames[i].cycle * 1'000'000LL;
      const std::int64_t sampled = sync_end[static_cast<std::size_t>(frames[i].cycle)];
      if ((frames[i].id & 0x780) == 0x180) {
        ASSERT_LE(ends[i] - begin, plan.timing.collect_ns) << trial;
      } else if ((frames[i].id & 0x780) == 0x200) {
        ASSERT_LE(ends[i] - begin, plan.buses[0].end_ns) << trial;
        ASSERT_LE(1e-9 * static_cast<double>(ends[i] - sampled), plan.timing.delay_s) << trial;
      }
    }
  }
}

}  // namespace
}  // namespace godobject::hal
