// SocketCan on the kernel's CAN: virtual interfaces vcan0 and vcan1, up, with an MTU of 72.
#include <gtest/gtest.h>

#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "hal/linux/socketcan.h"

namespace godobject::hal {
namespace {

/// Why the tests cannot run here; empty if they can.
std::string obstacle() {
  const int descriptor = ::socket(AF_CAN, SOCK_RAW, CAN_RAW);
  if (descriptor < 0) return std::string("not run: no CAN sockets (") + std::strerror(errno) + ")";
  std::string text;
  for (const char* name : {"vcan0", "vcan1"}) {
    ifreq request{};
    std::strncpy(request.ifr_name, name, sizeof request.ifr_name - 1);
    if (::ioctl(descriptor, SIOCGIFFLAGS, &request) != 0 || (request.ifr_flags & IFF_UP) == 0 ||
        ::ioctl(descriptor, SIOCGIFMTU, &request) != 0 || request.ifr_mtu != CANFD_MTU) {
      text = std::string("not run: ") + name + " is missing; ip link add dev " + name + " type vcan; ip link set " +
             name + " mtu 72 up";
    }
  }
  ::close(descriptor);
  return text;
}

/// Another node: a plain raw socket.
class Peer {
 public:
  explicit Peer(const char* interface) : descriptor_(::socket(AF_CAN, SOCK_RAW, CAN_RAW)) {
    const int on = 1;
    ::setsockopt(descriptor_, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, &on, sizeof on);
    sockaddr_can address{};
    address.can_family = AF_CAN;
    address.can_ifindex = static_cast<int>(::if_nametoindex(interface));
    EXPECT_EQ(::bind(descriptor_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  }
  ~Peer() { ::close(descriptor_); }
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;

  void put(canid_t id, std::uint8_t length, bool fd = false, std::uint8_t second_byte = 0) const {
    canfd_frame raw{};
    raw.can_id = id;
    raw.len = length;
    raw.data[1] = second_byte;
    const std::size_t size = fd ? CANFD_MTU : CAN_MTU;
    ASSERT_EQ(::send(descriptor_, &raw, size, 0), static_cast<ssize_t>(size)) << std::strerror(errno);
  }

  /// Identifier of the next frame that is there; -1 without one.
  std::int64_t next(canfd_frame& raw) const {
    return ::recv(descriptor_, &raw, sizeof raw, MSG_DONTWAIT) > 0 ? static_cast<std::int64_t>(raw.can_id) : -1;
  }

 private:
  int descriptor_;
};

class VcanTest : public testing::Test {
 protected:
  void SetUp() override {
    const std::string text = obstacle();
    if (!text.empty()) GTEST_SKIP() << text;
  }

  std::vector<ReceivedFrame> drain() {
    std::vector<ReceivedFrame> all;
    ReceivedFrame received;
    while (bus_.receive(received)) all.push_back(received);
    return all;
  }

  void open(const char* interface, const SocketCanOptions& options = {}) {
    const OpenResult result = bus_.open(interface, options);
    ASSERT_EQ(result.status, OpenStatus::kOk) << describe(result.status) << ", " << std::strerror(result.error);
  }

  SocketCan bus_;
};

/// An interface of its own, to be taken down and away.
class OwnInterfaceTest : public VcanTest {
 protected:
  void SetUp() override {
    VcanTest::SetUp();
    if (IsSkipped()) return;
    if (!run("ip link add dev vcan_own type vcan") || !run("ip link set vcan_own up")) {
      GTEST_SKIP() << "not run: an interface cannot be made; needs root and ip";
    }
  }
  void TearDown() override { run("ip link del vcan_own"); }

  static bool run(const std::string& command) { return std::system((command + " 2>/dev/null >&2").c_str()) == 0; }
};

TEST_F(VcanTest, OwnFramesComeBackMarkedInTheOrderOfTheWire) {
  open("vcan0");
  const Peer peer("vcan0");
  for (std::uint16_t i = 0; i < 100; ++i) {
    if (i % 3 == 0) {
      peer.put(0x180u + i, 8);
    } else {
      ASSERT_EQ(bus_.send({static_cast<std::uint16_t>(0x180 + i), 4, false, {}}), SendResult::kSent);
    }
  }
  const std::vector<ReceivedFrame> all = drain();
  ASSERT_EQ(all.size(), 100u);
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i].frame.id, 0x180 + i);
    EXPECT_EQ(all[i].own, i % 3 != 0);
    EXPECT_GT(all[i].time_ns, 0);
    if (i > 0) {
      EXPECT_GE(all[i].time_ns, all[i - 1].time_ns);
    }
  }
  EXPECT_EQ(bus_.health().unreturned, 0u);
}

TEST_F(VcanTest, AnotherSocketOfThisProcessIsNotOwn) {
  open("vcan0");
  SocketCan second;
  ASSERT_EQ(second.open("vcan0", {}).status, OpenStatus::kOk);
  ASSERT_EQ(second.send({0x80, 0, false, {}}), SendResult::kSent);
  ReceivedFrame received;
  ASSERT_TRUE(bus_.receive(received));
  EXPECT_FALSE(received.own);
  ASSERT_TRUE(second.receive(received));
  EXPECT_TRUE(received.own);
}

TEST_F(VcanTest, FramesReachAnotherNodeAsTheyWere) {
  open("vcan0", {.fd = true});
  const Peer peer("vcan0");
  ASSERT_EQ(bus_.send({0x203, 4, false, {0x0F, 0x00, 0xCE, 0xFF}}), SendResult::kSent);
  CanFrame long_one{0x204, 48, true, {}};
  long_one.data.fill(0x11);
  ASSERT_EQ(bus_.send(long_one), SendResult::kSent);
  canfd_frame raw{};
  ASSERT_EQ(peer.next(raw), 0x203);
  EXPECT_EQ(raw.len, 4);
  EXPECT_EQ(raw.data[2], 0xCE);
  ASSERT_EQ(peer.next(raw), 0x204);
  EXPECT_EQ(raw.len, 48);
  EXPECT_EQ(raw.flags & CANFD_BRS, CANFD_BRS);
  EXPECT_EQ(raw.data[47], 0x11);
}

TEST_F(VcanTest, FdFramesComeIfTheyAreWanted) {
  const Peer peer("vcan0");
  open("vcan0", {.fd = true});
  peer.put(0x181, 12, true);
  peer.put(0x182, 8);
  std::vector<ReceivedFrame> all = drain();
  ASSERT_EQ(all.size(), 2u);
  EXPECT_TRUE(all[0].frame.fd);
  EXPECT_EQ(all[0].frame.length, 12);
  EXPECT_FALSE(all[1].frame.fd);
  open("vcan0");
  peer.put(0x181, 12, true);
  peer.put(0x182, 8);
  all = drain();
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].frame.id, 0x182);
}

