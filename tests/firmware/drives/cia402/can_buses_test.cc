#include "firmware/drives/cia402/can_buses.h"

#include <gtest/gtest.h>
#include <linux/can/netlink.h>
#include <linux/if.h>
#include <linux/if_arp.h>
#include <linux/rtnetlink.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdarg>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "toolchain/command_line/failure.h"

namespace {

int can_socket_error = 0;  // of a new CAN socket; 0: the kernel answers

/// An interface that can be opened, and what rtnetlink tells of it.
struct OpenInterface {
  std::string description;
  int can = -1;  ///< the sockets; -1: none
  int netlink = -1;
};
OpenInterface* open_interface = nullptr;  // null: the kernel answers

bool is_of_can(int descriptor) { return open_interface != nullptr && descriptor == open_interface->can; }
bool is_of_netlink(int descriptor) { return open_interface != nullptr && descriptor == open_interface->netlink; }

}  // namespace

// The linker takes these before those of the C library.
extern "C" {

int socket(int domain, int type, int protocol) noexcept {
  if (domain == AF_CAN && can_socket_error != 0) {
    errno = can_socket_error;
    return -1;
  }
  if (open_interface == nullptr || (domain != AF_CAN && domain != AF_NETLINK)) {
    return static_cast<int>(::syscall(SYS_socket, domain, type, protocol));
  }
  const auto made = static_cast<int>(::syscall(SYS_socket, AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  (domain == AF_CAN ? open_interface->can : open_interface->netlink) = made;
  return made;
}

int ioctl(int descriptor, unsigned long what, ...) noexcept {
  va_list arguments;
  va_start(arguments, what);
  void* argument = va_arg(arguments, void*);
  va_end(arguments);
  if (!is_of_can(descriptor)) return static_cast<int>(::syscall(SYS_ioctl, descriptor, what, argument));
  ifreq& request = *static_cast<ifreq*>(argument);
  if (what == SIOCGIFINDEX) request.ifr_ifindex = 7;
  if (what == SIOCGIFHWADDR) request.ifr_hwaddr.sa_family = ARPHRD_CAN;
  if (what == SIOCGIFFLAGS) request.ifr_flags = IFF_UP;
  if (what == SIOCGIFMTU) request.ifr_mtu = 16;
  return 0;
}

int setsockopt(int descriptor, int level, int option, const void* value, socklen_t size) noexcept {
  if (is_of_can(descriptor)) return 0;
  return static_cast<int>(::syscall(SYS_setsockopt, descriptor, level, option, value, size));
}

int bind(int descriptor, const sockaddr* address, socklen_t size) noexcept {
  return is_of_can(descriptor) ? 0 : static_cast<int>(::syscall(SYS_bind, descriptor, address, size));
}

ssize_t send(int descriptor, const void* data, std::size_t size, int flags) {
  if (is_of_netlink(descriptor)) return static_cast<ssize_t>(size);
  return ::syscall(SYS_sendto, descriptor, data, size, flags, nullptr, 0);
}

ssize_t recv(int descriptor, void* data, std::size_t size, int flags) {
  if (!is_of_netlink(descriptor)) return ::syscall(SYS_recvfrom, descriptor, data, size, flags, nullptr, nullptr);
  const std::string& description = open_interface->description;
  std::memcpy(data, description.data(), std::min(size, description.size()));
  return static_cast<ssize_t>(description.size());
}

}  // extern "C"

namespace godobject::firmware::can_buses_test {
namespace {

using command::ExitCode;

/// Exit code and message for a kernel that refuses a CAN socket.
std::pair<ExitCode, std::string> refusal_of_a_socket(int error) {
  hal::BusLayout layout;
  layout.bus_count = 1;
  layout.joint_count = 1;
  can_socket_error = error;
  std::pair<ExitCode, std::string> refusal{ExitCode::kOk, ""};
  try {
    const CanBuses buses({"can0"}, layout);
  } catch (const command::Failure& failure) {
    refusal = {failure.exit_code(), failure.what()};
  }
  can_socket_error = 0;
  return refusal;
}

/// The kernel asks for a capability with EPERM, a security module refuses with EACCES.
TEST(CanBuses, TellsAMissingRightFromEachOtherRefusal) {
  for (const auto& [error, expected] :
       std::initializer_list<std::pair<int, ExitCode>>{{EPERM, ExitCode::kNoPermission},
                                                       {EACCES, ExitCode::kNoPermission},
                                                       {EMFILE, ExitCode::kUnavailable},
                                                       {ENOBUFS, ExitCode::kUnavailable},
                                                       {EAFNOSUPPORT, ExitCode::kUnavailable}}) {
    const auto [code, words] = refusal_of_a_socket(error);
    EXPECT_EQ(code, expected) << words;
    EXPECT_EQ(words.rfind("--bus can0: ", 0), 0u) << words;
    EXPECT_NE(words.find(std::string("(") + std::strerror(error) + ")"), std::string::npos) << words;
  }
}

template <class T>
std::string raw(const T& value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

std::string attribute(int type, const std::string& payload) {
  const auto length = static_cast<unsigned short>(RTA_LENGTH(payload.size()));
  std::string bytes = raw(rtattr{length, static_cast<unsigned short>(type)}) + payload;
  bytes.resize(RTA_ALIGN(bytes.size()));
  return bytes;
}

/// The message of rtnetlink about can0, which has a controller.
std::string description_of_can0(std::uint32_t bit_rate, int transmit_queue) {
  can_bittiming timing{};
  timing.bitrate = bit_rate;
  ifinfomsg link{};
  link.ifi_type = ARPHRD_CAN;
  link.ifi_flags = IFF_UP | IFF_ECHO;
  const std::string controller = attribute(IFLA_CAN_BITTIMING, raw(timing));
  const std::string kind = attribute(IFLA_INFO_KIND, std::string("can") + '\0') + attribute(IFLA_INFO_DATA, controller);
  const std::string body = raw(link) + attribute(IFLA_IFNAME, std::string("can0") + '\0') +
                           attribute(IFLA_TXQLEN, raw(transmit_queue)) + attribute(IFLA_LINKINFO, kind);
  nlmsghdr header{};
  header.nlmsg_len = static_cast<std::uint32_t>(sizeof header + body.size());
  header.nlmsg_type = RTM_NEWLINK;
  return raw(header) + body;
}

/// The refusal of can0, or its warnings that name `what`.
struct Opened {
  std::string refusal{};
  std::vector<std::string> warnings{};
};

Opened open_can0(const std::string& description, const std::string& what) {
  hal::BusLayout layout;
  layout.bus_count = 1;
  layout.joint_count = 1;
  OpenInterface can0{.description = description};
  open_interface = &can0;
  Opened opened;
  try {
    const CanBuses buses({"can0"}, layout);
    for (const std::string& line : buses.warnings()) {
      if (line.find(what) != std::string::npos) opened.warnings.push_back(line);
    }
  } catch (const command::Failure& failure) {
    EXPECT_EQ(failure.exit_code(), ExitCode::kUnavailable);
    opened.refusal = failure.what();
  }
  open_interface = nullptr;
  return opened;
}

/// An interface that lacks what the bus needs is refused, one that lacks less gives a warning. Both messages tell what
/// to do.
TEST(CanBuses, RefusesAnInterfaceThatOpensButDoesNotFit) {
  const Opened good = open_can0(description_of_can0(1'000'000, 1000), "can0: txqueuelen");
  EXPECT_EQ(good.refusal, "");
  EXPECT_TRUE(good.warnings.empty());
  const Opened slow = open_can0(description_of_can0(500'000, 1000), "");
  EXPECT_EQ(slow.refusal.rfind("--bus can0: 500 kbit/s; the device file has 1000; ip link set can0 ", 0), 0u)
      << slow.refusal;
  const Opened gone = open_can0("", "");
  EXPECT_EQ(gone.refusal.rfind("--bus can0: no such interface; ip link ", 0), 0u) << gone.refusal;
  const Opened narrow = open_can0(description_of_can0(1'000'000, 10), "can0: txqueuelen");
  EXPECT_EQ(narrow.refusal, "");
  ASSERT_EQ(narrow.warnings.size(), 1u);
  EXPECT_NE(narrow.warnings[0].find("is short; a burst may fill it; ip link set can0 "), std::string::npos)
      << narrow.warnings[0];
}

TEST(CanBuses, SplitsNamesAtTheirCommas) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(split_names("can0"), Names{"can0"});
  EXPECT_EQ(split_names("can0,vcan1"), (Names{"can0", "vcan1"}));
  EXPECT_EQ(split_names(",can0,,"), (Names{"", "can0", "", ""}));
}

}  // namespace
}  // namespace godobject::firmware::can_buses_test
