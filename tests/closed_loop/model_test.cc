// An arm that is not as its model: what stops it, when, and how far the tool has moved by then. Nobody holds it, or the
// hand lets it go while it runs.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <string>

#include "tests/closed_loop/seen_fault.h"
#include "tests/closed_loop/simulated_run.h"
#include "tests/support/small_scenes.h"

namespace godobject::firmware {
namespace {

const test::SceneImage& scene() {
  static const test::SceneImage image = test::ball_over_plate();
  return image;
}

using Load = std::function<Wrench(std::int64_t, const sim::BodyState&)>;

const Load kNobody = [](std::int64_t, const sim::BodyState&) { return Wrench{}; };

/// A hand that holds the tool as it was at the start, until a cycle: springs and dampers.
Load hand_until(std::int64_t end) {
  return [end, start = std::optional<Pose>()](std::int64_t cycle, const sim::BodyState& tool) mutable {
    if (!start) start = tool.pose;
    if (cycle >= end) return Wrench{};
    const Vector3 turned = log_rotation(start->rotation * tool.pose.rotation.conjugate());
    return Wrench{500.0 * (start->translation - tool.pose.translation) - 10.0 * tool.velocity.translation,
                  2.0 * turned - 0.05 * tool.velocity.rotation};
  };
}

struct Stop {
  Fault fault = Fault::kNone;
  std::int64_t cycle = -1;   ///< of the fault
  double until_stop = 0.0;   ///< way of the tool from its place at `from` to the fault [m]
  double in_all = 0.0;       ///< the same to the farthest place at all
  double most_before = 0.0;  ///< way of the tool up to `from` [m]
};

Stop stop_of(const SimulatedRun& run, std::int64_t from) {
  Stop stop;
  Vector3 begin = run.cycles.front().tool_R;
  const Vector3 first = begin;
  for (const SimulatedCycle& cycle : run.cycles) {
    if (cycle.number <= from) {
      begin = cycle.tool_R;
      stop.most_before = std::max(stop.most_before, (begin - first).norm());
    }
    const double way = (cycle.tool_R - begin).norm();
    if (stop.cycle < 0 && cycle.record.fault != Fault::kNone) {
      stop.fault = cycle.record.fault;
      stop.cycle = cycle.number;
      stop.until_stop = way;
    }
    if (cycle.number > from) stop.in_all = std::max(stop.in_all, way);
  }
  return stop;
}

void print(const std::string& name, const Stop& stop, std::int64_t from) {
  std::printf("[ measured ] %s: %s, %lld ms, %.1f mm to the fault, %.1f mm in all\n", name.c_str(),
              stop.fault == Fault::kNone ? "no fault" : describe(stop.fault),
              static_cast<long long>(stop.cycle < 0 ? -1 : stop.cycle - from), 1e3 * stop.until_stop,
              1e3 * stop.in_all);
}

struct WrongModel {
  const char* name;
  double more_payload;
  double more_mass;
};

void PrintTo(const WrongModel& wrong, std::ostream* out) { *out << wrong.name; }

class WrongModelTest : public testing::TestWithParam<WrongModel> {
 protected:
  SimulatedRun::Options options() const {
    SimulatedRun::Options options;
    options.more_payload = GetParam().more_payload;
    options.more_mass = GetParam().more_mass;
    options.engage_cycles = 500;                                             // as in the controller
    options.turn = exp_rotation(0.5 * std::numbers::pi * Vector3::UnitX());  // the plate stands beside the arm
    return options;
  }
};

class NobodyHolds : public WrongModelTest {};
class HandReleases : public WrongModelTest {};

constexpr double kEngagingMost = 0.045;  ///< way of the tool in all, stop included [m]
constexpr double kRunningMost = 0.2;

TEST_P(NobodyHolds, AnArmOfOtherMassesStopsWhileItEngages) {
  SimulatedRun::Options wrong = options();
  wrong.load = kNobody;
  SimulatedRun run(scene(), wrong);
  run.run(4000);
  const Stop stop = stop_of(run, 0);
  print(GetParam().name, stop, 0);
  test::record(seen_since(run.cycles, 0));
  EXPECT_EQ(stop.fault, Fault::kNotBalanced);
  EXPECT_LT(stop.in_all, kEngagingMost);
}

/// The tool begins inside a thick plate: the controller waits until somebody leads it out, but nobody does.
TEST_P(NobodyHolds, AnArmOfOtherMassesThatBeginsInsideStops) {
  static const test::SceneImage thick = test::ball_over_plate(0.06);
  SimulatedRun::Options wrong = options();
  wrong.load = kNobody;
  SimulatedRun run(thick, wrong);
  run.run(8000);
  const Stop stop = stop_of(run, 0);
  print(std::string("begins inside, ") + GetParam().name, stop, 0);
  test::record(seen_since(run.cycles, 0));
  EXPECT_EQ(run.cycles[400].record.outcome, Outcome::kStartInside);
  EXPECT_EQ(stop.fault, Fault::kDrifts);
  EXPECT_LT(stop.in_all, kRunningMost);
}

TEST_P(HandReleases, AnArmOfAnotherLoadStopsWhileItRuns) {
  constexpr std::int64_t kRelease = 1500;
  SimulatedRun::Options wrong = options();
  wrong.load = hand_until(kRelease);
  SimulatedRun run(scene(), wrong);
  run.run(8000);
  const Stop stop = stop_of(run, kRelease);
  print(GetParam().name, stop, kRelease);
  test::record(seen_since(run.cycles, kRelease));
  EXPECT_GT(stop.cycle, kRelease) << "the hand's hold hides it";
  EXPECT_EQ(stop.fault, Fault::kDrifts);
  EXPECT_LT(stop.in_all, kRunningMost);
}

constexpr WrongModel kHeavier{"payload 0.2 kg heavier", 0.2, 0.0};
constexpr WrongModel kALittleHeavier{"payload 0.12 kg heavier", 0.12, 0.0};
constexpr WrongModel kLighter{"payload 0.2 kg lighter", -0.2, 0.0};

std::string name_of(const testing::TestParamInfo<WrongModel>& wrong) {
  std::string name = wrong.param.name;
  std::erase_if(name, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; });
  return name;
}

INSTANTIATE_TEST_SUITE_P(Masses, NobodyHolds,
                         testing::Values(kHeavier, kALittleHeavier, kLighter,
                                         WrongModel{"links 10 % lighter", 0.0, -0.1},
                                         WrongModel{"links 10 % heavier", 0.0, 0.1}),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Masses, HandReleases, testing::Values(kHeavier, kALittleHeavier, kLighter), name_of);

TEST(RightModel, StaysWhereItIsWhenNobodyHoldsIt) {
  SimulatedRun::Options options;
  options.load = kNobody;
  SimulatedRun run(scene(), options);
  run.run(5000);
  const Stop stop = stop_of(run, 0);
  EXPECT_EQ(stop.fault, Fault::kNone);
  EXPECT_LT(stop.in_all, 1e-3);
}

/// Runs a hand that leads the ball along `way` from its start; `share` is of the way, by seconds since the hand begins.
Stop stop_of_hand(const Vector3& way, double begin, std::uint32_t engage_cycles,
                  const std::function<double(double)>& share, double tremor = 0.0) {
  SimulatedRun::Options options;
  options.begin = begin;
  options.engage_cycles = engage_cycles;
  for (int ms = 0; ms < 6000; ++ms) {
    const double t = 1e-3 * ms;
    const double shake = tremor * std::sin(2.0 * std::numbers::pi * 9.0 * t) * std::min(1.0, t);
    options.path.push_back(Vector3(0.0, 0.0, 0.06) + share(t) * way + shake * Vector3(0.5, -0.3, 1.0));
  }
  SimulatedRun run(scene(), options);
  run.run(static_cast<std::int64_t>(1e3 * begin) + 6000);
  return stop_of(run, 0);
}

const Vector3 kWays[] = {{0.0, 0.0, 0.15}, {0.12, 0.0, 0.0}, {0.0, 0.1, 0.1}, {0.05, 0.0, 0.15}};

/// Hands that move as evenly as they can, up and down and sideways, with and without tremor, must not look like masses.
TEST(RightModel, LetsAHandMoveItEvenly) {
  for (const Vector3& way : kWays) {
    for (const double speed : {0.05, 0.2}) {
      for (const double tremor : {0.0, 0.5e-3}) {
        const auto to_and_fro = [&](double t) {
          return 1.0 - std::abs(std::fmod(std::max(0.0, t - 0.6) * speed / way.norm(), 2.0) - 1.0);
        };
        const Stop stop = stop_of_hand(way, 0.6, 50, to_and_fro, tremor);
        EXPECT_EQ(stop.fault, Fault::kNone)
            << way.transpose() << " m at " << speed << " m/s, tremor of " << tremor << " m: " << describe(stop.fault);
      }
    }
  }
}

TEST(RightModel, LetsAHandSwingIt) {
  int unhindered = 0;
  for (const Vector3& way : kWays) {
    for (const double stretch : {1.0, 1.6, 2.4}) {
      for (const double speed : {0.2, 0.4, 0.6, 0.75}) {
        const Vector3 swing = stretch * way;
        const auto sine = [&](double t) {
          return 0.5 - 0.5 * std::cos(2.0 * speed / swing.norm() * std::max(0.0, t - 0.6));
        };
        const Stop stop = stop_of_hand(swing, 0.6, 50, sine);
        unhindered += stop.fault == Fault::kNone ? 1 : 0;
        EXPECT_NE(stop.fault, Fault::kDrifts) << swing.transpose() << " m at " << speed << " m/s";
        EXPECT_NE(stop.fault, Fault::kNotBalanced) << swing.transpose() << " m at " << speed << " m/s";
      }
    }
  }
  EXPECT_GE(unhindered, 24) << "of 48; others are too fast, or reach a limit of the arm";
}

/// A force that stays the same on a long way, but is not that of a weight: it pushes sideways.
TEST(RightModel, LetsAnEvenForcePushItSideways) {
  for (const Vector3& force : {Vector3(3.0, 0.0, 0.0), Vector3(0.0, 3.0, 0.0), Vector3(-2.0, 2.0, 0.0)}) {
    SimulatedRun::Options options;
    options.load = [&force](std::int64_t cycle, const sim::BodyState&) {
      return cycle > 800 ? Wrench{force, Vector3::Zero()} : Wrench{};
    };
    SimulatedRun run(scene(), options);
    run.run(1900);
    const Stop stop = stop_of(run, 800);
    EXPECT_EQ(stop.fault, Fault::kNone) << force.transpose() << " N: " << describe(stop.fault);
    EXPECT_GT(stop.in_all, 0.2);
  }
}

/// A hand that leads the tool out of a contact still moves while the arm engages.
TEST(RightModel, LetsAHandMoveItWhileItEngages) {
  for (const Vector3& way : kWays) {
    for (const double seconds : {0.5, 1.0, 2.0}) {
      const auto smooth = [&](double t) {
        const double s = std::clamp(t / seconds, 0.0, 1.0);
        return 0.5 * s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);
      };
      EXPECT_EQ(stop_of_hand(way, 0.2, 500, smooth).fault, Fault::kNone) << way.transpose() << " m in " << seconds;
    }
  }
}