TEST_F(VcanTest, OnlyTheIdentifiersThatMatterComeThrough) {
  const std::vector<std::uint16_t> identifiers = {0x080, 0x181, 0x581};
  open("vcan0", {.identifiers = identifiers});
  const Peer peer("vcan0");
  for (canid_t id = 0; id <= CAN_SFF_MASK; ++id) peer.put(id, 1);
  ASSERT_EQ(bus_.send({0x080, 0, false, {}}), SendResult::kSent);
  ASSERT_EQ(bus_.send({0x201, 0, false, {}}), SendResult::kSent);
  const std::vector<ReceivedFrame> all = drain();
  ASSERT_EQ(all.size(), 4u);
  EXPECT_EQ(all[0].frame.id, 0x080);
  EXPECT_EQ(all[1].frame.id, 0x181);
  EXPECT_EQ(all[2].frame.id, 0x581);
  EXPECT_TRUE(all[3].own);
  EXPECT_EQ(bus_.health().dropped, 0u);
}

TEST_F(VcanTest, ExtendedAndRemoteFramesAreCountedWithFiltersAndWithout) {
  const std::vector<std::uint16_t> identifiers = {0x181};
  const Peer peer("vcan0");
  for (const bool filtered : {false, true}) {
    open("vcan0", filtered ? SocketCanOptions{.identifiers = identifiers} : SocketCanOptions{});
    peer.put(CAN_EFF_FLAG | 0x181, 8);
    peer.put(CAN_EFF_FLAG | 0x12345678, 8);
    peer.put(CAN_RTR_FLAG | 0x181, 8);
    peer.put(CAN_RTR_FLAG | 0x300, 0);
    peer.put(0x181, 8);
    const std::vector<ReceivedFrame> all = drain();
    ASSERT_EQ(all.size(), 1u) << filtered;
    EXPECT_EQ(all[0].frame.id, 0x181);
    EXPECT_EQ(bus_.health().malformed, 4u) << filtered;
  }
}

TEST_F(VcanTest, CountsWhatTheSocketHadNoRoomFor) {
  open("vcan0", {.receive_buffer = 4096});
  const Peer peer("vcan0");
  constexpr std::size_t kSent = 500;
  for (std::size_t i = 0; i < kSent; ++i) peer.put(0x181, 8);
  const std::size_t first = drain().size();
  EXPECT_LT(first, kSent);
  peer.put(0x182, 8);  // brings the counter along
  const std::vector<ReceivedFrame> rest = drain();
  ASSERT_EQ(rest.size(), 1u);
  EXPECT_EQ(rest[0].frame.id, 0x182);
  EXPECT_EQ(bus_.health().dropped, kSent - first);
}

