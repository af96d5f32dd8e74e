#include "hal/linux/socketcan.h"

#include <gtest/gtest.h>

#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstddef>
#include <cstring>
#include <ctime>
#include <iterator>
#include <optional>
#include <random>

#include "tests/support/allocation_guard.h"

namespace godobject::hal {
namespace {

/// SocketCan on one end of a socket pair, whole frames from the other.
class SocketCanTest : public testing::Test {
 protected:
  SocketCanTest() {
    int ends[2];
    EXPECT_EQ(::socketpair(AF_UNIX, SOCK_DGRAM, 0, ends), 0);
    far_ = ends[1];
    const int on = 1;
    EXPECT_EQ(::setsockopt(ends[0], SOL_SOCKET, SO_TIMESTAMPNS, &on, sizeof on), 0);
    bus_.emplace(ends[0]);
  }
  ~SocketCanTest() override {
    if (far_ >= 0) ::close(far_);
  }

  void put(canid_t id, std::uint8_t length, const void* data = nullptr, std::size_t size = CAN_MTU) {
    canfd_frame raw{};
    raw.can_id = id;
    raw.len = length;
    for (int i = 0; i < CANFD_MAX_DLEN; ++i) raw.data[i] = static_cast<std::uint8_t>(0xA0 + i);
    if (data != nullptr) std::memcpy(raw.data, data, length);
    ASSERT_EQ(::send(far_, &raw, size, MSG_DONTWAIT), static_cast<ssize_t>(size));
  }

  /// An error frame.
  void put_error(canid_t error, std::uint8_t controller = 0) {
    const std::uint8_t data[8] = {0, controller, 0, 0, 0, 0, 0, 0};
    put(CAN_ERR_FLAG | error, CAN_ERR_DLC, data);
  }

  void drain() {
    ReceivedFrame received;
    while (bus_->receive(received)) {
    }
  }