/// Periods without a cycle, as many as the rule for overruns allows, do not hide a drift.
TEST(DriftTest, IsFoundInSpiteOfSkippedPeriods) {
  constexpr std::int64_t kRelease = 1500;
  SimulatedRun::Options options;
  options.turn = exp_rotation(0.5 * std::numbers::pi * Vector3::UnitX());  // the plate stands beside the arm
  options.more_payload = 0.12;
  options.load = hand_until(kRelease);
  for (std::int64_t cycle = 100; cycle < 8000; cycle += 120) {
    options.late.push_back({.ns = cycle * 1'000'000, .late_ns = 1'500'000});
  }
  SimulatedRun run(scene(), options);
  run.run(8000);
  const Stop stop = stop_of(run, kRelease);
  print("payload 0.12 kg heavier, skipped periods", stop, kRelease);
  EXPECT_GT(run.controller().counters().skipped, 40u);
  EXPECT_EQ(stop.fault, Fault::kDrifts);
  EXPECT_LT(stop.in_all, kRunningMost);
}

TEST(DriveThatGivesLess, StopsBeforeTheToolHasMovedFar) {
  constexpr std::int64_t kFault = 1200;
  SimulatedRun::Options options;
  options.load = kNobody;
  options.faults = {{sim::FaultKind::kTorqueLimited, 1, kFault, 100'000, 5.0}};
  SimulatedRun run(scene(), options);
  run.run(3000);
  const Stop stop = stop_of(run, kFault - 1);
  print("a drive gives less than it is asked", stop, kFault);
  test::record(seen_since(run.cycles, kFault));
  EXPECT_EQ(stop.fault, Fault::kTorqueWrong);
  EXPECT_EQ(run.controller().supervisor().fault_joint(), 1);
  EXPECT_LE(stop.cycle - kFault, 60);
  EXPECT_LT(stop.in_all, 0.01);
}

}  // namespace
}  // namespace godobject::firmware
