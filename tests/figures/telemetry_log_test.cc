#include "toolchain/figures/telemetry_log.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

#include <gtest/gtest.h>

#include "toolchain/command_line/failure.h"

namespace godobject::figures {
namespace {

using command::ExitCode;
using command::Failure;

const std::string kHeader =
    "t_s,late_us,compute_us,mode,fault,share,outcome,contacts,lost,q1_rad,q2_rad,qd1_rad_s,qd2_rad_s,torque1_Nm,"
    "torque2_Nm,dpx_m,dpy_m,dpz_m,dqw,dqx,dqy,dqz,gpx_m,gpy_m,gpz_m,gqw,gqx,gqy,gqz,fx_N,fy_N,fz_N,tx_Nm,ty_Nm,tz_Nm,"
    "depth_m,absorbed_J\n";
const std::string kBoot =
    "0.000000,0,0,boot,0,0,free,0,0,0,0,0,0,5,-6,1,2,3,1,0,0,0,1,2,3,1,0,0,0,0,0,0,0,0,0,-0.006,0\n";
const std::string kRunning =
    "0.001000,2,40,running,0,0.5,contact,7,0,0.25,-0.5,1.25,-1.5,5.5,-6.5,1,2,3,1,0,0,0,4,5,6,0,1,0,0,3,4,0,0,0,2,"
    "-0.00002,0.75\n";

class TelemetryLogFile : public testing::Test {
 protected:
  ~TelemetryLogFile() override { std::filesystem::remove(file_); }

  const std::filesystem::path& holding(const std::string& text) {
    std::ofstream(file_) << text;
    return file_;
  }

  void expect_refused(const std::string& text, const std::string& part) {
    try {
      (void)read_telemetry_log(holding(text));
      FAIL() << "accepted: " << text;
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.exit_code(), ExitCode::kBadData);
      EXPECT_NE(std::string(failure.what()).find(part), std::string::npos) << failure.what();
    }
  }

