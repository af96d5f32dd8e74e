#pragma once

#include <string>

#include "core/device/joint_vector.h"
#include "godobject/pose.h"
#include "toolchain/figures/telemetry_log.h"

namespace godobject::live {

/// One cycle of a controller, as a live page shows it.
struct LiveSample {
  double t = 0.0;                            ///< time of the cycle [s]
  std::string mode;                          ///< of the supervisor, one word
  std::string fault;                         ///< the reason for a stop; empty: none
  int fault_number = 0;                      ///< as in telemetry; 0: none
  std::string outcome;                       ///< of the god object's cycle, one word
  double share = 0.0;                        ///< share of the computed wrench that is rendered [0, 1]
  JointVector q = JointVector::Zero();       ///< joint positions [rad]
  JointVector qd = JointVector::Zero();      ///< joint velocities [rad/s]
  JointVector torque = JointVector::Zero();  ///< joint torques, sent [Nm]
  Pose H_WD;                                 ///< the moving mesh at the device pose
  Pose H_WS;                                 ///< the moving mesh at the god object's pose
  Wrench wrench_R;     ///< on the hand, along the axes of the room, about the moving body's centre of mass [N, Nm]
  double depth = 0.0;  ///< of the god object's deepest sample point, positive inside [m]
  double contacts = 0.0;
  double computed = 0.0;  ///< computing time [s]
  double late = 0.0;      ///< time by which the cycle began late [s]
  double absorbed = 0.0;  ///< energy taken from arm and hand since rendering began; below zero: given [J]
};

/// Returns the cycle of a telemetry.
LiveSample sample_of(const figures::TelemetryRow& row);

}  // namespace godobject::live
