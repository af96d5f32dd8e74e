#pragma once

#include <memory>
#include <string>
#include <vector>

#include "firmware/drives/drive_family.h"
#include "hal/can_bus.h"
#include "hal/cia402/bus_layout.h"
#include "hal/clock.h"

namespace godobject::firmware {

/// The CAN buses of a layout with the clock that belongs to them. A new transport (a simulation, an adapter without
/// SocketCAN) is a class of this kind and a line in `open_can_transport`.
class CanTransport {
 public:
  virtual ~CanTransport() = default;
  CanTransport(const CanTransport&) = delete;
  CanTransport& operator=(const CanTransport&) = delete;

  /// As `DriveLink::real_time`, `simulated_arm` and `make_clock`.
  virtual bool real_time() const noexcept = 0;
  virtual SimulatedArm* simulated_arm() noexcept = 0;
  virtual std::unique_ptr<hal::Clock> make_clock() = 0;

  const std::vector<hal::CanBus*>& buses() const noexcept { return buses_; }       ///< bus 0 first
  const std::vector<std::string>& names() const noexcept { return names_; }        ///< the same order
  const std::vector<std::string>& warnings() const noexcept { return warnings_; }  ///< one line each

 protected:
  CanTransport() = default;

  std::vector<hal::CanBus*> buses_;
  std::vector<std::string> names_;
  std::vector<std::string> warnings_;
};

/// Opens the buses of `layout`: loopback buses with simulated drives for the transport "sim", else this machine's CAN
/// interfaces of these names. `layout` outlives the transport. Throws as `DriveFamily::connect`.
std::unique_ptr<CanTransport> open_can_transport(const LinkRequest& request, const hal::BusLayout& layout);

}  // namespace godobject::firmware
