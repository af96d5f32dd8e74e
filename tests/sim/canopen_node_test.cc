#include "sim/canopen_node.h"

#include <gtest/gtest.h>

#include <vector>

#include "sim/cia401_panel.h"
#include "sim/cia402_slave.h"
#include "sim/virtual_clock.h"
#include "tests/sim/canopen_bench.h"
#include "tests/support/random.h"

namespace godobject::sim {
namespace {

using test::bytes_of;
using test::can_frame;
using test::is;
using test::kMs;

constexpr int kNode = 5;

hal::DriveConfig drive_config() {
  hal::DriveConfig config;
  config.node = kNode;
  config.counts = 1000.0;
  config.gear = 10.0;
  config.rated_torque = 2.0;
  return config;
}

JointHardwareParameters joint() {
  JointHardwareParameters joint;
  joint.torque_limit = 20.0;
  joint.brake_torque = 40.0;
  return joint;
}

struct Bench : test::NodeBench<Cia402Slave> {
  Cia402Slave slave{drive_config(), joint(), false};
  Bench() : NodeBench{slave} {}

  void start() {
    boot();
    put(can_frame(0, {1, 0}));
    ASSERT_EQ(node.nmt_state(), 5);
  }
};

TEST(CanopenNode, BootsAndSaysSo) {
  Bench bench;
  EXPECT_TRUE(bench.put(can_frame(0, {1, 0})).empty()) << "without supply it does not answer";
  bench.node.set_supply(true, 0);
  EXPECT_EQ(bench.node.next_timer_ns(), CanopenNode::kBoot_ns);
  EXPECT_TRUE(bench.put(can_frame(0, {1, 0})).empty()) << "nor while it boots";
  bench.node.run_timers(CanopenNode::kBoot_ns - 1);
  EXPECT_TRUE(bench.sent().empty());
  bench.node.run_timers(CanopenNode::kBoot_ns);
  const auto sent = bench.sent();
  ASSERT_EQ(sent.size(), 1u);
  EXPECT_TRUE(is(sent[0], 0x705, {0}));
  EXPECT_EQ(bench.node.nmt_state(), 0x7F);
}

TEST(CanopenNode, FollowsNmt) {
  Bench bench;
  bench.boot();
  const auto command = [&bench](int what, int node) {
    bench.put(can_frame(0, {what, node}));
    return static_cast<int>(bench.node.nmt_state());
  };
  EXPECT_EQ(command(1, kNode), 5);
  EXPECT_EQ(command(2, kNode + 1), 5) << "meant for somebody else";
  EXPECT_EQ(command(2, 0), 4);
  EXPECT_EQ(command(0x80, kNode), 0x7F);
  EXPECT_EQ(command(7, kNode), 0x7F);
  bench.put(can_frame(0, {1}));
  EXPECT_EQ(bench.node.nmt_state(), 0x7F) << "one byte is no command";
  command(1, 0);
  command(2, 0);
  EXPECT_TRUE(bench.put(test::sdo_request(kNode, 0x1000, 0, 0, 0)).empty()) << "stopped: no SDO";
  for (const int reset : {0x81, 0x82}) {
    command(0x80, 0);
    ASSERT_EQ(bench.write(0x1017, 0, 2, 20), 0u);
    ASSERT_EQ(bench.write(0x607E, 0, 1, 0x80), 0u);
    EXPECT_EQ(command(reset, 0), 0);
    bench.now_ns += 10 * kMs;
    bench.node.run_timers(bench.now_ns);
    const auto sent = bench.sent();
    ASSERT_EQ(sent.size(), 1u);
    EXPECT_TRUE(is(sent[0], 0x705, {0}));
    EXPECT_EQ(bench.read(0x1017), 0u);
    EXPECT_EQ(bench.read(0x607E), reset == 0x81 ? 0u : 0x80u) << "the profile's objects are the application's";
  }
}

TEST(CanopenNode, AnswersSdoByteByByte) {
  Bench bench;
  bench.boot();
  const auto answer = [&bench](std::initializer_list<int> request) {
    const auto sent = bench.put(can_frame(0x605, request));
    return sent.size() == 1 && sent[0].id == 0x585 ? bytes_of(sent[0]) : std::vector<int>{};
  };
  using Bytes = std::vector<int>;
  EXPECT_EQ(answer({0x40, 0x00, 0x10, 0, 0, 0, 0, 0}), (Bytes{0x43, 0x00, 0x10, 0, 0x92, 0x01, 0x02, 0x00}));
  EXPECT_EQ(answer({0x40, 0x17, 0x10, 0, 0, 0, 0, 0}), (Bytes{0x4B, 0x17, 0x10, 0, 0, 0, 0, 0}));
  EXPECT_EQ(answer({0x40, 0x01, 0x10, 0, 0, 0, 0, 0}), (Bytes{0x4F, 0x01, 0x10, 0, 0, 0, 0, 0}));
  EXPECT_EQ(answer({0x40, 0x76, 0x60, 0, 0, 0, 0, 0}), (Bytes{0x43, 0x76, 0x60, 0, 0xD0, 0x07, 0, 0})) << "2000 mNm";
  EXPECT_EQ(answer({0x2B, 0x17, 0x10, 0, 0x14, 0, 0, 0}), (Bytes{0x60, 0x17, 0x10, 0, 0, 0, 0, 0}));
  EXPECT_EQ(answer({0x40, 0x17, 0x10, 0, 0, 0, 0, 0}), (Bytes{0x4B, 0x17, 0x10, 0, 0x14, 0, 0, 0}));
  EXPECT_EQ(answer({0x2F, 0x60, 0x60, 0, 0x0A, 0, 0, 0}), (Bytes{0x60, 0x60, 0x60, 0, 0, 0, 0, 0}));
  EXPECT_EQ(answer({0x40, 0x61, 0x60, 0, 0, 0, 0, 0}), (Bytes{0x4F, 0x61, 0x60, 0, 0x0A, 0, 0, 0}));
  EXPECT_EQ(answer({0x23, 0x16, 0x10, 1, 0x32, 0, 0x7F, 0}), (Bytes{0x60, 0x16, 0x10, 1, 0, 0, 0, 0}));
  EXPECT_EQ(answer({0x22, 0x17, 0x10, 0, 0x15, 0, 0, 0}), (Bytes{0x60, 0x17, 0x10, 0, 0, 0, 0, 0})) << "size left open";
  // aborts: no object, no sub, read-only, write-only, length, value, segmented
  EXPECT_EQ(answer({0x40, 0x00, 0x30, 0, 0, 0, 0, 0}), (Bytes{0x80, 0x00, 0x30, 0, 0x00, 0x00, 0x02, 0x06}));
  EXPECT_EQ(answer({0x40, 0x18, 0x10, 9, 0, 0, 0, 0}), (Bytes{0x80, 0x18, 0x10, 9, 0x11, 0x00, 0x09, 0x06}));
  EXPECT_EQ(answer({0x2B, 0x41, 0x60, 0, 0, 0, 0, 0}), (Bytes{0x80, 0x41, 0x60, 0, 0x02, 0x00, 0x01, 0x06}));
  EXPECT_EQ(answer({0x40, 0x00, 0x20, 0, 0, 0, 0, 0}), (Bytes{0x80, 0x00, 0x20, 0, 0x01, 0x00, 0x01, 0x06}));
  EXPECT_EQ(answer({0x23, 0x17, 0x10, 0, 0, 0, 0, 0}), (Bytes{0x80, 0x17, 0x10, 0, 0x10, 0x00, 0x07, 0x06}));
  EXPECT_EQ(answer({0x2F, 0x60, 0x60, 0, 0x08, 0, 0, 0}), (Bytes{0x80, 0x60, 0x60, 0, 0x30, 0x00, 0x09, 0x06}));
  EXPECT_EQ(answer({0x21, 0x17, 0x10, 0, 2, 0, 0, 0}), (Bytes{0x80, 0x17, 0x10, 0, 0x01, 0x00, 0x04, 0x05}));
  EXPECT_EQ(answer({0xE0, 0x17, 0x10, 0, 2, 0, 0, 0}), (Bytes{0x80, 0x17, 0x10, 0, 0x01, 0x00, 0x04, 0x05}));
  EXPECT_TRUE(bench.put(can_frame(0x605, {0x80, 0, 0x10, 0, 0, 0, 0, 0})).empty()) << "an abort is not answered";
  EXPECT_TRUE(bench.put(can_frame(0x605, {0x40, 0, 0x10, 0})).empty()) << "four bytes are no SDO";
  EXPECT_TRUE(bench.put(can_frame(0x604, {0x40, 0, 0x10, 0, 0, 0, 0, 0})).empty()) << "another node's";
}

TEST(CanopenNode, MapsPdosInTheStandardsOrderOnly) {
  Bench bench;
  bench.boot();
  constexpr std::uint32_t kValid = 0x185;
  constexpr std::uint32_t kInvalid = 0x8000'0185;
  EXPECT_EQ(bench.write(0x1A00, 0, 1, 0), 0x0601'0000u) << "valid";
  EXPECT_EQ(bench.write(0x1800, 1, 4, 0x186), 0x0609'0030u) << "another COB-ID while valid";
  EXPECT_EQ(bench.write(0x1800, 1, 4, kInvalid), 0u);
  EXPECT_EQ(bench.write(0x1A00, 1, 4, 0x6041'0010), 0x0601'0000u) << "the count is not 0";
  EXPECT_EQ(bench.write(0x1A00, 0, 1, 0), 0u);
  EXPECT_EQ(bench.write(0x1A00, 1, 4, 0x6041'0010), 0u);
  EXPECT_EQ(bench.write(0x1A00, 2, 4, 0x6064'0010), 0x0604'0041u) << "it has 32 bits";
  EXPECT_EQ(bench.write(0x1A00, 2, 4, 0x6071'0010), 0x0604'0041u) << "goes the other way";
  EXPECT_EQ(bench.write(0x1A00, 2, 4, 0x605A'0010), 0x0604'0041u) << "in no PDO";
  EXPECT_EQ(bench.write(0x1A00, 2, 4, 0x3000'0010), 0x0602'0000u);
  EXPECT_EQ(bench.write(0x1A00, 2, 4, 0x6064'0220), 0x0609'0011u);
  EXPECT_EQ(bench.write(0x1A00, 2, 4, 0x6064'0020), 0u);
  EXPECT_EQ(bench.write(0x1A00, 3, 4, 0x606C'0020), 0u);
  EXPECT_EQ(bench.write(0x1A00, 0, 1, 3), 0x0604'0042u) << "80 bits";
  EXPECT_EQ(bench.write(0x1A00, 0, 1, 9), 0x0609'0030u);
  EXPECT_EQ(bench.write(0x1A00, 3, 4, 0x6077'0010), 0u);
  EXPECT_EQ(bench.write(0x1A00, 0, 1, 4), 0x0604'0041u) << "the fourth is empty";
  EXPECT_EQ(bench.write(0x1A00, 0, 1, 3), 0u);
  EXPECT_EQ(bench.write(0x1800, 2, 1, 250), 0x0609'0030u) << "a reserved type";
  EXPECT_EQ(bench.write(0x1800, 2, 1, 1), 0u);
  EXPECT_EQ(bench.write(0x1800, 1, 4, kValid | (1u << 29)), 0x0609'0030u) << "29 bits";
  EXPECT_TRUE(bench.put(can_frame(0, {1, 0})).empty());
  EXPECT_TRUE(bench.put(can_frame(0x80, {})).empty()) << "not valid yet";
  EXPECT_EQ(bench.write(0x1800, 1, 4, kValid), 0u);
  const auto sent = bench.put(can_frame(0x80, {}));
  ASSERT_EQ(sent.size(), 1u);
  EXPECT_TRUE(is(sent[0], 0x185, {0x10, 0x02, 0, 0, 0, 0, 0, 0})) << "not ready to switch on, remote, voltage";
}

TEST(CanopenNode, AnswersEveryNthSyncWhileOperational) {
  Bench bench;
  bench.boot();
  ASSERT_EQ(bench.write(0x1800, 2, 1, 3), 0u);
  EXPECT_TRUE(bench.put(can_frame(0x80, {})).empty()) << "pre-operational";
  bench.put(can_frame(0, {1, 0}));
  for (int i = 1; i <= 12; ++i) EXPECT_EQ(bench.put(can_frame(0x80, {})).size(), i % 3 == 0 ? 1u : 0u) << i;
  ASSERT_EQ(bench.write(0x1005, 0, 4, 0x81), 0u);
  for (int i = 1; i <= 3; ++i) EXPECT_TRUE(bench.put(can_frame(0x80, {})).empty());
}

TEST(CanopenNode, SendsByItsEventTimer) {
  Bench bench;
  bench.boot();
  ASSERT_EQ(bench.write(0x1800, 5, 2, 7), 0u);
  bench.put(can_frame(0, {1, 0}));
  EXPECT_EQ(bench.node.next_timer_ns(), bench.now_ns + 7 * kMs);
  bench.node.run_timers(bench.now_ns + 7 * kMs);
  ASSERT_EQ(bench.sent().size(), 1u);
  EXPECT_EQ(bench.node.next_timer_ns(), bench.now_ns + 14 * kMs);
}

TEST(CanopenNode, AnswersSyncWithWhatItSampledThenSoLongAfterIt) {
  Bench bench;
  bench.boot();
  ASSERT_EQ(bench.write(0x1800, 2, 1, 1), 0u);
  bench.node.set_answer(150'000);
  bench.put(can_frame(0, {1, 0}));
  EXPECT_TRUE(bench.put(can_frame(0x80, {})).empty());
  EXPECT_EQ(bench.node.next_timer_ns(), bench.now_ns + 150'000);
  bench.node.run_timers(bench.now_ns + 149'999);
  EXPECT_TRUE(bench.sent().empty());
  bench.node.run_timers(bench.now_ns + 150'000);
  ASSERT_EQ(bench.sent().size(), 1u);
  EXPECT_TRUE(bench.put(can_frame(0x80, {})).empty());
  bench.put(can_frame(0, {0x80, 0}));
  bench.node.run_timers(bench.now_ns + kMs);
  EXPECT_TRUE(bench.sent().empty()) << "no longer operational";
}

TEST(CanopenNode, ProducesHeartbeatsWithItsState) {
  Bench bench;
  bench.boot();
  ASSERT_EQ(bench.write(0x1017, 0, 2, 20), 0u);
  EXPECT_EQ(bench.node.next_timer_ns(), bench.now_ns + 20 * kMs);
  bench.node.run_timers(bench.now_ns + 20 * kMs);
  auto sent = bench.sent();
  ASSERT_EQ(sent.size(), 1u);
  EXPECT_TRUE(is(sent[0], 0x705, {0x7F}));
  bench.put(can_frame(0, {1, 0}));
  bench.node.run_timers(bench.now_ns + 40 * kMs);
  sent = bench.sent();
  ASSERT_EQ(sent.size(), 1u);
  EXPECT_TRUE(is(sent[0], 0x705, {5}));
  ASSERT_EQ(bench.write(0x1017, 0, 2, 0), 0u);
  EXPECT_EQ(bench.node.next_timer_ns(), kNever);
}

TEST(CanopenNode, MissesAHeartbeatToTheNanosecond) {
  for (const int behaviour : {0, 1, 2}) {
    Bench bench;
    bench.start();
    ASSERT_EQ(bench.write(0x1016, 1, 4, (127u << 16) | 50), 0u);
    ASSERT_EQ(bench.write(0x1029, 1, 1, static_cast<std::uint32_t>(behaviour)), 0u);
    EXPECT_EQ(bench.node.next_timer_ns(), kNever) << "armed by the first one";
    bench.put(can_frame(0x77F, {5}));
    bench.now_ns += 30 * kMs;
    bench.put(can_frame(0x77F, {5}));
    bench.put(can_frame(0x77E, {5}));
    EXPECT_EQ(bench.node.next_timer_ns(), bench.now_ns + 50 * kMs);
    bench.node.run_timers(bench.now_ns + 50 * kMs - 1);
    EXPECT_TRUE(bench.sent().empty());
    bench.node.run_timers(bench.now_ns + 50 * kMs);
    const auto sent = bench.sent();
    ASSERT_EQ(sent.size(), 1u);
    EXPECT_TRUE(is(sent[0], 0x085, {0x30, 0x81, 0x11, 0, 0, 0, 0, 0}));
    EXPECT_EQ(bench.node.nmt_state(), behaviour == 0 ? 0x7F : behaviour == 1 ? 5 : 4);
    EXPECT_EQ(bench.node.next_timer_ns(), kNever);
  }
}

TEST(CanopenNode, ChecksTheLengthOfARpdo) {
  Bench bench;
  bench.start();
  auto sent = bench.put(can_frame(0x205, {6}));
  ASSERT_EQ(sent.size(), 1u);
  EXPECT_TRUE(is(sent[0], 0x085, {0x10, 0x82, 0x11, 0, 0, 0, 0, 0}));
  EXPECT_EQ(bench.read(0x6040), 0u) << "not taken";
  sent = bench.put(can_frame(0x205, {6, 0, 99}));
  ASSERT_EQ(sent.size(), 1u);
  EXPECT_TRUE(is(sent[0], 0x085, {0x20, 0x82, 0x11, 0, 0, 0, 0, 0}));
  EXPECT_EQ(bench.read(0x6040), 6u) << "its first bytes are";
  EXPECT_EQ(bench.read(0x1001), 0x11u);
}

TEST(CanopenNode, SynchronousRpdoActsAtTheNextSync) {
  Bench bench;
  bench.boot();
  ASSERT_EQ(bench.write(0x1400, 2, 1, 1), 0u);
  bench.put(can_frame(0, {1, 0}));
  bench.put(can_frame(0x205, {6, 0}));
  EXPECT_EQ(bench.read(0x6040), 0u);
  bench.put(can_frame(0x80, {}));
  EXPECT_EQ(bench.read(0x6040), 6u);
}

TEST(CanopenNode, ScriptsSilenceAndRefuse) {
  Bench bench;
  bench.boot();
  ASSERT_EQ(bench.write(0x1017, 0, 2, 20), 0u);
  bench.node.mute_heartbeat(true);
  bench.node.run_timers(bench.now_ns + 20 * kMs);
  EXPECT_TRUE(bench.sent().empty());
  bench.node.refuse_sdo(SdoAbort::kValue);
  EXPECT_EQ(bench.write(0x1017, 0, 2, 0), 0x0609'0030u);
  bench.node.refuse_sdo(SdoAbort::kNone);
  EXPECT_EQ(bench.write(0x1017, 0, 2, 0), 0u);
  bench.node.restart(bench.now_ns);
  bench.node.run_timers(bench.now_ns + CanopenNode::kReset_ns);
  const auto sent = bench.sent();
  ASSERT_EQ(sent.size(), 1u);
  EXPECT_TRUE(is(sent[0], 0x705, {0}));
}

TEST(CanopenNode, SurvivesWhateverFramesCome) {
  test::Random random(7);
  Bench bench;
  bench.start();
  const std::array<int, 8> ids{0x000, 0x080, 0x205, 0x605, 0x605, 0x605, 0x77F, 0x085};
  for (int i = 0; i < 200'000; ++i) {
    hal::CanFrame frame;
    frame.id = static_cast<std::uint16_t>(ids.at(static_cast<std::size_t>(random.between(0.0, 7.999))));
    frame.length = static_cast<std::uint8_t>(random.between(0.0, 8.999));
    for (auto& byte : frame.data) byte = static_cast<std::uint8_t>(random.between(0.0, 255.999));
    if (frame.id == 0x605 && random.between(0.0, 1.0) < 0.9) {  // near to what makes sense
      frame.length = 8;
      frame.data[0] = random.between(0.0, 1.0) < 0.3
                          ? 0x40
                          : static_cast<std::uint8_t>(0x23 + 4 * static_cast<int>(random.between(0.0, 3.999)));
      const auto objects = bench.node.objects().entries();
      const ObjectEntry& entry =
          objects[static_cast<std::size_t>(random.between(0.0, static_cast<double>(objects.size()) - 1e-9))];
      frame.data[1] = static_cast<std::uint8_t>(entry.index);
      frame.data[2] = static_cast<std::uint8_t>(entry.index >> 8);
      frame.data[3] = entry.sub;
    }
    bench.now_ns += static_cast<std::int64_t>(random.between(0.0, 2e5));
    bench.put(frame);
    bench.node.run_timers(bench.now_ns);
    bench.slave.update(bench.now_ns, random.between(-9.0, 9.0), random.between(-3.0, 3.0));
    ASSERT_LE(std::abs(bench.slave.motor_torque()), 20.0 + 1e-9);
    bench.sent();
  }
}

TEST(Cia401Panel, AnswersSyncWithItsInputs) {
  hal::PanelConfig config;
  config.bus = 0;
  config.node = 0x20;
  Cia401Panel panel(config, false);
  test::NodeBench<Cia401Panel> bench{panel};
  bench.boot();
  EXPECT_EQ(bench.read(0x1000), 0x0001'0191u);
  ASSERT_EQ(bench.write(0x1800, 2, 1, 1), 0u);
  bench.put(can_frame(0, {1, 0x20}));
  for (const int inputs : {0, 1, 3, 7}) {
    panel.set_inputs(static_cast<std::uint8_t>(inputs));
    const auto sent = bench.put(can_frame(0x80, {}));
    ASSERT_EQ(sent.size(), 1u);
    EXPECT_TRUE(is(sent[0], 0x1A0, {inputs}));
    EXPECT_EQ(bench.read(0x6000, 1), static_cast<std::uint32_t>(inputs));
  }
  EXPECT_EQ(bench.write(0x6000, 1, 1, 0), 0x0601'0002u);
}

}  // namespace
}  // namespace godobject::sim
