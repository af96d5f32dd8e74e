// CAN interfaces for processes on a machine whose kernel has no CAN: a library for LD_PRELOAD. The frames of an interface
// go through pipes NAME.PID.DESCRIPTOR in the folder GODOBJECT_FAKE_CAN, one for each socket, which holds some hundred
// frames (fake_can.h); without that variable the kernel answers.
// The name of an interface says how it is: can*: works; down*: down; small*: has a small receive buffer; closed*: not
// for this user; eth*: no CAN interface. There are no others.
#include <dirent.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <linux/can.h>
#include <linux/can/netlink.h>
#include <linux/if.h>
#include <linux/if_arp.h>
#include <linux/rtnetlink.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "tests/support/fake_can.h"

namespace {

using godobject::test::FakeCanFrame;

struct Socket {
  bool can = false;
  bool netlink = false;
  std::string interface;
  std::string file;  // of its address
  int buffer = 0;
  bool small = false;
};

constexpr int kMost = 256;
std::array<Socket, kMost> sockets;
constexpr std::array<const char*, 5> kKinds = {"can", "down", "small", "closed", "eth"};

/// The C library's function.
template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

int fail(int error) {
  errno = error;
  return -1;
}

const char* folder() { return std::getenv("GODOBJECT_FAKE_CAN"); }

bool begins(const std::string& name, const char* kind) { return name.rfind(kind, 0) == 0; }

/// Index of an interface: its kind and the digit behind it; 0: there is none.
int index_of(const std::string& name) {
  for (std::size_t kind = 0; kind < kKinds.size(); ++kind) {
    const std::size_t length = std::strlen(kKinds[kind]);
    if (!begins(name, kKinds[kind]) || name.size() != length + 1) continue;
    return static_cast<int>(10 * kind) + (name[length] - '0') + 1;
  }
  return 0;
}

std::string name_of(int index) {
  return kKinds[static_cast<std::size_t>((index - 1) / 10)] + std::to_string((index - 1) % 10);
}

std::string path_of(const std::string& file) { return std::string(folder()) + '/' + file; }

bool is(int descriptor, bool Socket::*kind) {
  return descriptor >= 0 && descriptor < kMost && sockets[static_cast<std::size_t>(descriptor)].*kind;
}

Socket& at(int descriptor) { return sockets[static_cast<std::size_t>(descriptor)]; }

/// A frame goes to all sockets of the interface, its sender included.
ssize_t broadcast(const Socket& socket, int descriptor, const void* data, std::size_t size) {
  FakeCanFrame frame{::getpid(), descriptor, static_cast<std::uint32_t>(size), {}};
  std::memcpy(&frame.frame, data, std::min(size, sizeof frame.frame));
  DIR* listing = ::opendir(folder());
  if (listing == nullptr) return fail(ENETDOWN);
  while (const dirent* entry = ::readdir(listing)) {
    if (!begins(entry->d_name, (socket.interface + ".").c_str())) continue;
    const int to = ::open(path_of(entry->d_name).c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);
    if (to < 0) continue;  // its owner has gone
    // a pipe that is full loses the frame, as a slow node does
    if (::write(to, &frame, sizeof frame) < 0) errno = 0;
    ::close(to);
  }
  ::closedir(listing);
  return static_cast<ssize_t>(size);
}

/// One frame with what SocketCAN tells beside it: the time, and a mark for the socket's own.
bool take(int descriptor, mmsghdr& message) {
  FakeCanFrame frame{};
  if (::read(descriptor, &frame, sizeof frame) != static_cast<ssize_t>(sizeof frame)) return false;
  msghdr& header = message.msg_hdr;
  std::memcpy(header.msg_iov->iov_base, &frame.frame, std::min<std::size_t>(frame.size, header.msg_iov->iov_len));
  message.msg_len = frame.size;
  header.msg_flags = frame.process == ::getpid() && frame.descriptor == descriptor ? MSG_CONFIRM : 0;
  timespec now{};
  ::clock_gettime(CLOCK_REALTIME, &now);
  cmsghdr* part = CMSG_FIRSTHDR(&header);
  part->cmsg_level = SOL_SOCKET;
  part->cmsg_type = SO_TIMESTAMPNS;
  part->cmsg_len = CMSG_LEN(sizeof now);
  std::memcpy(CMSG_DATA(part), &now, sizeof now);
  header.msg_controllen = CMSG_SPACE(sizeof now);
  return true;
}

/// Appends an attribute to a netlink message.
void attribute(std::string& message, unsigned short type, const std::string& payload) {
  rtattr head{};
  head.rta_type = type;
  head.rta_len = static_cast<unsigned short>(RTA_LENGTH(payload.size()));
  message.append(reinterpret_cast<const char*>(&head), sizeof head);
  message += payload;
  message.resize(RTA_ALIGN(message.size()));
}

std::string number(int value) { return {reinterpret_cast<const char*>(&value), sizeof value}; }

/// The kernel's description of an interface.
std::string description(const std::string& name) {
  struct {
    nlmsghdr header{};
    ifinfomsg link{};
  } head;
  head.header.nlmsg_type = RTM_NEWLINK;
  head.link.ifi_type = begins(name, "eth") ? ARPHRD_ETHER : ARPHRD_CAN;
  head.link.ifi_flags = begins(name, "down") ? 0U : static_cast<unsigned>(IFF_UP);
  std::string message(reinterpret_cast<const char*>(&head), sizeof head);
  attribute(message, IFLA_IFNAME, name + '\0');
  attribute(message, IFLA_MTU, number(CANFD_MTU));
  attribute(message, IFLA_TXQLEN, number(1000));
  std::string kind;
  attribute(kind, IFLA_INFO_KIND, std::string("vcan") + '\0');
  attribute(message, IFLA_LINKINFO, kind);
  const auto size = static_cast<std::uint32_t>(message.size());
  std::memcpy(message.data(), &size, sizeof size);
  return message;
}

}  // namespace