TEST_F(VcanTest, TheBufferHoldsAThousandFrames) {
  if (::geteuid() != 0) GTEST_SKIP() << "not run: only root is granted more than net.core.rmem_max";
  const OpenResult result = bus_.open("vcan0", {});
  ASSERT_EQ(result.status, OpenStatus::kOk);
  EXPECT_GE(result.receive_buffer, 1 << 20);
  const Peer peer("vcan0");
  for (int i = 0; i < 1000; ++i) peer.put(0x181, 8);
  EXPECT_EQ(drain().size(), 1000u);
  EXPECT_EQ(bus_.health().dropped, 0u);
}

TEST_F(VcanTest, ErrorFramesOfTheInterfaceBecomeHealth) {
  open("vcan0");
  const Peer peer("vcan0");
  peer.put(CAN_ERR_FLAG | CAN_ERR_CRTL, CAN_ERR_DLC, false, CAN_ERR_CRTL_TX_PASSIVE);
  EXPECT_TRUE(drain().empty());
  EXPECT_TRUE(bus_.health().passive);
  peer.put(CAN_ERR_FLAG | CAN_ERR_LOSTARB, CAN_ERR_DLC);  // not asked for
  peer.put(CAN_ERR_FLAG | CAN_ERR_BUSOFF, CAN_ERR_DLC);
  EXPECT_TRUE(drain().empty());
  EXPECT_TRUE(bus_.health().bus_off);
  EXPECT_EQ(bus_.health().errors, 2u);
}

TEST_F(VcanTest, TwoInterfacesDoNotHearEachOther) {
  open("vcan0");
  const Peer peer("vcan1");
  peer.put(0x181, 8);
  EXPECT_TRUE(drain().empty());
}

TEST_F(OwnInterfaceTest, GoingDownInMidRunIsSeenBySendAndByReceive) {
  open("vcan_own");
  SocketCan sender;
  ASSERT_EQ(sender.open("vcan_own", {}).status, OpenStatus::kOk);
  { Peer("vcan_own").put(0x181, 8); }
  ASSERT_TRUE(run("ip link set vcan_own down"));

  const std::vector<ReceivedFrame> all = drain();
  EXPECT_TRUE(bus_.health().down);
  ASSERT_EQ(all.size(), 1u);  // it had come before
  EXPECT_EQ(sender.send({0x80, 0, false, {}}), SendResult::kDown);
  EXPECT_TRUE(sender.health().down);
  for (int i = 0; i < 10; ++i) {
    EXPECT_TRUE(drain().empty());
    EXPECT_EQ(bus_.send({0x80, 0, false, {}}), SendResult::kDown);
  }

  SocketCan late;
  EXPECT_EQ(late.open("vcan_own", {}).status, OpenStatus::kInterfaceDown);
  ASSERT_TRUE(run("ip link set vcan_own up"));
  EXPECT_EQ(bus_.send({0x80, 0, false, {}}), SendResult::kSent);
  EXPECT_TRUE(bus_.health().down);  // until it is opened again
  open("vcan_own");
  EXPECT_FALSE(bus_.health().down);
  EXPECT_EQ(bus_.send({0x80, 0, false, {}}), SendResult::kSent);
}

TEST_F(OwnInterfaceTest, AnInterfaceThatIsTakenAwayIsDown) {
  open("vcan_own");
  ASSERT_TRUE(run("ip link del vcan_own"));
  EXPECT_TRUE(drain().empty());
  EXPECT_TRUE(bus_.health().down);
  EXPECT_EQ(bus_.send({0x80, 0, false, {}}), SendResult::kDown);
  EXPECT_EQ(bus_.open("vcan_own", {}).status, OpenStatus::kNoInterface);
}

TEST_F(OwnInterfaceTest, FdNeedsItsMtu) {
  ASSERT_TRUE(run("ip link set vcan_own down") && run("ip link set vcan_own mtu 16") && run("ip link set vcan_own up"));
  EXPECT_EQ(bus_.open("vcan_own", {.fd = true}).status, OpenStatus::kNoFd);
  EXPECT_EQ(bus_.open("vcan_own", {}).status, OpenStatus::kOk);
}

TEST_F(OwnInterfaceTest, AFullTransmitQueueIsToldAtOnceAndMendsItself) {
  // by its path: a shell may have a tc of its own, without netem
  if (!run("/sbin/tc qdisc add dev vcan_own root netem delay 60s limit 5")) GTEST_SKIP() << "not run: no tc netem";
  open("vcan_own");
  const CanFrame frame{0x201, 4, false, {}};
  for (int i = 0; i < 5; ++i) EXPECT_EQ(bus_.send(frame), SendResult::kSent) << i;
  for (int i = 0; i < 5; ++i) EXPECT_EQ(bus_.send(frame), SendResult::kFull) << i;
  EXPECT_FALSE(bus_.health().down);
  ASSERT_TRUE(run("/sbin/tc qdisc del dev vcan_own root"));
  EXPECT_EQ(bus_.send(frame), SendResult::kSent);
}

}  // namespace
}  // namespace godobject::hal
