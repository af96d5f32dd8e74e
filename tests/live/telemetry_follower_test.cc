#include "toolchain/live/telemetry_follower.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "firmware/cycle/fault.h"
#include "tests/live/live_scene.h"
#include "tests/support/folder_test.h"
#include "toolchain/command_line/failure.h"

namespace godobject::live::telemetry_follower_test {
namespace {

const char* const kHeader =
    "t_s,late_us,compute_us,mode,fault,share,outcome,contacts,lost,q1_rad,q2_rad,qd1_rad_s,qd2_rad_s,torque1_Nm,"
    "torque2_Nm,dpx_m,dpy_m,"
    "dpz_m,dqw,dqx,dqy,dqz,gpx_m,gpy_m,gpz_m,gqw,gqx,gqy,gqz,fx_N,fy_N,fz_N,tx_Nm,ty_Nm,tz_Nm,depth_m,absorbed_J\n";

std::string row(double t) {
  return fmt::format(
      "{:.6f},3,25,running,0,1,contact,4,0,0.5,-0.25,9,10,7,8,1,2,3,1,0,0,0,4,5,6,0.5,0.5,0.5,0.5,7,8,9,0.1,0.2,0.3,-"
      "1e-"
      "5,"
      "0.01\n",
      t);
}

class TelemetryFollowerTest : public test::FolderTest {
 protected:
  TelemetryFollowerTest() {
    config_ = ball_in_hand(folder_);
    config_.telemetry.folder = folder_;
    follower_.emplace(config_);
  }

  void append(const std::string& text) { std::ofstream(file_, std::ios::app) << text; }
  void replace(const std::string& text) {
    std::filesystem::remove(file_);
    append(text);
  }
  std::vector<double> times() {
    std::vector<LiveSample> samples;
    follower_->take(samples);
    std::vector<double> times;
    for (const LiveSample& sample : samples) times.push_back(sample.t);
    return times;
  }

