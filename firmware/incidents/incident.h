#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/device/joint_vector.h"
#include "firmware/cycle/fault.h"
#include "godobject/pose.h"

namespace godobject::firmware {

/// A row of telemetry.csv.
struct IncidentRow {
  double t = 0.0;          ///< by the controller's clock [s]
  double late = 0.0;       ///< lateness of waking [s]
  double computing = 0.0;  ///< [s]
  std::string mode;
  Fault fault = Fault::kNone;
  int lost = 0;         ///< cycles in a row without a fresh position, of the worst joint
  int fault_joint = 0;  ///< joint of the fault, from 1; 0: not known, or no single joint
  hal::Alarm alarm = hal::Alarm::kNone;
  JointVector q = JointVector::Zero();       ///< [rad]
  JointVector qd = JointVector::Zero();      ///< [rad/s]
  JointVector torque = JointVector::Zero();  ///< sent [Nm]
  Pose H_WD;                                 ///< device pose
  Vector3 force = Vector3::Zero();           ///< rendered on the hand [N]
  Vector3 hand_torque = Vector3::Zero();     ///< [Nm]
};

/// The limits of a run, from run.toml.
struct IncidentBounds {
  struct Joint {
    double lower = 0.0, upper = 0.0;  ///< [rad]
    double velocity = 0.0;            ///< [rad/s]
    double torque = 0.0;              ///< [Nm]
    int bus = 0;
    int node = 0;
  };
  double period = 1e-3;           ///< T [s]
  double compute = 0.0;           ///< computing time in the bus plan [s]
  double velocity_span = 3e-3;    ///< over which the controller estimates velocities [s]
  double scale = 1.0;             ///< motion in the scene per motion of the hand
  double force = 0.0;             ///< at the hand [N]
  double torque = 0.0;            ///< [Nm]
  double speed_stop = 0.0;        ///< of the hand [m/s]
  double turn_stop = 0.0;         ///< [rad/s]
  double joint_speed_stop = 0.0;  ///< share of a joint's speed limit
  std::vector<Joint> joints;
  std::vector<std::string> buses;  ///< names, bus 0 first
};

/// An emergency message (EMCY) of a drive, from can.log.
struct Emergency {
  std::string bus;
  int node = 0;
  unsigned code = 0;
};

/// The record of a run around a stop.
struct Incident {
  std::filesystem::path folder;
  int joint_count = 0;
  std::vector<IncidentRow> rows;    ///< at least one; up to 30 s before the stop and 60 s after it
  std::optional<std::size_t> stop;  ///< the first row with the fault; none: no fault
  std::string began;                ///< start of the run in UTC; empty: not known
  std::string stopped;              ///< stop in UTC; empty: not known
  std::string program, machine, image;
  std::optional<IncidentBounds> bounds;
  std::vector<Emergency> emergencies;
  std::string words;               ///< of the controller about the stop; empty: none
  std::vector<std::string> notes;  ///< defects of the record
};

}  // namespace godobject::firmware
