#include <gtest/gtest.h>

#include <algorithm>
#include <deque>

#include "firmware/cycle/lateness_watch.h"
#include "firmware/cycle/limit_watch.h"
#include "firmware/cycle/observation.h"
#include "firmware/cycle/rate_watch.h"
#include "tests/support/random.h"

namespace godobject::firmware::watches_test {
namespace {

TEST(RateWatch, CountsTheEventsOfTheLastThousandCycles) {
  test::Random random(1);
  for (const double share : {0.002, 0.009, 0.010, 0.012, 0.1, 1.0}) {
    RateWatch watch;
    std::deque<bool> last;  // an independent window
    int alarms = 0;
    for (int i = 0; i < 5000; ++i) {
      const bool happened = random.between(0.0, 1.0) < share;
      last.push_back(happened);
      if (last.size() > 1000) last.pop_front();
      const bool often = happened && std::count(last.begin(), last.end(), true) > 10;
      ASSERT_EQ(watch.update(happened), often) << share << ' ' << i;
      alarms += often ? 1 : 0;
    }
    EXPECT_EQ(alarms > 0, share > 0.005) << share;
  }
}

/// Ten events, and the eleventh 999 or 1000 cycles after the first.
TEST(RateWatch, ForgetsAnEventAfterAThousandCycles) {
  for (const int gap : {999, 1000}) {
    RateWatch watch;
    for (int i = 0; i < gap; ++i) ASSERT_FALSE(watch.update(i < 10));
    EXPECT_EQ(watch.update(true), gap == 999);
    EXPECT_FALSE(watch.update(false)) << "without an event there is none too many";
  }
}

TEST(LimitWatch, FindsALimitThatStays) {
  for (const std::uint32_t most : {1u, 5u, 50u}) {
    LimitWatch watch;
    for (std::uint32_t k = 1; k <= 2 * most; ++k) ASSERT_EQ(watch.update(true, most), k > most) << most << ' ' << k;
    EXPECT_FALSE(watch.update(false, most)) << "it was not counted beyond the first cycle that is too many";
    EXPECT_TRUE(watch.update(true, most));
    watch.reset();
    for (std::uint32_t k = 1; k <= most; ++k) ASSERT_FALSE(watch.update(true, most));
  }
}

/// Of each row `active` cycles are limited and then `free` ones are not: more than half of them are too many in time.
TEST(LimitWatch, FindsALimitThatFlickersInMoreThanHalfOfTheCycles) {
  struct Flicker {
    int active, free;
    int found;  // cycle; -1: never
  };
  // of 2 + 1 cycles one remains: after 48 rows 48, and row 49 reaches 49, 50 and with the next one 51
  for (const Flicker& flicker : {Flicker{1, 1, -1}, {1, 2, -1}, {49, 49, -1}, {50, 60, -1}, {49, 1, 53}, {2, 1, 149}}) {
    LimitWatch watch;
    int found = -1;
    for (int k = 0; k < 100'000 && found < 0; ++k) {
      if (watch.update(k % (flicker.active + flicker.free) < flicker.active, 50)) found = k + 1;
    }
    EXPECT_EQ(found, flicker.found) << flicker.active << '+' << flicker.free;
  }
}

TEST(LatenessWatch, FindsThreeInARowOneThatIsLongAndTooMany) {
  LatenessWatch row(1e-3);
  for (const bool third : {false, false, true, true}) EXPECT_EQ(row.update(1), third);
  EXPECT_FALSE(row.update(0));
  for (const bool third : {false, false, true}) EXPECT_EQ(row.update(1), third) << "counted again";

  for (const std::int64_t longest : {std::int64_t{5'000'000}, std::int64_t{5'000'001}}) {
    LatenessWatch watch(1e-3);
    EXPECT_EQ(watch.update(longest), longest > 5'000'000);
    EXPECT_FALSE(watch.update(0));
  }

  LatenessWatch often(1e-3);  // every other cycle: the eleventh is too many
  for (int i = 1; i <= 30; ++i) {
    ASSERT_EQ(often.update(1), i > 10) << i;
    ASSERT_FALSE(often.update(0)) << "an early cycle is no overrun";
  }
  LatenessWatch early(1e-3);
  for (int i = 0; i < 3000; ++i) ASSERT_FALSE(early.update(i % 2 == 0 ? 0 : -1));
}

/// A period longer than drives wait by default: for 4 ms, or four periods, less where three periods take over 10 ms.
TEST(LatenessWatch, CallsLongWhatTheDrivesDoNotWaitFor) {
  for (const auto& [period, longest] : {std::pair{0.125e-3, std::int64_t{4'125'000}},
                                        {0.25e-3, std::int64_t{4'250'000}},
                                        {2e-3, std::int64_t{10'000'000}},
                                        {4e-3, std::int64_t{16'000'000}},
                                        {10e-3, std::int64_t{30'000'000}}}) {
    LatenessWatch watch(period);
    EXPECT_FALSE(watch.update(longest)) << period;
    EXPECT_TRUE(watch.update(longest + 1)) << period;
  }
}

TEST(RateWatch, AllowsAsManyAsItIsTold) {
  RateWatch watch(200);
  for (int i = 1; i <= 400; ++i) ASSERT_EQ(watch.update(i % 2 == 1), i % 2 == 1 && (i + 1) / 2 > 200) << i;
}

/// Every combination of states and ages of three joints, of which the arm has one, two or three.
TEST(Observation, SummarizesTheDrivesOfTheArmAlone) {
  using hal::DriveState;
  constexpr int kStates = 5;
  for (int joint_count = 1; joint_count <= 3; ++joint_count) {
    for (int code = 0; code < kStates * kStates * kStates * 8; ++code) {
      hal::JointReading reading;
      const int states[3] = {code % 5, code / 5 % 5, code / 25 % 5};
      int answer = 0, enabled = 0, rest = 0, fault = 0, fresh = 0;
      for (int i = 0; i < 3; ++i) {
        const auto joint = static_cast<std::size_t>(i);
        const auto state = static_cast<DriveState>(states[i]);
        reading.state[joint] = state;
        reading.age[joint] = (code / 125 >> i & 1) == 0 ? 0 : 1 + static_cast<std::uint32_t>(i);
        if (i >= joint_count) continue;
        answer += state == DriveState::kUnavailable ? 0 : 1;
        enabled += state == DriveState::kEnabled ? 1 : 0;
        rest += state == DriveState::kOff || state == DriveState::kFault ? 1 : 0;
        fault += state == DriveState::kFault ? 1 : 0;
        fresh += reading.age[joint] == 0 ? 1 : 0;
      }
      const DriveSummary drives = summarize(reading, joint_count);
      ASSERT_EQ(drives.all_answer, answer == joint_count) << code;
      ASSERT_EQ(drives.all_enabled, enabled == joint_count) << code;
      ASSERT_EQ(drives.none_moves, rest == joint_count) << code;
      ASSERT_EQ(drives.any_fault, fault > 0) << code;
      ASSERT_EQ(drives.all_fresh, fresh == joint_count) << code;
    }
  }
}

/// An observation that nobody has filled in shows no event, and no switch that somebody holds.
TEST(Observation, ShowsNothingBeforeItIsFilledIn) {
  const Observation seen;
  EXPECT_FALSE(seen.emergency_stop || seen.enable_switch || seen.alarm || seen.drive_restarted);
  EXPECT_FALSE(seen.stuck || seen.too_fast || seen.inside || seen.end_requested || seen.reset_requested);
  EXPECT_TRUE(seen.finite);
  EXPECT_EQ(seen.lost + seen.jumps + seen.sends_failed, 0u);
  EXPECT_EQ(seen.joint_beyond_limit, -1);
  EXPECT_EQ(seen.contact_force, 0.0);
  EXPECT_EQ(seen.overrun_ns, 0);
}

/// A summary that nobody has made claims nothing: no drive answers, none rests.
TEST(Observation, ClaimsNothingOfDrivesBeforeTheyAreSummarized) {
  const DriveSummary drives;
  EXPECT_FALSE(drives.all_answer || drives.all_enabled || drives.none_moves || drives.any_fault || drives.all_fresh);
}

}  // namespace
}  // namespace godobject::firmware::watches_test
