#include "tests/hal/fake_kernel.h"

#include <gtest/gtest.h>

#include <linux/can.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdarg>
#include <cstring>

namespace godobject::hal {
namespace {

FakeKernel* present = nullptr;

int fail(int error) {
  errno = error;
  return -1;
}

std::vector<std::uint8_t> bytes_of(const void* data, std::size_t size) {
  const auto* begin = static_cast<const std::uint8_t*>(data);
  return {begin, begin + size};
}

}  // namespace

FakeKernel::FakeKernel() { present = this; }

FakeKernel::~FakeKernel() { present = nullptr; }

std::vector<std::uint8_t> FakeKernel::option(int level, int name) const {
  const auto found = options.find({level, name});
  return found == options.end() ? std::vector<std::uint8_t>() : found->second;
}

namespace {

int answer(FakeKernel& kernel, unsigned long what, ifreq& request) {
  const auto found = kernel.interfaces.find(request.ifr_name);
  if (found == kernel.interfaces.end() || kernel.failing_requests.contains(what)) return fail(ENODEV);
  const FakeKernel::Interface& interface = found->second;
  switch (what) {
    case SIOCGIFINDEX: request.ifr_ifindex = interface.index; return 0;
    case SIOCGIFHWADDR: request.ifr_hwaddr.sa_family = interface.hardware; return 0;
    case SIOCGIFFLAGS: request.ifr_flags = interface.flags; return 0;
    case SIOCGIFMTU: request.ifr_mtu = interface.mtu; return 0;
    default: return fail(ENOTTY);
  }
}

/// Fills one message as the kernel does: what does not fit is cut off and marked.
void fill(mmsghdr& header, const FakeKernel::Message& message) {
  msghdr& head = header.msg_hdr;
  EXPECT_EQ(head.msg_name, nullptr);
  EXPECT_EQ(head.msg_namelen, 0u);
  ASSERT_EQ(head.msg_iovlen, 1u);
  EXPECT_EQ(head.msg_iov[0].iov_len, sizeof(canfd_frame));
  const std::size_t size = std::min(message.bytes.size(), head.msg_iov[0].iov_len);
  std::memcpy(head.msg_iov[0].iov_base, message.bytes.data(), size);
  header.msg_len = static_cast<unsigned>(size);
  head.msg_flags = message.flags | (size < message.bytes.size() ? MSG_TRUNC : 0);
  ASSERT_LE(message.control.size(), head.msg_controllen);
  if (!message.control.empty()) std::memcpy(head.msg_control, message.control.data(), message.control.size());
  head.msg_controllen = message.control.size();
}

int receive(FakeKernel& kernel, mmsghdr* headers, unsigned count) {
  ++kernel.receives;
  if (kernel.receives_none) return 0;
  if (!kernel.messages.empty() && kernel.messages.front().error != 0) {
    const int error = kernel.messages.front().error;
    kernel.messages.pop_front();
    return fail(error);
  }
  unsigned taken = 0;
  while (taken < count && !kernel.messages.empty() && kernel.messages.front().error == 0) {
    fill(headers[taken++], kernel.messages.front());
    kernel.messages.pop_front();
  }
  return taken > 0 ? static_cast<int>(taken) : fail(EAGAIN);
}

bool is_fake(int descriptor) { return present != nullptr && descriptor >= present->first_socket; }

}  // namespace
}  // namespace godobject::hal

using godobject::hal::FakeKernel;
using godobject::hal::present;

