#pragma once

#include <memory>
#include <string>
#include <vector>

#include "firmware/configuration/controller_file.h"
#include "firmware/drives/drive_link.h"
#include "firmware/machine/finding.h"
#include "hal/frame_tap.h"

namespace godobject::firmware {

/// The transport of a simulated arm in this process; any other name is of hardware.
inline constexpr const char* kSimulatedTransport = "sim";

/// The input of `DriveFamily::connect`. Configuration and placement are read during the call only.
struct LinkRequest {
  std::string transport;                     ///< the option --bus: "sim", or the names of interfaces
  const ControllerConfig* config = nullptr;  ///< not null
  const Placement* placement = nullptr;      ///< not null
  hal::FrameTap* tap = nullptr;              ///< observer of every frame on CAN buses; null: none; outlives the link
};

/// A kind of drives with its protocol, planned for the device file but not connected. `choose_drives`
/// (firmware/controller/drive_choice.h) picks it. hal/README.md, "Adding a drive family", lists the steps for a new
/// one.
class DriveFamily {
 public:
  virtual ~DriveFamily() = default;
  DriveFamily(const DriveFamily&) = delete;
  DriveFamily& operator=(const DriveFamily&) = delete;

  /// Longest time from the sample of a position to the torque that answers it [s], for the gain check. Known before any
  /// hardware is touched.
  virtual double delay() const noexcept = 0;

  /// The time plan of a cycle for the user; each line ends with a line feed.
  virtual std::string plan() const = 0;

  /// Throws command::Failure (kBadConfig), after printing the plan to stderr, if a cycle has no room for its messages.
  virtual void require_plan() const = 0;

  /// Checks of the interfaces that `transport` names, for `godobject-controller doctor`; none for a simulated one.
  virtual std::vector<Finding> examine(const std::string& transport) const = 0;

  /// Opens the transport. Throws command::Failure: kBadConfig if the transport does not fit the device file,
  /// kUnavailable or kNoPermission naming the interface if it cannot be used, and all that SimulatedArm throws.
  virtual std::unique_ptr<DriveLink> connect(const LinkRequest& request) const = 0;

 protected:
  DriveFamily() = default;
};

}  // namespace godobject::firmware
