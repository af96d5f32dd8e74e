#pragma once

#include <array>
#include <cstdint>

#include "core/device/joint_vector.h"
#include "hal/cia402/drive_identity.h"
#include "hal/cia402/temperature.h"

namespace godobject::hal {

inline constexpr int kMaxBuses = 8;

/// Address and scaling of a joint's drive. The only struct with other units than SI.
///
/// Joint position [rad] = zero + sign * 2 pi * (6064) / (counts * gear); joint torque [Nm] = sign * gear * rated *
/// (6077) / 1000.
struct DriveConfig {
  int bus = 0;                      ///< index of its bus
  int node = 1;                     ///< 1 to 126, unique on its bus
  double counts = 1 << 20;          ///< counts of 6064 a turn of the motor
  double gear = 1.0;                ///< turns of the motor a turn of the joint
  double rated_torque = 0.0;        ///< of the motor [Nm]; must be equal to 6076 of the drive
  double torque_limit = 0.0;        ///< largest commanded torque of the joint [Nm]
  double sign = 1.0;                ///< -1: the motor turns against the joint's direction
  double zero = 0.0;                ///< position of the joint where 6064 is 0 [rad]
  DriveIdentity identity{};         ///< expected of the drive; a start compares each field that is given
  TemperatureConfig temperature{};  ///< read about once a second
};

/// The operator's panel: a CiA 401 input module that answers each SYNC with 6000:1, see object_numbers.h. Cycles
/// without an answer, see `cycles_to_loss`, count as an emergency stop.
struct PanelConfig {
  int bus = -1;  ///< -1: no panel; then only a simulated bus may be driven
  int node = 0x20;
};

/// Drives and panel on one or several buses. Defaults are chosen; their ranges stand in
/// firmware/configuration/cia402_keys.cc.
struct BusLayout {
  int bus_count = 1;
  double bit_rate = 1e6;              ///< [bit/s]
  bool fd = false;                    ///< SYNC and PDOs as FD frames
  bool fd_services = false;           ///< with `fd`: all other messages as FD frames, too; else they are classical
  double data_rate = 5e6;             ///< bit rate of FD frames' data [bit/s]
  double period = 1e-3;               ///< T: time from one SYNC to the next [s]
  double compute = 120e-6;            ///< computing time between the last position and the first torque [s]
  double answer = 0.0;                ///< longest time from SYNC's end until a node has queued its TPDO1 [s]
  double drive_delay = 0.0;           ///< time from an RPDO's end to the torque plus a position's age at SYNC [s]
  double command_deadline = 4e-3;     ///< a drive stops by itself if torques are missing for longer [s]
  double drive_heartbeat = 20e-3;     ///< period of the heartbeats of drives and controller [s]
  double heartbeat_timeout = 50e-3;   ///< a missing heartbeat is noticed after this time [s]
  double mode_refresh = 1.0;          ///< a drive sends its mode on change and with this period [s]
  double boot_timeout = 5.0;          ///< until each node must boot [s]
  double limited_time = 50e-3;        ///< for which a drive may limit its torque by itself [s]
  double read_back_interval = 50e-3;  ///< from one SDO exchange to the next while the drives may have power [s]
  int joint_count = 0;
  std::array<DriveConfig, kMaxJoints> drives{};
  PanelConfig panel;
};

/// Times of a cycle, computed by `plan_buses`.
struct BusTiming {
  std::int64_t collect_ns = 0;  ///< from handing SYNC over until every sample has arrived
  double delay_s = 0.0;         ///< longest time from a sample to the torque that answers it [s]
};

}  // namespace godobject::hal
