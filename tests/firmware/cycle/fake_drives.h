#pragma once

#include <algorithm>

#include "hal/joint_drives.h"

namespace godobject::firmware {

/// Drives of an arm whose joints are where a test puts them. They do what they are asked a cycle later; a test sets
/// what else is read, and looks at what was sent.
class FakeDrives final : public hal::JointDrives {
 public:
  explicit FakeDrives(int joint_count) : joint_count_(joint_count) { reading.enable_switch = true; }

  int joint_count() const noexcept override { return joint_count_; }
  void request() noexcept override { ++requests; }
  std::int64_t collect_ns() const noexcept override { return 0; }
  /// The enable switch is released at first, as who asks for power must have it.
  void receive(hal::JointReading& out) noexcept override {
    out = reading;
    out.enable_switch = reading.enable_switch && ++receives_ > kReleased;
  }
  double delay() const noexcept override { return torque_delay; }

  bool send(const hal::JointCommand& command) noexcept override {
    sent = command;
    ++sends;
    if (follows_torque) reading.torque = command.torque;
    using hal::DriveState;
    for (int i = 0; i < joint_count_; ++i) {
      DriveState& state = reading.state[static_cast<std::size_t>(i)];
      switch (command.power) {
        case hal::PowerRequest::kEnable:
          if (state == DriveState::kOff) state = DriveState::kEnabled;
          break;
        case hal::PowerRequest::kReset:
          if (state == DriveState::kFault) state = DriveState::kOff;
          break;
        case hal::PowerRequest::kOff:
        case hal::PowerRequest::kQuickStop:
          if (state == DriveState::kEnabled) state = DriveState::kOff;
          break;
      }
    }
    return !fails_to_send;
  }

  hal::JointReading reading;
  hal::JointCommand sent;
  int requests = 0;
  int sends = 0;
  bool fails_to_send = false;
  bool follows_torque = true;  ///< measures the torque that was sent
  double torque_delay = 1e-3;  ///< from a position's sample to the torque [s]

 private:
  static constexpr int kReleased = 150;

  int joint_count_;
  int receives_ = 0;
};

}  // namespace godobject::firmware
