#pragma once

#include <filesystem>
#include <string>

#include "core/device/joint_torque.h"
#include "hal/cia402/bus_layout.h"

namespace godobject::firmware {

/// An arm and how it is driven, as a file in firmware/devices says it.
struct Device {
  std::string name;
  ArmModel model;
  JointTorqueParameters torque;
  hal::BusLayout bus;  ///< without `compute`: that is the controller's
};

/// Reads and validates a device file; its keys stand at the top of firmware/devices/*.toml. No key has a default.
/// Throws command::Failure: kNoInput if the file cannot be read, kBadConfig naming file, line and key.
Device read_device_file(const std::filesystem::path& file);

/// Makes the mesh's frame M the device's tool frame. Before the call `model.H_FM` is the pose of T, the tool frame of
/// the device file; `H_TM` is the mesh in it. The payload stays where it is.
void regrip(const Pose& H_TM, Device& device);

}  // namespace godobject::firmware
