#include "hal/cia402/bring_up.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "tests/hal/bring_up_bench.h"
#include "tests/support/random.h"

namespace godobject::hal {
namespace {

TEST_F(BringUpTest, StartsEveryNode) {
  const BringUpResult result = start();
  EXPECT_EQ(result.status, BringUpStatus::kOk) << describe(result.status) << ' ' << result.bus << ' ' << result.node
                                               << std::hex << ' ' << result.index << ' ' << result.found;
  for (const ScriptedNode* node : {&joint_0_, &joint_1_, &joint_2_, &panel_}) {
    EXPECT_EQ(node->state, 0x05);
    EXPECT_EQ(node->nmt, (std::vector<int>{0x82, 0x01}));
  }
  EXPECT_TRUE(sent_no_command());
  EXPECT_EQ(world_.longest_sleep_ns, 1'000'000);
  EXPECT_LT(world_.now_ns(), kSecond_ns / 2);
}

TEST_F(BringUpTest, WritesTheObjectsInTheOrderOfTheStandard) {
  ASSERT_EQ(start().status, BringUpStatus::kOk);
  using Write = std::pair<std::pair<int, int>, std::uint32_t>;
  const std::vector<Write> expected = {
      {{0x1400, 1}, 0x80000202},  // invalid
      {{0x1600, 0}, 0},          {{0x1600, 1}, 0x60400010}, {{0x1600, 2}, 0x60710010}, {{0x1600, 0}, 2},
      {{0x1400, 2}, 255},        {{0x1400, 5}, 4},          {{0x1400, 1}, 0x202},      {{0x1800, 1}, 0x80000182},
      {{0x1A00, 0}, 0},          {{0x1A00, 1}, 0x60410010}, {{0x1A00, 2}, 0x60640020}, {{0x1A00, 3}, 0x60770010},
      {{0x1A00, 0}, 3},          {{0x1800, 2}, 1},          {{0x1800, 1}, 0x182},      {{0x1801, 1}, 0x80000282},
      {{0x1A01, 0}, 0},          {{0x1A01, 1}, 0x60610008}, {{0x1A01, 0}, 1},          {{0x1801, 2}, 255},
      {{0x1801, 5}, 1000},                                   // ms
      {{0x1801, 1}, 0x282},      {{0x1016, 1}, 0x007F0032},  // node 127, 50 ms
      {{0x1017, 0}, 20},         {{0x1029, 1}, 1},          {{0x6007, 0}, 3},          {{0x605A, 0}, 2},
      {{0x605E, 0}, 2},          {{0x6060, 0}, 10},
  };
  EXPECT_EQ(joint_2_.writes, expected);
  const std::vector<Write> panel = {{{0x1800, 1}, 0x800001A0}, {{0x1A00, 0}, 0}, {{0x1A00, 1}, 0x60000108},
                                    {{0x1A00, 0}, 1},          {{0x1800, 2}, 1}, {{0x1800, 1}, 0x1A0},
                                    {{0x1017, 0}, 20}};
  EXPECT_EQ(panel_.writes, panel);
}

TEST_F(BringUpTest, WritesWhatOnlySomeDrivesHave) {
  joint_0_.objects[{0x1006, 0}] = {4, 0};
  joint_0_.objects[{0x1801, 3}] = {2, 50};
  joint_0_.objects[{0x1802, 1}] = {4, 0x381};
  joint_0_.objects[{0x60C2, 1}] = {1, 0};
  joint_0_.objects[{0x60C2, 2}] = {1, 0};
  ASSERT_EQ(start().status, BringUpStatus::kOk);
  EXPECT_EQ(joint_0_.object(0x1006, 0).value, 1000u);
  EXPECT_EQ(joint_0_.object(0x1801, 3).value, 0u);  // a change is told at once
  EXPECT_EQ(joint_0_.object(0x1802, 1).value, 0x80000381u);
  EXPECT_EQ(joint_0_.object(0x60C2, 1).value, 1u);
  EXPECT_EQ(joint_0_.object(0x60C2, 2).value, 0xFDu);  // 10^-3
}

TEST_F(BringUpTest, RefusesASecondMaster) {
  for (const CanFrame& of_master : {frame(0x080, {}), frame(0x202, {0x0F, 0, 0, 0}), frame(0x000, {0x01, 0x00}),
                                    frame(0x77F, {0x05}), frame(0x601, {0x40, 0, 0x10, 0, 0, 0, 0, 0})}) {
    FakeBus first;
    FakeBus second;
    second.receive_next(frame(0x701, {0x05}));
    second.receive_next(of_master);
    const std::array<CanBus*, 2> wires = {&first, &second};
    ScriptedWorld world{{}};
    const BringUpResult result = bring_up(layout_, wires, world, nullptr);
    EXPECT_EQ(result.status, BringUpStatus::kSecondMaster);
    EXPECT_EQ(result.bus, 1);
    EXPECT_EQ(result.found, of_master.id);
    EXPECT_TRUE(first.sent.empty() && second.sent.empty());
  }
}

TEST_F(BringUpTest, ListensForATenthOfASecondFirst) {
  bool heard = false;
  world_.each_sleep = [&] {
    if (!heard && world_.now_ns() >= 99'000'000) {
      heard = true;
      first_.receive_next(frame(0x080, {}));
    }
  };
  EXPECT_EQ(start().status, BringUpStatus::kSecondMaster);
  EXPECT_TRUE(world_.log.empty());
}

TEST_F(BringUpTest, RefusesASecondMasterThatComesLater) {
  joint_1_.before_answer = [](FakeBus& bus) { bus.receive_next(frame(0x200 + 1, {0, 0, 0, 0})); };
  const BringUpResult result = start();
  EXPECT_EQ(result.status, BringUpStatus::kSecondMaster);
  EXPECT_EQ(result.bus, 1);
}

TEST_F(BringUpTest, WaitsForANodeThatBootsLate) {
  joint_1_.boot_delay_ns = 4 * kSecond_ns;
  EXPECT_EQ(start().status, BringUpStatus::kOk);
  EXPECT_GT(world_.now_ns(), 4 * kSecond_ns);
}

TEST_F(BringUpTest, NamesTheNodeThatNeverBoots) {
  joint_1_.boots = false;
  const BringUpResult result = start();
  EXPECT_EQ(result.status, BringUpStatus::kNoBootUp);
  EXPECT_EQ(result.bus, 1);
  EXPECT_EQ(result.node, 1);
  EXPECT_EQ(result.joint, 1);
  EXPECT_NEAR(static_cast<double>(world_.now_ns()), 5.1e9, 0.01e9);
  EXPECT_TRUE(sent_no_command());
}

TEST_F(BringUpTest, NamesTheNodeThatDoesNotAnswer) {
  panel_.answers = false;
  const BringUpResult result = start();
  EXPECT_EQ(result.status, BringUpStatus::kNoAnswer);
  EXPECT_EQ(result.node, 32);
  EXPECT_EQ(result.joint, -1);
  EXPECT_EQ(result.index, 0x1000);
}

TEST_F(BringUpTest, NamesTheNodeThatStartsAnew) {
  int answers = 0;
  joint_2_.before_answer = [&](FakeBus& bus) {
    if (++answers == 10) bus.receive_next(frame(0x702, {0x00}));
  };
  const BringUpResult result = start();
  EXPECT_EQ(result.status, BringUpStatus::kStartedAnew);
  EXPECT_EQ(result.joint, 2);
}

TEST_F(BringUpTest, NamesTheNodeThatDoesNotStart) {
  joint_0_.starts = false;
  const BringUpResult result = start();
  EXPECT_EQ(result.status, BringUpStatus::kNotOperational);
  EXPECT_EQ(result.joint, 0);
  EXPECT_EQ(result.expected, 0x05u);
  EXPECT_EQ(result.found, 0x7Fu);
}

TEST_F(BringUpTest, WaitsForADriveThatTellsItsModeByItsTimerOnly) {
  joint_1_.first_mode_ns = kSecond_ns;
  EXPECT_EQ(start().status, BringUpStatus::kOk);
  EXPECT_GT(world_.now_ns(), kSecond_ns);
}

TEST_F(BringUpTest, NamesTheDriveThatDoesNotTellItsMode) {
  joint_1_.tells_mode = false;
  const BringUpResult result = start();
  EXPECT_EQ(result.status, BringUpStatus::kModeNotTold);
  EXPECT_EQ(result.bus, 1);
  EXPECT_EQ(result.joint, 1);
  EXPECT_EQ(result.index, 0x6061);
}

/// A wrong object in the drive of joint 1, and the result that the bring-up must return.
struct WrongObject {
  int index;
  int subindex;
  ScriptedNode::Object object;
  BringUpStatus status;
  std::uint32_t expected;
  std::uint32_t found;
};

TEST_F(BringUpTest, NamesTheObjectThatIsNotAsItMustBe) {
  using Status = BringUpStatus;
  const std::vector<WrongObject> wrong = {
      {0x1000, 0, {4, 0x00020191}, Status::kWrongValue, 0x192, 0x00020191},
      {0x6502, 0, {4, 0x000001FF}, Status::kWrongValue, 0x200, 0x1FF},
      {0x6076, 0, {4, 1516}, Status::kWrongValue, 1500, 1516},  // one percent is 15
      {0x6076, 0, {4, 1484}, Status::kWrongValue, 1500, 1484},
      {0x6071, 0, {4, 0}, Status::kWrongSize, 2, 4},
      {0x6077, 0, {4, 0}, Status::kWrongSize, 2, 4},
      {0x6064, 0, {8, 0}, Status::kWrongSize, 4, 0},
      {0x1005, 0, {4, 0x40000080}, Status::kWrongValue, 0x80, 0x40000080},  // makes SYNC itself
      {0x1400, 5, {2, 100, true}, Status::kWrongValue, 4, 100},
      {0x1400, 2, {1, 1, true}, Status::kWrongValue, 255, 1},
      {0x1800, 1, {4, 0x80000181, true}, Status::kWrongValue, 0x181, 0x80000181},
      {0x1A00, 2, {4, 0x606C0020, true}, Status::kWrongValue, 0x60640020, 0x606C0020},
      {0x1801, 2, {1, 254, true}, Status::kWrongValue, 255, 254},
      {0x1A01, 1, {4, 0x60600008, true}, Status::kWrongValue, 0x60610008, 0x60600008},
      {0x1016, 1, {4, 0, true}, Status::kWrongValue, 0x007F0032, 0},
      {0x6007, 0, {2, 0, true}, Status::kWrongValue, 3, 0},
      {0x605A, 0, {2, 6, true}, Status::kWrongValue, 2, 6},
      {0x605E, 0, {4, 0}, Status::kRefused, 2, 0x06070010},
  };
  for (const WrongObject& object : wrong) {
    joint_1_ = scripted_drive(1, 1500);
    joint_1_.object(object.index, object.subindex) = object.object;
    const BringUpResult result = start();
    SCOPED_TRACE(testing::Message() << std::hex << object.index << ':' << object.subindex);
    EXPECT_EQ(result.status, object.status);
    EXPECT_EQ(result.bus, 1);
    EXPECT_EQ(result.node, 1);
    EXPECT_EQ(result.joint, 1);
    EXPECT_EQ(result.index, object.index);
    EXPECT_EQ(result.subindex, object.subindex);
    EXPECT_EQ(result.expected, object.expected);
    EXPECT_EQ(result.found, object.found);
    EXPECT_NE(std::string(describe(result.status)).find(';'), std::string::npos);
  }
  EXPECT_TRUE(sent_no_command());
}

/// Adds the objects that a start writes only to drives and panels that have them.
void add_optional_objects(ScriptedNode& drive, ScriptedNode& panel) {
  drive.objects.insert({{{0x1006, 0}, {4, 0}},
                        {{0x1401, 1}, {4, 0x301}},
                        {{0x1402, 1}, {4, 0x401}},
                        {{0x1403, 1}, {4, 0x501}},
                        {{0x1801, 3}, {2, 50}},
                        {{0x1802, 1}, {4, 0x381}},
                        {{0x1803, 1}, {4, 0x481}},
                        {{0x60C2, 1}, {1, 0}},
                        {{0x60C2, 2}, {1, 0}}});
  panel.objects.insert({{0x1016, 1}, {4, 0}});
}

/// Bits that a node must keep as they were written. Of a PDO's COB-ID: the identifier, and that the PDO is off; of a
/// PDO that is off, only the latter.
std::uint32_t bits_to_keep(int index, int subindex, int size, std::uint32_t written) {
  const bool is_cob = subindex == 1 && (index >> 8 == 0x14 || index >> 8 == 0x18);
  if (is_cob) return written >= 0x80000000 ? 0x80000000 : 0x800007FF;
  return size == 4 ? 0xFFFFFFFF : (1u << 8 * size) - 1;
}

/// Each written object in turn acknowledges the write, but then reads with one other bit: the highest or the lowest.
TEST_F(BringUpTest, ReadsBackEveryObjectThatItWrites) {
  add_optional_objects(joint_1_, panel_);
  for (ScriptedNode* node : {&joint_1_, &panel_}) {
    const ScriptedNode fresh = *node;
    ASSERT_EQ(start().status, BringUpStatus::kOk);
    std::map<std::pair<int, int>, std::uint32_t> written;
    for (const auto& [key, value] : node->writes) written[key] = value;  // the last write remains
    EXPECT_EQ(written.size(), node == &panel_ ? 6u : 33u);
    for (const auto& [key, value] : written) {
      // 6060 is a request; the drive answers with 6061
      const std::pair read = key == std::pair(0x6060, 0) ? std::pair(0x6061, 0) : key;
      const int size = fresh.objects.at(key).size;
      const std::uint32_t keep = bits_to_keep(key.first, key.second, size, value);
      for (const std::uint32_t bit : {std::bit_floor(keep), keep & ~(keep - 1)}) {
        *node = fresh;
        node->reads[read] = value ^ bit;
        const BringUpResult result = start();
        SCOPED_TRACE(testing::Message() << std::hex << read.first << ':' << read.second << ' ' << bit);
        EXPECT_EQ(result.status, BringUpStatus::kWrongValue);
        EXPECT_EQ(result.index, read.first);
        EXPECT_EQ(result.subindex, read.second);
        EXPECT_EQ(result.expected, value & keep);
        EXPECT_EQ(result.found, value ^ bit);
      }
    }
    *node = fresh;
  }
  EXPECT_TRUE(sent_no_command());
}

TEST_F(BringUpTest, RefusesADriveThatGivesLessTorqueThanItsJointMayTake) {
  layout_.drives[1].gear = 20.0;
  layout_.drives[1].torque_limit = 45.0;  // of 30 Nm rated: 1500 permille
  for (const int limit : {0x6072, 0x60E0, 0x60E1}) {
    for (const std::uint32_t permille : {1499u, 1500u, 0xFFFFu}) {
      joint_1_ = scripted_drive(1, 1500);
      joint_1_.objects[{limit, 0}] = {2, permille};
      const BringUpResult result = start();
      SCOPED_TRACE(testing::Message() << std::hex << limit << ' ' << permille);
      if (permille >= 1500) {
        EXPECT_EQ(result.status, BringUpStatus::kOk);
        continue;
      }
      EXPECT_EQ(result.status, BringUpStatus::kTooLow);
      EXPECT_EQ(result.joint, 1);
      EXPECT_EQ(result.index, limit);
      EXPECT_EQ(result.expected, 1500u);
      EXPECT_EQ(result.found, 1499u);
    }
  }
}

TEST_F(BringUpTest, RefusesAQuickStopWithoutARamp) {
  joint_1_.object(0x6085, 0).value = 0;
  const BringUpResult result = start();
  EXPECT_EQ(result.status, BringUpStatus::kTooLow);
  EXPECT_EQ(result.index, 0x6085);
}

TEST_F(BringUpTest, ComparesEncoderAndGearWithTheLayoutAsFarAsADriveHasThem) {
  layout_.drives[1].counts = 1 << 16;
  layout_.drives[1].gear = 12.5;
  struct Row {
    int index;
    std::uint32_t over;
    std::uint32_t under;
    double found;  // 0: good
    double expected = 0.0;
  };
  for (const Row& row :
       {Row{0x608F, 65536, 1, 0.0}, Row{0x608F, 131072, 2, 0.0}, Row{0x608F, 262144, 1, 262144.0, 65536.0},
        Row{0x6091, 25, 2, 0.0}, Row{0x6091, 1, 1, 0.0}, Row{0x6091, 25, 1, 25.0, 12.5}, Row{0x6091, 2, 25, 0.08, 12.5},
        Row{0x6091, 5, 0, HUGE_VAL, 12.5}}) {
    joint_1_ = scripted_drive(1, 1500);
    joint_1_.objects[{row.index, 1}] = {4, row.over};
    joint_1_.objects[{row.index, 2}] = {4, row.under};
    const BringUpResult result = start();
    SCOPED_TRACE(testing::Message() << std::hex << row.index << std::dec << ' ' << row.over << '/' << row.under);
    EXPECT_EQ(result.status, row.found == 0.0 ? BringUpStatus::kOk : BringUpStatus::kWrongRatio);
    if (row.found == 0.0) continue;
    EXPECT_EQ(result.joint, 1);
    EXPECT_EQ(result.index, row.index);
    EXPECT_EQ(result.ratio_expected, row.expected);
    EXPECT_EQ(result.ratio_found, row.found);
  }
}

TEST_F(BringUpTest, RefusesASyncCounterAndInputsThatAreTurnedRound) {
  for (ScriptedNode* node : {&joint_0_, &panel_}) {
    node->objects[{0x1019, 0}] = {1, 2};
    const BringUpResult result = start();
    EXPECT_EQ(result.status, BringUpStatus::kWrongValue);
    EXPECT_EQ(result.index, 0x1019);
    node->objects[{0x1019, 0}].value = 0;
  }
  panel_.objects[{0x6002, 1}] = {1, 0x01};
  const BringUpResult result = start();
  EXPECT_EQ(result.status, BringUpStatus::kWrongValue);
  EXPECT_EQ(result.index, 0x6002);
  EXPECT_EQ(result.node, 32);
}

TEST_F(BringUpTest, ThePanelWatchesTheControllerIfItCan) {
  panel_.objects[{0x1016, 1}] = {4, 0};
  ASSERT_EQ(start().status, BringUpStatus::kOk);
  EXPECT_EQ(panel_.object(0x1016, 1).value, 0x007F0032u);
}

/// While it listens, waits for a boot-up, writes objects and waits for the nodes to start.
TEST_F(BringUpTest, EndsAtOnceWhenItIsAskedTo) {
  joint_1_.boot_delay_ns = 200'000'000;
  joint_2_.starts = false;
  for (const std::int64_t at_ns : {0LL, 50'000'000LL, 99'000'000LL, 150'000'000LL, 400'000'000LL, 700'000'000LL}) {
    std::atomic<bool> end{at_ns == 0};
    const std::int64_t begin_ns = world_.now_ns();
    world_.log.clear();
    world_.each_sleep = [&] { end = world_.now_ns() - begin_ns >= at_ns; };
    const BringUpResult result = bring_up(layout_, wires_, world_, nullptr, &end);
    EXPECT_EQ(result.status, BringUpStatus::kEnded) << at_ns;
    EXPECT_EQ(result.began, at_ns > 100'000'000) << at_ns;
    EXPECT_EQ(world_.log.empty(), !result.began) << at_ns;
    EXPECT_LE(world_.now_ns() - begin_ns - at_ns, 1'000'000) << at_ns;
    EXPECT_TRUE(sent_no_command());
  }
}

TEST_F(BringUpTest, TakesARatedTorqueWithinOnePercent) {
  joint_1_.object(0x6076, 0).value = 1515;
  EXPECT_EQ(start().status, BringUpStatus::kOk);
}

TEST_F(BringUpTest, NamesTheObjectThatIsMissing) {
  for (const auto& [key, object] : scripted_drive(1, 1500).objects) {
    joint_1_ = scripted_drive(1, 1500);
    joint_1_.objects.erase(key);
    const BringUpResult result = start();
    if (key == std::pair(0x6061, 0)) continue;  // made by the write to 6060
    EXPECT_EQ(result.status, BringUpStatus::kRefused) << std::hex << key.first;
    EXPECT_EQ(result.index, key.first);
    EXPECT_EQ(result.found, 0x06020000u);
  }
}

TEST_F(BringUpTest, TellsADeadInterface) {
  second_.state.down = true;
  BringUpResult result = start();
  EXPECT_EQ(result.status, BringUpStatus::kBusDown);
  EXPECT_EQ(result.bus, 1);
  second_.state = BusHealth();
  first_.state.bus_off = true;
  result = start();
  EXPECT_EQ(result.status, BringUpStatus::kBusDown);
  EXPECT_EQ(result.bus, 0);
  first_.state = BusHealth();
  first_.result = SendResult::kDown;
  EXPECT_EQ(start().status, BringUpStatus::kBusDown);
  first_.result = SendResult::kFull;
  EXPECT_EQ(start().status, BringUpStatus::kCannotSend);
}

TEST_F(BringUpTest, TellsABusWithoutAcknowledgementFromASilentNode) {
  joint_1_.boots = false;
  second_.state.unreturned = 1;
  const BringUpResult result = start();
  EXPECT_EQ(result.status, BringUpStatus::kCannotSend);
  EXPECT_EQ(result.bus, 1);
  EXPECT_EQ(result.node, 0);
}

TEST_F(BringUpTest, IsNotLedAstrayByOthersFrames) {
  // answers of another node, to other objects, and the like of another bus
  joint_2_.before_answer = [this](FakeBus& bus) {
    bus.receive_next(frame(0x583, {0x43, 0x00, 0x10, 0x00, 0, 0, 0, 0}));
    bus.receive_next(frame(0x582, {0x43, 0xFF, 0x5F, 0x00, 0, 0, 0, 0}));
    bus.receive_next(frame(0x705, {0x00}));
    bus.receive_next(frame(0x185, {1, 2, 3}));
    bus.receive_next(frame(0x082, {0x30, 0x81, 0x11, 0, 0, 0, 0, 0}));
    second_.receive_next(frame(0x582, {0x80, 0x00, 0x10, 0x00, 0, 0, 0x02, 0x06}));
  };
  EXPECT_EQ(start().status, BringUpStatus::kOk);
}

TEST_F(BringUpTest, RandomFramesOfNodesNeitherCrashItNorMakeItGivePower) {
  test::Random random(4);
  world_.each_sleep = [&] {
    for (int k = random.integer(0, 20); k > 0; --k) {
      constexpr std::array<int, 8> kIds = {0x081, 0x181, 0x1A0, 0x581, 0x582, 0x5A0, 0x701, 0x123};
      CanFrame noise{static_cast<std::uint16_t>(kIds.at(static_cast<std::size_t>(random.integer(0, 7))))};
      noise.length = static_cast<std::uint8_t>(random.integer(0, 64));
      for (std::uint8_t& byte : noise.data) byte = static_cast<std::uint8_t>(random.integer(0, 255));
      (random.integer(0, 1) == 0 ? first_ : second_).receive_next(noise);
    }
  };
  layout_.boot_timeout = 0.5;
  for (int run = 0; run < 100; ++run) {
    const BringUpResult result = start();
    EXPECT_NE(result.status, BringUpStatus::kSecondMaster);
    EXPECT_NE(result.status, BringUpStatus::kBusDown);
    EXPECT_NE(result.status, BringUpStatus::kCannotSend);
  }
  EXPECT_TRUE(sent_no_command());
}

}  // namespace
}  // namespace godobject::hal
