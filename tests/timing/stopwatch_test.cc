#include "toolchain/timing/stopwatch.h"

#include <chrono>

#include <gtest/gtest.h>

namespace godobject::timing {
namespace {

TEST(Stopwatch, NeverRunsBackwards) {
  const Stopwatch now = stopwatch();
  std::int64_t last = now();
  for (int i = 0; i < 100000; ++i) {
    const std::int64_t next = now();
    ASSERT_GE(next, last);
    last = next;
  }
}

TEST(Stopwatch, RunsAsFastAsTheSystemsClock) {
  using Clock = std::chrono::steady_clock;
  const Stopwatch now = stopwatch();
  const auto begin = Clock::now();
  const std::int64_t begin_ns = now();
  while (Clock::now() - begin < std::chrono::milliseconds(50)) {
  }
  const double elapsed = static_cast<double>(now() - begin_ns);
  const double system =
      static_cast<double>(std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - begin).count());
  // if the process is suspended between the two readings, the system's time is longer, never shorter
  EXPECT_LT(elapsed, 1.01 * system);
}

}  // namespace
}  // namespace godobject::timing