  const std::filesystem::path file_ = folder_ / "telemetry.csv";
  firmware::ControllerConfig config_;
  std::optional<TelemetryFollower> follower_;
};

using Times = std::vector<double>;

TEST_F(TelemetryFollowerTest, ReadsEachColumn) {
  append(kHeader + row(0.001));
  std::vector<LiveSample> samples;
  follower_->take(samples);
  ASSERT_EQ(samples.size(), 1u);
  const LiveSample& sample = samples.front();
  EXPECT_EQ(sample.t, 0.001);
  EXPECT_NEAR(sample.late, 3e-6, 1e-15);
  EXPECT_NEAR(sample.computed, 25e-6, 1e-15);
  EXPECT_EQ(sample.mode, "running");
  EXPECT_EQ(sample.fault, "");
  EXPECT_EQ(sample.outcome, "contact");
  EXPECT_EQ(sample.contacts, 4.0);
  EXPECT_EQ(sample.q[0], 0.5);
  EXPECT_EQ(sample.q[1], -0.25);
  EXPECT_EQ(sample.qd.head<2>(), Eigen::Vector2d(9.0, 10.0));
  EXPECT_EQ(sample.torque.head<2>(), Eigen::Vector2d(7.0, 8.0));
  EXPECT_EQ(sample.H_WD.translation, Vector3(1.0, 2.0, 3.0));
  EXPECT_EQ(sample.H_WD.rotation.w(), 1.0);
  EXPECT_EQ(sample.H_WS.translation, Vector3(4.0, 5.0, 6.0));
  EXPECT_EQ(sample.H_WS.rotation.z(), 0.5);
  EXPECT_EQ(sample.wrench_R.force, Vector3(7.0, 8.0, 9.0));
  EXPECT_EQ(sample.wrench_R.torque, Vector3(0.1, 0.2, 0.3));
  EXPECT_EQ(sample.depth, -1e-5);
  EXPECT_EQ(sample.absorbed, 0.01);
}

/// A page is not empty before there is a telemetry: it shows where the mesh will begin.
TEST_F(TelemetryFollowerTest, SaysThatItWaits) {
  std::vector<LiveSample> samples;
  follower_->take(samples);
  follower_->take(samples);
  ASSERT_EQ(samples.size(), 1u);
  EXPECT_NE(samples[0].mode.find("telemetry.csv"), std::string::npos);
  EXPECT_EQ(samples[0].H_WD.translation, config_.workspace.start.translation);
  EXPECT_EQ(samples[0].q, config_.workspace.posture);
}

TEST_F(TelemetryFollowerTest, WaitsForTheFileAndForTheEndOfALine) {
  EXPECT_EQ(times(), Times{0.0}) << "the sample of a page that waits";
  append(std::string(kHeader).substr(0, 20));
  EXPECT_EQ(times(), Times{});
  append(std::string(kHeader).substr(20));
  EXPECT_EQ(times(), Times{});
  const std::string second = row(0.002);
  append(row(0.001) + second.substr(0, 5));
  EXPECT_EQ(times(), Times{0.001});
  EXPECT_EQ(times(), Times{});
  append(second.substr(5) + row(0.003));
  EXPECT_EQ(times(), (Times{0.002, 0.003}));
  EXPECT_EQ(follower_->lost(), 0u);
}

TEST_F(TelemetryFollowerTest, FollowsTheNextRun) {
  append(kHeader + row(5.0) + row(5.001));
  EXPECT_EQ(times().size(), 2u);
  replace(kHeader + row(0.001));  // another file
  EXPECT_EQ(times(), Times{0.001});
  std::filesystem::resize_file(file_, 0);  // as a run that opens the same file does
  times();
  append(kHeader + row(0.002));
  EXPECT_EQ(times(), Times{0.002});
}

/// The controller gives each run a folder of its own, and lets links lead to the newest.
TEST_F(TelemetryFollowerTest, FollowsTheLinkToTheNextRun) {
  const auto begin_run = [this](const std::string& name, const std::string& rows) {
    std::filesystem::create_directory(folder_ / name);
    std::ofstream(folder_ / name / "telemetry.csv") << kHeader << rows;
    std::filesystem::create_symlink(name, folder_ / ".latest");
    std::filesystem::rename(folder_ / ".latest", folder_ / "latest");
  };
  std::filesystem::create_symlink("latest/telemetry.csv", file_);
  EXPECT_EQ(times(), Times{0.0}) << "no run yet";
  begin_run("one", row(5.0));
  EXPECT_EQ(times(), Times{5.0});
  append(row(5.001));
  EXPECT_EQ(times(), Times{5.001});
  begin_run("two", row(6.0));
  EXPECT_EQ(times(), Times{6.0});
  std::ofstream(folder_ / "one" / "telemetry.csv", std::ios::app) << row(5.002);
  append(row(6.001));
  EXPECT_EQ(times(), Times{6.001}) << "the first run is left";
}

/// A new run has written as many bytes as the one before, between two looks.
TEST_F(TelemetryFollowerTest, FollowsTheNextRunOfTheSameLength) {
  append(kHeader + row(5.0) + row(5.001));
  EXPECT_EQ(times().size(), 2u);
  std::ofstream(file_, std::ios::trunc) << kHeader << row(0.001) << row(0.002);
  append(row(0.003));
  times();  // finds that the time has gone back
  EXPECT_EQ(times(), (Times{0.001, 0.002, 0.003}));
}

TEST_F(TelemetryFollowerTest, SkipsTheBeginOfALongFile) {
  std::string text = kHeader;
  for (int i = 1; i <= 20000; ++i) text += row(1e-3 * i);
  append(text);
  const Times read = times();
  ASSERT_GT(read.size(), 1000u);
  EXPECT_LT(read.size(), 15000u);
  EXPECT_EQ(read.back(), 20.0);
  for (std::size_t i = 1; i < read.size(); ++i) ASSERT_NEAR(read[i] - read[i - 1], 1e-3, 1e-9);
  EXPECT_EQ(follower_->lost(), 0u);
  append(row(20.001));
  EXPECT_EQ(times(), Times{20.001});
}

TEST_F(TelemetryFollowerTest, CountsLinesThatAreNoRow) {
  append(kHeader + row(0.001) + "rubbish\n" + "x" + row(0.002) + "\n" + row(0.003));
  EXPECT_EQ(times(), (Times{0.001, 0.003}));
  EXPECT_EQ(follower_->lost(), 3u);
}

TEST_F(TelemetryFollowerTest, DescribesFaults) {
  std::string stopped = row(0.002);
  stopped.replace(stopped.find(",0,1,contact"), 2, ",17");
  std::string unknown = row(0.003);
  unknown.replace(unknown.find(",0,1,contact"), 2, ",9999");  // of a later version
  append(kHeader + row(0.001) + stopped + unknown);
  std::vector<LiveSample> samples;
  follower_->take(samples);
  ASSERT_EQ(samples.size(), 3u);
  EXPECT_EQ(samples[0].fault, "");
  EXPECT_EQ(samples[1].fault_number, 17);
  EXPECT_EQ(samples[1].fault, describe(static_cast<firmware::Fault>(17)));
  EXPECT_EQ(samples[2].fault, "");
}

TEST_F(TelemetryFollowerTest, RefusesAFileThatIsNoTelemetry) {
  append("a,b\n1,2\n");
  try {
    times();
    ADD_FAILURE() << "a file with other columns is followed";
  } catch (const command::Failure& failure) {
    EXPECT_EQ(failure.exit_code(), command::ExitCode::kBadData);
    EXPECT_NE(std::string(failure.what()).find("telemetry.csv:1: has no column t_s"), std::string::npos);
  }
}

TEST_F(TelemetryFollowerTest, OnlyLooks) { EXPECT_NE(follower_->answer(ResetRequest{}), ""); }

}  // namespace
}  // namespace godobject::live::telemetry_follower_test
