#pragma once

#include "firmware/cycle/supervisor.h"

namespace godobject::firmware {

/// Three joints of 1 Nm.
inline ArmModel three_joints() {
  ArmModel arm;
  arm.joint_count = 3;
  for (int i = 0; i < 3; ++i) arm.joints[static_cast<std::size_t>(i)].torque = 1.0;
  return arm;
}

/// A short start. The sign test is left out unless asked for.
inline Supervisor::Parameters short_start(bool sign_test = false) {
  Supervisor::Parameters p;
  p.boot_cycles = 300;
  p.engage_cycles = 10;
  p.sign_test = sign_test;
  return p;
}

/// A supervisor among drives that do what they are asked a cycle later.
class Bench {
 public:
  explicit Bench(const Supervisor::Parameters& p = short_start()) : supervisor(three_joints(), p) {
    seen.drives = {true, false, true, false, true};
    seen.enable_switch = true;
  }

  const Decision& step() {
    Observation shown = seen;
    // the operator releases the switch for one cycle when the supervisor enters the mode IDLE
    if (lets_go && supervisor.mode() == Mode::kIdle && !was_idle_) shown.enable_switch = false;
    was_idle_ = supervisor.mode() == Mode::kIdle;
    decision = supervisor.step(shown);
    ++cycles;
    if (joints_follow) seen.q += 1e-2 * decision.test_torque;
    if (!obeys) return decision;
    switch (decision.power) {
      case hal::PowerRequest::kEnable:
        seen.drives.all_enabled = true;
        seen.drives.none_moves = false;
        break;
      case hal::PowerRequest::kReset: seen.drives.any_fault = false; [[fallthrough]];
      case hal::PowerRequest::kOff:
      case hal::PowerRequest::kQuickStop:
        seen.drives.all_enabled = false;
        seen.drives.none_moves = true;
        break;
    }
    return decision;
  }

  /// Steps until the mode is reached; how many it took, or -1 after 5000.
  int run_to(Mode mode) {
    for (int i = 0; i < 5000; ++i) {
      if (supervisor.mode() == mode) return i;
      step();
    }
    return -1;
  }

  /// Steps as long as the supervisor stays in its mode, at most 5000 times; how many steps ended in this mode.
  int stay() {
    const Mode mode = supervisor.mode();
    for (int i = 0; i < 5000; ++i) {
      step();
      if (supervisor.mode() != mode) return i;
    }
    return -1;
  }

  Supervisor supervisor;
  Observation seen;
  Decision decision;
  bool obeys = true;
  bool lets_go = true;
  bool joints_follow = false;  ///< the joints move along the torque of the sign test
  int cycles = 0;

 private:
  bool was_idle_ = false;
};

/// Nothing is rendered, and no torque of the sign test is sent.
inline bool is_stop(const Decision& decision) {
  return decision.share == 0.0 && !decision.of_last && !decision.rate_limited && decision.test_torque.isZero(0.0);
}

}  // namespace godobject::firmware
