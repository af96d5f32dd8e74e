#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "firmware/machine/finding.h"
#include "hal/cia402/bus_layout.h"

namespace godobject::firmware {

/// What the kernel says of a network interface. What an interface without controller does not have is zero.
struct CanInterface {
  std::string name;
  std::string kind;  ///< "can" has a controller; "vcan" and "vxcan" are simulated
  bool can = false;  ///< it is one of CAN at all
  bool up = false;
  int mtu = 0;                   ///< 72 with FD frames, else 16 [bytes]
  int transmit_queue = 0;        ///< txqueuelen [frames]
  std::uint32_t bit_rate = 0;    ///< [bit/s]
  std::uint32_t data_rate = 0;   ///< of FD frames' data [bit/s]
  std::uint32_t restart_ms = 0;  ///< after which a controller that has left the bus comes back by itself; 0: never
  bool echoes = false;           ///< own frames come back once they were on the wire, not when they are handed over
  bool listen_only = false;      ///< it neither sends nor acknowledges
  bool passive = false;          ///< the controller's error counters are high
  bool bus_off = false;          ///< the controller has left the bus
};

/// An RTM_NEWLINK message of rtnetlink, its header included. Nothing if it is none.
std::optional<CanInterface> parse_link(std::span<const std::uint8_t> message);

/// Asks the kernel by rtnetlink; any user may. Nothing: there is no such interface.
std::optional<CanInterface> read_can_interface(const std::string& name);

/// What an interface lacks of what the layout wants, each with its cure; one good finding if it lacks nothing.
std::vector<Finding> examine_can_interface(const CanInterface& interface, const hal::BusLayout& layout);

/// The same of all interfaces by name, those that are not there included.
std::vector<Finding> examine_can_interfaces(std::span<const std::string> names, const hal::BusLayout& layout);

}  // namespace godobject::firmware
