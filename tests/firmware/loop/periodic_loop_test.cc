#include "firmware/loop/periodic_loop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "firmware/cycle/lateness_watch.h"
#include "tests/support/random.h"

namespace godobject::firmware::periodic_loop_test {
namespace {

constexpr std::int64_t kPeriod_ns = 1'000'000;

/// Time that passes while somebody sleeps or a test says so.
class FakeClock final : public hal::Clock {
 public:
  std::int64_t now_ns() noexcept override { return now; }
  void sleep_until(std::int64_t ns) noexcept override { now = std::max(now, ns); }
  std::int64_t now = 12'345'678;
};

TEST(PeriodicLoop, WakesAtAbsoluteDeadlinesWhateverComputingTakes) {
  FakeClock clock;
  LoopStatistics statistics;
  std::vector<std::int64_t> deadlines;
  test::Random random(1);
  int left = 1000;
  run_periodically(
      clock, {kPeriod_ns, 0, kPeriod_ns}, statistics, [] {},
      [&](const LoopEvents& events) {
        EXPECT_EQ(events.overrun_ns, 0);
        EXPECT_EQ(events.skipped, 0u);
        clock.now += random.integer(1, 999'999);
        return --left > 0;
      },
      [&](const CycleTimes& times) { deadlines.push_back(times.deadline_ns); });
  ASSERT_EQ(deadlines.size(), 1000u);
  for (std::size_t i = 0; i < deadlines.size(); ++i) {
    EXPECT_EQ(deadlines[i], 13'000'000 + static_cast<std::int64_t>(i) * kPeriod_ns);
  }
  EXPECT_EQ(statistics.lateness.largest_ns(), 0);
  EXPECT_LE(statistics.compute.largest_ns(), 999'999);
}

TEST(PeriodicLoop, LeavesOutWhatHasPassedAndTellsTheNextCycle) {
  // computing time of a cycle -> by how much the next one hears that it was late, and how many periods it lost
  for (const auto& [took, overrun, skipped] :
       std::initializer_list<std::array<std::int64_t, 3>>{{kPeriod_ns, 0, 0},
                                                          {kPeriod_ns + 1, 1, 1},
                                                          {2 * kPeriod_ns, kPeriod_ns, 1},
                                                          {2 * kPeriod_ns + 1, kPeriod_ns + 1, 2},
                                                          {7 * kPeriod_ns + 500, 6 * kPeriod_ns + 500, 7}}) {
    FakeClock clock;
    LoopStatistics statistics;
    std::vector<LoopEvents> heard;
    std::vector<std::int64_t> deadlines;
    run_periodically(
        clock, {kPeriod_ns, 0, kPeriod_ns}, statistics, [] {},
        [&, spent = took](const LoopEvents& events) {
          heard.push_back(events);
          if (heard.size() == 3) clock.now += spent;
          return heard.size() < 6;
        },
        [&](const CycleTimes& times) { deadlines.push_back(times.deadline_ns); });
    EXPECT_EQ(heard[3].overrun_ns, overrun);
    EXPECT_EQ(heard[3].skipped, static_cast<std::uint32_t>(skipped));
    EXPECT_EQ(heard[4].overrun_ns, 0);
    EXPECT_EQ(deadlines[3] - deadlines[2], (1 + skipped) * kPeriod_ns);
    EXPECT_EQ(deadlines[4] - deadlines[3], kPeriod_ns) << "no burst";
  }
}

/// A clock that wakes its sleepers late by a script, a number a sleep.
class LateClock final : public hal::Clock {
 public:
  explicit LateClock(std::vector<std::int64_t> late) : late_(std::move(late)) {}
  std::int64_t now_ns() noexcept override { return now; }
  void sleep_until(std::int64_t ns) noexcept override {
    now = std::max(now, ns) + (slept_ < late_.size() ? late_[slept_] : 0);
    ++slept_;
  }
  std::int64_t now = 0;

 private:
  std::vector<std::int64_t> late_;
  std::size_t slept_ = 0;
};

/// Computing time counts from the last sample: neither late waking nor the wait for samples is part of it.
TEST(PeriodicLoop, TellsTheNextCycleThatOneComputedForLongerThanPlanned) {
  constexpr std::int64_t kPlanned_ns = 120'000;
  for (const std::int64_t took : {0, 119'999, 120'000, 120'001, 700'000, 2'500'000}) {
    LateClock clock({0, 0, 30'000, 400, 90'000, 0});
    LoopStatistics statistics;
    std::vector<std::int64_t> heard;
    run_periodically(
        clock, {kPeriod_ns, 300'000, kPlanned_ns}, statistics, [] {},
        [&](const LoopEvents& events) {
          heard.push_back(events.computed_late_ns);
          clock.now += heard.size() == 2 ? took : kPlanned_ns;
          return heard.size() < 5;
        },
        [&](const CycleTimes&) { clock.now += 70'000; });
    EXPECT_EQ(heard, (std::vector<std::int64_t>{0, 0, std::max<std::int64_t>(0, took - kPlanned_ns), 0, 0})) << took;
  }
}

/// The scheduler's lateness lies before the cycle that wakes late: that one must know, for its velocities.
TEST(PeriodicLoop, TellsACycleOfItsOwnLateWakingAndNoOther) {
  class LateOnce final : public hal::Clock {
   public:
    explicit LateOnce(std::int64_t by) : late_by_(by) {}
    std::int64_t now_ns() noexcept override { return now; }
    void sleep_until(std::int64_t ns) noexcept override {
      now = std::max(now, ns);
      if (++slept_ == 4) now += late_by_;
    }
    std::int64_t now = 0;

   private:
    std::int64_t late_by_;
    int slept_ = 0;
  };
  for (const std::int64_t late : {400'000, 999'999, 1'000'000, 1'600'000, 2'400'000, 7'200'000}) {
    LateOnce clock(late);
    LoopStatistics statistics;
    std::vector<LoopEvents> heard;
    std::vector<std::int64_t> woke;
    run_periodically(
        clock, {kPeriod_ns, 0, kPeriod_ns}, statistics, [] {},
        [&](const LoopEvents& events) {
          heard.push_back(events);
          woke.push_back(clock.now);
          clock.now += 50'000;
          return heard.size() < 8;
        },
        [](const CycleTimes&) {});
    EXPECT_EQ(heard[3].overrun_ns, late >= kPeriod_ns ? late : 0) << late;
    std::int64_t periods = 0;
    for (std::size_t i = 1; i < heard.size(); ++i) {
      if (i != 3) {
        EXPECT_EQ(heard[i].overrun_ns, late < kPeriod_ns && late > 950'000 && i == 4 ? late + 50'000 - kPeriod_ns : 0)
            << late << " " << i;
      }
      // the reported number of periods between two cycles is off by at most one, by half in the cycle that wakes late
      const auto told = static_cast<double>(1 + heard[i].skipped);
      const double apart = static_cast<double>(woke[i] - woke[i - 1]) / kPeriod_ns;
      EXPECT_LE(std::abs(told - apart), 1.0) << late << " " << i;
      if (i == 3) {
        EXPECT_LE(std::abs(told - apart), 0.5) << late;
      }
      periods += 1 + heard[i].skipped;
    }
    EXPECT_LE(std::abs(periods - (woke.back() - woke.front()) / kPeriod_ns), 1) << late;
  }
}

TEST(DurationHistogram, TellsQuantilesToASixteenthOfAnOctave) {
  test::Random random(2);
  std::vector<std::int64_t> all;
  DurationHistogram histogram;
  for (int i = 0; i < 50'000; ++i) {
    all.push_back(static_cast<std::int64_t>(std::exp(random.between(0.0, 20.0))));
    histogram.add(all.back());
  }
  std::sort(all.begin(), all.end());
  EXPECT_EQ(histogram.count(), all.size());
  EXPECT_EQ(histogram.largest_ns(), all.back());
  for (const double share : {0.01, 0.5, 0.9, 0.999}) {
    const auto exact = static_cast<double>(all[static_cast<std::size_t>(std::ceil(share * 50'000.0)) - 1]);
    const auto told = static_cast<double>(histogram.quantile_ns(share));
    EXPECT_GE(told, exact);
    EXPECT_LE(told, exact * (1.0 + 1.0 / 16.0) + 1.0);
  }
  EXPECT_EQ(histogram.quantile_ns(1.0), all.back());
}

TEST(DurationHistogram, TakesEveryNumber) {
  DurationHistogram histogram;
  EXPECT_EQ(histogram.quantile_ns(0.5), 0);
  histogram.add(-5);
  EXPECT_EQ(histogram.quantile_ns(1.0), 0);
  for (int bit = 0; bit < 63; ++bit) {
    DurationHistogram one;
    one.add(std::int64_t{1} << bit);
    EXPECT_EQ(one.quantile_ns(0.5), std::int64_t{1} << bit);
  }
  histogram.add(INT64_MAX);
  EXPECT_EQ(histogram.largest_ns(), INT64_MAX);
}

TEST(LatenessWatch, CountsInARowInAWindowAndTheLongOnes) {
  LatenessWatch row(1e-3);
  EXPECT_FALSE(row.update(1));
  EXPECT_FALSE(row.update(1));
  EXPECT_TRUE(row.update(1));
  LatenessWatch longest(1e-3);
  EXPECT_FALSE(longest.update(5'000'000));
  EXPECT_TRUE(longest.update(5'000'001));
  LatenessWatch window(1e-3);
  for (int i = 0; i < 20'000; ++i) ASSERT_FALSE(window.update(i % 100 == 0 ? 1 : 0)) << i;
  LatenessWatch more(1e-3);
  bool tripped = false;
  for (int i = 0; i < 1000; ++i) tripped |= more.update(i % 90 == 0 ? 1 : 0);
  EXPECT_TRUE(tripped);
}

/// Every number below 16 has a bucket of its own; above, a bucket ends at most 1/16 of its beginning later.
TEST(DurationHistogram, RoundsUpToTheEndOfABucketAndNoFurther) {
  std::vector<std::int64_t> numbers;
  for (std::int64_t ns = 0; ns < 5000; ++ns) numbers.push_back(ns);
  for (int bit = 13; bit < 62; ++bit) {
    for (const std::int64_t more : {-1, 0, 1, 12345}) numbers.push_back((std::int64_t{1} << bit) + more);
  }
  const auto end_of = [](std::int64_t ns) {
    DurationHistogram histogram;
    histogram.add(ns);
    histogram.add(INT64_MAX);
    return histogram.quantile_ns(0.5);
  };
  for (const std::int64_t ns : numbers) {
    const std::int64_t last = end_of(ns);
    ASSERT_GE(last, ns);
    ASSERT_LE(last - ns, ns / 16) << ns;
    ASSERT_EQ(end_of(last), last) << "the end belongs to its own bucket";
    ASSERT_GT(end_of(last + 1), last) << "the next number does not";
  }
}

TEST(DurationHistogram, CountsTheShareOfDurationsThatAreNoLonger) {
  DurationHistogram histogram;
  EXPECT_EQ(histogram.count(), 0u);
  EXPECT_EQ(histogram.largest_ns(), 0);
  for (const std::int64_t ns : {1, 2, 3, 4, 5, 6, 7, 8, 9, 10}) histogram.add(ns);
  EXPECT_EQ(histogram.count(), 10u);
  EXPECT_EQ(histogram.largest_ns(), 10);
  EXPECT_EQ(histogram.quantile_ns(0.0), 1) << "the shortest";
  EXPECT_EQ(histogram.quantile_ns(0.1), 1);
  EXPECT_EQ(histogram.quantile_ns(0.11), 2);
  EXPECT_EQ(histogram.quantile_ns(0.5), 5);
  EXPECT_EQ(histogram.quantile_ns(0.51), 6);
  EXPECT_EQ(histogram.quantile_ns(1.0), 10);
  EXPECT_EQ(histogram.quantile_ns(1.1), 10);
}

/// The samples come at their time, however soon after the request.
TEST(PeriodicLoop, WaitsForSamplesThatComeANanosecondLater) {
  LateClock clock({0, 0, 0, 0});
  LoopStatistics statistics;
  std::vector<std::int64_t> ran;
  run_periodically(
      clock, {kPeriod_ns, 1, kPeriod_ns}, statistics, [] {},
      [&](const LoopEvents&) {
        ran.push_back(clock.now % kPeriod_ns);
        return ran.size() < 2;
      },
      [](const CycleTimes&) {});
  EXPECT_EQ(ran, (std::vector<std::int64_t>{1, 1}));
}

/// Three cycles by hand: samples 300 us after waking; the second one wakes 20 us late, and for the samples 7 us.
TEST(PeriodicLoop, MeasuresLatenessAndComputingTimeOfEachCycle) {
  LateClock clock({0, 0, 20'000, 7'000, 0, 0});
  clock.now = 4'000'001;
  LoopStatistics statistics;
  std::vector<std::int64_t> requested, ran;
  std::vector<CycleTimes> times;
  run_periodically(
      clock, {kPeriod_ns, 300'000, kPeriod_ns}, statistics, [&] { requested.push_back(clock.now); },
      [&](const LoopEvents& events) {
        EXPECT_EQ(events.overrun_ns, 0);
        EXPECT_EQ(events.skipped, 0u);
        EXPECT_FALSE(events.end_requested || events.reset_requested);
        ran.push_back(clock.now);
        clock.now += 100'000 * static_cast<std::int64_t>(ran.size());
        return ran.size() < 3;
      },
      [&](const CycleTimes& t) {
        times.push_back(t);
        clock.now += 50'000;  // records are no computing time
      });
  EXPECT_EQ(requested, (std::vector<std::int64_t>{5'000'000, 6'020'000, 7'000'000}));
  EXPECT_EQ(ran, (std::vector<std::int64_t>{5'300'000, 6'327'000, 7'300'000}));
  ASSERT_EQ(times.size(), 3u);
  const std::int64_t expected[3][4] = {
      {5'000'000, 0, 0, 100'000}, {6'000'000, 20'000, 7'000, 200'000}, {7'000'000, 0, 0, 300'000}};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(times[i].deadline_ns, expected[i][0]);
    EXPECT_EQ(times[i].late_ns, expected[i][1]);
    EXPECT_EQ(times[i].collect_late_ns, expected[i][2]);
    EXPECT_EQ(times[i].compute_ns, expected[i][3]);
  }
  EXPECT_EQ(statistics.lateness.count(), 3u);
  EXPECT_EQ(statistics.lateness.largest_ns(), 20'000);
  EXPECT_EQ(statistics.collect_lateness.count(), 3u);
  EXPECT_EQ(statistics.collect_lateness.largest_ns(), 7'000);
  EXPECT_EQ(statistics.compute.count(), 3u);
  EXPECT_EQ(statistics.compute.largest_ns(), 300'000);
}

/// Periods that pass between the first deadline and the first waking are skipped ones, as between any two cycles.
TEST(PeriodicLoop, TellsTheFirstCycleOfItsLateWaking) {
  for (const auto& [late, overrun, skipped] :
       std::initializer_list<std::array<std::int64_t, 3>>{{0, 0, 0},
                                                          {400'000, 0, 0},
                                                          {600'000, 0, 1},
                                                          {1'000'000, 1'000'000, 1},
                                                          {1'600'000, 1'600'000, 2},
                                                          {2'400'000, 2'400'000, 2},
                                                          {7'200'000, 7'200'000, 7}}) {
    LateClock clock({late});
    clock.now = 3'000'001;
    LoopStatistics statistics;
    LoopEvents heard;
    run_periodically(
        clock, {kPeriod_ns, 0, kPeriod_ns}, statistics, [] {},
        [&](const LoopEvents& events) {
          heard = events;
          return false;
        },
        [](const CycleTimes&) {});
    EXPECT_EQ(heard.overrun_ns, overrun) << late;
    EXPECT_EQ(heard.skipped, static_cast<std::uint32_t>(skipped)) << late;
  }
}

/// The first deadline is the next whole period, also where the clock shows one already.
TEST(PeriodicLoop, BeginsAtTheNextWholePeriod) {
  for (const auto& [now, first] : std::initializer_list<std::array<std::int64_t, 2>>{
           {0, 0}, {1, 1'000'000}, {999'999, 1'000'000}, {1'000'000, 1'000'000}, {1'000'001, 2'000'000}}) {
    FakeClock clock;
    clock.now = now;
    LoopStatistics statistics;
    std::int64_t deadline = -1;
    run_periodically(
        clock, {kPeriod_ns, 0, kPeriod_ns}, statistics, [] {},
        [](const LoopEvents& events) { return events.skipped != 0; },
        [&](const CycleTimes& times) { deadline = times.deadline_ns; });
    EXPECT_EQ(deadline, first) << now;
    EXPECT_EQ(clock.now, first) << now;
  }
}

}  // namespace
}  // namespace godobject::firmware::periodic_loop_test
