#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "hal/cia402/can_drives.h"
#include "hal/clock.h"
#include "tests/hal/fake_bus.h"
#include "tests/hal/frames.h"

namespace godobject::hal {

inline constexpr int kOff = 0x0250;
inline constexpr int kReady = 0x0231;
inline constexpr int kSwitchedOn = 0x0233;
inline constexpr int kEnabled = 0x1237;     // follows the torque
inline constexpr int kBrakeOpens = 0x0237;  // does not yet
inline constexpr int kQuickStopActive = 0x0217;
inline constexpr int kFault = 0x0218;

inline CanFrame tpdo(int node, int statusword, std::int32_t count, std::int16_t permille) {
  const auto byte = [](auto value, int i) {
    return static_cast<int>(static_cast<std::uint32_t>(value) >> (8 * i) & 0xFF);
  };
  return frame(static_cast<std::uint16_t>(0x180 + node),
               {byte(statusword, 0), byte(statusword, 1), byte(count, 0), byte(count, 1), byte(count, 2),
                byte(count, 3), byte(permille, 0), byte(permille, 1)});
}

/// One bus: joint 0 is node 5, joint 1 is node 3 and turns the other way round, the panel is node 32.
class CanDrivesTest : public testing::Test {
 protected:
  static BusLayout layout() {
    BusLayout layout;
    layout.joint_count = 2;
    layout.read_back_interval = 50e-3;
    layout.drives[0] = {.bus = 0, .node = 5, .counts = 1000, .gear = 10.0, .rated_torque = 2.0};
    layout.drives[1] = {
        .bus = 0, .node = 3, .counts = 4000, .gear = 1.0, .rated_torque = 5.0, .sign = -1.0, .zero = 1.0};
    layout.panel = {.bus = 0, .node = 32};
    return layout;
  }

  /// Everything answers.
  void answer_all(int statusword) {
    bus_.receive_next(tpdo(5, statusword, count_0_, 100));
    bus_.receive_next(tpdo(3, statusword, count_1_, -50));
    bus_.receive_next(frame(0x1A0, {panel_inputs_}));
  }

  void heartbeats() {
    for (const int node : {5, 3, 32}) bus_.receive_next(frame(static_cast<std::uint16_t>(0x700 + node), {0x05}));
  }

  const JointReading& receive() {
    drives_.receive(reading_);
    return reading_;
  }

  /// A whole cycle in which everything answers; returns the RPDOs, and then what was sent behind SYNC.
  std::vector<CanFrame> cycle(int statusword, PowerRequest power = PowerRequest::kOff, double torque = 0.0) {
    drives_.request();
    if (++cycles_ % 20 == 0) heartbeats();
    answer_all(statusword);
    receive();
    const std::vector<CanFrame> requested = bus_.take_sent();
    JointCommand command;
    command.power = power;
    command.torque.head(2).setConstant(torque);
    sent_ = drives_.send(command);
    std::vector<CanFrame> sent = bus_.take_sent();
    for (const CanFrame& frame : requested) {
      if (frame.id != 0x080) sent.push_back(frame);
    }
    return sent;
  }

  /// The controlwords of both joints.
  static std::pair<int, int> controlwords(const std::vector<CanFrame>& sent) {
    return {sent.at(0).data[0] | sent.at(0).data[1] << 8, sent.at(1).data[0] | sent.at(1).data[1] << 8};
  }

  /// Alarm after one cycle with an extra frame in it.
  Alarm alarm_of(const CanFrame& extra) {
    drives_.request();
    answer_all(kOff);
    bus_.receive_next(extra);
    receive();
    drives_.send({});
    return reading_.alarm;
  }

  FakeBus bus_;
  std::array<CanBus*, 1> wires_ = {&bus_};
  CanDrives drives_{layout(), wires_, {.collect_ns = 500'000, .delay_s = 0.7e-3}};
  JointReading reading_;
  bool sent_ = false;
  int cycles_ = 0;
  int count_0_ = 0;
  int count_1_ = 0;
  int panel_inputs_ = 0x03;
};

class SleepingClock final : public Clock {
 public:
  std::int64_t now_ns() noexcept override { return now_ns_; }
  void sleep_until(std::int64_t ns) noexcept override {
    now_ns_ = std::max(now_ns_, ns);
    each_sleep(now_ns_);
  }

  std::function<void(std::int64_t)> each_sleep = [](std::int64_t) {};

 private:
  std::int64_t now_ns_ = 0;
};

}  // namespace godobject::hal