extern "C" {

int socket(int domain, int type, int protocol) noexcept {
  static auto* const make = real<decltype(socket)>("socket");
  const bool can = domain == AF_CAN;
  const bool netlink = domain == AF_NETLINK;
  if (folder() == nullptr || !(can || netlink)) return make(domain, type, protocol);
  const int flags = type & (SOCK_NONBLOCK | SOCK_CLOEXEC);
  const int descriptor = make(AF_UNIX, SOCK_DGRAM | flags, 0);
  if (descriptor >= kMost) return fail(EMFILE);
  if (descriptor >= 0) {
    Socket made;
    made.can = can;
    made.netlink = netlink;
    at(descriptor) = made;
  }
  return descriptor;
}

int close(int descriptor) {
  static auto* const end = real<decltype(close)>("close");
  if (is(descriptor, &Socket::can) && !at(descriptor).file.empty()) ::unlink(path_of(at(descriptor).file).c_str());
  if (descriptor >= 0 && descriptor < kMost) at(descriptor) = {};
  return end(descriptor);
}

int ioctl(int descriptor, unsigned long what, ...) noexcept {
  va_list arguments;
  va_start(arguments, what);
  void* argument = va_arg(arguments, void*);
  va_end(arguments);
  static auto* const control = real<int(int, unsigned long, void*)>("ioctl");
  if (!is(descriptor, &Socket::can)) return control(descriptor, what, argument);
  ifreq& request = *static_cast<ifreq*>(argument);
  const std::string name = request.ifr_name;
  const int index = index_of(name);
  if (index == 0) return fail(ENODEV);
  switch (what) {
    case SIOCGIFINDEX:
      request.ifr_ifindex = index;
      at(descriptor).small = begins(name, "small");
      return 0;
    case SIOCGIFHWADDR:
      request.ifr_hwaddr.sa_family = begins(name, "eth") ? ARPHRD_ETHER : ARPHRD_CAN;
      return 0;
    case SIOCGIFFLAGS: request.ifr_flags = begins(name, "down") ? 0 : IFF_UP; return 0;
    case SIOCGIFMTU: request.ifr_mtu = CANFD_MTU; return 0;
    default: return fail(ENOTTY);
  }
}

int setsockopt(int descriptor, int level, int option, const void* value, socklen_t size) noexcept {
  static auto* const set = real<decltype(setsockopt)>("setsockopt");
  if (!is(descriptor, &Socket::can)) return set(descriptor, level, option, value, size);
  if (level == SOL_SOCKET && option == SO_RCVBUFFORCE) std::memcpy(&at(descriptor).buffer, value, sizeof(int));
  return 0;
}

int getsockopt(int descriptor, int level, int option, void* value, socklen_t* size) noexcept {
  static auto* const get = real<decltype(getsockopt)>("getsockopt");
  if (!is(descriptor, &Socket::can)) return get(descriptor, level, option, value, size);
  const int granted = at(descriptor).small ? 4096 : 2 * at(descriptor).buffer;
  std::memcpy(value, &granted, sizeof granted);
  return 0;
}

int bind(int descriptor, const sockaddr* address, socklen_t size) noexcept {
  static auto* const bind_to = real<decltype(bind)>("bind");
  if (!is(descriptor, &Socket::can)) return bind_to(descriptor, address, size);
  sockaddr_can can{};
  std::memcpy(&can, address, sizeof can);
  Socket& socket = at(descriptor);
  socket.interface = name_of(can.can_ifindex);
  if (begins(socket.interface, "closed")) return fail(EPERM);
  socket.file = socket.interface + '.' + std::to_string(::getpid()) + '.' + std::to_string(descriptor);
  const std::string file = path_of(socket.file);
  if (::mkfifo(file.c_str(), 0600) != 0) return -1;
  const int pipe = ::open(file.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  if (pipe < 0) return -1;
  ::dup2(pipe, descriptor);
  return ::close(pipe);
}

ssize_t send(int descriptor, const void* data, size_t size, int flags) {
  static auto* const pass = real<decltype(send)>("send");
  if (is(descriptor, &Socket::can)) return broadcast(at(descriptor), descriptor, data, size);
  if (!is(descriptor, &Socket::netlink)) return pass(descriptor, data, size, flags);
  at(descriptor).interface = static_cast<const char*>(data) + NLMSG_LENGTH(sizeof(ifinfomsg)) + sizeof(rtattr);
  return static_cast<ssize_t>(size);
}

ssize_t recv(int descriptor, void* data, size_t size, int flags) {
  static auto* const take_from = real<decltype(recv)>("recv");
  if (!is(descriptor, &Socket::netlink)) return take_from(descriptor, data, size, flags);
  if (index_of(at(descriptor).interface) == 0) return fail(ENODEV);
  const std::string message = description(at(descriptor).interface);
  std::memcpy(data, message.data(), std::min(size, message.size()));
  return static_cast<ssize_t>(message.size());
}

int recvmmsg(int descriptor, mmsghdr* messages, unsigned count, int flags, timespec* patience) {
  static auto* const take_all = real<decltype(recvmmsg)>("recvmmsg");
  if (!is(descriptor, &Socket::can)) return take_all(descriptor, messages, count, flags, patience);
  unsigned taken = 0;
  while (taken < count && take(descriptor, messages[taken])) ++taken;
  return taken > 0 ? static_cast<int>(taken) : fail(EAGAIN);
}

}  // extern "C"
