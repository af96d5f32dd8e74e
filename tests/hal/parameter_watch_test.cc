#include "hal/cia402/parameter_watch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace godobject::hal::cia402 {
namespace {

using canopen::SdoResponse;
using Kind = SdoResponse::Kind;

struct Watched {
  int index;
  int subindex;
  int size;
  std::uint32_t value;
};

/// As the start leaves them: deadline and type of RPDO1, the watched heartbeat, both reactions, the mode.
const std::vector<Watched> kWatched = {{0x1400, 5, 2, 4}, {0x1400, 2, 1, 255}, {0x1016, 1, 4, 0x007F0032},
                                       {0x6007, 0, 2, 3}, {0x605A, 0, 2, 2},   {0x6061, 0, 1, 10}};

/// Bus 0 has joint 1 as node 9; bus 1 has joints 0 and 2 as nodes 5 and 3; bus 2 has only the panel.
BusLayout layout() {
  BusLayout layout;
  layout.bus_count = 3;
  layout.joint_count = 3;
  layout.drives[0] = {.bus = 1, .node = 5};
  layout.drives[1] = {.bus = 0, .node = 9};
  layout.drives[2] = {.bus = 1, .node = 3};
  layout.panel = {.bus = 2, .node = 32};
  return layout;
}

/// An SDO request to read, byte by byte.
struct Request {
  int node;
  int index;
  int subindex;
};

class ParameterWatchTest : public testing::Test {
 protected:
  Request ask() {
    CanFrame frame;
    EXPECT_TRUE(watch_.next(frame));
    EXPECT_EQ(frame.length, 8);
    EXPECT_EQ(frame.data[0], 0x40);
    EXPECT_GT(frame.id, 0x600);
    return {frame.id - 0x600, frame.data[1] | frame.data[2] << 8, frame.data[3]};
  }

  /// The answer of a drive that is as the start left it.
  static SdoResponse good(const Request& request) {
    const auto at = std::ranges::find_if(
        kWatched, [&](const Watched& w) { return w.index == request.index && w.subindex == request.subindex; });
    EXPECT_NE(at, kWatched.end()) << std::hex << request.index;
    return {.node = request.node,
            .kind = Kind::kRead,
            .index = static_cast<std::uint16_t>(request.index),
            .subindex = static_cast<std::uint8_t>(request.subindex),
            .size = at->size,
            .value = at->value};
  }

  /// The next request for an object of a node; those before it are answered.
  Request ask_for(int node, int index) {
    for (;;) {
      const Request request = ask();
      if (request.node == node && request.index == index) return request;
      watch_.take(good(request));
    }
  }

  Alarm alarm() const { return watch_.finding().alarm; }

