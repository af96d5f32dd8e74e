#include "hal/linux/socketcan.h"

#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <net/if_arp.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cstring>
#include <ctime>

namespace godobject::hal {
namespace {

/// Frames that one call of `receive` may drop. Chosen: bounds its time to that of 4 batches.
constexpr int kMostLeftOut = 64;
constexpr std::size_t kMostIdentifiers = CAN_RAW_FILTER_MAX - 2;

/// The error classes to receive; lost arbitration is no error.
constexpr can_err_mask_t kErrors = CAN_ERR_TX_TIMEOUT | CAN_ERR_CRTL | CAN_ERR_PROT | CAN_ERR_TRX | CAN_ERR_ACK |
                                   CAN_ERR_BUSOFF | CAN_ERR_BUSERROR | CAN_ERR_RESTARTED;

bool is_length(int bytes, bool fd) noexcept {
  if (bytes <= CAN_MAX_DLEN) return true;
  constexpr std::array<int, 7> kLong = {12, 16, 20, 24, 32, 48, 64};
  return fd && std::find(kLong.begin(), kLong.end(), bytes) != kLong.end();
}

bool set(int descriptor, int level, int option, const void* value, std::size_t size) noexcept {
  return ::setsockopt(descriptor, level, option, value, static_cast<socklen_t>(size)) == 0;
}

bool switch_on(int descriptor, int level, int option) noexcept {
  const int on = 1;
  return set(descriptor, level, option, &on, sizeof on);
}

/// Requests a receive buffer and returns the granted size, which may be smaller.
int set_receive_buffer(int descriptor, int bytes) noexcept {
  const int half = bytes / 2;  // the kernel doubles it
  if (!set(descriptor, SOL_SOCKET, SO_RCVBUFFORCE, &half, sizeof half)) {
    set(descriptor, SOL_SOCKET, SO_RCVBUF, &half, sizeof half);
  }
  int granted = 0;
  socklen_t size = sizeof granted;
  ::getsockopt(descriptor, SOL_SOCKET, SO_RCVBUF, &granted, &size);
  return granted;
}

bool set_filters(int descriptor, std::span<const std::uint16_t> identifiers) noexcept {
  if (identifiers.empty()) return true;
  if (identifiers.size() > kMostIdentifiers) return false;
  std::array<can_filter, kMostIdentifiers + 2> filters{};
  std::size_t count = 0;
  for (const std::uint16_t id : identifiers) {
    filters[count++] = {id, CAN_SFF_MASK | CAN_EFF_FLAG | CAN_RTR_FLAG};
  }
  filters[count++] = {CAN_EFF_FLAG, CAN_EFF_FLAG};  // none of CANopen: passed in order to be counted
  filters[count++] = {CAN_RTR_FLAG, CAN_EFF_FLAG | CAN_RTR_FLAG};
  return set(descriptor, SOL_CAN_RAW, CAN_RAW_FILTER, filters.data(), count * sizeof(can_filter));
}

}  // namespace

const char* describe(OpenStatus status) noexcept {
  switch (status) {
    case OpenStatus::kOk: return "ok";
    case OpenStatus::kNoCan: return "this kernel has no CAN; modprobe can_raw, or boot a kernel with CAN";
    case OpenStatus::kSocket: return "cannot make a CAN socket";
    case OpenStatus::kNoInterface: return "no such interface; ip link shows the existing ones";
    case OpenStatus::kNotCan: return "not a CAN interface";
    case OpenStatus::kInterfaceDown: return "the interface is down; ip link set it up";
    case OpenStatus::kNoFd: return "the interface has no FD frames; ip link set it up with fd on, a vcan with mtu 72";
    case OpenStatus::kOption: return "an option of the CAN socket was refused";
    case OpenStatus::kBind: return "cannot bind the CAN socket";
  }
  return "unknown status";
}

SocketCan::~SocketCan() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

OpenResult SocketCan::open(const char* interface, const SocketCanOptions& options) noexcept {
  OpenResult result;
  const auto end = [&](OpenStatus status, bool with_error) {
    result.status = status;
    result.error = with_error ? errno : 0;
    return result;
  };
  if (descriptor_ >= 0) ::close(descriptor_);
  health_ = {};
  drop_counter_ = 0;
  fetched_ = taken_ = 0;
  only_fd_ = options.fd && options.only_fd;

  descriptor_ = ::socket(AF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW);
  if (descriptor_ < 0) {
    return end(errno == EAFNOSUPPORT || errno == EPROTONOSUPPORT ? OpenStatus::kNoCan : OpenStatus::kSocket, true);
  }

  ifreq request{};
  if (std::strlen(interface) >= sizeof request.ifr_name) return end(OpenStatus::kNoInterface, false);
  std::strncpy(request.ifr_name, interface, sizeof request.ifr_name - 1);
  if (::ioctl(descriptor_, SIOCGIFINDEX, &request) != 0) return end(OpenStatus::kNoInterface, true);
  const int index = request.ifr_ifindex;
  if (::ioctl(descriptor_, SIOCGIFHWADDR, &request) != 0) return end(OpenStatus::kNoInterface, true);
  if (request.ifr_hwaddr.sa_family != ARPHRD_CAN) return end(OpenStatus::kNotCan, false);
  if (::ioctl(descriptor_, SIOCGIFFLAGS, &request) != 0) return end(OpenStatus::kNoInterface, true);
  if ((request.ifr_flags & IFF_UP) == 0) return end(OpenStatus::kInterfaceDown, false);
  if (::ioctl(descriptor_, SIOCGIFMTU, &request) != 0) return end(OpenStatus::kNoInterface, true);
  if (options.fd && request.ifr_mtu < static_cast<int>(CANFD_MTU)) return end(OpenStatus::kNoFd, false);

  result.receive_buffer = set_receive_buffer(descriptor_, options.receive_buffer);
  const bool set_all = switch_on(descriptor_, SOL_CAN_RAW, CAN_RAW_RECV_OWN_MSGS) &&
                       (!options.fd || switch_on(descriptor_, SOL_CAN_RAW, CAN_RAW_FD_FRAMES)) &&
                       set(descriptor_, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, &kErrors, sizeof kErrors) &&
                       set_filters(descriptor_, options.identifiers) &&
                       switch_on(descriptor_, SOL_SOCKET, SO_RXQ_OVFL) &&
                       switch_on(descriptor_, SOL_SOCKET, SO_TIMESTAMPNS);
  if (!set_all) return end(OpenStatus::kOption, true);

  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = index;
  if (::bind(descriptor_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    return end(OpenStatus::kBind, true);
  }
  return result;
}

SendResult SocketCan::send(const CanFrame& frame) noexcept {
  assert(frame.id <= CAN_SFF_MASK && is_length(frame.length, frame.fd));
  const bool fd = frame.fd || only_fd_;
  canfd_frame raw{};  // a classical frame has the same layout, truncated
  raw.can_id = frame.id;
  raw.len = frame.length;
  raw.flags = fd ? CANFD_BRS : 0;
  std::memcpy(raw.data, frame.data.data(), frame.length);
  const std::size_t size = fd ? CANFD_MTU : CAN_MTU;
  const ssize_t sent = ::send(descriptor_, &raw, size, MSG_DONTWAIT | MSG_NOSIGNAL);
  if (sent == static_cast<ssize_t>(size)) {
    ++health_.unreturned;
    return SendResult::kSent;
  }
  if (errno == ENOBUFS || errno == EAGAIN || errno == EINTR || errno == ENOMEM) return SendResult::kFull;
  health_.down = true;
  return SendResult::kDown;
}

bool SocketCan::receive(ReceivedFrame& received) noexcept {
  for (; left_out_ < kMostLeftOut; ++left_out_) {
    if (taken_ == fetched_ && !fetch()) break;
    const std::size_t i = taken_++;
    if (take(messages_[i], frames_[i], received)) return true;
  }
  left_out_ = 0;
  return false;
}

/// Reads the next batch of frames. False: there is none.
bool SocketCan::fetch() noexcept {
  fetched_ = taken_ = 0;
  for (std::size_t i = 0; i < kBatch; ++i) {
    vectors_[i] = {&frames_[i], sizeof(canfd_frame)};
    messages_[i].msg_hdr.msg_iov = &vectors_[i];
    messages_[i].msg_hdr.msg_iovlen = 1;
    messages_[i].msg_hdr.msg_control = controls_[i].data();
    messages_[i].msg_hdr.msg_controllen = kControlBytes;
  }
  for (int attempt = 0; attempt < 2; ++attempt) {
    const int count = ::recvmmsg(descriptor_, messages_.data(), kBatch, MSG_DONTWAIT, nullptr);
    if (count > 0) {
      fetched_ = static_cast<std::size_t>(count);
      return true;
    }
    if (count == 0 || errno == EAGAIN || errno == EINTR) return false;
    health_.down = true;  // the kernel reports it once; earlier frames are still in the queue
  }
  return false;
}

/// Converts a received message. False: it is dropped.
bool SocketCan::take(const mmsghdr& message, const canfd_frame& raw, ReceivedFrame& received) noexcept {
  const msghdr& header = message.msg_hdr;
  read_control(header, received);
  const bool fd = message.msg_len == CANFD_MTU;
  const bool whole = (fd || message.msg_len == CAN_MTU) && (header.msg_flags & MSG_TRUNC) == 0;
  if (whole && (raw.can_id & CAN_ERR_FLAG) != 0) {
    read_error(raw);
    return false;
  }
  if (!whole || (raw.can_id & ~CAN_SFF_MASK) != 0 || !is_length(raw.len, fd)) {
    ++health_.malformed;
    return false;
  }
  received.own = (header.msg_flags & MSG_CONFIRM) != 0;
  if (received.own) health_.unreturned = 0;
  received.frame = {static_cast<std::uint16_t>(raw.can_id), raw.len, fd, {}};
  std::memcpy(received.frame.data.data(), raw.data, raw.len);
  return true;
}

/// Reads time stamp and drop counter.
void SocketCan::read_control(const msghdr& header, ReceivedFrame& received) noexcept {
  received.time_ns = 0;
  for (const cmsghdr* part = CMSG_FIRSTHDR(&header); part != nullptr;
       part = CMSG_NXTHDR(const_cast<msghdr*>(&header), const_cast<cmsghdr*>(part))) {
    if (part->cmsg_level != SOL_SOCKET) continue;
    if (part->cmsg_type == SCM_TIMESTAMPNS) {
      timespec time{};
      std::memcpy(&time, CMSG_DATA(part), sizeof time);
      received.time_ns = time.tv_sec * 1'000'000'000 + time.tv_nsec;
    } else if (part->cmsg_type == SO_RXQ_OVFL) {
      std::uint32_t drops = 0;
      std::memcpy(&drops, CMSG_DATA(part), sizeof drops);
      health_.dropped += drops - drop_counter_;  // modulo 2^32
      drop_counter_ = drops;
    }
  }
}

void SocketCan::read_error(const canfd_frame& raw) noexcept {
  ++health_.errors;
  if ((raw.can_id & CAN_ERR_BUSOFF) != 0) health_.bus_off = true;
  if ((raw.can_id & CAN_ERR_CRTL) != 0) {
    const std::uint8_t state = raw.data[1];
    constexpr std::uint8_t kPassive = CAN_ERR_CRTL_RX_PASSIVE | CAN_ERR_CRTL_TX_PASSIVE;
    constexpr std::uint8_t kBetter = CAN_ERR_CRTL_RX_WARNING | CAN_ERR_CRTL_TX_WARNING | CAN_ERR_CRTL_ACTIVE;
    if ((state & kPassive) != 0) {
      health_.passive = true;
    } else if ((state & kBetter) != 0) {
      health_.passive = false;
    }
  }
}

}  // namespace godobject::hal
