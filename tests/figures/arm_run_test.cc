#include "toolchain/figures/arm_run.h"

#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

#include <gtest/gtest.h>

#include "tests/figures/replay_rows.h"
#include "toolchain/command_line/failure.h"
#include "toolchain/figures/arm_figure.h"

namespace godobject::figures {
namespace {

TelemetryRow cycle(double t, const std::string& mode, double share, std::vector<double> torque = {0.0, 0.0}) {
  TelemetryRow row;
  row.cycle = replay_row(t, share > 0.0 ? 4.0 : 0.0, -0.00002, share > 0.0 ? 3.0 : 0.0, 0.0, 0.0);
  row.mode = mode;
  row.share = share;
  row.torque = std::move(torque);
  return row;
}

/// Boot, two cycles of contact, end.
ArmLog run_in_order() {
  return {.cycles = {cycle(0.0, "boot", 0.0), cycle(0.001, "running", 1.0, {-30.0, 12.0}), cycle(0.002, "running", 1.0),
                     cycle(0.003, "ended", 0.0)},
          .hand = {{0.0, 5.0}, {0.001, 1.0}, {0.002, 1.5}, {0.003, 9.0}},
          .torque_limits = {100.0, 20.0}};
}

ArmRun judged(const ArmLog& log) {
  ArmRun run = arm_run(log, 0.006);
  run.name = "peg";
  run.voxel_size = 0.002;
  return run;
}

std::string verdict(const ArmRun& run) { return judge_arm_runs({run}).front(); }

TEST(ArmRun, CountsFromTheFirstRenderedCycleToTheLast) {
  ArmLog log = run_in_order();
  log.cycles[0].cycle.depth = 0.001;  // before rendering starts the depth does not count
  log.cycles[2].cycle.H_WD.translation = Vector3(0.003, 0.004, 0.0);
  const ArmRun run = judged(log);
  EXPECT_DOUBLE_EQ(run.seconds, 0.003);
  EXPECT_EQ(run.statistics.contact_cycles, 2u);
  EXPECT_EQ(run.statistics.penetration_max, -0.00002);
  EXPECT_DOUBLE_EQ(run.distance, 0.005);
  EXPECT_DOUBLE_EQ(run.torque, 0.6) << "12 of 20, not 30 of 100";
  EXPECT_EQ(run.torque_joint, 2);
  EXPECT_DOUBLE_EQ(run.work, 0.5);
  EXPECT_EQ(run.least_work, 0.0);
  EXPECT_FALSE(run.interrupted);
}

TEST(ArmRun, InOrderHoldsAllThatIsClaimed) {
  EXPECT_EQ(verdict(judged(run_in_order())),
            "HOLDS in every scene, closed loop: rendering without interruption, end without a fault; no sample "
            "point inside, the nearest is 0.0200 mm from the surface; joint torques of at most 60 % of their limits; "
            "the hand never receives more "
            "work than it did");
  EXPECT_TRUE(judge_arm_runs({}).empty());
}

TEST(ArmRun, ThatStopsIsMissed) {
  ArmLog log = run_in_order();
  log.cycles[1].fault = 14;
  EXPECT_EQ(verdict(judged(log)), "MISSED peg, closed loop: fault 14 ended the run");
  log = run_in_order();
  log.cycles.pop_back();
  EXPECT_EQ(verdict(judged(log)), "MISSED peg, closed loop: the last cycle is in mode running, not in mode ended");
  log = run_in_order();
  log.cycles.insert(log.cycles.begin() + 2, cycle(0.0015, "armed", 0.0));
  EXPECT_EQ(verdict(judged(log)), "MISSED peg, closed loop: rendering was interrupted or did not start");
}

TEST(ArmRun, WithoutContactShowsNothing) {
  ArmLog log = run_in_order();
  for (TelemetryRow& row : log.cycles) row.cycle.contacts = 0.0;
  EXPECT_EQ(verdict(judged(log)), "MISSED peg, closed loop: there was no contact");
}

TEST(ArmRun, ThatPenetratesPopsThroughOverloadsOrPushesIsMissed) {
  ArmLog log = run_in_order();
  log.cycles[2].cycle.depth = 0.0001;
  EXPECT_NE(verdict(judged(log)).find("is up to 0.100 mm, 0.05 voxels, inside, at 0.002 s"), std::string::npos);
  ArmRun run = judged(run_in_order());
  run.crossing = Crossing{.distance = 0.1, .t = 1.5};
  EXPECT_NE(verdict(run).find("goes 100.0 mm behind the surface, at 1.500 s"), std::string::npos);
  log = run_in_order();
  log.cycles[1].torque = {101.0, 0.0};
  EXPECT_NE(verdict(judged(log)).find("the torque of joint 1 is 101 % of its limit"), std::string::npos);
  log = run_in_order();
  log.hand[2].work = 0.9;  // below the first value, although the last one is above it
  EXPECT_NE(verdict(judged(log)).find("the hand received 0.1000 J more work than it did"), std::string::npos);
}

TEST(ArmRun, IsATableOf120Characters) {
  ArmRun run = judged(run_in_order());
  run.name = "arm-bunny-teapot";
  const std::string text = arm_table({run, run});
  for (std::size_t begin = 0; begin < text.size(); begin = text.find('\n', begin) + 1)
    EXPECT_LE(text.find('\n', begin) - begin, 120u);
}

TEST(ArmRun, IsDrawnWithItsModesAndItsJoints) {
  const ArmFigure figure{.title = "Peg", .facts = "", .markers = {{"A", 0.001}}, .log = run_in_order()};
  const std::string text = gnuplot_text(figure, "x.png");
  // the first two samples of each curve
  for (const char* const begin : {"$force << END\n0.0000 0\n0.0010 4\n", "$torque << END\n0.0000 0\n0.0010 0\n",
                                  "$distance << END\n0.0000 nan\n0.0010 0\n", "$depth << END\n0.0000 nan\n0.0010 -20\n",
                                  "$mode << END\n0.0000 0\n0.0010 1\n", "$joint1 << END\n0.0000 0\n0.0010 -30\n",
                                  "$joint2 << END\n0.0000 0\n0.0010 60\n"}) {
    EXPECT_NE(text.find(begin), std::string::npos) << begin;
  }
  EXPECT_NE(text.find("\n0.0030 9\n"), std::string::npos);
  EXPECT_NE(text.find("('boot' 0, 'running' 1, 'ended' 2)"), std::string::npos);
  EXPECT_NE(text.find("title 'joint 2'"), std::string::npos);
}

TEST(ArmRun, WantsTheDeviceFileOfItsArm) {
  const auto folder = std::filesystem::path(testing::TempDir()) / ("arm_run_test_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "telemetry.csv")
      << "t_s,late_us,compute_us,mode,fault,share,outcome,contacts,q1_rad,qd1_rad_s,torque1_Nm,dpx_m,dpy_m,dpz_m,dqw,"
         "dqx,dqy,dqz,gpx_m,gpy_m,gpz_m,gqw,gqx,"
         "gqy,gqz,fx_N,fy_N,fz_N,tx_Nm,ty_Nm,tz_Nm,depth_m,absorbed_J\n"
      << "0,0,0,boot,0,0,free,0,0,0,1,0,0,0,1,0,0,0,0,0,0,1,0,0,0,0,0,0,0,0,0,0,0\n";
  std::ofstream(folder / "hand.csv") << "t_s,hand_J\n0,0\n";
  std::ofstream(folder / "arm.toml") << "[[joint]]\ntorque = 7.5\n";
  EXPECT_EQ(read_arm_log(folder, folder / "arm.toml").torque_limits, std::vector<double>{7.5});
  std::ofstream(folder / "arm.toml") << "[[joint]]\ntorque = 7.5\n[[joint]]\ntorque = 7.5\n";
  try {
    (void)read_arm_log(folder, folder / "arm.toml");
    ADD_FAILURE() << "accepted";
  } catch (const command::Failure& failure) {
    EXPECT_NE(std::string(failure.what()).find("has 2 joints"), std::string::npos) << failure.what();
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace godobject::figures
