// SocketCan on a kernel that answers as a test wants: opening, options, error numbers, messages.
#include <gtest/gtest.h>

#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <net/if_arp.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "hal/linux/socketcan.h"
#include "tests/hal/fake_kernel.h"

namespace godobject::hal {
namespace {

constexpr int kSocket = FakeKernel::kSocket;

int number(const std::vector<std::uint8_t>& bytes) {
  int value = -1;
  if (bytes.size() == sizeof value) std::memcpy(&value, bytes.data(), sizeof value);
  return value;
}

class SocketCanOpenTest : public testing::Test {
 protected:
  SocketCanOpenTest() { kernel_.interfaces["can3"] = {}; }

  void expect_end(OpenStatus status, int error, const SocketCanOptions& options = {}) {
    errno = EIO;  // of an earlier call
    const OpenResult result = bus_.open("can3", options);
    EXPECT_EQ(result.status, status) << describe(result.status);
    EXPECT_EQ(result.error, error);
  }

  bool is_on(int level, int name) const { return number(kernel_.option(level, name)) == 1; }

  static FakeKernel::Message message(canid_t id, std::uint8_t length, std::size_t size = CAN_MTU) {
    canfd_frame raw{};
    raw.can_id = id;
    raw.len = length;
    std::iota(std::begin(raw.data), std::end(raw.data), std::uint8_t{0x40});
    FakeKernel::Message result;
    result.bytes.resize(size);
    std::memcpy(result.bytes.data(), &raw, std::min(size, sizeof raw));
    return result;
  }

  static FakeKernel::Message failure(int error) { return {.bytes = {}, .error = error}; }

  /// Adds a control message of SOL_SOCKET.
  template <class Value>
  static void add_control(FakeKernel::Message& message, int type, const Value& value, int level = SOL_SOCKET) {
    cmsghdr header{};
    header.cmsg_len = CMSG_LEN(sizeof value);
    header.cmsg_level = level;
    header.cmsg_type = type;
    std::vector<std::uint8_t> part(CMSG_SPACE(sizeof value));
    std::memcpy(part.data(), &header, sizeof header);
    std::memcpy(part.data() + CMSG_LEN(0), &value, sizeof value);
    message.control.insert(message.control.end(), part.begin(), part.end());
  }

