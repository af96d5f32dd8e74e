#pragma once

#include <sys/socket.h>
#include <time.h>

#include <cstdint>
#include <deque>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace godobject::hal {

/// The system calls of SocketCan and MonotonicClock, as long as one of these lives; then the kernel's again. The linker
/// takes the functions of fake_kernel.cc before those of the C library.
class FakeKernel {
 public:
  struct Interface {
    int index = 7;
    unsigned short hardware = 280;  // ARPHRD_CAN
    short flags = 1;                // IFF_UP
    int mtu = 16;                   // classical frames
  };

  /// A message for recvmmsg; without bytes it is the error number `error`.
  struct Message {
    std::vector<std::uint8_t> bytes;
    int flags = 0;
    std::vector<std::uint8_t> control{};
    int error = 0;
  };

  struct Sent {
    std::vector<std::uint8_t> bytes;
    int flags = 0;
  };

  static constexpr int kSocket = 1000;

  FakeKernel();
  ~FakeKernel();
  FakeKernel(const FakeKernel&) = delete;
  FakeKernel& operator=(const FakeKernel&) = delete;

  /// The value of a socket option that was set. Empty: it was not.
  std::vector<std::uint8_t> option(int level, int name) const;

  std::map<std::string, Interface> interfaces;
  int first_socket = kSocket;                ///< the first descriptor that socket() returns
  bool buffer_is_unknown = false;            ///< getsockopt fails
  int socket_error = 0;                      ///< of socket(); 0: it works
  std::set<unsigned long> failing_requests;  ///< of ioctl, with ENODEV
  std::set<std::pair<int, int>> refused;     ///< options (level, name), with EPERM
  int largest_buffer = 1 << 24;              ///< granted by SO_RCVBUF
  int bind_error = 0;                        ///< 0: it works
  std::vector<int> socket_arguments;         ///< of the last socket()
  std::map<std::pair<int, int>, std::vector<std::uint8_t>> options;
  std::vector<std::uint8_t> bound;  ///< address of the last bind()
  std::vector<int> closed;          ///< descriptors, in order
  int open_sockets = 0;

  std::deque<int> send_errors;  ///< of the next calls of send(); 0: it works
  std::vector<Sent> sent;
  std::deque<Message> messages;  ///< to be received; then EAGAIN
  int receives = 0;              ///< calls of recvmmsg
  bool receives_none = false;    ///< recvmmsg returns 0

  timespec now{};
  int interrupts = 0;  ///< calls of clock_nanosleep that end with EINTR
  struct Sleep {
    int clock;
    int flags;
    timespec until;
  };
  std::vector<Sleep> sleeps;
  std::vector<int> clocks;  ///< read by clock_gettime
};

}  // namespace godobject::hal
