#pragma once

#include <array>
#include <cstdint>

#include "core/device/joint_vector.h"

namespace godobject::hal {

inline constexpr int kMaxBuses = 4;

/// How a joint is reached and what its drive's numbers mean. The only place with anything but SI.
///
/// Joint position [rad] = zero + sign * 2 pi * (6064) / (counts * gear); joint torque [Nm] = sign * gear * rated *
/// (6077) / 1000.
struct DriveConfig {
  int bus = 0;                ///< index of its bus
  int node = 1;               ///< 1 to 127, different on one bus
  double counts = 1 << 20;    ///< of 6064 a turn of the motor
  double gear = 1.0;          ///< turns of the motor a turn of the joint
  double rated_torque = 0.0;  ///< of the motor [Nm]; 6076 of the drive must say the same
  double torque_limit = 0.0;  ///< of the joint: the most that is asked for [Nm]
  double sign = 1.0;          ///< -1: the motor turns against the joint
  double zero = 0.0;          ///< position of the joint where 6064 is 0 [rad]
};

/// The operator's panel: a CiA 401 input module that answers each SYNC with 6000:1, see object_numbers.h. Three cycles
/// without it count as an emergency stop.
struct PanelConfig {
  int bus = -1;  ///< -1: there is none, and no bus that is not simulated may be driven
  int node = 0x20;
};

/// All joints over one or several buses.
struct BusLayout {
  int bus_count = 1;
  double bit_rate = 1e6;           ///< [bit/s]
  bool fd = false;                 ///< SYNC and PDOs in FD frames; all else stays classical
  double data_rate = 5e6;          ///< of FD frames' data [bit/s]
  double period = 1e-3;            ///< [s]
  double compute = 120e-6;         ///< what the controller may take between the last position and the first torque [s]
  double answer = 0.0;             ///< from SYNC's end until a node has queued the TPDO that answers it, at most [s]
  double drive_delay = 0.0;        ///< from an RPDO's end to the torque, and of a position's age at SYNC, together [s]
  double command_deadline = 4e-3;  ///< a drive trips when torques stay away for so long [s]
  double drive_heartbeat = 20e-3;  ///< producer of drives and controller [s]
  double heartbeat_timeout = 50e-3;  ///< consumer [s]
  double mode_refresh = 1.0;         ///< a drive tells its mode when it changes, and this often [s]
  double boot_timeout = 5.0;         ///< for each node [s]
  int read_back_interval = 50;       ///< cycles from one SDO exchange to the next while torque may flow
  int joint_count = 0;
  std::array<DriveConfig, kMaxJoints> drives{};
  PanelConfig panel;
};

/// When things happen in a cycle; `plan_buses` computes it.
struct BusTiming {
  std::int64_t collect_ns = 0;  ///< from SYNC's hand-over until every sample has come
  double delay_s = 0.0;         ///< longest time from a sample to the torque that answers it [s]
};

}  // namespace godobject::hal
