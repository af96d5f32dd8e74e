#include "hal/cia402/read_object.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "tests/hal/can_drives_bench.h"

namespace godobject::hal {
namespace {

constexpr std::int64_t kMs_ns = 1'000'000;

/// Reads 6076:0 of node 5, whose value is 20000. Frames come at times.
class ReadObjectTest : public testing::Test {
 protected:
  ReadObjectTest() {
    clock_.each_sleep = [this](std::int64_t now_ns) {
      ++sleeps_;
      if (now_ns == at_ns_) bus_.receive_next(answer_);
    };
    bus_.echoes = true;
  }

  bool read() { return read_object(bus_, clock_, 5, 0x6076, 0, value_); }

  FakeBus bus_;
  SleepingClock clock_;
  CanFrame answer_ = frame(0x585, {0x43, 0x76, 0x60, 0x00, 0x20, 0x4E, 0x00, 0x00});
  std::int64_t at_ns_ = -1;
  std::uint32_t value_ = 7;
  int sleeps_ = 0;
};

TEST_F(ReadObjectTest, AsksOnceAndReturnsTheValue) {
  bus_.receive_next(frame(0x705, {0x05}));  // from before
  at_ns_ = 3 * kMs_ns;
  EXPECT_TRUE(read());
  EXPECT_EQ(value_, 20000u);
  EXPECT_EQ(clock_.now_ns(), 3 * kMs_ns);
  EXPECT_EQ(bus_.sent, (std::vector<CanFrame>{frame(0x605, {0x40, 0x76, 0x60, 0x00, 0, 0, 0, 0})}));
}

TEST_F(ReadObjectTest, WaitsASecondInStepsOfAMillisecond) {
  EXPECT_FALSE(read());
  EXPECT_EQ(clock_.now_ns(), 1000 * kMs_ns);
  EXPECT_EQ(sleeps_, 1000);
  at_ns_ = (1000 + 999) * kMs_ns;
  EXPECT_TRUE(read()) << "just in time";
  EXPECT_EQ(value_, 20000u);
}

TEST_F(ReadObjectTest, ARequestThatDoesNotGoIsNotWaitedFor) {
  for (const SendResult result : {SendResult::kFull, SendResult::kDown}) {
    bus_.result = result;
    bus_.receive_next(answer_);
    EXPECT_FALSE(read());
    EXPECT_EQ(clock_.now_ns(), 0);
  }
}

TEST_F(ReadObjectTest, PassesOverAllOtherFrames) {
  const auto other = [this](std::size_t byte, int bits) {
    CanFrame changed = answer_;
    changed.data.at(byte) ^= static_cast<std::uint8_t>(bits);
    return changed;
  };
  CanFrame of_another = answer_;
  of_another.id = 0x586;
  bus_.receive_next(of_another);
  bus_.receive_next(other(1, 0x01));
  bus_.receive_next(other(2, 0x10));
  bus_.receive_next(other(3, 0x01));
  bus_.receive_next(answer_, true);  // an own frame
  bus_.receive_next(frame(0x585, {0x43, 0x76, 0x60, 0x00}));
  bus_.receive_next(frame(0x185, {0x43, 0x76, 0x60, 0x00, 1, 2, 3, 4}));
  EXPECT_FALSE(read());
  EXPECT_EQ(value_, 7u) << "no value was taken";
  EXPECT_EQ(clock_.now_ns(), 1000 * kMs_ns);
}

TEST_F(ReadObjectTest, AnAbortALongerObjectAndAConfirmedWriteEndTheWait) {
  for (const int command : {0x80, 0x41, 0x40, 0x60, 0x00}) {
    answer_.data[0] = static_cast<std::uint8_t>(command);
    at_ns_ = clock_.now_ns() + 2 * kMs_ns;
    EXPECT_FALSE(read()) << command;
    EXPECT_EQ(clock_.now_ns(), at_ns_) << command;
  }
}

}  // namespace
}  // namespace godobject::hal
