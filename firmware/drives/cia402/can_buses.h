#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hal/can_bus.h"
#include "hal/cia402/bus_layout.h"
#include "hal/linux/socketcan.h"

namespace godobject::firmware {

/// "can0,can1" -> its parts; empty ones stay.
std::vector<std::string> split_names(const std::string& names);

/// The CAN interfaces that a layout's buses are, opened, each with a kernel filter for what its nodes and a master may
/// send.
class CanBuses {
 public:
  /// Throws command::Failure: kBadConfig if their number is not the layout's or one is named twice, kUnavailable naming
  /// the interface and the cure if one cannot be opened or has another bit rate, kNoPermission if that is not
  /// permitted.
  CanBuses(const std::vector<std::string>& interfaces, const hal::BusLayout& layout);

  const std::vector<hal::CanBus*>& buses() const { return buses_; }
  const hal::SocketCan& socket(std::size_t i) const { return *sockets_[i]; }

  /// What is not as it should be, though it may go on: a line each.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  std::vector<std::unique_ptr<hal::SocketCan>> sockets_;
  std::vector<hal::CanBus*> buses_;
  std::vector<std::string> warnings_;
};

}  // namespace godobject::firmware
