#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "firmware/machine/finding.h"
#include "hal/cia402/bus_layout.h"

namespace godobject::firmware {

/// The kernel's data on a network interface. Entries of a controller are zero where there is none.
struct CanInterface {
  std::string name;
  std::string kind;  ///< "can" has a controller; "vcan" and "vxcan" are simulated
  bool can = false;  ///< it is a CAN interface
  bool up = false;
  int mtu = 0;                   ///< 72 with FD frames, else 16 [bytes]
  int transmit_queue = 0;        ///< txqueuelen [frames]
  std::uint32_t bit_rate = 0;    ///< [bit/s]
  std::uint32_t data_rate = 0;   ///< of FD frames' data [bit/s]
  std::uint32_t restart_ms = 0;  ///< time after which a bus-off controller restarts by itself; 0: never
  bool echoes = false;           ///< own frames return after they were on the wire, not when they are handed over
  bool listen_only = false;      ///< the controller neither sends nor acknowledges
  bool passive = false;          ///< the controller is error-passive
  bool bus_off = false;          ///< the controller is bus-off
};

/// Parses an RTM_NEWLINK message of rtnetlink with its header. None: it is another message, or broken.
std::optional<CanInterface> parse_link(std::span<const std::uint8_t> message);

/// Asks the kernel by rtnetlink, without any right. None: there is no such interface.
std::optional<CanInterface> read_can_interface(const std::string& name);

/// Checks an interface against the layout: one finding with a cure for each lack, or one good finding.
std::vector<Finding> examine_can_interface(const CanInterface& interface, const hal::BusLayout& layout);

/// Checks all interfaces by name. An interface that does not exist is a finding, too.
std::vector<Finding> examine_can_interfaces(std::span<const std::string> names, const hal::BusLayout& layout);

}  // namespace godobject::firmware
