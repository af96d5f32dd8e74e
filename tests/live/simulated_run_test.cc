#include "toolchain/live/simulated_run.h"

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <thread>

#include "tests/live/live_scene.h"
#include "tests/support/folder_test.h"

namespace godobject::live::simulated_run_test {
namespace {

class SimulatedRunTest : public test::FolderTest {
 protected:
  /// Takes samples until one fits. The limit of a minute is only for a run that never comes there.
  bool waits_for(SimulatedRun& run, const std::function<bool(const LiveSample&)>& fits) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (std::chrono::steady_clock::now() < end) {
      samples_.clear();
      run.take(samples_);
      for (const LiveSample& sample : samples_) {
        last_ = sample;
        if (fits(sample)) return true;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return false;
  }
  static bool runs(const LiveSample& sample) { return sample.mode == "running"; }

  firmware::ControllerConfig config_ = ball_in_hand(folder_);
  const HandRequest press_{{Quaternion::Identity(), Vector3(0.0, 0.0, 0.0)}};
  std::vector<LiveSample> samples_;
  LiveSample last_;
};

/// The ball rests at 30 mm; the hand wants it at 0.
TEST_F(SimulatedRunTest, HoldsABallThatAPagePressesOntoAPlate) {
  SimulatedRun run(config_, true);
  ASSERT_TRUE(waits_for(run, runs));
  ASSERT_EQ(run.answer(press_), "");
  ASSERT_TRUE(waits_for(run, [](const LiveSample& s) { return s.wrench_R.force.norm() > 3.0; }));
  EXPECT_EQ(last_.outcome, "contact");
  EXPECT_NEAR(last_.H_WS.translation.z(), 0.03, 1e-3);
  EXPECT_LT(last_.H_WD.translation.z(), last_.H_WS.translation.z());
  EXPECT_GT((run.placement()->mapping.H_WR.rotation._transformVector(last_.wrench_R.force)).z(), 2.9);
  ASSERT_EQ(run.answer(HandRequest{{Quaternion::Identity(), Vector3(0.0, 0.0, 0.05)}}), "");
  ASSERT_TRUE(
      waits_for(run, [](const LiveSample& s) { return s.outcome == "free" && s.H_WD.translation.z() > 0.045; }));
}

/// A page asks for a place that is far inside of the plate: the hand stops before it can do harm.
TEST_F(SimulatedRunTest, BoundsTheForceOfTheHand) {
  SimulatedRun run(config_, true);
  ASSERT_TRUE(waits_for(run, runs));
  ASSERT_EQ(run.answer(HandRequest{{exp_rotation(Vector3(3.0, 0.0, 0.0)), Vector3(0.0, 0.0, -50.0)}}), "");
  ASSERT_TRUE(waits_for(run, [](const LiveSample& s) { return s.wrench_R.force.norm() > 3.0; }));
  double largest = 0.0;
  const double until = last_.t + 1.5;
  ASSERT_TRUE(waits_for(run, [&](const LiveSample& s) {
    largest = std::max(largest, s.wrench_R.force.norm());
    return s.t > until;
  }));
  EXPECT_LT(largest, 40.0);
  EXPECT_EQ(last_.mode, "running");
  EXPECT_EQ(last_.fault, "");
}

TEST_F(SimulatedRunTest, ChangesTheSolverWhileItRuns) {
  SimulatedRun run(config_, true);
  ASSERT_TRUE(waits_for(run, runs));
  EXPECT_EQ(run.settings()->solver, Solver::kContact);
  ASSERT_EQ(run.answer(ChangeRequest{.solver = Solver::kCorrected, .friction = true}), "");
  EXPECT_EQ(run.settings()->solver, Solver::kCorrected);
  EXPECT_TRUE(run.settings()->friction);
  ASSERT_EQ(run.answer(press_), "");
  ASSERT_TRUE(waits_for(run, [](const LiveSample& s) { return s.wrench_R.force.norm() > 3.0; }));
  EXPECT_EQ(last_.mode, "running");
}

/// Whatever is changed while the hand presses: the body stays on the plate, and the force goes on.
TEST_F(SimulatedRunTest, HoldsThePlateThroughEachChange) {
  SimulatedRun run(config_, true);
  ASSERT_TRUE(waits_for(run, runs));
  ASSERT_EQ(run.answer(press_), "");
  ASSERT_TRUE(waits_for(run, [](const LiveSample& s) { return s.outcome == "contact"; }));
  for (const ChangeRequest& change :
       {ChangeRequest{.stiffness = 500.0}, ChangeRequest{.friction = true}, ChangeRequest{.solver = Solver::kCorrected},
        ChangeRequest{.solver = Solver::kContact}, ChangeRequest{.friction = false}, ChangeRequest{.damping = 2.0},
        ChangeRequest{.stiffness = 1000.0}}) {
    ASSERT_EQ(run.answer(change), "");
    const double settled = last_.t + 0.6;
    ASSERT_TRUE(waits_for(run, [&](const LiveSample& s) {
      EXPECT_GT(s.H_WS.translation.z(), 0.0285) << s.t;
      EXPECT_NE(s.outcome, "start_inside") << s.t;
      return s.t > settled;
    }));
    EXPECT_GT(last_.wrench_R.force.norm(), 2.0);
  }
}

/// Softer gains give less force at the same place.
TEST_F(SimulatedRunTest, ChangesTheStiffnessWhileItRuns) {
  SimulatedRun run(config_, true);
  ASSERT_TRUE(waits_for(run, runs));
  ASSERT_EQ(run.answer(ChangeRequest{.stiffness = 100.0}), "");
  ASSERT_EQ(run.answer(press_), "");
  ASSERT_TRUE(waits_for(run, [](const LiveSample& s) { return s.outcome == "contact"; }));
  const double rests = last_.t + 1.0;
  ASSERT_TRUE(waits_for(run, [&](const LiveSample& s) { return s.t > rests; }));
  const double stretch = (last_.H_WS.translation - last_.H_WD.translation).norm();
  EXPECT_GT(stretch, 0.005);
  EXPECT_NEAR(last_.wrench_R.force.norm() / stretch, 100.0, 5.0);
}

TEST_F(SimulatedRunTest, RefusesGainsBeyondTheBoundaryUnlessForced) {
  SimulatedRun run(config_, true);
  const double boundary = run.settings()->boundary;
  ASSERT_GT(boundary, 1000.0);
  const std::string why = run.answer(ChangeRequest{.stiffness = 1.1 * boundary});
  EXPECT_NE(why.find("beyond the stability boundary"), std::string::npos) << why;
  EXPECT_EQ(run.settings()->stiffness, 1000.0);
  EXPECT_EQ(run.answer(ChangeRequest{.stiffness = 1.1 * boundary, .beyond = true}), "");
  EXPECT_TRUE(run.settings()->beyond);
  EXPECT_EQ(run.answer(ChangeRequest{.stiffness = 0.5 * boundary}), "");
  EXPECT_FALSE(run.settings()->beyond);
  EXPECT_NE(run.answer(ChangeRequest{.stiffness = -1.0, .beyond = true}), "");
  EXPECT_NE(run.answer(ChangeRequest{.damping = -1.0}), "");
}

TEST_F(SimulatedRunTest, BeginsAgainAfterAReset) {
  SimulatedRun run(config_, true);
  ASSERT_TRUE(waits_for(run, runs));
  ASSERT_EQ(run.answer(ChangeRequest{.solver = Solver::kCorrected}), "");
  ASSERT_EQ(run.answer(ResetRequest{}), "");
  ASSERT_TRUE(waits_for(run, [](const LiveSample& s) { return s.mode == "boot"; }));
  ASSERT_TRUE(waits_for(run, runs));
  EXPECT_EQ(run.failure(), "");
  EXPECT_EQ(run.settings()->solver, Solver::kCorrected);
}

TEST_F(SimulatedRunTest, OnlyLooksWithoutAHand) {
  SimulatedRun run(config_, false);
  EXPECT_NE(run.answer(press_), "");
  EXPECT_NE(run.answer(ChangeRequest{.solver = Solver::kPaper}), "");
  EXPECT_NE(run.answer(ResetRequest{}), "");
}

}  // namespace
}  // namespace godobject::live::simulated_run_test
