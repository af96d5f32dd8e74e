#include "hal/record_ring.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <thread>

#include "hal/can_log_ring.h"
#include "tests/support/random.h"

namespace godobject::hal {
namespace {

TEST(RecordRing, IsAQueueThatLosesTheNewestRecords) {
  using Ring = RecordRing<int, 8>;
  Ring ring;
  EXPECT_EQ(Ring::kCapacity, 8u);
  EXPECT_EQ(ring.lost(), 0u);
  int record = -1;
  EXPECT_FALSE(ring.pop(record));
  EXPECT_EQ(record, -1);
  for (int k = 0; k < 11; ++k) ring.push(k);
  EXPECT_EQ(ring.lost(), 3u);
  for (int k = 0; k < 8; ++k) {
    ASSERT_TRUE(ring.pop(record));
    EXPECT_EQ(record, k);
  }
  EXPECT_FALSE(ring.pop(record));
  EXPECT_EQ(ring.lost(), 3u);
}

/// Against a queue of the library, over many rounds of the ring.
TEST(RecordRing, KeepsOrderAndCountsWhatItLosesInAnyPattern) {
  test::Random random(6);
  for (int run = 0; run < 20; ++run) {
    RecordRing<int, 4> ring;
    std::deque<int> expected;
    std::uint64_t lost = 0;
    for (int k = 0; k < 2000; ++k) {
      if (random.integer(0, 99) < 50 + run - 10) {
        ring.push(k);
        if (expected.size() < 4) {
          expected.push_back(k);
        } else {
          ++lost;
        }
      } else {
        int record = -1;
        ASSERT_EQ(ring.pop(record), !expected.empty());
        if (expected.empty()) continue;
        ASSERT_EQ(record, expected.front());
        expected.pop_front();
      }
      ASSERT_EQ(ring.lost(), lost);
    }
    EXPECT_GT(lost, 0u);
  }
}

/// Every record arrives once and in order, or is counted as lost.
TEST(RecordRing, CarriesRecordsFromOneThreadToAnother) {
  constexpr std::uint64_t kRecords = 100'000;
  const auto ring = std::make_unique<RecordRing<std::uint64_t, 64>>();
  std::atomic<bool> over{false};
  std::thread loop([&] {
    for (std::uint64_t k = 1; k <= kRecords; ++k) ring->push(k);
    over = true;
  });
  std::uint64_t taken = 0;
  std::uint64_t last = 0;
  bool ordered = true;
  for (;;) {
    const bool last_look = over;
    std::uint64_t record = 0;
    while (ring->pop(record)) {
      ordered = ordered && record > last;
      last = record;
      ++taken;
    }
    if (last_look) break;
  }
  loop.join();
  EXPECT_TRUE(ordered);
  EXPECT_EQ(taken + ring->lost(), kRecords);
}

TEST(CanLogRing, CarriesFramesWithTheirBus) {
  const auto ring = std::make_unique<CanLogRing>();
  LoggedFrame logged;
  EXPECT_FALSE(ring->pop(logged));
  ReceivedFrame received;
  received.time_ns = 5;
  received.own = true;
  for (std::size_t k = 0; k < CanLogRing::kCapacity + 10; ++k) {
    received.frame.id = static_cast<std::uint16_t>(k % 0x800);
    ring->on_frame(static_cast<int>(k % 4), received);
  }
  EXPECT_EQ(ring->lost(), 10u);
  for (std::size_t k = 0; k < CanLogRing::kCapacity; ++k) {
    ASSERT_TRUE(ring->pop(logged));
    ASSERT_EQ(logged.bus, static_cast<int>(k % 4));
    ASSERT_EQ(logged.received.frame.id, k % 0x800);
    ASSERT_EQ(logged.received.time_ns, 5);
    ASSERT_TRUE(logged.received.own);
  }
  EXPECT_FALSE(ring->pop(logged));
  EXPECT_EQ(LoggedFrame().bus, 0);
}

}  // namespace
}  // namespace godobject::hal