extern "C" {

int socket(int domain, int type, int protocol) noexcept {
  if (present == nullptr) return static_cast<int>(::syscall(SYS_socket, domain, type, protocol));
  present->socket_arguments = {domain, type, protocol};
  if (present->socket_error != 0) return godobject::hal::fail(present->socket_error);
  return present->first_socket + present->open_sockets++;
}

int close(int descriptor) {
  if (present == nullptr) return static_cast<int>(::syscall(SYS_close, descriptor));
  present->closed.push_back(descriptor);
  return 0;
}

int ioctl(int descriptor, unsigned long what, ...) noexcept {
  va_list arguments;
  va_start(arguments, what);
  void* argument = va_arg(arguments, void*);
  va_end(arguments);
  if (!godobject::hal::is_fake(descriptor)) return static_cast<int>(::syscall(SYS_ioctl, descriptor, what, argument));
  return godobject::hal::answer(*present, what, *static_cast<ifreq*>(argument));
}

int setsockopt(int descriptor, int level, int name, const void* value, socklen_t size) noexcept {
  if (!godobject::hal::is_fake(descriptor)) {
    return static_cast<int>(::syscall(SYS_setsockopt, descriptor, level, name, value, size));
  }
  if (present->refused.contains({level, name})) return godobject::hal::fail(EPERM);
  present->options[{level, name}] = godobject::hal::bytes_of(value, size);
  return 0;
}

/// Returns the receive buffer, which the kernel makes twice as large as it was asked to.
int getsockopt(int descriptor, int level, int name, void* value, socklen_t* size) noexcept {
  if (!godobject::hal::is_fake(descriptor)) {
    return static_cast<int>(::syscall(SYS_getsockopt, descriptor, level, name, value, size));
  }
  if (present->buffer_is_unknown || level != SOL_SOCKET || name != SO_RCVBUF || *size != sizeof(int))
    return godobject::hal::fail(EINVAL);
  int granted = 212'992;  // nobody has asked
  for (const int asked : {SO_RCVBUF, SO_RCVBUFFORCE}) {
    const std::vector<std::uint8_t> bytes = present->option(SOL_SOCKET, asked);
    if (bytes.size() != sizeof granted) continue;
    std::memcpy(&granted, bytes.data(), sizeof granted);
    granted = 2 * (asked == SO_RCVBUF ? std::min(granted, present->largest_buffer / 2) : granted);
  }
  std::memcpy(value, &granted, sizeof granted);
  return 0;
}

int bind(int descriptor, const sockaddr* address, socklen_t size) noexcept {
  if (!godobject::hal::is_fake(descriptor)) {
    return static_cast<int>(::syscall(SYS_bind, descriptor, address, size));
  }
  if (present->bind_error != 0) return godobject::hal::fail(present->bind_error);
  present->bound = godobject::hal::bytes_of(address, size);
  return 0;
}

ssize_t send(int descriptor, const void* data, std::size_t size, int flags) {
  if (!godobject::hal::is_fake(descriptor)) {
    return ::syscall(SYS_sendto, descriptor, data, size, flags, nullptr, 0);
  }
  if (!present->send_errors.empty()) {
    const int error = present->send_errors.front();
    present->send_errors.pop_front();
    if (error != 0) return godobject::hal::fail(error);
  }
  present->sent.push_back({godobject::hal::bytes_of(data, size), flags});
  return static_cast<ssize_t>(size);
}

int recvmmsg(int descriptor, mmsghdr* headers, unsigned count, int flags, timespec* timeout) {
  if (!godobject::hal::is_fake(descriptor)) {
    return static_cast<int>(::syscall(SYS_recvmmsg, descriptor, headers, count, flags, timeout));
  }
  EXPECT_EQ(flags, MSG_DONTWAIT);
  return godobject::hal::receive(*present, headers, count);
}

int clock_gettime(clockid_t clock, timespec* now) noexcept {
  if (present == nullptr) return static_cast<int>(::syscall(SYS_clock_gettime, clock, now));
  present->clocks.push_back(clock);
  *now = present->now;
  return 0;
}

int clock_nanosleep(clockid_t clock, int flags, const timespec* until, timespec* remaining) {
  if (present == nullptr) {
    return ::syscall(SYS_clock_nanosleep, clock, flags, until, remaining) == 0 ? 0 : errno;
  }
  if (until == nullptr) return EFAULT;
  present->sleeps.push_back({clock, flags, *until});
  return present->interrupts-- > 0 ? EINTR : 0;
}

}  // extern "C"
