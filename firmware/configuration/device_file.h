#pragma once

#include <filesystem>
#include <string>

#include "core/device/joint_torque.h"
#include "hal/cia402/bus_layout.h"

namespace godobject::firmware {

/// An arm and its drives: the contents of a file in firmware/devices.
struct Device {
  std::string name;
  std::string text;  ///< of the file, as it was read
  ArmModel model;
  JointTorqueParameters torque;
  hal::BusLayout bus;  ///< without `compute`, which the controller file has
};

/// Reads and validates a device file. The head of each firmware/devices/*.toml explains the keys; none has a default
/// but some of [bus]. Throws command::Failure: kNoInput if the file cannot be read, kBadConfig naming file, line and
/// key.
Device read_device_file(const std::filesystem::path& file);

/// Makes the mesh's frame M the device's tool frame. Before the call `model.H_FM` is the pose of T, the tool frame of
/// the device file; `H_TM` is the mesh in it. The payload stays where it is.
void regrip(const Pose& H_TM, Device& device);

}  // namespace godobject::firmware
