#pragma once

#include <vector>

#include "core/device/arm_model.h"
#include "hal/cia402/bus_layout.h"
#include "toolchain/files/toml_table.h"

namespace godobject::firmware {

/// Sets the deadline of torques and the times of heartbeats to those that suit `bus.period` if a device file has none.
void set_usual_times(hal::BusLayout& bus);

/// Reads `[bus]` of a device file: rates, times, the operator's panel. Throws as `read_device_file`.
void read_bus(const files::TomlTable& table, hal::BusLayout& bus);

/// Reads the keys of a `[[joint]]` that describe its CiA 402 drive: bus, node, counts, gear, rated_torque, sign, zero,
/// identity, temperature.
/// `joint`: read before. Throws as `read_device_file`.
hal::DriveConfig read_drive(const files::TomlTable& table, const ArmJoint& joint);

/// Completes `bus` once all drives are read: counts joints and buses, refuses a bus without nodes and a node number
/// that is used twice on a bus, and a serial number that two drives of a product have. Throws as `read_device_file`.
void finish_buses(const files::TomlTable& table, const std::vector<files::TomlTable>& joints, hal::BusLayout& bus);

}  // namespace godobject::firmware