  std::optional<SocketCan> bus_;
  int far_ = -1;
};

TEST_F(SocketCanTest, SendsTheBytesOfAClassicalFrame) {
  const CanFrame frame{0x203, 4, false, {0x0F, 0x00, 0xCE, 0xFF, 0x77}};
  ASSERT_EQ(bus_->send(frame), SendResult::kSent);
  unsigned char got[128];
  ASSERT_EQ(::recv(far_, got, sizeof got, MSG_DONTWAIT), 16);
  const unsigned char expected[16] = {0x03, 0x02, 0, 0, 4, 0, 0, 0, 0x0F, 0x00, 0xCE, 0xFF, 0, 0, 0, 0};
  EXPECT_EQ(std::memcmp(got, expected, 16), 0);
}

TEST_F(SocketCanTest, SendsAnFdFrameWithTheHigherBitRate) {
  CanFrame frame{0x181, 12, true, {}};
  frame.data.fill(0x5A);
  ASSERT_EQ(bus_->send(frame), SendResult::kSent);
  unsigned char got[128];
  ASSERT_EQ(::recv(far_, got, sizeof got, MSG_DONTWAIT), 72);
  EXPECT_EQ(got[4], 12);
  EXPECT_EQ(got[5], CANFD_BRS);
  EXPECT_EQ(got[8 + 11], 0x5A);
  EXPECT_EQ(got[8 + 12], 0);
}

TEST_F(SocketCanTest, ReceivesWhatWasPutInItsOrderAcrossBatches) {
  for (int i = 0; i < 9; ++i) {  // 9 at a time, to be within what the pair queues
    for (int k = 0; k < 9; ++k) put(static_cast<canid_t>(0x100 + 9 * i + k), static_cast<std::uint8_t>(k));
    ReceivedFrame received;
    for (int k = 0; k < 9; ++k) {
      ASSERT_TRUE(bus_->receive(received));
      EXPECT_EQ(received.frame.id, 0x100 + 9 * i + k);
      EXPECT_EQ(received.frame.length, k);
      EXPECT_FALSE(received.frame.fd);
      EXPECT_FALSE(received.own);
      for (std::size_t b = 0; b < 64; ++b) {
        ASSERT_EQ(received.frame.data[b], b < static_cast<std::size_t>(k) ? 0xA0 + b : 0);
      }
    }
    EXPECT_FALSE(bus_->receive(received));
  }
}

TEST_F(SocketCanTest, ReceivesFdFrames) {
  put(0x181, 64, nullptr, CANFD_MTU);
  put(0x182, 8, nullptr, CANFD_MTU);
  ReceivedFrame received;
  ASSERT_TRUE(bus_->receive(received));
  EXPECT_TRUE(received.frame.fd);
  EXPECT_EQ(received.frame.length, 64);
  EXPECT_EQ(received.frame.data[63], 0xA0 + 63);
  ASSERT_TRUE(bus_->receive(received));
  EXPECT_TRUE(received.frame.fd);
  EXPECT_EQ(received.frame.length, 8);
  EXPECT_EQ(received.frame.data[8], 0);
}

TEST_F(SocketCanTest, StampsFramesByTheClockThatMayBeSet) {
  timespec before{};
  ::clock_gettime(CLOCK_REALTIME, &before);
  put(0x181, 0);
  ReceivedFrame received;
  ASSERT_TRUE(bus_->receive(received));
  timespec after{};
  ::clock_gettime(CLOCK_REALTIME, &after);
  EXPECT_GE(received.time_ns, before.tv_sec * 1'000'000'000 + before.tv_nsec);
  EXPECT_LE(received.time_ns, after.tv_sec * 1'000'000'000 + after.tv_nsec);
}

TEST_F(SocketCanTest, CountsAndLeavesOutWhatNoCanopenNodeSends) {
  put(CAN_EFF_FLAG | 0x181, 8);
  put(CAN_RTR_FLAG | 0x181, 8);
  put(0x181, 9);
  put(0x181, 9, nullptr, CANFD_MTU);
  put(0x181, 65, nullptr, CANFD_MTU);
  put(0x181, 8, nullptr, 15);
  put(0x181, 8, nullptr, 71);
  put(0x181, 8, nullptr, 0);
  put(0x182, 1);
  ReceivedFrame received;
  ASSERT_TRUE(bus_->receive(received));
  EXPECT_EQ(received.frame.id, 0x182);
  EXPECT_FALSE(bus_->receive(received));
  EXPECT_EQ(bus_->health().malformed, 8u);
  EXPECT_EQ(bus_->health().errors, 0u);
}

TEST_F(SocketCanTest, ErrorFramesBecomeHealth) {
  put_error(CAN_ERR_CRTL, CAN_ERR_CRTL_TX_WARNING);
  drain();
  EXPECT_FALSE(bus_->health().passive);
  put_error(CAN_ERR_CRTL, CAN_ERR_CRTL_TX_PASSIVE);
  drain();
  EXPECT_TRUE(bus_->health().passive);
  put_error(CAN_ERR_CRTL, CAN_ERR_CRTL_RX_OVERFLOW);  // says nothing of the state
  drain();
  EXPECT_TRUE(bus_->health().passive);
  put_error(CAN_ERR_CRTL, CAN_ERR_CRTL_ACTIVE);
  drain();
  EXPECT_FALSE(bus_->health().passive);
  put_error(CAN_ERR_PROT, CAN_ERR_CRTL_TX_PASSIVE);  // that byte is the controller's only in frames of its class
  drain();
  EXPECT_FALSE(bus_->health().passive);
  EXPECT_FALSE(bus_->health().bus_off);
  put_error(CAN_ERR_BUSOFF);
  drain();
  EXPECT_TRUE(bus_->health().bus_off);
  put_error(CAN_ERR_RESTARTED);
  drain();
  EXPECT_TRUE(bus_->health().bus_off);
  EXPECT_EQ(bus_->health().errors, 7u);
  EXPECT_EQ(bus_->health().malformed, 0u);
  EXPECT_FALSE(bus_->health().down);
}

TEST_F(SocketCanTest, AFullQueueIsToldAndBlocksNothing) {
  const CanFrame frame{0x201, 8, false, {}};
  int sent = 0;
  SendResult last = SendResult::kSent;
  while (sent < 100'000 && (last = bus_->send(frame)) == SendResult::kSent) ++sent;
  EXPECT_EQ(last, SendResult::kFull);
  EXPECT_EQ(bus_->health().unreturned, static_cast<std::uint32_t>(sent));
  EXPECT_FALSE(bus_->health().down);
  unsigned char got[128];
  ASSERT_GT(::recv(far_, got, sizeof got, MSG_DONTWAIT), 0);
  EXPECT_EQ(bus_->send(frame), SendResult::kSent);
}

TEST_F(SocketCanTest, AGoneFarEndIsDownAndStaysSo) {
  ::close(far_);
  far_ = -1;
  ReceivedFrame received;
  EXPECT_FALSE(bus_->receive(received));
  EXPECT_EQ(bus_->send({0x201, 8, false, {}}), SendResult::kDown);
  EXPECT_TRUE(bus_->health().down);
}

TEST(SocketCan, IsDownBeforeItIsOpened) {
  SocketCan bus;
  ReceivedFrame received;
  EXPECT_FALSE(bus.receive(received));
  EXPECT_EQ(bus.send({}), SendResult::kDown);
  EXPECT_TRUE(bus.health().down);
}

TEST(SocketCan, RefusesInterfacesThatAreNone) {
  SocketCan bus;
  for (const char* name : {"", "no-such-can", "a-name-that-is-longer-than-any-interface"}) {
    const OpenStatus status = bus.open(name, {}).status;
    EXPECT_TRUE(status == OpenStatus::kNoInterface || status == OpenStatus::kNoCan) << name;
  }
  const OpenStatus loopback = bus.open("lo", {}).status;
  EXPECT_TRUE(loopback == OpenStatus::kNotCan || loopback == OpenStatus::kNoCan);
  EXPECT_STRNE(describe(loopback), "unknown status");
}

/// One `receive` is bounded, whatever comes: 64 frames that are left out.
TEST_F(SocketCanTest, AFloodOfErrorFramesDoesNotHoldTheCaller) {
  ReceivedFrame received;
  for (int i = 0; i < 200; ++i) {
    for (int k = 0; k < 8; ++k) put_error(CAN_ERR_BUSERROR);
    ASSERT_FALSE(bus_->receive(received));
  }
  EXPECT_EQ(bus_->health().errors, 1600u);
}

/// Nor is a cycle held that takes frames until there are no more, with others between them.
TEST_F(SocketCanTest, SixtyFourFramesAreLeftOutUntilAllIsTaken) {
  ReceivedFrame received;
  for (int i = 0; i < 8; ++i) {
    for (int k = 0; k < 7; ++k) put_error(CAN_ERR_BUSERROR);
    put(0x181, 1);
    ASSERT_TRUE(bus_->receive(received)) << i;
  }
  for (int k = 0; k < 8; ++k) put_error(CAN_ERR_BUSERROR);
  put(0x182, 1);
  EXPECT_FALSE(bus_->receive(received)) << "until the next cycle";
  ASSERT_TRUE(bus_->receive(received));
  EXPECT_EQ(received.frame.id, 0x182);
}

TEST_F(SocketCanTest, RandomMessagesNeverBecomeImpossibleFrames) {
  std::mt19937 random(3);
  for (int i = 0; i < 20'000; ++i) {
    unsigned char bytes[100];
    for (unsigned char& byte : bytes) byte = static_cast<unsigned char>(random());
    if (i % 2 == 0) bytes[1] = bytes[2] = bytes[3] = 0;
    if (i % 3 == 0) bytes[4] %= 16;
    const std::size_t size = i % 4 == 0 ? random() % sizeof bytes : (i % 4 == 1 ? CAN_MTU : CANFD_MTU);
    ASSERT_EQ(::send(far_, bytes, size, MSG_DONTWAIT), static_cast<ssize_t>(size));
    ReceivedFrame received;
    if (!bus_->receive(received)) continue;
    ASSERT_LE(received.frame.id, 0x7FF);
    ASSERT_LE(received.frame.length, received.frame.fd ? 64 : 8);
  }
  EXPECT_GT(bus_->health().malformed, 0u);
}

TEST_F(SocketCanTest, AsksForNoHeap) {
  if (!test::AllocationGuard::works()) GTEST_SKIP() << "not run: heap calls are not counted under a sanitizer";
  ReceivedFrame received;
  const CanFrame frame{0x201, 8, false, {}};
  unsigned char got[128];
  const test::AllocationGuard guard;
  for (int i = 0; i < 1000; ++i) {
    put(0x181, 8);
    ASSERT_EQ(bus_->send(frame), SendResult::kSent);
    ASSERT_EQ(::recv(far_, got, sizeof got, MSG_DONTWAIT), 16);
    ASSERT_TRUE(bus_->receive(received));
    ASSERT_FALSE(bus_->receive(received));
  }
  EXPECT_EQ(guard.allocations(), 0);
}

/// Ends this process at any system call but send, recvmmsg and the end itself.
bool allow_only_what_the_cycle_needs() {
  const sock_filter program[] = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, __NR_sendto, 3, 0),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, __NR_recvmmsg, 2, 0),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, __NR_exit_group, 1, 0),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
  };
  const sock_fprog filter{static_cast<unsigned short>(std::size(program)), const_cast<sock_filter*>(program)};
  return ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter) == 0;
}

