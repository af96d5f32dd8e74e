#include "firmware/controller/operator_notice.h"

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>
#include <thread>

#include <fmt/format.h>

#include "firmware/controller/warning.h"
#include "firmware/controller/work_calibration.h"
#include "firmware/cycle/cycles_in.h"
#include "firmware/cycle/supervisor.h"

namespace godobject::firmware {
namespace {

constexpr double kMoment = 3.0;  // [s] chosen: longer than an operator needs who knows what to do
constexpr double kBehind = 0.3;  // [s] chosen: a hand feels it by then

std::string why(const Standing& standing) {
  if (standing.fault != Fault::kAlarm) return describe(standing.fault);
  const std::string joint = standing.alarm_joint >= 0 ? fmt::format("joint {}: ", standing.alarm_joint + 1) : "";
  return joint + describe(standing.alarm);
}

/// Prints a line for each joint that is noted and was not in `said`, and notes it there.
void say_of_joints(std::atomic<std::uint8_t>& noted, std::uint8_t& said, const char* what) {
  const std::uint8_t joints = noted.exchange(0, std::memory_order_relaxed);
  for (int i = 0; i < kMaxJoints; ++i) {
    if (((joints & ~said) >> i & 1) != 0) warn(fmt::format("joint {}: {}", i + 1, what));
  }
  said = static_cast<std::uint8_t>(said | joints);
}

}  // namespace

void OperatorNotice::look() {
  const Standing standing = report_.standing.load(std::memory_order_relaxed);
  const bool waits = report_.waiting.load(std::memory_order_relaxed) > cycles_in(kMoment, period_);
  if (waits && !said_waiting_) {
    warn(standing.mode == Mode::kIdle ? "waits for the enable switch: release it, then hold it"
                                      : "waits with the arm held: the moving body touches or penetrates the still "
                                        "body, or the budget of work does not suffice to find out; move the tool away");
  }
  said_waiting_ = waits;
  const bool is_behind = report_.longest_behind.exchange(0, std::memory_order_relaxed) > cycles_in(kBehind, period_);
  if (is_behind && !said_behind_) {
    warn(
        fmt::format("the god object stays behind, so that the hand is held: each cycle spends its budget of work; "
                    "move back, end the run, and {}",
                    kMoreTime));
  }
  said_behind_ = is_behind;
  say_of_joints(report_.limited, said_limited_,
                "the drive limits its torque by itself (statusword bit 11), the force is too low; check its current "
                "limits, supply voltage and temperature");
  say_of_joints(report_.warm, said_warm_,
                "the drive is warmer than temperature.warn; let it rest, or the arm stops at temperature.stop");
  say_of_joints(report_.temperature_lost, said_lost_,
                "the drive did not answer for its temperature; the arm stops if it stays so");
  const bool stopped = standing.mode == Mode::kStopped && !refuses_to_start(standing.fault);
  if (stopped && !said_stopped_) {
    warn(fmt::format("stopped: {}; to go on, release enable switch and emergency stop, then kill -USR1 {}",
                     why(standing), ::getpid()));
  }
  said_stopped_ = stopped;
}

void OperatorNotice::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    look();
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
}

}  // namespace godobject::firmware
