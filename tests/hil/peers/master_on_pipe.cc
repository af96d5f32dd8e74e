// CanDrives on a pipe (FramePipe) with a drive, node 5, and a panel, node 20h, of another library. Prints its progress
// on stderr. Exit: 0 passed, 1 failed.
#include <cmath>
#include <cstdio>
#include <deque>

#include "hal/cia402/can_drives.h"
#include "hal/linux/monotonic_clock.h"
#include "tests/hil/peers/frame_pipe.h"

namespace {

using namespace godobject;

/// A bus on a pipe. Own frames are received again, before all later frames.
class PipeBus final : public hal::CanBus {
 public:
  hal::SendResult send(const hal::CanFrame& frame) noexcept override {
    pipe_.write(frame);
    own_.push_back(frame);
    return hal::SendResult::kSent;
  }
  bool receive(hal::ReceivedFrame& received) noexcept override {
    received = {};
    received.own = !own_.empty();
    if (!received.own) return pipe_.read(received.frame);
    received.frame = own_.front();
    own_.pop_front();
    return true;
  }
  hal::BusHealth health() const noexcept override { return {}; }

 private:
  test::FramePipe pipe_;
  std::deque<hal::CanFrame> own_;
};

/// Runs cycles of 10 ms. The other side, an interpreter, has 8 ms of each cycle for its answer.
class Cycles {
 public:
  Cycles(hal::CanDrives& drives, hal::Clock& clock) : drives_(drives), clock_(clock) {}

  /// Runs cycles until `done` returns true, for at most 3 s.
  template <class Done>
  bool run(hal::PowerRequest power, double torque, Done&& done) {
    hal::JointCommand command;
    command.power = power;
    command.torque[0] = torque;
    for (int i = 0; i < 300; ++i) {
      drives_.request();
      clock_.sleep_until(clock_.now_ns() + 8'000'000);
      drives_.receive(reading);
      drives_.send(command);
      clock_.sleep_until(clock_.now_ns() + 2'000'000);
      if (done()) return true;
    }
    return false;
  }

  hal::JointReading reading;

 private:
  hal::CanDrives& drives_;
  hal::Clock& clock_;
};

bool check(bool good, const char* what) {
  std::fprintf(stderr, "%s: %s\n", what, good ? "yes" : "NO");
  return good;
}

}  // namespace

int main() {
  hal::BusLayout layout;
  layout.period = 10e-3;
  layout.command_deadline = 0.5;
  layout.heartbeat_timeout = 1.0;
  layout.joint_count = 1;
  layout.drives[0] = {.bus = 0, .node = 5, .counts = 65536, .gear = 100, .rated_torque = 2.0, .sign = -1, .zero = 0.25};
  layout.panel.bus = 0;
  PipeBus bus;
  hal::CanBus* const buses[] = {&bus};
  hal::MonotonicClock clock;
  hal::CanDrives drives(layout, buses, {.collect_ns = 8'000'000, .delay_s = 8e-3});
  const hal::BringUpResult result = drives.bring_up(clock);
  if (result.status != hal::BringUpStatus::kOk) {
    std::fprintf(stderr, "node %d, %04X:%d: %s; expected %X, found %X\n", result.node, result.index, result.subindex,
                 describe(result.status), result.expected, result.found);
    return 1;
  }
  Cycles cycles(drives, clock);
  hal::JointReading& reading = cycles.reading;
  using enum hal::PowerRequest;

  // 12345 of 6553600 counts per turn, and 10 Nm, 50 permille of 200 Nm: both against the joint's direction
  constexpr double kPosition = 0.25 - 2.0 * M_PI * 12345.0 / 6553600.0;
  bool good = check(cycles.run(kEnable, 0.0, [&] { return reading.state[0] == hal::DriveState::kEnabled; }), "enabled");
  good = good && check(std::fabs(reading.position[0] - kPosition) < 1e-12, "position");
  good = good && check(reading.enable_switch && !reading.emergency_stop && !reading.clutch_open, "panel");
  good = good && check(cycles.run(kEnable, 10.0, [&] { return std::fabs(reading.torque[0] - 10.0) < 1e-9; }), "torque");
  good = good && check(reading.alarm == hal::Alarm::kNone, "no alarm");
  good =
      good && check(cycles.run(kQuickStop, 0.0, [&] { return reading.state[0] == hal::DriveState::kOff; }), "stopped");
  good = good && check(cycles.run(kOff, 0.0, [&] { return reading.alarm == hal::Alarm::kDriveError; }), "its error");
  drives.stop_nodes();
  return good ? 0 : 1;
}
