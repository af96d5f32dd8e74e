#include "firmware/drives/cia402/can_buses.h"

#include <cerrno>
#include <cstring>
#include <set>

#include <fmt/format.h>

#include "firmware/machine/can_interfaces.h"
#include "hal/cia402/bus_identifiers.h"
#include "toolchain/command_line/failure.h"

namespace godobject::firmware {
namespace {

using command::ExitCode;
using command::Failure;

/// Receive buffer without a warning [bytes]. Derived: at some 800 bytes a frame, as the kernel counts them
/// (SocketCanOptions), and 18 frames a cycle of seven joints on one bus it holds 18 cycles.
constexpr int kEnoughReceiveBuffer = 1 << 18;

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
    throw Failure(
        ExitCode::kBadConfig,
        fmt::format("--bus names {} CAN interfaces, the device has {} buses; name one for each bus, bus 0 first",
                    interfaces.size(), layout.bus_count));
  }
  if (std::set<std::string>(interfaces.begin(), interfaces.end()).size() != interfaces.size()) {
    throw Failure(ExitCode::kBadConfig, "--bus names an interface twice; name a different one for each bus");
  }
  for (std::size_t i = 0; i < interfaces.size(); ++i) {
    const std::string& name = interfaces[i];
    const hal::BusIdentifiers identifiers(layout, static_cast<int>(i));
    auto socket = std::make_unique<hal::SocketCan>();
    const hal::OpenResult result =
        socket->open(name.c_str(), {.fd = layout.fd, .only_fd = layout.fd_services, .identifiers = identifiers.all()});
    if (result.status != hal::OpenStatus::kOk) {
      const bool forbidden = result.error == EPERM || result.error == EACCES;
      const std::string system = result.error == 0 ? "" : fmt::format(" ({})", std::strerror(result.error));
      throw Failure(forbidden ? ExitCode::kNoPermission : ExitCode::kUnavailable,
                    fmt::format("--bus {}: {}{}", name, describe(result.status), system));
    }
    if (result.receive_buffer < kEnoughReceiveBuffer) {
      warnings_.push_back(fmt::format("{}: the receive buffer has only {} bytes; sysctl -w net.core.rmem_max={}", name,
                                      result.receive_buffer, kEnoughReceiveBuffer));
    }
    buses_.push_back(socket.get());
    sockets_.push_back(std::move(socket));
  }
  for (const Finding& finding : examine_can_interfaces(interfaces, layout)) {
    if (finding.good) continue;
    const std::string line = fmt::format("{}; {}", finding.what, finding.cure);
    if (finding.needed) throw Failure(ExitCode::kUnavailable, "--bus " + line);
    warnings_.push_back(line);
  }
}

}  // namespace godobject::firmware
