#pragma once

#include <array>
#include <cstdint>

#include "godobject/status.h"
#include "hal/joint_drives.h"

namespace godobject::firmware {

/// The states of all drives in short.
struct DriveSummary {
  bool all_answer = false;
  bool all_enabled = false;
  bool none_moves = false;  ///< every drive answers, and none is enabled or in a quick stop
  bool any_fault = false;
  bool all_fresh = false;  ///< every state was reported in this cycle
};

DriveSummary summarize(const hal::JointReading& reading, int joint_count) noexcept;

/// The supervisor's input of a cycle: computed before torques are sent.
struct Observation {
  DriveSummary drives;
  bool emergency_stop = false;
  bool enable_switch = false;
  bool alarm = false;
  bool drive_restarted = false;            ///< the alarm is the restart of a drive
  JointVector q = JointVector::Zero();     ///< checked positions [rad]
  std::uint32_t lost = 0;                  ///< CheckedPositions::predicted
  std::uint32_t jumps = 0;                 ///< CheckedPositions::jumps
  bool finite = true;                      ///< CheckedPositions::finite
  bool stuck = false;                      ///< CheckedPositions::stuck
  int joint_beyond_limit = -1;             ///< a joint beyond its position limit; -1: none
  std::array<bool, kMaxJoints> limited{};  ///< drives that limit their torque by themselves
  bool too_fast = false;                   ///< hand or joint above its stop speed, or a joint that runs away
  Status status = Status::kOk;             ///< of velocity estimate, mapping, god object and joint torque
  bool drifts = false;                     ///< ModelWatch::drifts
  bool drifts_early = false;               ///< ModelWatch::drifts_early
  int wrong_torque_joint = -1;             ///< joint whose drive measures another torque than was sent; -1: none
  double contact_force = 0.0;              ///< size of the computed wrench [N]; torques count at the rotation length
  bool inside = false;                     ///< the god object started inside and is not yet outside
  std::int64_t overrun_ns = 0;             ///< of the previous cycle
  std::int64_t computed_late_ns = 0;       ///< of the previous cycle: computing time beyond the plan
  std::uint32_t sends_failed = 0;          ///< cycles in a row before this one in which sending failed
  bool end_requested = false;              ///< SIGTERM, SIGINT, SIGHUP, or the duration is over
  bool reset_requested = false;            ///< by the operator
};

}  // namespace godobject::firmware