  ParameterWatch watch_{layout(), 1};
};

TEST_F(ParameterWatchTest, AsksEveryDriveOfItsBusForEveryParameterInOneRound) {
  std::vector<int> nodes;
  for (int round = 0; round < 3; ++round) {
    std::set<std::tuple<int, int, int>> asked;
    for (int k = 0; k < 12; ++k) {
      const Request request = ask();
      asked.insert({request.node, request.index, request.subindex});
      nodes.push_back(request.node);
      watch_.take(good(request));
    }
    EXPECT_EQ(asked.size(), 12u);
    for (const Watched& watched : kWatched) {
      for (const int node : {5, 3}) EXPECT_TRUE(asked.contains({node, watched.index, watched.subindex}));
    }
  }
  EXPECT_EQ(alarm(), Alarm::kNone);
  for (std::size_t i = 1; i < nodes.size(); ++i) EXPECT_NE(nodes[i], nodes[i - 1]) << "in turn";
}

TEST_F(ParameterWatchTest, AsksThreeDrivesInTheOrderOfTheirJoints) {
  BusLayout one = layout();
  one.drives[1].bus = 1;
  watch_ = ParameterWatch(one, 1);
  std::vector<int> nodes;
  for (int k = 0; k < 9; ++k) nodes.push_back(ask().node);
  const auto first = std::ranges::find(nodes, 5);
  ASSERT_LE(nodes.end() - first, 9);
  constexpr std::array<int, 3> kOrder = {5, 9, 3};
  for (auto at = first; at != nodes.end(); ++at) {
    EXPECT_EQ(*at, kOrder.at(static_cast<std::size_t>(at - first) % 3));
  }
}

/// Of three drives two tell their temperature: one request more for each of these in a round, in turn with the others.
TEST_F(ParameterWatchTest, AsksForEachTemperatureOnceARound) {
  BusLayout one = layout();
  one.drives[1].bus = 1;
  one.drives[0].temperature = {.index = 0x2310, .subindex = 3, .warn = 70.0, .stop = 85.0};
  one.drives[1].temperature = {.index = 0x2345, .warn = 60.0, .stop = 65.0};
  watch_ = ParameterWatch(one, 1);
  EXPECT_EQ(watch_.interval(1000), 950 / (7 * 3));
  for (int round = 0; round < 3; ++round) {
    std::map<std::tuple<int, int, int>, int> asked;
    for (int k = 0; k < 6 * 3 + 2; ++k) {
      const Request request = ask();
      ++asked[{request.node, request.index, request.subindex}];
      if (request.index >= 0x2000 && request.index < 0x6000) {
        watch_.take({.node = request.node,
                     .kind = Kind::kRead,
                     .index = static_cast<std::uint16_t>(request.index),
                     .subindex = static_cast<std::uint8_t>(request.subindex),
                     .size = 2,
                     .value = request.node == 5 ? 84u : 61u});
      } else {
        watch_.take(good(request));
      }
    }
    EXPECT_EQ(asked.size(), 20u);
    EXPECT_EQ((asked[{5, 0x2310, 3}]), 1);
    EXPECT_EQ((asked[{9, 0x2345, 0}]), 1);
    for (const auto& [what, times] : asked) EXPECT_EQ(times, 1);
  }
  EXPECT_EQ(watch_.temperature(0).celsius(), 84.0);
  EXPECT_EQ(watch_.temperature(1).celsius(), 61.0);
  EXPECT_TRUE(std::isnan(watch_.temperature(2).celsius()));
  EXPECT_EQ(alarm(), Alarm::kNone);
}

/// A drive that answers for its parameters, but not for its temperature, is lost at the third request. Answers of other
/// nodes and for other objects do not count.
TEST_F(ParameterWatchTest, LosesATemperatureThatIsNotAnsweredAndNothingElse) {
  BusLayout one = layout();
  for (DriveConfig& drive : one.drives) drive.temperature = {.index = 0x2310, .warn = 70.0, .stop = 85.0};
  for (const bool aborts : {false, true}) {
    watch_ = ParameterWatch(one, 1);
    int asked = 0;
    for (int k = 0; k < 200 && watch_.temperature(0).alarm() == Alarm::kNone; ++k) {
      const Request request = ask();
      if (request.index != 0x2310) {
        watch_.take(good(request));
        continue;
      }
      SdoResponse response{.node = request.node, .kind = Kind::kRead, .index = 0x2310, .size = 2, .value = 30};
      if (request.node == 3) {
        watch_.take(response);
        continue;
      }
      ++asked;
      response.node = 3;
      watch_.take(response);
      response.node = 5;
      response.subindex = 1;
      watch_.take(response);
      response.subindex = 0;
      response.kind = Kind::kAborted;
      if (aborts) watch_.take(response);
    }
    EXPECT_EQ(asked, 3) << aborts;
    EXPECT_EQ(watch_.temperature(0).alarm(), Alarm::kTemperatureLost);
    EXPECT_EQ(watch_.temperature(2).alarm(), Alarm::kNone);
    EXPECT_EQ(watch_.temperature(2).celsius(), 30.0);
    EXPECT_EQ(alarm(), Alarm::kNone) << "its parameters are answered";
  }
}

/// A drive without any answer is silent also where the fifth request is for its temperature.
TEST_F(ParameterWatchTest, FindsASilentDriveWhicheverRequestIsTheFifth) {
  BusLayout one = layout();
  for (DriveConfig& drive : one.drives) drive.temperature = {.index = 0x2310, .warn = 70.0, .stop = 85.0};
  for (int first = 0; first < 14; ++first) {
    watch_ = ParameterWatch(one, 1);
    for (int k = 0; k < first; ++k) {
      const Request request = ask();
      if (request.index != 0x2310) watch_.take(good(request));
    }
    int unanswered = 0;
    while (alarm() == Alarm::kNone && unanswered < 40) {
      ask();
      ++unanswered;
    }
    EXPECT_EQ(alarm(), Alarm::kParameterChanged);
    EXPECT_LE(unanswered, 11) << first << ": five of each of two drives, and one that sees it";
  }
}

TEST_F(ParameterWatchTest, HasNothingToAskOnABusWithoutADrive) {
  for (ParameterWatch none : {ParameterWatch(layout(), 2), ParameterWatch()}) {
    CanFrame frame;
    for (int k = 0; k < 10; ++k) EXPECT_FALSE(none.next(frame));
    EXPECT_EQ(frame.id, 0);
    EXPECT_EQ(none.finding().alarm, Alarm::kNone);
    EXPECT_EQ(none.interval(50), 50);
    EXPECT_EQ(none.interval(2000), 950);
  }
}

TEST_F(ParameterWatchTest, AsksADriveThatIsAloneForOneParameterAfterTheOther) {
  ParameterWatch single(layout(), 0);
  std::map<std::pair<int, int>, int> asked;
  for (int k = 0; k < 12; ++k) {
    CanFrame frame;
    ASSERT_TRUE(single.next(frame));
    EXPECT_EQ(frame.id, 0x609);
    ++asked[{frame.data[1] | frame.data[2] << 8, frame.data[3]}];
  }
  EXPECT_EQ(asked.size(), 6u);
  for (const auto& [object, count] : asked) EXPECT_EQ(count, 2);
}

/// Each of 6 parameters of n drives within 950 cycles: at most 950 / 6 n apart.
TEST_F(ParameterWatchTest, ReadsEveryParameterWithinASecond) {
  for (int joints = 1; joints <= kMaxJoints; ++joints) {
    BusLayout one;
    one.joint_count = joints;
    for (int i = 0; i < joints; ++i) one.drives[static_cast<std::size_t>(i)].node = i + 1;
    const ParameterWatch watch(one, 0);
    constexpr std::array<int, 8> kMost = {0, 158, 79, 52, 39, 31, 26, 22};
    const int most = kMost.at(static_cast<std::size_t>(joints));
    EXPECT_EQ(watch.interval(1000), most) << joints;
    EXPECT_EQ(watch.interval(most), most);
    EXPECT_EQ(watch.interval(most - 1), most - 1);
    EXPECT_EQ(watch.interval(1), 1);
  }
}

/// Within a second of any period: 950 ms, in cycles, over 6 parameters of two drives; never less than a cycle.
TEST_F(ParameterWatchTest, ReadsEveryParameterWithinASecondAtEveryPeriod) {
  BusLayout two;
  two.joint_count = 2;
  two.drives[0].node = 1, two.drives[1].node = 2;
  for (const auto& [period, most] : {std::pair{0.125e-3, 633}, {0.25e-3, 316}, {1e-3, 79}, {10e-3, 7}}) {
    two.period = period;
    const ParameterWatch watch(two, 0);
    EXPECT_EQ(watch.interval(5000), most) << period;
    EXPECT_EQ(watch.interval(3), 3);
  }
  two.joint_count = kMaxJoints;
  for (int i = 0; i < kMaxJoints; ++i) two.drives[static_cast<std::size_t>(i)].node = i + 1;
  two.period = 50e-3;
  EXPECT_EQ(ParameterWatch(two, 0).interval(10), 1);
}

TEST_F(ParameterWatchTest, FindsAnyOtherValue) {
  for (const Watched& watched : kWatched) {
    for (int bit = 0; bit < 8 * watched.size; ++bit) {
      watch_ = ParameterWatch(layout(), 1);
      SdoResponse response = good(ask_for(3, watched.index));
      if (response.subindex != watched.subindex) {
        watch_.take(response);
        response = good(ask_for(3, watched.index));
      }
      response.value ^= 1u << bit;
      watch_.take(response);
      EXPECT_EQ(alarm(), watched.index == 0x6061 ? Alarm::kWrongMode : Alarm::kParameterChanged);
      const AlarmDetail& detail = watch_.finding();
      EXPECT_EQ(detail.bus, 1);
      EXPECT_EQ(detail.joint, 2);
      EXPECT_EQ(detail.id, 0) << "no frame raised it";
      EXPECT_EQ(detail.index, watched.index);
      EXPECT_EQ(detail.subindex, watched.subindex);
      EXPECT_EQ(detail.expected, watched.value);
      EXPECT_EQ(detail.found, watched.value ^ 1u << bit);
    }
  }
}

TEST_F(ParameterWatchTest, TakesAnAnswerWithoutASizeButNoneOfAnotherSizeOrKind) {
  SdoResponse response = good(ask_for(5, 0x6007));
  response.size = 0;  // not told by the drive
  watch_.take(response);
  EXPECT_EQ(alarm(), Alarm::kNone);
  for (const int size : {1, 3, 4}) {
    watch_ = ParameterWatch(layout(), 1);
    response = good(ask_for(5, 0x6007));
    response.size = size;
    watch_.take(response);
    EXPECT_EQ(alarm(), Alarm::kParameterChanged) << size;
  }
  for (const Kind kind : {Kind::kWritten, Kind::kAborted, Kind::kLong}) {
    for (const bool told : {false, true}) {
      watch_ = ParameterWatch(layout(), 1);
      response = good(ask_for(5, 0x6007));
      response.kind = kind;
      if (!told) response.size = 0;
      watch_.take(response);
      EXPECT_EQ(alarm(), Alarm::kParameterChanged) << "the value would be good";
    }
  }
}

/// Answers to another node, index or subindex, and those that nobody has asked for, neither alarm nor count.
TEST_F(ParameterWatchTest, PassesOverAnswersToOtherRequests) {
  const Request request = ask_for(3, 0x6007);
  const auto other = [&](int node, int index, int subindex) {
    SdoResponse response = good(request);
    response.node = node;
    response.index = static_cast<std::uint16_t>(index);
    response.subindex = static_cast<std::uint8_t>(subindex);
    response.value ^= 1;
    watch_.take(response);
    EXPECT_EQ(alarm(), Alarm::kNone) << node << ' ' << index << ' ' << subindex;
  };
  other(5, 0x6007, 0);
  other(3, 0x6008, 0);
  other(3, 0x605A, 0);
  other(3, 0x6007, 1);
  other(5, 0x605A, 1);
  watch_.take(good(request));
  SdoResponse twice = good(request);
  twice.value ^= 1;
  watch_.take(twice);
  EXPECT_EQ(alarm(), Alarm::kNone) << "it has been answered";
  ParameterWatch fresh(layout(), 1);
  fresh.take({.node = 5, .kind = Kind::kRead, .index = 0x1400, .subindex = 5, .size = 2, .value = 99});
  EXPECT_EQ(fresh.finding().alarm, Alarm::kNone) << "nothing was asked yet";
}

/// The alarm comes with the request after the fifth silent one of the same drive.
TEST_F(ParameterWatchTest, FiveSilentExchangesInARowOfOneDriveAreAnAlarm) {
  for (int cycle = 0; cycle < 3; ++cycle) {
    for (int silent = 0; silent < 4;) {
      const Request request = ask();
      EXPECT_EQ(alarm(), Alarm::kNone);
      if (request.node == 5) {
        watch_.take(good(request));
      } else {
        ++silent;
      }
    }
    for (Request request = ask();; request = ask()) {
      watch_.take(good(request));
      if (request.node == 3) break;  // an answer: from the beginning
    }
  }
  EXPECT_EQ(alarm(), Alarm::kNone);
  Request last{};
  for (int silent = 0; silent < 5;) {
    last = ask();
    EXPECT_EQ(alarm(), Alarm::kNone);
    if (last.node == 5) watch_.take(good(last));
    silent += last.node == 3 ? 1 : 0;
  }
  ask();
  EXPECT_EQ(alarm(), Alarm::kParameterChanged);
  EXPECT_EQ(watch_.finding().joint, 2);
  EXPECT_EQ(watch_.finding().index, last.index);
  EXPECT_EQ(watch_.finding().subindex, last.subindex);
  EXPECT_EQ(watch_.finding().found, 0u);
}

TEST_F(ParameterWatchTest, KeepsItsFirstFinding) {
  SdoResponse first = good(ask_for(3, 0x6007));
  first.value = 0;
  watch_.take(first);
  SdoResponse second = good(ask_for(5, 0x605A));
  second.value = 6;
  watch_.take(second);
  EXPECT_EQ(watch_.finding().index, 0x6007);
  EXPECT_EQ(watch_.finding().joint, 2);
}

}  // namespace
}  // namespace godobject::hal::cia402
