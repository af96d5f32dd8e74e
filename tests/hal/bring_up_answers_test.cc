// The start against nodes that answer oddly, buses that take nothing, and its own deadlines.
#include "hal/cia402/bring_up.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "tests/hal/bring_up_bench.h"

namespace godobject::hal {
namespace {

constexpr std::int64_t kMillisecond_ns = 1'000'000;

/// Object of an SDO frame.
std::pair<int, int> object_of(const CanFrame& frame) { return {frame.data[1] | frame.data[2] << 8, frame.data[3]}; }

class BringUpAnswersTest : public BringUpTest {
 protected:
  /// Requests that node `id - 0x600` was sent on one of the buses, by their object.
  std::map<std::pair<int, int>, int> requests(int id) const {
    std::map<std::pair<int, int>, int> count;
    for (const CanFrame& frame : world_.log) {
      if (frame.id == id) ++count[object_of(frame)];
    }
    return count;
  }

  bool sent_no_request() const {
    return std::ranges::none_of(world_.log, [](const CanFrame& frame) { return frame.id >= 0x600; });
  }

  /// Calls `action` once, at the first millisecond from `at_ns` on.
  void at(std::int64_t at_ns, std::function<void()> action) {
    world_.each_sleep = [this, at_ns, action = std::move(action), done = false]() mutable {
      if (done || world_.now_ns() < at_ns) return;
      done = true;
      action();
    };
  }
};

TEST_F(BringUpAnswersTest, ASuccessNamesNobody) {
  const BringUpResult result = start();
  EXPECT_EQ(result.status, BringUpStatus::kOk);
  EXPECT_EQ(result.bus, -1);
  EXPECT_EQ(result.node, 0);
  EXPECT_EQ(result.joint, -1);
  EXPECT_EQ(result.index, 0);
  EXPECT_EQ(result.subindex, 0);
  EXPECT_EQ(result.expected, 0u);
  EXPECT_EQ(result.found, 0u);
  EXPECT_TRUE(result.began);
}

/// Numbers of the steps before do not stay in the result.
TEST_F(BringUpAnswersTest, ASilentNodeHasNoNumbers) {
  int answers = 0;
  joint_2_.before_answer = [&](FakeBus&) { joint_2_.answers = ++answers < 20; };
  const BringUpResult result = start();
  EXPECT_EQ(result.status, BringUpStatus::kNoAnswer);
  EXPECT_EQ(result.joint, 2);
  EXPECT_EQ(result.node, 2);
  EXPECT_EQ(result.bus, 0);
  EXPECT_NE(result.index, 0);
  EXPECT_EQ(result.expected, 0u);
  EXPECT_EQ(result.found, 0u);
}

TEST_F(BringUpAnswersTest, AnEndThatWasAskedForIsOfNoBus) {
  const std::atomic<bool> end{true};
  const BringUpResult result = bring_up(layout_, wires_, world_, nullptr, &end);
  EXPECT_EQ(result.status, BringUpStatus::kEnded);
  EXPECT_EQ(result.bus, -1);
  EXPECT_EQ(result.node, 0);
  EXPECT_FALSE(result.began);
}

// ---------------------------------------------------------------- deadlines

TEST_F(BringUpAnswersTest, WaitsForABootUpAsLongAsTheLayoutSays) {
  layout_.boot_timeout = 0.3;
  joint_0_.boots = false;
  const BringUpResult result = start();
  EXPECT_EQ(result.status, BringUpStatus::kNoBootUp);
  EXPECT_EQ(result.joint, 0);
  EXPECT_EQ(world_.now_ns(), (100 + 300) * kMillisecond_ns);
  EXPECT_TRUE(sent_no_request());
}

TEST_F(BringUpAnswersTest, WaitsASecondForAnAnswer) {
  joint_0_.answers = false;
  EXPECT_EQ(start().status, BringUpStatus::kNoAnswer);
  const std::int64_t begin_ns = (100 + 12 + 50) * kMillisecond_ns;  // listened, booted, settled
  EXPECT_NEAR(static_cast<double>(world_.now_ns() - begin_ns), 1e9, 3e6);
}

TEST_F(BringUpAnswersTest, WaitsASecondAndAPeriodForAMode) {
  layout_.mode_refresh = 0.25;
  joint_0_.tells_mode = false;
  std::int64_t started_ns = 0;
  world_.each_sleep = [&] {
    if (started_ns == 0 && panel_.state == 0x05) started_ns = world_.now_ns();
  };
  const BringUpResult result = start();
  EXPECT_EQ(result.status, BringUpStatus::kModeNotTold);
  EXPECT_EQ(result.joint, 0);
  EXPECT_EQ(result.index, 0x6061);
  EXPECT_NEAR(static_cast<double>(world_.now_ns() - started_ns), 1.25e9, 3e6);
}

TEST_F(BringUpAnswersTest, TakesAModeAndAStateUntilTheDeadline) {
  layout_.mode_refresh = 0.25;
  joint_0_.first_mode_ns = 1'240 * kMillisecond_ns;
  EXPECT_EQ(start().status, BringUpStatus::kOk);
}

/// The last boot-up, of a node that takes its time, and the first request to any node are 50 ms apart.
TEST_F(BringUpAnswersTest, SettlesForFiftyMillisecondsAfterTheLastBootUp) {
  joint_1_.boot_delay_ns = 200 * kMillisecond_ns;
  std::int64_t booted_ns = -1;
  std::int64_t asked_ns = -1;
  world_.each_sleep = [&] {
    if (booted_ns < 0 && !joint_1_.nmt.empty() && joint_1_.boot_at_ns < 0) booted_ns = world_.now_ns();
    if (asked_ns < 0 && std::ranges::any_of(first_.sent, [](const CanFrame& f) { return f.id > 0x600; })) {
      asked_ns = world_.now_ns();
    }
  };
  EXPECT_EQ(start().status, BringUpStatus::kOk);
  EXPECT_NEAR(static_cast<double>(asked_ns - booted_ns), 50e6, 1.5e6);
}

// ---------------------------------------------------------------- boot and start

/// A boot-up before the reset of communication is that of another start.
TEST_F(BringUpAnswersTest, EachNodeMustBootAfterItsReset) {
  joint_1_.boots = false;
  at(50 * kMillisecond_ns, [&] { second_.receive_next(frame(0x701, {0x00})); });
  const BringUpResult result = start();
  EXPECT_EQ(result.status, BringUpStatus::kNoBootUp);
  EXPECT_EQ(result.joint, 1);
}

/// A supply that bounces: the node boots twice within 50 ms.
TEST_F(BringUpAnswersTest, ANodeMayBootAgainWhileItsSupplySettles) {
  at((100 + 10 + 45) * kMillisecond_ns, [&] { second_.receive_next(frame(0x701, {0x00})); });
  EXPECT_EQ(start().status, BringUpStatus::kOk);
}

TEST_F(BringUpAnswersTest, ANodeThatBootsAgainAfterItsSupplyHasSettledIsRefused) {
  at((100 + 10 + 60) * kMillisecond_ns, [&] { second_.receive_next(frame(0x701, {0x00})); });
  const BringUpResult result = start();
  EXPECT_EQ(result.status, BringUpStatus::kStartedAnew);
  EXPECT_EQ(result.joint, 1);
  EXPECT_EQ(result.bus, 1);
}

/// Each node in turn does not start; drives tell their mode nevertheless.
TEST_F(BringUpAnswersTest, EachNodeMustBecomeOperational) {
  const std::array<ScriptedNode*, 4> nodes = {&joint_0_, &joint_1_, &joint_2_, &panel_};
  for (int i = 0; i < 4; ++i) {
    nodes.at(static_cast<std::size_t>(i))->starts = false;
    world_.each_sleep = [&] {
      if (panel_.nmt.empty() || panel_.nmt.back() != 0x01) return;
      first_.receive_next(frame(0x281, {0x0A}));
      first_.receive_next(frame(0x282, {0x0A}));
      second_.receive_next(frame(0x281, {0x0A}));
    };
    const BringUpResult result = start();
    EXPECT_EQ(result.status, BringUpStatus::kNotOperational);
    EXPECT_EQ(result.joint, i < 3 ? i : -1);
    EXPECT_EQ(result.node, i == 0 || i == 1 ? 1 : i == 2 ? 2 : 32);
    EXPECT_EQ(result.expected, 5u);
    EXPECT_EQ(result.found, 0x7Fu);
    nodes.at(static_cast<std::size_t>(i))->starts = true;
    panel_.nmt.clear();
  }
}

/// A mode counts from NMT start on, in a frame of one byte, of a drive of this bus.
TEST_F(BringUpAnswersTest, EachDriveMustTellItsModeAfterItsStart) {
  const std::array<ScriptedNode*, 3> drives = {&joint_0_, &joint_1_, &joint_2_};
  for (int i = 0; i < 3; ++i) {
    ScriptedNode& drive = *drives.at(static_cast<std::size_t>(i));
    drive.tells_mode = false;
    FakeBus& bus = i == 1 ? second_ : first_;
    FakeBus& other = i == 1 ? first_ : second_;
    const auto id = static_cast<std::uint16_t>(0x280 + (i == 2 ? 2 : 1));
    drive.before_answer = [&bus, id](FakeBus&) { bus.receive_next(frame(id, {0x0A})); };  // too early
    world_.each_sleep = [&] {
      bus.receive_next(frame(id, {0x0A, 0x00}));
      bus.receive_next(frame(id, {}));
      bus.receive_next(frame(0x285, {0x0A}));
      if (i == 2) other.receive_next(frame(id, {0x0A}));
    };
    const BringUpResult result = start();
    EXPECT_EQ(result.status, BringUpStatus::kModeNotTold) << i;
    EXPECT_EQ(result.joint, i);
    drive.tells_mode = true;
  }
}

TEST_F(BringUpAnswersTest, ModesOfOtherNodesDisturbNothing) {
  for (ScriptedNode* node : {&joint_0_, &joint_1_, &joint_2_, &panel_}) {
    node->before_answer = [](FakeBus& bus) {
      bus.receive_next(frame(0x285, {0x0A}));
      bus.receive_next(frame(0x2FF, {0x08}));
    };
  }
  EXPECT_EQ(start().status, BringUpStatus::kOk);
  layout_.panel.bus = -1;
  EXPECT_EQ(start().status, BringUpStatus::kOk);
}

// ---------------------------------------------------------------- answers

/// Bad answers to another object, sub-index or node come before each good one, and behind it.
TEST_F(BringUpAnswersTest, TakesOnlyTheAnswerToItsRequest) {
  for (ScriptedNode* node : {&joint_0_, &joint_1_, &joint_2_, &panel_}) {
    const auto mislead = [](const CanFrame& request, FakeBus& bus) {
      CanFrame bad = request;  // an abort of the request
      bad.data[0] = 0x80;
      bad.id = static_cast<std::uint16_t>(request.id - 0x80);
      for (const std::size_t byte : {1u, 2u, 3u}) {
        CanFrame other = bad;
        other.data[byte] ^= 0x01;
        bus.receive_next(other);
      }
      bad.id = 0x5FE;
      bus.receive_next(bad);
    };
    node->before_answer_to = mislead;
    node->after_answer_to = mislead;
  }
  EXPECT_EQ(start().status, BringUpStatus::kOk);
}

/// An answer whose server does not tell the size: all four bytes, of which the object's own count.
TEST_F(BringUpAnswersTest, TakesAnAnswerWithoutASize) {
  for (ScriptedNode* node : {&joint_0_, &joint_1_, &joint_2_, &panel_}) {
    node->change_answer = [](const CanFrame& request, CanFrame& response) {
      if (request.data[0] != 0x40 || (response.data[0] & 0xE2) != 0x42) return;
      response.data[0] = 0x42;
    };
  }
  EXPECT_EQ(start().status, BringUpStatus::kOk);
}

TEST_F(BringUpAnswersTest, RefusesEveryOtherSize) {
  for (const int size : {1, 2, 3}) {
    joint_1_.change_answer = [size](const CanFrame& request, CanFrame& response) {
      if (object_of(request) == std::pair(0x6076, 0))
        response.data[0] = static_cast<std::uint8_t>(0x43 | (4 - size) << 2);
    };
    const BringUpResult result = start();
    EXPECT_EQ(result.status, BringUpStatus::kWrongSize) << size;
    EXPECT_EQ(result.index, 0x6076);
    EXPECT_EQ(result.expected, 4u);
    EXPECT_EQ(result.found, static_cast<std::uint32_t>(size));
  }
  // a confirmed write is no answer to a read
  joint_1_.change_answer = [](const CanFrame& request, CanFrame& response) {
    if (object_of(request) == std::pair(0x6064, 0)) response.data[0] = 0x60;
  };
  const BringUpResult result = start();
  EXPECT_EQ(result.status, BringUpStatus::kWrongSize);
  EXPECT_EQ(result.expected, 4u);
  EXPECT_EQ(result.found, 0u);
}

/// A value or a segment is no confirmation of a write.
TEST_F(BringUpAnswersTest, AWriteMustBeConfirmed) {
  for (const int command : {0x43, 0x4B, 0x41, 0x20, 0x00}) {
    joint_1_ = scripted_drive(1, 1500);
    joint_1_.change_answer = [command](const CanFrame& request, CanFrame& response) {
      if (object_of(request) == std::pair(0x1017, 0) && request.data[0] != 0x40) {
        response.data[0] = static_cast<std::uint8_t>(command);
      }
    };
    const BringUpResult result = start();
    EXPECT_EQ(result.status, BringUpStatus::kNoAnswer) << command;
    EXPECT_EQ(result.index, 0x1017);
    EXPECT_EQ(result.joint, 1);
  }
}

/// CiA 301 has two abort codes for an object that a node lacks. After any other one the object is there.
TEST_F(BringUpAnswersTest, TellsAnAbsentObjectFromARefusedOne) {
  joint_1_.absent = 0x06090011;  // no such sub-index
  EXPECT_EQ(start().status, BringUpStatus::kOk);
  for (const std::uint32_t code : {0x06010001u, 0x06020001u, 0x06090010u, 0x06090012u, 0x08000000u, 0u}) {
    joint_1_.absent = code;
    const BringUpResult result = start();
    EXPECT_EQ(result.status, BringUpStatus::kRefused) << std::hex << code;
    EXPECT_EQ(result.found, code);
    EXPECT_EQ(result.joint, 1);
  }
}

TEST_F(BringUpAnswersTest, RefusedPartsOfARatioAreNamed) {
  joint_1_.objects[{0x6091, 1}] = {4, 1};
  BringUpResult result = start();  // without its second sub-index
  EXPECT_EQ(result.status, BringUpStatus::kRefused);
  EXPECT_EQ(result.index, 0x6091);
  EXPECT_EQ(result.subindex, 2);
  joint_1_.objects[{0x6091, 2}] = {4, 1};
  for (const int subindex : {1, 2}) {
    joint_1_.change_answer = [subindex](const CanFrame& request, CanFrame& response) {
      if (object_of(request) == std::pair(0x6091, subindex)) response.data[0] = 0x80;  // with a code of its own
    };
    result = start();
    EXPECT_EQ(result.status, BringUpStatus::kRefused) << subindex;
    EXPECT_EQ(result.index, 0x6091);
    EXPECT_EQ(result.subindex, subindex);
    EXPECT_NE(joint_1_.state, 0x05);
  }
}

/// Ratios are good to a thousandth: 65536 counts within 65.5, a gear of 12.5 within 0.0125, on both sides.
TEST_F(BringUpAnswersTest, RatiosMayDifferByAThousandth) {
  layout_.drives[1].counts = 65536;
  layout_.drives[1].gear = -12.5;  // the sign is in 607E, or in the layout's own sign
  struct Row {
    int index;
    std::uint32_t over;
    std::uint32_t under;
    bool good;
  };
  for (const Row& row :
       {Row{0x608F, 65536 + 65, 1, true}, Row{0x608F, 65536 + 66, 1, false}, Row{0x608F, 65536 - 65, 1, true},
        Row{0x608F, 65536 - 66, 1, false}, Row{0x6091, 12512, 1000, true}, Row{0x6091, 12513, 1000, false},
        Row{0x6091, 12488, 1000, true}, Row{0x6091, 12487, 1000, false}, Row{0x6091, 1001, 1000, true},
        Row{0x6091, 10011, 10000, false}, Row{0x6091, 9991, 10000, true}, Row{0x6091, 9989, 10000, false}}) {
    joint_1_ = scripted_drive(1, 1500);
    joint_1_.objects[{row.index, 1}] = {4, row.over};
    joint_1_.objects[{row.index, 2}] = {4, row.under};
    EXPECT_EQ(start().status, row.good ? BringUpStatus::kOk : BringUpStatus::kWrongRatio) << row.over;
    EXPECT_EQ(joint_1_.state == 0x05, row.good) << row.over;
  }
}

/// An object that a node lacks is asked for once; one that it has is written and read back.
TEST_F(BringUpAnswersTest, AsksOnceForAnObjectThatANodeLacks) {
  ASSERT_EQ(start().status, BringUpStatus::kOk);
  const std::map<std::pair<int, int>, int> lacking = requests(0x602);
  for (const auto& object : {std::pair(0x1006, 0), std::pair(0x1401, 1), std::pair(0x1803, 1), std::pair(0x1801, 3),
                             std::pair(0x60C2, 1), std::pair(0x60C2, 2)}) {
    EXPECT_EQ(lacking.at(object), 1) << std::hex << object.first;
    joint_2_.objects[object] = {object.first == 0x60C2 ? 1 : object.second == 3 ? 2 : 4, 0};
  }
  EXPECT_EQ(lacking.at({0x1017, 0}), 2);
  EXPECT_EQ(requests(0x620).at({0x1016, 1}), 1);
  world_.log.clear();
  ASSERT_EQ(start().status, BringUpStatus::kOk);
  const std::map<std::pair<int, int>, int> having = requests(0x602);
  for (const auto& object : {std::pair(0x1006, 0), std::pair(0x1401, 1), std::pair(0x1803, 1), std::pair(0x1801, 3),
                             std::pair(0x60C2, 1), std::pair(0x60C2, 2)}) {
    EXPECT_EQ(having.at(object), 2) << std::hex << object.first;
  }
}

// ---------------------------------------------------------------- buses

TEST_F(BringUpAnswersTest, ADeadInterfaceEndsTheStartAtOnce) {
  second_.state.down = true;
  EXPECT_EQ(start().status, BringUpStatus::kBusDown);
  EXPECT_EQ(world_.now_ns(), 0);
  EXPECT_TRUE(world_.log.empty() && first_.sent.empty());
  second_.state.down = false;
  second_.result = SendResult::kDown;
  const BringUpResult result = start();
  EXPECT_EQ(result.status, BringUpStatus::kBusDown);
  EXPECT_EQ(result.bus, 1);
  EXPECT_EQ(world_.now_ns(), 100 * kMillisecond_ns);
  EXPECT_TRUE(sent_no_request());
}

TEST_F(BringUpAnswersTest, AFullQueueEndsTheStartAfterASecond) {
  second_.result = SendResult::kFull;
  const BringUpResult result = start();
  EXPECT_EQ(result.status, BringUpStatus::kCannotSend);
  EXPECT_EQ(result.bus, 1);
  EXPECT_EQ(world_.now_ns(), 1100 * kMillisecond_ns);
  EXPECT_TRUE(sent_no_request());
}

/// The first cause is told, and it ends the wait for room in a queue.
TEST_F(BringUpAnswersTest, ASecondMasterIsToldWhileAQueueIsFull) {
  second_.result = SendResult::kFull;
  at(300 * kMillisecond_ns, [&] { first_.receive_next(frame(0x201, {0, 0, 0, 0})); });
  const BringUpResult result = start();
  EXPECT_EQ(result.status, BringUpStatus::kSecondMaster);
  EXPECT_EQ(result.bus, 0);
  EXPECT_EQ(result.found, 0x201u);
  EXPECT_EQ(world_.now_ns(), 300 * kMillisecond_ns);
  EXPECT_TRUE(sent_no_request());
}

TEST_F(BringUpAnswersTest, ASecondMasterEndsTheWaitForABootUp) {
  joint_1_.boot_delay_ns = kSecond_ns;
  at(300 * kMillisecond_ns, [&] { first_.receive_next(frame(0x080, {})); });
  EXPECT_EQ(start().status, BringUpStatus::kSecondMaster);
  EXPECT_EQ(world_.now_ns(), 300 * kMillisecond_ns);
  EXPECT_TRUE(sent_no_request());
}

TEST_F(BringUpAnswersTest, AQueueThatFillsUpDuringTheSetupIsTold) {
  int answers = 0;
  joint_1_.before_answer = [&](FakeBus& bus) {
    if (++answers == 7) bus.result = SendResult::kFull;
  };
  const BringUpResult result = start();
  EXPECT_EQ(result.status, BringUpStatus::kCannotSend);
  EXPECT_EQ(result.bus, 1);
  EXPECT_EQ(answers, 7);
  EXPECT_LT(world_.now_ns(), 3 * kSecond_ns / 2);
}

TEST_F(BringUpAnswersTest, AQueueThatTakesNoStartCommandIsTold) {
  panel_.before_answer_to = [&](const CanFrame& request, FakeBus&) {
    if (request.data[0] == 0x40 && object_of(request) == std::pair(0x1017, 0)) first_.result = SendResult::kFull;
  };
  const BringUpResult result = start();
  EXPECT_EQ(result.status, BringUpStatus::kCannotSend);
  EXPECT_EQ(result.bus, 0);
  EXPECT_EQ(joint_0_.state, 0x7F);
}

/// A millisecond has room for some twenty frames. More than three times as many wait for the next one.
TEST_F(BringUpAnswersTest, TakesSixtyFourFramesOfABusAMillisecond) {
  for (int k = 0; k < 300; ++k) first_.receive_next(frame(0x7FF, {1}));
  std::vector<std::size_t> waiting;
  layout_.joint_count = 0;
  layout_.panel.bus = -1;
  ScriptedWorld silent({});
  silent.each_sleep = [&] { waiting.push_back(first_.waiting.size()); };
  EXPECT_EQ(bring_up(layout_, wires_, silent, nullptr).status, BringUpStatus::kOk);
  ASSERT_GT(waiting.size(), 5u);
  EXPECT_EQ(waiting[0], 300u - 64u);
  EXPECT_EQ(waiting[1], 300u - 2 * 64u);
  EXPECT_EQ(waiting[3], 300u - 4 * 64u);
  EXPECT_EQ(waiting[4], 0u);
}

class RecordingTap final : public FrameTap {
 public:
  void on_frame(int bus, const ReceivedFrame& received) noexcept override {
    (received.own ? own : others).push_back({bus, received.frame.id});
  }
  std::vector<std::pair<int, int>> own;
  std::vector<std::pair<int, int>> others;
};

TEST_F(BringUpAnswersTest, ShowsEveryFrameToTheTap) {
  RecordingTap tap;
  first_.receive_next(frame(0x7FF, {1}));
  ASSERT_EQ(bring_up(layout_, wires_, world_, &tap).status, BringUpStatus::kOk);
  EXPECT_EQ(tap.own.size(), world_.log.size());
  EXPECT_EQ(tap.own.at(0), std::pair(0, 0x000));
  EXPECT_EQ(tap.own.at(1), std::pair(1, 0x000));
  EXPECT_EQ(tap.others.at(0), std::pair(0, 0x7FF));
  for (const auto& seen : {std::pair(0, 0x701), std::pair(0, 0x582), std::pair(1, 0x5A0), std::pair(1, 0x281)}) {
    EXPECT_GT(std::ranges::count(tap.others, seen), 0) << seen.first << ' ' << std::hex << seen.second;
  }
}

}  // namespace
}  // namespace godobject::hal