  const std::filesystem::path file_ =
      std::filesystem::path(testing::TempDir()) /
      (std::string("telemetry_") + testing::UnitTest::GetInstance()->current_test_info()->name() + "_" +
       std::to_string(::getpid()) + ".csv");
};

TEST_F(TelemetryLogFile, IsReadByTheNamesOfItsColumns) {
  const TelemetryLog log = read_telemetry_log(holding(kHeader + kBoot + kRunning));
  ASSERT_EQ(log.size(), 2u);
  EXPECT_EQ(log[0].mode, "boot");
  EXPECT_EQ(log[0].torque, (std::vector<double>{5.0, -6.0}));
  const TelemetryRow& row = log[1];
  EXPECT_EQ(row.cycle.t, 0.001);
  EXPECT_DOUBLE_EQ(row.late, 2e-6);
  EXPECT_DOUBLE_EQ(row.compute, 40e-6);
  EXPECT_EQ(row.absorbed, 0.75);
  EXPECT_EQ(row.position, (std::vector<double>{0.25, -0.5}));
  EXPECT_EQ(row.velocity, (std::vector<double>{1.25, -1.5}));
  EXPECT_EQ(row.torque, (std::vector<double>{5.5, -6.5}));
  EXPECT_EQ(row.share, 0.5);
  EXPECT_EQ(row.fault, 0);
  EXPECT_EQ(row.cycle.status, "contact");
  EXPECT_EQ(row.cycle.contacts, 7.0);
  EXPECT_EQ(row.cycle.depth, -0.00002);
  EXPECT_EQ(row.cycle.H_WD.translation, Vector3(1, 2, 3));
  EXPECT_EQ(row.cycle.H_WS.translation, Vector3(4, 5, 6));
  EXPECT_EQ(row.cycle.H_WS.rotation.x(), 1.0);
  EXPECT_EQ(row.cycle.wrench.force, Vector3(3, 4, 0));
  EXPECT_EQ(row.cycle.wrench.torque, Vector3(0, 0, 2));
}

TEST_F(TelemetryLogFile, IsAReplayOfTheCyclesThatRendered) {
  const ReplayLog log = read_replay_log(holding(kHeader + kBoot + kRunning));
  ASSERT_EQ(log.size(), 1u);
  EXPECT_EQ(log[0].t, 0.001);
  EXPECT_EQ(log[0].depth, -0.00002);
  EXPECT_THROW((void)read_replay_log(holding(kHeader + kBoot)), Failure) << "no cycle rendered";
}

TEST_F(TelemetryLogFile, NamesWhatIsWrong) {
  expect_refused("", "is empty");
  expect_refused(kHeader, "holds no cycle");
  expect_refused(kHeader + kBoot + "0.001,1,2\n", ":3: has 3 fields, not 37");
  expect_refused(kHeader + kRunning + kBoot, ":3: t_s does not increase");
  std::string text = kHeader + kBoot;
  text.replace(text.find("-0.006"), 6, "nan");
  expect_refused(text, ":2: depth_m is \"nan\"");
  text = kHeader;
  text.replace(text.find("share"), 5, "chair");
  expect_refused(text + kBoot, ":1: has no column share");
  text = "t_s,mode,fault,share,outcome,contacts,depth_m\n";
  expect_refused(text + "0,boot,0,0,free,0,0\n", ":1: has no column");
}

/// The wrench is along the axes of the room: a turn by 90 degrees about x takes y to z. An older telemetry has no turn.
TEST_F(TelemetryLogFile, TurnsTheWrenchToTheAxesOfTheScene) {
  const auto with = [](std::string line, const char* more) { return line.insert(line.size() - 1, more); };
  const TelemetryLog turned = read_telemetry_log(
      holding(with(kHeader, ",wqw,wqx,wqy,wqz") + with(kRunning, ",0.70710678118654757,0.70710678118654757,0,0")));
  EXPECT_EQ(turned[0].cycle.wrench.force, Vector3(3, 4, 0)) << "as it is";
  const ReplayLog cycles = rendered(turned);
  EXPECT_TRUE(cycles[0].wrench.force.isApprox(Vector3(3, 0, 4), 1e-12)) << cycles[0].wrench.force.transpose();
  EXPECT_TRUE(cycles[0].wrench.torque.isApprox(Vector3(0, -2, 0), 1e-12)) << cycles[0].wrench.torque.transpose();
  EXPECT_EQ(rendered(read_telemetry_log(holding(kHeader + kRunning)))[0].wrench.force, Vector3(3, 4, 0));
}

/// A telemetry without joints, times and energy is read; what it lacks is empty or no number, not zero.
TEST_F(TelemetryLogFile, NeedsNoColumnsOfJointsTimesAndEnergy) {
  std::string text = kHeader;
  for (const char* name : {"late_us", "compute_us", "q1_rad", "q2_rad", "qd1_rad_s", "qd2_rad_s", "absorbed_J"}) {
    text.replace(text.find(name), 1, "x");
  }
  const TelemetryRow row = read_telemetry_log(holding(text + kBoot)).front();
  EXPECT_TRUE(row.position.empty());
  EXPECT_TRUE(row.velocity.empty());
  EXPECT_EQ(row.torque.size(), 2u);
  for (const double missing : {row.late, row.compute, row.absorbed}) EXPECT_TRUE(std::isnan(missing));
}

TEST_F(TelemetryLogFile, HasTheWorkOfTheHandBesideIt) {
  const auto hand = read_hand_log(holding("t_s,hand_J\n0.000000,0\n0.001000,-0.25\n"));
  ASSERT_EQ(hand.size(), 2u);
  EXPECT_EQ(hand[1].t, 0.001);
  EXPECT_EQ(hand[1].work, -0.25);
  EXPECT_THROW((void)read_hand_log(holding("t_s,hand_J\n")), Failure);
}

}  // namespace
}  // namespace godobject::figures
