#include "firmware/machine/can_interfaces.h"

#include <linux/can.h>
#include <linux/can/netlink.h>
#include <linux/if.h>
#include <linux/if_arp.h>
#include <linux/rtnetlink.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

namespace godobject::firmware {
namespace {

constexpr int kFdMtu = CANFD_MTU;
/// Length of the transmit queue [frames]. Chosen: 1000 is the default of other network interfaces. The default of CAN,
/// 10, is full after one cycle of seven joints on a bus (SYNC, heartbeat, SDO, RPDOs) if the bus stalls.
constexpr int kTransmitQueue = 1000;

using Bytes = std::span<const std::uint8_t>;

/// The first bytes as a T; zeros if there are too few.
template <class T>
T read(Bytes bytes) {
  T value{};
  if (bytes.size() >= sizeof value) std::memcpy(&value, bytes.data(), sizeof value);
  return value;
}

std::string read_text(Bytes bytes) {
  std::string text(bytes.begin(), bytes.end());
  return text.substr(0, text.find('\0'));
}

/// Calls `use(type, payload)` for each attribute of a list, up to the first broken one.
template <class Use>
void for_attributes(Bytes list, Use&& use) {
  while (list.size() >= sizeof(rtattr)) {
    const auto header = read<rtattr>(list);
    if (header.rta_len < sizeof(rtattr) || header.rta_len > list.size()) return;
    use(header.rta_type & NLA_TYPE_MASK, list.subspan(sizeof(rtattr), header.rta_len - sizeof(rtattr)));
    const std::size_t aligned = RTA_ALIGN(header.rta_len);
    list = list.subspan(std::min(aligned, list.size()));
  }
}

void read_controller(Bytes list, CanInterface& interface) {
  for_attributes(list, [&](int type, Bytes payload) {
    switch (type) {
      case IFLA_CAN_BITTIMING: interface.bit_rate = read<can_bittiming>(payload).bitrate; break;
      case IFLA_CAN_DATA_BITTIMING: interface.data_rate = read<can_bittiming>(payload).bitrate; break;
      case IFLA_CAN_RESTART_MS: interface.restart_ms = read<std::uint32_t>(payload); break;
      case IFLA_CAN_CTRLMODE:
        interface.listen_only = (read<can_ctrlmode>(payload).flags & CAN_CTRLMODE_LISTENONLY) != 0;
        break;
      case IFLA_CAN_STATE: {
        const auto state = read<std::uint32_t>(payload);
        interface.passive = state == CAN_STATE_ERROR_PASSIVE;
        interface.bus_off = state == CAN_STATE_BUS_OFF;
        break;
      }
      default: break;
    }
  });
}

void read_kind(Bytes list, CanInterface& interface) {
  Bytes data;
  for_attributes(list, [&](int type, Bytes payload) {
    if (type == IFLA_INFO_KIND) interface.kind = read_text(payload);
    if (type == IFLA_INFO_DATA) data = payload;
  });
  if (interface.kind == "can") read_controller(data, interface);
}

/// The `ip` command that sets the interface up for the layout.
std::string setting_up(const std::string& name, const hal::BusLayout& layout) {
  const std::string fd = layout.fd ? fmt::format(" dbitrate {:.0f} fd on", layout.data_rate) : "";
  return fmt::format("ip link set {0} down; ip link set {0} up txqueuelen {1} type can bitrate {2:.0f}{3} restart-ms 0",
                     name, kTransmitQueue, layout.bit_rate, fd);
}

Finding good(const std::string& what) { return {.good = true, .what = what, .cure = "", .needed = false}; }

/// A lack without whose cure the bus does not work.
Finding missing(const std::string& what, const std::string& cure) {
  return {.good = false, .what = what, .cure = cure, .needed = true};
}

/// A lack with which the bus works for now.
Finding doubtful(const std::string& what, const std::string& cure) {
  return {.good = false, .what = what, .cure = cure, .needed = false};
}

/// Equal to a thousandth: CAN controllers divide their clock and do not reach every rate exactly.
bool is_rate(std::uint32_t have, double wanted) { return std::abs(have - wanted) <= 0.001 * wanted; }

/// Checks of an interface with a controller.
void examine_controller(const CanInterface& interface, const hal::BusLayout& layout, std::vector<Finding>& findings) {
  const std::string& name = interface.name;
  if (!is_rate(interface.bit_rate, layout.bit_rate)) {
    findings.push_back(missing(fmt::format("{}: {:g} kbit/s; the device file has {:g}", name, 1e-3 * interface.bit_rate,
                                           1e-3 * layout.bit_rate),
                               setting_up(name, layout)));
  }
  if (layout.fd && !is_rate(interface.data_rate, layout.data_rate)) {
    findings.push_back(missing(fmt::format("{}: {:g} kbit/s for the data of FD frames; the device file has {:g}", name,
                                           1e-3 * interface.data_rate, 1e-3 * layout.data_rate),
                               setting_up(name, layout)));
  }
  if (!interface.echoes) {
    findings.push_back(missing(name + ": its driver does not report when a frame was on the wire",
                               "use an adapter whose driver has IFF_ECHO; slcan of old kernels does not"));
  }
  if (interface.listen_only) {
    findings.push_back(missing(name + ": listens only",
                               fmt::format("ip link set {0} down; ip link set {0} up type can listen-only off", name)));
  }
  if (interface.bus_off) {
    findings.push_back(
        missing(name + ": its controller is bus-off after errors",
                "check wires, termination (120 ohm at both ends) and bit rate; then " + setting_up(name, layout)));
  }
  if (interface.passive) {
    findings.push_back(
        doubtful(name + ": its controller is error-passive",
                 "check wires, termination (120 ohm at both ends) and bit rate, and that a drive is switched on"));
  }
  if (interface.transmit_queue < kTransmitQueue) {
    findings.push_back(
        doubtful(fmt::format("{}: txqueuelen {} is short; a burst may fill it", name, interface.transmit_queue),
                 fmt::format("ip link set {} txqueuelen {}", name, kTransmitQueue)));
  }
  if (interface.restart_ms != 0) {
    findings.push_back(missing(fmt::format("{}: restarts by itself {} ms after bus-off", name, interface.restart_ms),
                               setting_up(name, layout)));
  }
}

/// An rtnetlink socket, closed by the destructor.
class NetlinkSocket {
 public:
  NetlinkSocket() : descriptor_(::socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC, NETLINK_ROUTE)) {}
  ~NetlinkSocket() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  NetlinkSocket(const NetlinkSocket&) = delete;
  NetlinkSocket& operator=(const NetlinkSocket&) = delete;

  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

}  // namespace

std::optional<CanInterface> parse_link(Bytes message) {
  const auto header = read<nlmsghdr>(message);
  const std::size_t begin = NLMSG_HDRLEN + NLMSG_ALIGN(sizeof(ifinfomsg));
  if (header.nlmsg_type != RTM_NEWLINK || header.nlmsg_len < begin || header.nlmsg_len > message.size()) {
    return std::nullopt;
  }
  const auto link = read<ifinfomsg>(message.subspan(NLMSG_HDRLEN));
  CanInterface interface;
  interface.can = link.ifi_type == ARPHRD_CAN;
  interface.up = (link.ifi_flags & IFF_UP) != 0;
  interface.echoes = (link.ifi_flags & IFF_ECHO) != 0;
  for_attributes(message.subspan(begin, header.nlmsg_len - begin), [&](int type, Bytes payload) {
    switch (type) {
      case IFLA_IFNAME: interface.name = read_text(payload); break;
      case IFLA_MTU: interface.mtu = read<int>(payload); break;
      case IFLA_TXQLEN: interface.transmit_queue = read<int>(payload); break;
      case IFLA_LINKINFO: read_kind(payload, interface); break;
      default: break;
    }
  });
  return interface;
}

std::optional<CanInterface> read_can_interface(const std::string& name) {
  if (name.empty() || name.size() >= IFNAMSIZ) return std::nullopt;
  struct Request {
    nlmsghdr header{};
    ifinfomsg link{};
    rtattr attribute{};
    std::array<char, IFNAMSIZ> name{};
  } request;
  static_assert(sizeof request == NLMSG_LENGTH(sizeof(ifinfomsg)) + RTA_LENGTH(IFNAMSIZ));
  request.header.nlmsg_len = sizeof request;
  request.header.nlmsg_type = RTM_GETLINK;
  request.header.nlmsg_flags = NLM_F_REQUEST;
  request.attribute.rta_type = IFLA_IFNAME;
  request.attribute.rta_len = RTA_LENGTH(IFNAMSIZ);
  std::memcpy(request.name.data(), name.data(), name.size());

  const NetlinkSocket socket;
  if (::send(socket.descriptor(), &request, sizeof request, 0) != sizeof request) return std::nullopt;
  std::vector<std::uint8_t> answer(1 << 16);
  const ssize_t size = ::recv(socket.descriptor(), answer.data(), answer.size(), 0);
  if (size <= 0) return std::nullopt;
  return parse_link(Bytes(answer).first(static_cast<std::size_t>(size)));
}

std::vector<Finding> examine_can_interface(const CanInterface& interface, const hal::BusLayout& layout) {
  const std::string& name = interface.name;
  if (!interface.can) return {missing(name + ": not a CAN interface", "ip link show type can lists CAN interfaces")};
  const bool simulated = interface.kind != "can";
  std::vector<Finding> findings;
  if (!interface.up) {
    findings.push_back(missing(name + ": down", simulated ? "ip link set " + name + " up" : setting_up(name, layout)));
  }
  if (layout.fd && interface.mtu < kFdMtu) {
    findings.push_back(missing(name + ": has no FD frames",
                               simulated ? fmt::format("ip link set {0} down; ip link set {0} mtu {1} up", name, kFdMtu)
                                         : setting_up(name, layout)));
  }
  if (!simulated) examine_controller(interface, layout, findings);
  if (findings.empty()) {
    findings.push_back(good(simulated ? fmt::format("{}: up, simulated ({})", name, interface.kind)
                                      : fmt::format("{}: up, {:g} kbit/s, txqueuelen {}", name,
                                                    1e-3 * interface.bit_rate, interface.transmit_queue)));
  }
  return findings;
}

std::vector<Finding> examine_can_interfaces(std::span<const std::string> names, const hal::BusLayout& layout) {
  std::vector<Finding> findings;
  for (const std::string& name : names) {
    const std::optional<CanInterface> interface = read_can_interface(name);
    if (!interface) {
      findings.push_back(
          missing(name + ": no such interface",
                  "ip link show type can lists the existing ones; for a simulated one: ip link add dev " + name +
                      " type vcan"));
      continue;
    }
    for (Finding& finding : examine_can_interface(*interface, layout)) findings.push_back(std::move(finding));
  }
  return findings;
}

}  // namespace godobject::firmware
