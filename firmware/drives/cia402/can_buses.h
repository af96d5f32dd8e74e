#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hal/can_bus.h"
#include "hal/cia402/bus_layout.h"
#include "hal/linux/socketcan.h"

namespace godobject::firmware {

/// Splits "can0,can1" at its commas; empty parts stay.
std::vector<std::string> split_names(const std::string& names);

/// The opened CAN interfaces for the buses of a layout. A kernel filter on each passes the frames that its nodes and a
/// master may send.
class CanBuses {
 public:
  /// Throws command::Failure: kBadConfig if their number is not the layout's or a name occurs twice, kUnavailable
  /// naming the interface and the cure if it cannot be opened or has another bit rate, kNoPermission if a right is
  /// missing.
  CanBuses(const std::vector<std::string>& interfaces, const hal::BusLayout& layout);

  const std::vector<hal::CanBus*>& buses() const { return buses_; }
  const hal::SocketCan& socket(std::size_t i) const { return *sockets_[i]; }

  /// One line for each finding that does not forbid a run.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  std::vector<std::unique_ptr<hal::SocketCan>> sockets_;
  std::vector<hal::CanBus*> buses_;
  std::vector<std::string> warnings_;
};

}  // namespace godobject::firmware