/// Returns the wait status of a process that runs `action` under these rules. Exit code 99: the rules cannot be set.
template <typename Action>
int status_of_restricted(Action action) {
  const pid_t child = ::fork();
  if (child == 0) {
    if (!allow_only_what_the_cycle_needs()) ::_exit(99);
    ::_exit(action());
  }
  int status = -1;
  EXPECT_EQ(::waitpid(child, &status, 0), child);
  return status;
}

TEST_F(SocketCanTest, ItsOnlySystemCallsAreSendAndReceive) {
  if (!test::AllocationGuard::works()) GTEST_SKIP() << "not run: a sanitizer makes system calls of its own";
  const int planted = status_of_restricted([] { return static_cast<int>(::syscall(SYS_getppid)); });
  if (WIFEXITED(planted) && WEXITSTATUS(planted) == 99) GTEST_SKIP() << "not run: this kernel has no seccomp filters";
  ASSERT_TRUE(WIFSIGNALED(planted));  // the rules hold
  for (int i = 0; i < 8; ++i) put(0x181, 8);
  const int status = status_of_restricted([&] {
    ReceivedFrame received;
    int seen = 0;
    while (bus_->receive(received)) ++seen;
    for (int i = 0; i < 1000; ++i) static_cast<void>(bus_->send({0x201, 8, false, {}}));  // full in the end
    return seen == 8 ? 0 : 1;
  });
  ASSERT_TRUE(WIFEXITED(status)) << "killed by signal " << WTERMSIG(status);
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

}  // namespace
}  // namespace godobject::hal
