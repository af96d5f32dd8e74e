#include "firmware/controller/operator_notice.h"

#include <gtest/gtest.h>
#include <time.h>
#include <unistd.h>

#include <chrono>
#include <string>
#include <thread>

namespace godobject::firmware::operator_notice_test {
namespace {

class OperatorNoticeTest : public testing::Test {
 protected:
  /// The line that the operator gets for this state; empty: none.
  std::string told(Mode mode, std::uint32_t waiting, Fault fault = Fault::kNone, hal::Alarm alarm = hal::Alarm::kNone,
                   int joint = -1) {
    report_.standing = Standing{mode, fault, alarm, static_cast<std::int8_t>(joint)};
    report_.waiting = waiting;
    testing::internal::CaptureStderr();
    notice_.look();
    return testing::internal::GetCapturedStderr();
  }

  RunReport report_;
  OperatorNotice notice_{report_, 1e-3};
};

const std::string kIdle = "firmware_session_test: waits for the enable switch: release it, then hold it\n";
const std::string kArmed =
    "firmware_session_test: waits with the arm held: the moving body touches or penetrates the still body, or the "
    "budget of work does not suffice to find out; move the tool away\n";

TEST_F(OperatorNoticeTest, SaysOnceThatItWaitsForLongerThanThreeSeconds) {
  for (const auto& [mode, line] : {std::pair{Mode::kIdle, kIdle}, {Mode::kArmed, kArmed}}) {
    EXPECT_EQ(told(mode, 0), "");
    EXPECT_EQ(told(mode, 3000), "");
    EXPECT_EQ(told(mode, 3001), line);
    EXPECT_EQ(told(mode, 9000), "") << "once";
    EXPECT_EQ(told(Mode::kRunning, 0), "");
    EXPECT_EQ(told(mode, 3001), line) << "another occasion";
    told(Mode::kRunning, 0);
  }
}

TEST_F(OperatorNoticeTest, SaysOnceForEachJointThatItsDriveLimitsTheTorque) {
  const auto line = [](int joint) {
    return "firmware_session_test: joint " + std::to_string(joint) +
           ": the drive limits its torque by itself (statusword bit 11), the force is too low; check its current "
           "limits, supply voltage and temperature\n";
  };
  EXPECT_EQ(told(Mode::kRunning, 0), "");
  report_.limited = 0b1000001;
  EXPECT_EQ(told(Mode::kRunning, 0), line(1) + line(7));
  EXPECT_EQ(told(Mode::kRunning, 0), "") << "it is over";
  report_.limited = 0b1000011;
  EXPECT_EQ(told(Mode::kRunning, 0), line(2)) << "a limit that comes and goes is told once";
}

TEST_F(OperatorNoticeTest, SaysOnceForEachJointThatItsDriveIsWarmOrSilent) {
  report_.warm = 0b10;
  report_.temperature_lost = 0b1;
  EXPECT_EQ(
      told(Mode::kIdle, 0),
      "firmware_session_test: joint 2: the drive is warmer than temperature.warn; let it rest, or the arm stops at "
      "temperature.stop\nfirmware_session_test: joint 1: the drive did not answer for its temperature; the arm "
      "stops if it stays so\n");
  report_.warm = 0b10;
  report_.temperature_lost = 0b1;
  EXPECT_EQ(told(Mode::kIdle, 0), "");
}

TEST_F(OperatorNoticeTest, CountsTheCyclesOfItsPeriod) {
  for (const auto& [period, waits, behind] : {std::tuple{0.25e-3, 12000u, 1200u}, std::tuple{10e-3, 300u, 30u}}) {
    OperatorNotice notice(report_, period);
    const auto told_by = [&](std::uint32_t waiting, std::uint32_t stays) {
      report_.standing = {.mode = Mode::kIdle};
      report_.waiting = waiting;
      report_.longest_behind = stays;
      testing::internal::CaptureStderr();
      notice.look();
      return testing::internal::GetCapturedStderr();
    };
    EXPECT_EQ(told_by(waits, behind), "") << period;
    EXPECT_EQ(told_by(waits + 1, 0), kIdle);
    EXPECT_NE(told_by(waits + 1, behind + 1).find("stays behind"), std::string::npos);
  }
}

/// Also if it has waited for long when it is first looked at.
TEST_F(OperatorNoticeTest, SaysAtTheFirstLookThatItWaits) { EXPECT_EQ(told(Mode::kIdle, 9000), kIdle); }

TEST_F(OperatorNoticeTest, SaysOnceThatTheGodObjectStaysBehind) {
  const auto told_at = [this](std::uint32_t behind) {
    report_.longest_behind = behind;
    return told(Mode::kRunning, 0);
  };
  const std::string line =
      "firmware_session_test: the god object stays behind, so that the hand is held: each cycle spends its budget of "
      "work; move back, end the run, and raise loop.compute, and loop.cycle_budget if it is set, or compile the scene "
      "with fewer points or with point_budget\n";
  EXPECT_EQ(told_at(300), "");
  EXPECT_EQ(told_at(301), line);
  EXPECT_EQ(told_at(900), "") << "once";
  EXPECT_EQ(told_at(0), "");
  EXPECT_EQ(told_at(301), line) << "another occasion";
  EXPECT_EQ(report_.longest_behind, 0u) << "so that a stay between two looks is told, and one only once";
}

TEST_F(OperatorNoticeTest, SaysOnceWhyItHasStoppedAndHowToGoOn) {
  const auto line = [](const std::string& why) {
    return "firmware_session_test: stopped: " + why +
           "; to go on, release enable switch and emergency stop, then kill -USR1 " + std::to_string(::getpid()) + "\n";
  };
  EXPECT_EQ(told(Mode::kStopping, 0, Fault::kTooFast), "") << "the arm still moves";
  EXPECT_EQ(told(Mode::kStopped, 0, Fault::kTooFast), line(describe(Fault::kTooFast)));
  EXPECT_EQ(told(Mode::kStopped, 0, Fault::kTooFast), "") << "once";
  EXPECT_EQ(told(Mode::kBoot, 0), "");
  const std::string alarm = describe(hal::Alarm::kNodeReset);
  EXPECT_EQ(told(Mode::kStopped, 0, Fault::kAlarm, hal::Alarm::kNodeReset, 0), line("joint 1: " + alarm));
  told(Mode::kBoot, 0);
  EXPECT_EQ(told(Mode::kStopped, 0, Fault::kAlarm, hal::Alarm::kNodeReset, 6), line("joint 7: " + alarm));
  told(Mode::kBoot, 0);
  EXPECT_EQ(told(Mode::kStopped, 0, Fault::kAlarm, hal::Alarm::kNodeReset), line(alarm));
  told(Mode::kBoot, 0);
  EXPECT_EQ(told(Mode::kStopped, 0, Fault::kSignWrong), "") << "the run ends with this fault and says so itself";
}

TEST_F(OperatorNoticeTest, RunsUntilItIsAskedToStop) {
  report_.standing = Standing{Mode::kIdle, Fault::kNone, hal::Alarm::kNone, -1};
  report_.waiting = 4000;
  testing::internal::CaptureStderr();
  std::stop_source stop;
  stop.request_stop();
  notice_.run(stop.get_token());
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << "asked before it looked";
}

/// The thread beside the loop takes little of the processor's time.
TEST_F(OperatorNoticeTest, SleepsBetweenTwoLooks) {
  const auto own_ms = [] {
    timespec time{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
  };
  double took_ms = 0.0;
  std::jthread thread([&](const std::stop_token& stop) {
    const double before_ms = own_ms();
    notice_.run(stop);
    took_ms = own_ms() - before_ms;
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  thread.request_stop();
  thread.join();
  EXPECT_LT(took_ms, 30.0);
}

}  // namespace
}  // namespace godobject::firmware::operator_notice_test
