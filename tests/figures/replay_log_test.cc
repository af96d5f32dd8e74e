#include "toolchain/figures/replay_log.h"

#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

#include <gtest/gtest.h>

#include "toolchain/command_line/failure.h"
#include "toolchain/replay/replay.h"

namespace godobject::figures {
namespace {

using command::ExitCode;
using command::Failure;

// t, device pose, god-object pose, force, torque, depth, contacts, substeps, step1_ns, solve_ns, status
const std::string kFirst = "0.000,1,2,3,1,0,0,0,4,5,6,0,1,0,0,3,4,0,0,0,2,0.001,7,1,20000,400,contact\n";
const std::string kSecond = "0.001,1,2,3,1,0,0,0,4,5,6,0,1,0,0,0,0,0,0,0,0,-0.006,0,1,9000,100,free\n";

class ReplayLogFile : public testing::Test {
 protected:
  ~ReplayLogFile() override { std::filesystem::remove(file_); }

  const std::filesystem::path& holding(const std::string& rows) {
    std::ofstream(file_) << replay::kColumns << "\n" << rows;
    return file_;
  }

  void expect_refused(const std::string& rows, const std::string& place) {
    try {
      (void)read_replay_log(holding(rows));
      FAIL() << "accepted: " << rows;
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.exit_code(), ExitCode::kBadData);
      EXPECT_NE(std::string(failure.what()).find(file_.string() + place), std::string::npos) << failure.what();
    }
  }

  const std::filesystem::path file_ = std::filesystem::path(testing::TempDir()) /
                                      (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) +
                                       "_" + std::to_string(::getpid()) + ".csv");
};

TEST_F(ReplayLogFile, IsReadColumnByColumn) {
  const ReplayLog log = read_replay_log(holding(kFirst + kSecond));
  ASSERT_EQ(log.size(), 2u);
  EXPECT_EQ(log[0].H_WD.translation, Vector3(1, 2, 3));
  EXPECT_EQ(log[0].H_WD.rotation.w(), 1.0);
  EXPECT_EQ(log[0].H_WS.translation, Vector3(4, 5, 6));
  EXPECT_EQ(log[0].H_WS.rotation.x(), 1.0);
  EXPECT_EQ(log[0].wrench.force.norm(), 5.0);
  EXPECT_EQ(log[0].wrench.torque.norm(), 2.0);
  EXPECT_EQ(log[0].depth, 0.001);
  EXPECT_EQ(log[0].contacts, 7.0);
  EXPECT_EQ(log[0].step1_ns, 20000.0);
  EXPECT_EQ(log[0].solve_ns, 400.0);
  EXPECT_EQ(log[1].status, "free");
}

TEST_F(ReplayLogFile, NamesTheLineThatIsWrong) {
  expect_refused(kFirst + "0.001,1,2\n", ":3:");
  expect_refused(kFirst + kFirst, ":3:");                                                 // the same time twice
  expect_refused(kFirst + "x" + kSecond, ":3:");                                          // not a number
  expect_refused("0.000,1,2,3,1,0,0,0,nan" + kFirst.substr(kFirst.find(",5,6")), ":2:");  // not finite
  expect_refused(kFirst.substr(0, kFirst.size() - 1) + ",1\n", ":2:");                    // a field too many
}

TEST_F(ReplayLogFile, MayHoldABadDevicePoseInARowThatSaysSo) {
  const std::string bad = "0.001,nan,2,3,1,0,0,0,4,5,6,0,1,0,0,0,0,0,0,0,0,-0.006,0,1,9000,100,bad_input\n";
  EXPECT_EQ(read_replay_log(holding(kFirst + bad)).size(), 2u);
}

TEST_F(ReplayLogFile, MayHoldTheOverlapOfTheMeshes) {
  const auto holding_overlap = [&](const std::string& overlap) {
    std::ofstream(file_) << replay::kColumns << "," << replay::kOverlapColumn << "\n"
                         << kFirst.substr(0, kFirst.size() - 1) << overlap << "\n";
  };
  holding_overlap(",0.00025");
  EXPECT_EQ(read_replay_log(file_).at(0).status, "contact");
  for (const char* bad : {"", ",", ",x", ",nan", ",1,2"}) {
    holding_overlap(bad);
    EXPECT_THROW((void)read_replay_log(file_), Failure) << bad;
  }
}

TEST_F(ReplayLogFile, IsRefusedWithoutHeaderOrRows) {
  expect_refused("", ":2:");
  std::ofstream(file_) << kFirst;
  EXPECT_THROW((void)read_replay_log(file_), Failure);
}

TEST_F(ReplayLogFile, IsMissedByName) {
  try {
    (void)read_replay_log("no/such.csv");
    FAIL();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.exit_code(), ExitCode::kNoInput);
    EXPECT_NE(std::string(failure.what()).find("no/such.csv"), std::string::npos);
  }
}

TEST_F(ReplayLogFile, GivesTheNearestRowAndNoneBeyondItsSpan) {
  const ReplayLog log = read_replay_log(holding(kFirst + kSecond));
  EXPECT_EQ(row_at(log, 0.0004, file_).t, 0.0);
  EXPECT_EQ(row_at(log, 0.0006, file_).t, 0.001);
  EXPECT_THROW((void)row_at(log, 0.5, file_), Failure);
  EXPECT_THROW((void)row_at(log, -0.5, file_), Failure);
  try {
    (void)row_at(log, 0.5, file_);
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.exit_code(), ExitCode::kBadData);
    EXPECT_NE(std::string(failure.what()).find("choose a time within 0 .. 0.001 s"), std::string::npos);
  }
}

TEST_F(ReplayLogFile, NamesMomentsByTimeOrByDepth) {
  const ReplayLog log = read_replay_log(holding(kFirst + kSecond));
  ReplayLog deeper = log;
  deeper[1].depth = 0.002;
  EXPECT_EQ(moment("deepest", {&log}), 0.0);
  EXPECT_EQ(moment("deepest", {&log, &deeper}), 0.001);
  EXPECT_EQ(moment("1.25", {&log}), 1.25);
  EXPECT_FALSE(moment("1.25 s", {&log}));
  EXPECT_FALSE(moment("nan", {&log}));
}

}  // namespace
}  // namespace godobject::figures
