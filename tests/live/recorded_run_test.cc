#include "toolchain/live/recorded_run.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <thread>

#include <fmt/format.h>

#include "tests/live/live_scene.h"
#include "tests/support/folder_test.h"
#include "toolchain/command_line/failure.h"
#include "toolchain/replay/replay.h"

namespace godobject::live::recorded_run_test {
namespace {

/// A replay of 0.2 s in which the force rises by 1 N in a cycle.
class RecordedRunTest : public test::FolderTest {
 protected:
  RecordedRunTest() {
    ball_in_hand(folder_);
    std::ofstream out(folder_ / "replay.csv");
    out << replay::kColumns << '\n';
    for (int i = 0; i < 200; ++i) {
      out << fmt::format("{:.3f},0,0,0.05,1,0,0,0,0,0,0.03,1,0,0,0,0,{},0,0,0,0.5,-1e-5,3,1,2000,500,contact\n",
                         1.0 + 1e-3 * i, i);
    }
  }

  RecordedRun run() const { return {folder_ / "replay.csv", folder_ / "ball.scene", {}}; }
};

TEST_F(RecordedRunTest, ShowsEachCycleOnceInItsOrderAndBeginsAgain) {
  RecordedRun run = this->run();
  EXPECT_EQ(run.placement(), nullptr);
  EXPECT_EQ(run.start().translation.z(), 0.05);
  EXPECT_EQ(run.largest_force(), 199.0);
  EXPECT_EQ(run.largest_torque(), 0.5);
  std::vector<LiveSample> samples;
  while (samples.size() < 500) {
    run.take(samples);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  for (std::size_t i = 0; i < 500; ++i) {
    const double expected = 1.0 + 1e-3 * static_cast<double>(i % 200);
    ASSERT_NEAR(samples[i].t, expected, 1e-9) << i;
    EXPECT_EQ(samples[i].wrench_R.force.y(), static_cast<double>(i % 200));
  }
  EXPECT_EQ(samples[0].outcome, "contact");
  EXPECT_NEAR(samples[0].computed, 2.5e-6, 1e-15);
  EXPECT_EQ(samples[0].H_WS.translation.z(), 0.03);
}

TEST_F(RecordedRunTest, RefusesWhatIsNoReplay) {
  std::ofstream(folder_ / "replay.csv") << "a,b\n";
  EXPECT_THROW(run(), command::Failure);
  EXPECT_THROW(RecordedRun(folder_ / "replay.csv", folder_ / "none.scene", {}), command::Failure);
}

TEST_F(RecordedRunTest, OnlyLooks) {
  RecordedRun run = this->run();
  EXPECT_NE(run.answer(ResetRequest{}), "");
  EXPECT_FALSE(run.settings());
}

}  // namespace
}  // namespace godobject::live::recorded_run_test
