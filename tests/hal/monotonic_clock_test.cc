#include "hal/linux/monotonic_clock.h"

#include <gtest/gtest.h>

#include <time.h>

#include <cstdint>
#include <vector>

#include "tests/hal/fake_kernel.h"

namespace godobject::hal {
namespace {

TEST(MonotonicClock, ReadsSecondsAndNanosecondsOfTheClockThatNobodySets) {
  std::int64_t read = 0;
  std::vector<int> clocks;
  {
    FakeKernel kernel;
    kernel.now = {.tv_sec = 12'345, .tv_nsec = 987'654'321};
    read = MonotonicClock().now_ns();
    clocks = kernel.clocks;
  }
  EXPECT_EQ(read, 12'345'987'654'321);
  EXPECT_EQ(clocks, std::vector<int>{CLOCK_MONOTONIC});
}

/// A signal ends a call, not the sleep: it is called again with the same absolute time.
TEST(MonotonicClock, SleepsUntilAnAbsoluteTimeOverSignals) {
  for (const int interrupts : {0, 1, 3}) {
    std::vector<FakeKernel::Sleep> sleeps;
    {
      FakeKernel kernel;
      kernel.interrupts = interrupts;
      MonotonicClock().sleep_until(12'345'987'654'321);
      sleeps = kernel.sleeps;
    }
    EXPECT_EQ(sleeps.size(), 1u + static_cast<std::size_t>(interrupts));
    for (const FakeKernel::Sleep& sleep : sleeps) {
      EXPECT_EQ(sleep.clock, CLOCK_MONOTONIC);
      EXPECT_EQ(sleep.flags, TIMER_ABSTIME);
      EXPECT_EQ(sleep.until.tv_sec, 12'345);
      EXPECT_EQ(sleep.until.tv_nsec, 987'654'321);
    }
  }
}

}  // namespace
}  // namespace godobject::hal
