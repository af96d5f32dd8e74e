#include "hal/cia402/alarm_latch.h"

#include <gtest/gtest.h>

#include <optional>

#include "tests/support/random.h"

namespace godobject::hal::cia402 {
namespace {

/// Alarms that only a new start can cure, see `CanDrives`.
bool needs_a_new_start(Alarm alarm) {
  switch (alarm) {
    case Alarm::kNodeReset:
    case Alarm::kForeignWrite:
    case Alarm::kParameterChanged:
    case Alarm::kAnswersLate: return true;
    default: return false;
  }
}

constexpr int kAlarms = static_cast<int>(Alarm::kTemperatureLost) + 1;

TEST(AlarmLatch, KeepsOverAResetOnlyWhatANewStartCures) {
  for (int number = 1; number < kAlarms; ++number) {
    const auto alarm = static_cast<Alarm>(number);
    AlarmLatch latch;
    EXPECT_EQ(latch.first().alarm, Alarm::kNone);
    latch.raise({});
    latch.raise({.alarm = alarm, .bus = 2, .joint = 3, .id = 0x85});
    latch.raise({});
    EXPECT_EQ(latch.first().alarm, alarm);
    latch.reset();
    EXPECT_EQ(latch.first().alarm, needs_a_new_start(alarm) ? alarm : Alarm::kNone) << number;
    EXPECT_EQ(latch.first().joint, needs_a_new_start(alarm) ? 3 : -1) << number;
    latch.clear();
    EXPECT_EQ(latch.first().alarm, Alarm::kNone);
    latch.reset();
    EXPECT_EQ(latch.first().alarm, Alarm::kNone) << "cleared for good";
  }
}

/// Against two memories that are written as the class comment says it. Each alarm is told by its joint.
TEST(AlarmLatch, ShowsTheFirstAlarmSinceTheResetAndThenTheFirstThatLasts) {
  test::Random random(11);
  for (int run = 0; run < 200; ++run) {
    AlarmLatch latch;
    std::optional<int> first;
    std::optional<int> lasting;
    for (int k = 0; k < 30; ++k) {
      const int action = random.integer(0, 19);
      if (action == 0) {
        latch.clear();
        first = lasting = std::nullopt;
      } else if (action < 5) {
        latch.reset();
        first = lasting;
      } else {
        const auto alarm = static_cast<Alarm>(random.integer(1, kAlarms - 1));
        latch.raise({.alarm = alarm, .joint = k});
        if (!first) first = k;
        if (!lasting && needs_a_new_start(alarm)) lasting = k;
      }
      ASSERT_EQ(latch.first().alarm == Alarm::kNone, !first.has_value());
      ASSERT_EQ(latch.first().joint, first.value_or(-1));
    }
  }
}

}  // namespace
}  // namespace godobject::hal::cia402
