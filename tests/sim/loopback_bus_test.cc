#include "sim/loopback_bus.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "tests/support/allocation_guard.h"
#include "tests/support/random.h"

namespace godobject::sim {
namespace {

hal::CanFrame frame(std::uint16_t id, int length, bool fd = false) {
  hal::CanFrame frame;
  frame.id = id;
  frame.length = static_cast<std::uint8_t>(length);
  frame.fd = fd;
  return frame;
}

TEST(FrameTime, IsThatOfTheWorstStuffing) {
  const hal::BusLayout layout;  // 1 Mbit/s, 5 Mbit/s
  EXPECT_EQ(frame_ns(layout, frame(0x080, 0)), 55'000);
  EXPECT_EQ(frame_ns(layout, frame(0x701, 1)), 65'000);
  EXPECT_EQ(frame_ns(layout, frame(0x201, 4)), 95'000);
  EXPECT_EQ(frame_ns(layout, frame(0x181, 8)), 135'000);
  hal::BusLayout slow = layout;
  slow.bit_rate = 250e3;
  EXPECT_EQ(frame_ns(slow, frame(0x181, 8)), 540'000);
}

/// Counts the bits of a classical frame with the stuffing rule itself: a bit after five equal ones.
TEST(FrameTime, HoldsForEveryFrameThatIsStuffedBitByBit) {
  test::Random random(1);
  int most = 0;
  for (int i = 0; i < 20'000; ++i) {
    // start, identifier, remote, two reserved, length, data, checksum of 15 bits; worst: 00000 1111 0000 ...
    const int n = i % 9;
    const int stuffed = 34 + 8 * n;
    std::vector<bool> bits;
    const bool worst = i < 9;
    for (int b = 0; b < stuffed; ++b)
      bits.push_back(worst ? (b == 0 ? false : ((b - 1) / 4) % 2 == 1) : random.between(0.0, 1.0) < 0.5);
    int inserted = 0;
    int run = 0;
    bool last = true;
    for (const bool bit : bits) {
      run = run > 0 && bit == last ? run + 1 : 1;
      last = bit;
      if (run == 5) {
        ++inserted;
        last = !bit;
        run = 1;
      }
    }
    const int all = stuffed + inserted + 13;
    EXPECT_LE(1000 * all, frame_ns({}, frame(0, n)));
    if (n == 8) most = std::max(most, all);
  }
  EXPECT_EQ(most, 135);
}

/// DRIVES.md's figures: a SYNC, six or seven answers of 8 bytes and as many torques of 4 on one bus.
TEST(FrameTime, OfFdFramesIsThatOfTheLayouts) {
  const hal::BusLayout layout;
  const auto cycle = [&layout](int joints) {
    return frame_ns(layout, frame(0x080, 0, true)) +
           joints * (frame_ns(layout, frame(0x181, 8, true)) + frame_ns(layout, frame(0x201, 4, true)));
  };
  EXPECT_EQ(frame_ns(layout, frame(0x080, 0, true)), 40'600);
  EXPECT_EQ(cycle(6), 671'800);
  EXPECT_EQ(cycle(7), 777'000);
  EXPECT_EQ(frame_ns(layout, frame(0x181, 16, true)), 72'600);
  EXPECT_EQ(frame_ns(layout, frame(0x181, 20, true)), 34'000 + 7'600 + 40'000);
}

/// With `fd_services` every message is an FD frame: 1 byte in 34 + 43 / 5 us.
TEST(FrameTime, OfAllMessagesAsFdFrames) {
  hal::BusLayout layout;
  layout.fd = layout.fd_services = true;
  LoopbackBus bus(layout);
  ASSERT_TRUE(bus.hand_over(1, frame(0x701, 1), 0));
  bus.arbitrate(0);
  EXPECT_EQ(bus.next_ns(), 42'600);
  layout.fd = false;  // nothing without FD
  LoopbackBus classical(layout);
  ASSERT_TRUE(classical.hand_over(1, frame(0x701, 1), 0));
  classical.arbitrate(0);
  EXPECT_EQ(classical.next_ns(), 65'000);
}

struct Wire {
  hal::BusLayout layout;
  std::unique_ptr<LoopbackBus> bus = std::make_unique<LoopbackBus>(layout);
  std::vector<WireFrame> ended;

  void run(std::int64_t until_ns) {
    std::int64_t now_ns = ended.empty() ? 0 : ended.back().end_ns;
    for (;;) {
      bus->arbitrate(now_ns);
      const std::int64_t next_ns = bus->next_ns();
      if (next_ns > until_ns) return;
      now_ns = next_ns;
      WireFrame frame;
      if (bus->take(now_ns, frame)) ended.push_back(frame);
    }
  }
};

TEST(LoopbackBus, LowestIdentifierGoesFirstAndNobodyIsInterrupted) {
  Wire wire;
  ASSERT_TRUE(wire.bus->hand_over(3, frame(0x701, 1), 0));
  ASSERT_TRUE(wire.bus->hand_over(1, frame(0x182, 8), 10'000));  // while the first one is on the wire
  ASSERT_TRUE(wire.bus->hand_over(2, frame(0x181, 8), 20'000));
  ASSERT_TRUE(wire.bus->hand_over(0, frame(0x080, 0), 65'000));  // ready the moment that the wire is free
  wire.run(1'000'000);
  ASSERT_EQ(wire.ended.size(), 4u);
  const std::vector<std::uint16_t> order{0x701, 0x080, 0x181, 0x182};
  const std::vector<std::int64_t> ends{65'000, 120'000, 255'000, 390'000};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(wire.ended[i].frame.id, order[i]);
    EXPECT_EQ(wire.ended[i].end_ns, ends[i]);
  }
  EXPECT_EQ(wire.bus->busy_ns(), 390'000);
}

TEST(LoopbackBus, AnEndSendsInOrderWhateverItsIdentifiers) {
  Wire wire;
  ASSERT_TRUE(wire.bus->hand_over(0, frame(0x600, 8), 0));
  ASSERT_TRUE(wire.bus->hand_over(0, frame(0x080, 0), 0));
  ASSERT_TRUE(wire.bus->hand_over(1, frame(0x300, 0), 0));
  wire.run(1'000'000);
  ASSERT_EQ(wire.ended.size(), 3u);
  EXPECT_EQ(wire.ended[0].frame.id, 0x300);
  EXPECT_EQ(wire.ended[1].frame.id, 0x600);
  EXPECT_EQ(wire.ended[2].frame.id, 0x080);
}

TEST(LoopbackBus, EqualIdentifiersGoInTheOrderOfTheEnds) {
  Wire wire;
  ASSERT_TRUE(wire.bus->hand_over(5, frame(0x080, 0), 0));
  ASSERT_TRUE(wire.bus->hand_over(2, frame(0x080, 0), 0));
  wire.run(1'000'000);
  ASSERT_EQ(wire.ended.size(), 2u);
  EXPECT_EQ(wire.ended[0].end, 2);
  EXPECT_EQ(wire.ended[1].end, 5);
}

TEST(LoopbackBus, RefusesWhatItsQueueDoesNotHold) {
  Wire wire;
  for (int i = 0; i < LoopbackBus::kQueue; ++i) ASSERT_TRUE(wire.bus->hand_over(0, frame(1, 0), 0));
  EXPECT_FALSE(wire.bus->hand_over(0, frame(1, 0), 0));
  wire.bus->arbitrate(0);
  EXPECT_TRUE(wire.bus->hand_over(0, frame(1, 0), 0));
}

TEST(LoopbackEnd, ComputesBetweenReceivingAndSending) {
  Wire wire;
  LoopbackEnd end(*wire.bus, 0, 120'000);
  end.set_now(1'000'000);
  EXPECT_EQ(end.send(frame(0x080, 0)), hal::SendResult::kSent);
  EXPECT_EQ(end.send(frame(0x601, 8)), hal::SendResult::kSent);
  hal::ReceivedFrame received;
  EXPECT_FALSE(end.receive(received));
  end.set_now(1'400'000);
  EXPECT_EQ(end.send(frame(0x201, 4)), hal::SendResult::kSent);
  wire.run(3'000'000);
  ASSERT_EQ(wire.ended.size(), 3u);
  EXPECT_EQ(wire.ended[0].end_ns, 1'055'000);
  EXPECT_EQ(wire.ended[1].end_ns, 1'190'000);
  EXPECT_EQ(wire.ended[2].end_ns, 1'400'000 + 120'000 + 95'000);
}

TEST(LoopbackEnd, KnowsItsOwnFramesAndCountsWhatItLoses) {
  Wire wire;
  LoopbackEnd end(*wire.bus, 4, 0);
  end.deliver({frame(0x080, 0), 4, 55'000});
  end.deliver({frame(0x181, 8), 1, 190'000});
  hal::ReceivedFrame received;
  ASSERT_TRUE(end.receive(received));
  EXPECT_TRUE(received.own);
  EXPECT_EQ(received.time_ns, 55'000);
  ASSERT_TRUE(end.receive(received));
  EXPECT_FALSE(received.own);
  EXPECT_EQ(received.frame.id, 0x181);
  EXPECT_FALSE(end.receive(received));
  for (int i = 0; i < LoopbackEnd::kReceiveQueue + 7; ++i) end.deliver({frame(0x181, 8), 1, i});
  EXPECT_EQ(end.health().dropped, 7u);
  int count = 0;
  while (end.receive(received)) EXPECT_EQ(received.time_ns, count++) << "the oldest are kept";
  EXPECT_EQ(count, LoopbackEnd::kReceiveQueue);
}

TEST(LoopbackEnd, SaysWhenItCannotSend) {
  Wire wire;
  LoopbackEnd end(*wire.bus, 0, 0);
  for (int i = 0; i < LoopbackBus::kQueue; ++i) ASSERT_EQ(end.send(frame(0x201, 4)), hal::SendResult::kSent);
  EXPECT_EQ(end.send(frame(0x201, 4)), hal::SendResult::kFull);
  end.set_down(true);
  EXPECT_EQ(end.send(frame(0x201, 4)), hal::SendResult::kDown);
  EXPECT_TRUE(end.health().down);
  end.deliver({frame(0x181, 8), 1, 0});
  hal::ReceivedFrame received;
  EXPECT_FALSE(end.receive(received));
  end.set_down(false);
  end.set_bus_off();
  EXPECT_EQ(end.send(frame(0x201, 4)), hal::SendResult::kSent);
  EXPECT_TRUE(end.health().bus_off);
  wire.run(1'000'000);
  EXPECT_TRUE(wire.ended.empty()) << "nothing of it reaches the wire";
}

TEST(LoopbackBus, IsStatic) {
  if (!test::AllocationGuard::works()) GTEST_SKIP() << "not run: a sanitizer has the heap for itself";
  Wire wire;
  const auto end = std::make_unique<LoopbackEnd>(*wire.bus, 0, 1000);
  const test::AllocationGuard guard;
  WireFrame ended;
  hal::ReceivedFrame received;
  for (std::int64_t now_ns = 0; now_ns < 100'000'000; now_ns += 1000) {
    end->set_now(now_ns);
    if (now_ns % 1'000'000 == 0) (void)end->send(frame(0x080, 0));
    if (now_ns % 300'000 == 0) (void)wire.bus->hand_over(1, frame(0x181, 8), now_ns);
    wire.bus->arbitrate(now_ns);
    if (wire.bus->take(now_ns, ended)) end->deliver(ended);
    (void)end->receive(received);
  }
  EXPECT_EQ(guard.allocations(), 0);
}

}  // namespace
}  // namespace godobject::sim
