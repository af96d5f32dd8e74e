#include "firmware/can_buses.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <set>

#include <fmt/format.h>

#include "firmware/command/failure.h"
#include "hal/canopen/object_numbers.h"

namespace godobject::firmware {
namespace {

using command::ExitCode;
using command::Failure;

constexpr int kController = 127;           // the node that the controller's heartbeat is of
constexpr int kEnoughTransmitQueue = 1000;  // [frames]

void add_node(int node, std::vector<std::uint16_t>& identifiers) {
  using namespace hal::canopen;
  for (const Cob base : {kCobEmergency, kCobTpdo1, kCobRpdo1, kCobSdoResponse, kCobSdoRequest, kCobHeartbeat}) {
    identifiers.push_back(static_cast<std::uint16_t>(base + node));
  }
}

/// What the nodes of a bus send and a master may send to them.
std::vector<std::uint16_t> identifiers_on(const hal::BusLayout& layout, int bus) {
  std::vector<std::uint16_t> identifiers{hal::canopen::kCobNmt, hal::canopen::kCobSync};
  for (int i = 0; i < layout.joint_count; ++i) {
    const hal::DriveConfig& drive = layout.drives[static_cast<std::size_t>(i)];
    if (drive.bus == bus) add_node(drive.node, identifiers);
  }
  if (layout.panel.bus == bus) add_node(layout.panel.node, identifiers);
  identifiers.push_back(hal::canopen::kCobHeartbeat + kController);
  return identifiers;
}

}  // namespace

std::vector<std::string> split_names(const std::string& names) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t comma = 0; comma != std::string::npos; begin = comma + 1) {
    comma = names.find(',', begin);
    parts.push_back(names.substr(begin, comma - begin));
  }
  return parts;
}

CanBuses::CanBuses(const std::vector<std::string>& interfaces, const hal::BusLayout& layout) {
  if (static_cast<int>(interfaces.size()) != layout.bus_count) {
    throw Failure(ExitCode::kBadConfig,
                  fmt::format("--bus names {} CAN interfaces, the device has {} buses; name one each, such as can0,can1",
                              interfaces.size(), layout.bus_count));
  }
  if (std::set<std::string>(interfaces.begin(), interfaces.end()).size() != interfaces.size()) {
    throw Failure(ExitCode::kBadConfig, "--bus names an interface twice; name another one for each bus");
  }
  for (std::size_t i = 0; i < interfaces.size(); ++i) {
    const std::string& name = interfaces[i];
    const std::vector<std::uint16_t> identifiers = identifiers_on(layout, static_cast<int>(i));
    auto socket = std::make_unique<hal::SocketCan>();
    const hal::OpenResult result = socket->open(name.c_str(), {.fd = layout.fd, .identifiers = identifiers});
    if (result.status != hal::OpenStatus::kOk) {
      const bool forbidden = result.error == EPERM || result.error == EACCES;
      const std::string system = result.error == 0 ? "" : fmt::format(" ({})", std::strerror(result.error));
      throw Failure(forbidden ? ExitCode::kNoPermission : ExitCode::kUnavailable,
                    fmt::format("--bus {}: {}{}", name, describe(result.status), system));
    }
    if (result.transmit_queue < kEnoughTransmitQueue) {
      warnings_.push_back(fmt::format("{}: room for {} frames to send; ip link set {} txqueuelen {}", name,
                                      result.transmit_queue, name, kEnoughTransmitQueue));
    }
    buses_.push_back(socket.get());
    sockets_.push_back(std::move(socket));
  }
}

}  // namespace godobject::firmware
