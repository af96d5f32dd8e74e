#pragma once

#include <cstdint>
#include <stop_token>

#include "firmware/loop/controller_run.h"

namespace godobject::firmware {

/// Tells the operator, once for each occasion, what to do: the controller waits for longer than 3 s, the god object
/// stays behind for longer than 0.3 s because of the budget of work, a drive limits its torque by itself, is warm or
/// does not answer for its temperature (once a run for each joint), or the arm has stopped.
class OperatorNotice {
 public:
  /// `report`: of the running loop; outlives this. `period`: T [s].
  OperatorNotice(RunReport& report, double period) noexcept : report_(report), period_(period) {}

  /// Reads the report and prints a line if there is something new to say.
  void look();

  /// Looks five times a second until it is asked to stop: the thread beside the loop.
  void run(const std::stop_token& stop);

 private:
  RunReport& report_;
  double period_;
  bool said_waiting_ = false;
  bool said_behind_ = false;
  bool said_stopped_ = false;
  std::uint8_t said_limited_ = 0;  // one bit a joint
  std::uint8_t said_warm_ = 0;
  std::uint8_t said_lost_ = 0;
};

}  // namespace godobject::firmware