  FakeKernel kernel_;
  SocketCan bus_;
};

TEST_F(SocketCanOpenTest, BindsARawSocketThatNeverWaitsToTheInterface) {
  kernel_.interfaces["can4"] = {.index = 9};
  expect_end(OpenStatus::kOk, 0);
  EXPECT_EQ(bus_.descriptor(), kSocket);
  EXPECT_EQ(kernel_.socket_arguments, (std::vector<int>{AF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW}));
  sockaddr_can address{};
  ASSERT_EQ(kernel_.bound.size(), sizeof address);
  std::memcpy(&address, kernel_.bound.data(), sizeof address);
  EXPECT_EQ(address.can_family, AF_CAN);
  EXPECT_EQ(address.can_ifindex, 7);
  EXPECT_TRUE(kernel_.closed.empty());
}

TEST_F(SocketCanOpenTest, AsksForOwnFramesErrorsTimeStampsAndDropCounts) {
  expect_end(OpenStatus::kOk, 0);
  EXPECT_TRUE(is_on(SOL_CAN_RAW, CAN_RAW_RECV_OWN_MSGS));
  EXPECT_TRUE(is_on(SOL_SOCKET, SO_RXQ_OVFL));
  EXPECT_TRUE(is_on(SOL_SOCKET, SO_TIMESTAMPNS));
  EXPECT_TRUE(kernel_.option(SOL_CAN_RAW, CAN_RAW_FD_FRAMES).empty()) << "not asked for";
  EXPECT_TRUE(kernel_.option(SOL_CAN_RAW, CAN_RAW_FILTER).empty()) << "all identifiers";
  const auto errors = static_cast<can_err_mask_t>(number(kernel_.option(SOL_CAN_RAW, CAN_RAW_ERR_FILTER)));
  for (const can_err_mask_t error : {CAN_ERR_TX_TIMEOUT, CAN_ERR_CRTL, CAN_ERR_PROT, CAN_ERR_TRX, CAN_ERR_ACK,
                                     CAN_ERR_BUSOFF, CAN_ERR_BUSERROR, CAN_ERR_RESTARTED}) {
    EXPECT_NE(errors & error, 0u) << error;
  }
  EXPECT_EQ(errors & CAN_ERR_LOSTARB, 0u) << "no error";
}

TEST_F(SocketCanOpenTest, NamesTheMissingSupportOfTheKernel) {
  for (const auto& [error, status] :
       {std::pair(EAFNOSUPPORT, OpenStatus::kNoCan), std::pair(EPROTONOSUPPORT, OpenStatus::kNoCan),
        std::pair(EMFILE, OpenStatus::kSocket), std::pair(EPERM, OpenStatus::kSocket)}) {
    kernel_.socket_error = error;
    expect_end(status, error);
    EXPECT_LT(bus_.descriptor(), 0);
  }
}

TEST_F(SocketCanOpenTest, RefusesANameThatNoInterfaceHas) {
  EXPECT_EQ(bus_.open("can5", {}).status, OpenStatus::kNoInterface);
  EXPECT_EQ(bus_.open("can5", {}).error, ENODEV);
  const std::string longest(IFNAMSIZ - 1, 'c');
  kernel_.interfaces[longest] = {};
  EXPECT_EQ(bus_.open(longest.c_str(), {}).status, OpenStatus::kOk);
  const OpenResult longer = bus_.open((longest + 'c').c_str(), {});
  EXPECT_EQ(longer.status, OpenStatus::kNoInterface) << "and not the one whose name is the beginning";
  EXPECT_EQ(longer.error, 0);
  EXPECT_EQ(longer.receive_buffer, 0);
}

TEST_F(SocketCanOpenTest, AnInterfaceThatGoesWhileItIsAskedIsNoInterface) {
  constexpr std::array<unsigned long, 4> kRequests = {SIOCGIFINDEX, SIOCGIFHWADDR, SIOCGIFFLAGS, SIOCGIFMTU};
  for (const unsigned long request : kRequests) {
    kernel_.failing_requests = {request};
    kernel_.options.clear();
    expect_end(OpenStatus::kNoInterface, ENODEV);
    EXPECT_TRUE(kernel_.options.empty());
    EXPECT_TRUE(kernel_.bound.empty());
  }
}

TEST_F(SocketCanOpenTest, RefusesAnInterfaceThatIsOfNoUse) {
  kernel_.interfaces["can3"] = {.hardware = ARPHRD_ETHER};
  expect_end(OpenStatus::kNotCan, 0);
  kernel_.interfaces["can3"] = {.flags = IFF_RUNNING};
  expect_end(OpenStatus::kInterfaceDown, 0);
  kernel_.interfaces["can3"] = {.flags = IFF_UP | IFF_RUNNING};
  expect_end(OpenStatus::kOk, 0);
}

TEST_F(SocketCanOpenTest, FdNeedsAnInterfaceWithFdFrames) {
  for (const int mtu : {16, 71, 72, 2060}) {
    kernel_.interfaces["can3"].mtu = mtu;
    kernel_.options.clear();
    expect_end(mtu < 72 ? OpenStatus::kNoFd : OpenStatus::kOk, 0, {.fd = true});
    EXPECT_EQ(is_on(SOL_CAN_RAW, CAN_RAW_FD_FRAMES), mtu >= 72);
    expect_end(OpenStatus::kOk, 0);  // classical frames go everywhere
  }
}

TEST_F(SocketCanOpenTest, EveryRefusedOptionEndsTheOpening) {
  const std::vector<std::uint16_t> identifiers = {0x80};
  kernel_.interfaces["can3"].mtu = 72;
  const std::vector<std::pair<int, int>> options = {
      {SOL_CAN_RAW, CAN_RAW_RECV_OWN_MSGS}, {SOL_CAN_RAW, CAN_RAW_FD_FRAMES}, {SOL_CAN_RAW, CAN_RAW_ERR_FILTER},
      {SOL_CAN_RAW, CAN_RAW_FILTER},        {SOL_SOCKET, SO_RXQ_OVFL},        {SOL_SOCKET, SO_TIMESTAMPNS}};
  for (const auto& option : options) {
    kernel_.refused = {option};
    expect_end(OpenStatus::kOption, EPERM, {.fd = true, .identifiers = identifiers});
    EXPECT_TRUE(kernel_.bound.empty()) << option.second;
  }
  kernel_.refused = {{SOL_CAN_RAW, CAN_RAW_FD_FRAMES}, {SOL_CAN_RAW, CAN_RAW_FILTER}};
  expect_end(OpenStatus::kOk, 0);  // neither is asked for
}

TEST_F(SocketCanOpenTest, NamesARefusedAddress) {
  kernel_.bind_error = ENETDOWN;
  expect_end(OpenStatus::kBind, ENETDOWN);
}

/// The kernel doubles a buffer. It grants the whole to root only; others get as much as they may have.
TEST_F(SocketCanOpenTest, TellsTheGrantedReceiveBuffer) {
  EXPECT_EQ(bus_.open("can3", {}).receive_buffer, 1 << 20);
  EXPECT_EQ(bus_.open("can3", {.receive_buffer = 4096}).receive_buffer, 4096);
  EXPECT_EQ(number(kernel_.option(SOL_SOCKET, SO_RCVBUFFORCE)), 2048);
  EXPECT_TRUE(kernel_.option(SOL_SOCKET, SO_RCVBUF).empty()) << "that one is bounded";
  kernel_.options.clear();
  kernel_.refused = {{SOL_SOCKET, SO_RCVBUFFORCE}};
  kernel_.largest_buffer = 425'984;
  EXPECT_EQ(bus_.open("can3", {}).receive_buffer, 425'984);
  EXPECT_EQ(bus_.open("can3", {.receive_buffer = 4096}).receive_buffer, 4096);
  kernel_.options.clear();
  kernel_.refused.insert({SOL_SOCKET, SO_RCVBUF});
  EXPECT_EQ(bus_.open("can3", {}).receive_buffer, 212'992) << "what it has anyway";
  kernel_.buffer_is_unknown = true;
  EXPECT_EQ(bus_.open("can3", {}).receive_buffer, 0);
}

/// As the kernel compares: an identifier passes if it equals a filter's in the bits of its mask.
bool passes(const std::vector<can_filter>& filters, canid_t id) {
  for (const can_filter& filter : filters) {
    if ((id & filter.can_mask) == (filter.can_id & filter.can_mask)) return true;
  }
  return false;
}

TEST_F(SocketCanOpenTest, FiltersPassTheIdentifiersAndWhatIsToBeCounted) {
  const std::vector<std::uint16_t> identifiers = {0x000, 0x080, 0x185, 0x7FF};
  expect_end(OpenStatus::kOk, 0, {.identifiers = identifiers});
  const std::vector<std::uint8_t> bytes = kernel_.option(SOL_CAN_RAW, CAN_RAW_FILTER);
  std::vector<can_filter> filters(bytes.size() / sizeof(can_filter));
  ASSERT_EQ(bytes.size(), filters.size() * sizeof(can_filter));
  std::memcpy(filters.data(), bytes.data(), bytes.size());
  EXPECT_EQ(filters.size(), identifiers.size() + 2);
  for (canid_t id = 0; id <= CAN_SFF_MASK; ++id) {
    const bool wanted = std::find(identifiers.begin(), identifiers.end(), id) != identifiers.end();
    EXPECT_EQ(passes(filters, id), wanted) << id;
    EXPECT_TRUE(passes(filters, id | CAN_RTR_FLAG)) << "remote";
    EXPECT_TRUE(passes(filters, id | CAN_EFF_FLAG)) << "extended";
    EXPECT_TRUE(passes(filters, id | CAN_EFF_FLAG | CAN_RTR_FLAG));
  }
}

/// CAN_RAW_FILTER_MAX is 512; two filters are for extended and for remote frames.
TEST_F(SocketCanOpenTest, TakesAsManyIdentifiersAsTheKernelHasFilters) {
  std::vector<std::uint16_t> identifiers(510);
  std::iota(identifiers.begin(), identifiers.end(), std::uint16_t{0});
  expect_end(OpenStatus::kOk, 0, {.identifiers = identifiers});
  EXPECT_EQ(kernel_.option(SOL_CAN_RAW, CAN_RAW_FILTER).size(), 512 * sizeof(can_filter));
  identifiers.push_back(0x7FF);
  errno = 0;
  EXPECT_EQ(bus_.open("can3", {.identifiers = identifiers}).status, OpenStatus::kOption);
}

TEST_F(SocketCanOpenTest, ClosesEverySocketOnce) {
  {
    SocketCan never;
    SocketCan given(0);
    SocketCan bus;
    EXPECT_EQ(bus.open("can3", {}).status, OpenStatus::kOk);
    EXPECT_TRUE(kernel_.closed.empty());
    EXPECT_EQ(bus.open("can3", {}).status, OpenStatus::kOk);
    EXPECT_EQ(kernel_.closed, std::vector<int>{kSocket}) << "of the opening before";
    EXPECT_EQ(given.descriptor(), 0);
  }
  EXPECT_EQ(kernel_.closed, (std::vector<int>{kSocket, kSocket + 1, 0}));
  kernel_.closed.clear();
  SocketCan zero(0);
  EXPECT_EQ(zero.open("can3", {}).status, OpenStatus::kOk);
  EXPECT_EQ(kernel_.closed, std::vector<int>{0});
}

/// A process without standard input gets 0.
TEST_F(SocketCanOpenTest, ADescriptorMayBeZero) {
  kernel_.first_socket = 0;
  expect_end(OpenStatus::kOk, 0);
  EXPECT_EQ(bus_.descriptor(), 0);
}

TEST_F(SocketCanOpenTest, ASocketThatWasGivenCountsDropsFromZero) {
  SocketCan given(kSocket);
  kernel_.messages = {message(0x181, 8)};
  add_control(kernel_.messages[0], SO_RXQ_OVFL, std::uint32_t{3});
  ReceivedFrame received;
  ASSERT_TRUE(given.receive(received));
  EXPECT_EQ(given.health().dropped, 3u);
}

TEST_F(SocketCanOpenTest, ForgetsWhatWasBeforeItWasOpened) {
  expect_end(OpenStatus::kOk, 0);
  kernel_.messages = {message(0x181, 8), message(0x182, 8)};
  add_control(kernel_.messages[0], SO_RXQ_OVFL, std::uint32_t{5});
  ReceivedFrame received;
  ASSERT_TRUE(bus_.receive(received));
  kernel_.send_errors = {ENETDOWN};
  EXPECT_EQ(bus_.send({0x80, 0, false, {}}), SendResult::kDown);
  EXPECT_EQ(bus_.health().dropped, 5u);
  expect_end(OpenStatus::kOk, 0);
  EXPECT_EQ(bus_.health().dropped, 0u);
  EXPECT_FALSE(bus_.health().down);
  EXPECT_FALSE(bus_.receive(received)) << "the second frame was of the socket before";
  kernel_.messages = {message(0x183, 8)};
  add_control(kernel_.messages[0], SO_RXQ_OVFL, std::uint32_t{2});  // a new socket counts from zero
  ASSERT_TRUE(bus_.receive(received));
  EXPECT_EQ(bus_.health().dropped, 2u);
}

TEST_F(SocketCanOpenTest, ErrorNumbersOfSendTellAFullQueueFromADeadInterface) {
  expect_end(OpenStatus::kOk, 0);
  for (const int error : {ENOBUFS, EAGAIN, EINTR, ENOMEM}) {
    kernel_.send_errors = {error};
    EXPECT_EQ(bus_.send({0x201, 4, false, {}}), SendResult::kFull) << error;
    EXPECT_FALSE(bus_.health().down) << error;
  }
  EXPECT_EQ(bus_.health().unreturned, 0u);
  EXPECT_EQ(bus_.send({0x201, 4, false, {}}), SendResult::kSent);
  EXPECT_EQ(kernel_.sent.at(0).flags, MSG_DONTWAIT | MSG_NOSIGNAL);
  EXPECT_EQ(bus_.health().unreturned, 1u);
  for (const int error : {ENETDOWN, ENXIO, ENODEV, EBADF, EINVAL}) {
    expect_end(OpenStatus::kOk, 0);
    kernel_.send_errors = {error};
    EXPECT_EQ(bus_.send({0x201, 4, false, {}}), SendResult::kDown) << error;
    EXPECT_TRUE(bus_.health().down) << error;
    EXPECT_EQ(bus_.send({0x201, 4, false, {}}), SendResult::kSent);
    EXPECT_TRUE(bus_.health().down) << "until the next opening";
  }
}

/// Classical frames, as those of NMT, heartbeats and SDO, leave as FD frames at the higher rate if the bus takes these
/// only.
TEST_F(SocketCanOpenTest, SendsEveryFrameAsAnFdFrameOnRequest) {
  kernel_.interfaces["can3"] = {.mtu = CANFD_MTU};
  for (const auto& [fd, only_fd] : {std::pair{true, true}, {true, false}, {false, true}, {false, false}}) {
    expect_end(OpenStatus::kOk, 0, {.fd = fd, .only_fd = only_fd});
    kernel_.sent.clear();
    EXPECT_EQ(bus_.send({0x77F, 1, false, {0x05}}), SendResult::kSent);
    const std::vector<std::uint8_t>& bytes = kernel_.sent.at(0).bytes;
    const bool as_fd = fd && only_fd;
    EXPECT_EQ(bytes.size(), as_fd ? CANFD_MTU : CAN_MTU) << fd << only_fd;
    EXPECT_EQ(bytes.at(4), 1) << "its length";
    EXPECT_EQ(bytes.at(5), as_fd ? CANFD_BRS : 0) << "its flags";
    EXPECT_EQ(bytes.at(8), 0x05);
  }
}

TEST_F(SocketCanOpenTest, AnEmptyOrInterruptedReceiveIsNoFault) {
  expect_end(OpenStatus::kOk, 0);
  ReceivedFrame received;
  for (const int error : {EAGAIN, EINTR}) {
    kernel_.messages = {failure(error), message(0x181, 8)};
    EXPECT_FALSE(bus_.receive(received)) << error;
    EXPECT_FALSE(bus_.health().down);
    EXPECT_TRUE(bus_.receive(received)) << "with the next call";
  }
  kernel_.receives_none = true;
  errno = ENETDOWN;  // of an earlier call
  EXPECT_FALSE(bus_.receive(received));
  EXPECT_FALSE(bus_.health().down);
}

/// The kernel reports once that an interface went down; frames that had come before are still in the queue.
TEST_F(SocketCanOpenTest, TakesTheFramesBehindTheReportThatTheInterfaceIsDown) {
  expect_end(OpenStatus::kOk, 0);
  kernel_.messages = {failure(ENETDOWN), message(0x181, 8)};
  ReceivedFrame received;
  EXPECT_TRUE(bus_.receive(received));
  EXPECT_EQ(received.frame.id, 0x181);
  EXPECT_TRUE(bus_.health().down);
  EXPECT_FALSE(bus_.receive(received));
  EXPECT_TRUE(bus_.health().down);
  // a socket that always fails does not hold the caller
  kernel_.receives = 0;
  for (int k = 0; k < 10; ++k) kernel_.messages.push_back(failure(EBADF));
  EXPECT_FALSE(bus_.receive(received));
  EXPECT_EQ(kernel_.receives, 2);
}

/// Sixteen frames cost one call, and the end another one.
TEST_F(SocketCanOpenTest, TakesSixteenFramesACall) {
  expect_end(OpenStatus::kOk, 0);
  for (int count = 0; count <= 70; ++count) {
    for (int k = 0; k < count; ++k) kernel_.messages.push_back(message(static_cast<canid_t>(0x100 + k), 8));
    kernel_.receives = 0;
    ReceivedFrame received;
    int taken = 0;
    while (bus_.receive(received)) {
      EXPECT_EQ(received.frame.id, 0x100 + taken++);
      for (std::uint8_t i = 0; i < 8; ++i) EXPECT_EQ(received.frame.data[i], 0x40 + i);
    }
    EXPECT_EQ(taken, count);
    EXPECT_EQ(kernel_.receives, (count + 15) / 16 + 1) << count;
  }
}

/// Sixty-four frames that are left out end a call; the next one begins to count again.
TEST_F(SocketCanOpenTest, LeavesOutSixtyFourFramesACall) {
  expect_end(OpenStatus::kOk, 0);
  ReceivedFrame received;
  for (int k = 0; k < 63; ++k) kernel_.messages.push_back(message(CAN_EFF_FLAG | 1, 8));
  kernel_.messages.push_back(message(0x181, 8));
  EXPECT_TRUE(bus_.receive(received));
  kernel_.messages.push_back(message(CAN_EFF_FLAG | 1, 8));
  kernel_.messages.push_back(message(0x182, 8));
  EXPECT_FALSE(bus_.receive(received)) << "the sixty-fourth since the queue was last empty";
  for (int k = 0; k < 63; ++k) kernel_.messages.push_back(message(CAN_EFF_FLAG | 1, 8));
  kernel_.messages.push_back(message(0x183, 8));
  EXPECT_TRUE(bus_.receive(received));
  EXPECT_EQ(received.frame.id, 0x182);
  EXPECT_TRUE(bus_.receive(received));
  EXPECT_EQ(received.frame.id, 0x183);
  EXPECT_EQ(bus_.health().malformed, 127u);
}

TEST_F(SocketCanOpenTest, OwnFramesAreMarkedAndEndTheCountOfThoseOnTheirWay) {
  expect_end(OpenStatus::kOk, 0);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(bus_.send({0x80, 0, false, {}}), SendResult::kSent);
  EXPECT_EQ(bus_.health().unreturned, 3u);
  kernel_.messages = {message(0x181, 8), message(0x080, 0)};
  kernel_.messages[1].flags = MSG_CONFIRM;
  ReceivedFrame received;
  ASSERT_TRUE(bus_.receive(received));
  EXPECT_FALSE(received.own);
  EXPECT_EQ(bus_.health().unreturned, 3u);
  ASSERT_TRUE(bus_.receive(received));
  EXPECT_TRUE(received.own);
  EXPECT_EQ(bus_.health().unreturned, 0u);
}

/// A message that was longer than a frame is cut off by the kernel to the size of an FD frame.
TEST_F(SocketCanOpenTest, DropsAMessageThatWasCutOff) {
  expect_end(OpenStatus::kOk, 0);
  kernel_.messages = {message(0x181, 8, CANFD_MTU + 1), message(0x182, 8)};
  ReceivedFrame received;
  ASSERT_TRUE(bus_.receive(received));
  EXPECT_EQ(received.frame.id, 0x182);
  EXPECT_EQ(bus_.health().malformed, 1u);
}

/// A part of an error frame tells nothing of the bus.
TEST_F(SocketCanOpenTest, AnErrorFrameMustBeWhole) {
  expect_end(OpenStatus::kOk, 0);
  kernel_.messages = {message(CAN_ERR_FLAG | CAN_ERR_BUSOFF, CAN_ERR_DLC, 15)};
  ReceivedFrame received;
  EXPECT_FALSE(bus_.receive(received));
  EXPECT_EQ(bus_.health().malformed, 1u);
  EXPECT_EQ(bus_.health().errors, 0u);
  EXPECT_FALSE(bus_.health().bus_off);
}

TEST_F(SocketCanOpenTest, ReadsTimeStampAndDropCounterInAnyOrder) {
  expect_end(OpenStatus::kOk, 0);
  const timespec time{.tv_sec = 1'700'000'000, .tv_nsec = 123'456'789};
  std::uint32_t drops = 0xFFFFFFF0;
  std::uint64_t sum = 0;
  for (int k = 0; k < 8; ++k) {
    const std::uint32_t more = k == 0 ? drops : 7;  // over the counter's wrap
    if (k > 0) drops += more;
    sum += more;
    FakeKernel::Message one = message(0x181, 8);
    if (k % 2 == 0) add_control(one, SCM_TIMESTAMPNS, time);
    if (k == 3) add_control(one, SO_RXQ_OVFL, std::uint32_t{77}, SOL_CAN_RAW);  // of another level
    if (k == 7) add_control(one, SO_MARK, std::uint32_t{77});                   // of another type
    add_control(one, SO_RXQ_OVFL, drops);
    if (k % 4 == 2) std::rotate(one.control.begin(), one.control.begin() + CMSG_SPACE(sizeof time), one.control.end());
    if (k % 4 == 1) one.control.clear();
    kernel_.messages = {one};
    ReceivedFrame received;
    received.time_ns = -1;
    ASSERT_TRUE(bus_.receive(received));
    EXPECT_EQ(received.time_ns, k % 2 == 0 ? 1'700'000'000'123'456'789 : 0);
    if (k % 4 != 1) {
      EXPECT_EQ(bus_.health().dropped, sum) << k;
    }
  }
}

}  // namespace
}  // namespace godobject::hal
