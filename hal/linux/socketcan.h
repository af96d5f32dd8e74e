#pragma once

#include <array>
#include <cstdint>
#include <span>

#include <linux/can.h>
#include <sys/socket.h>

#include "hal/can_bus.h"

namespace godobject::hal {

struct SocketCanOptions {
  bool fd = false;       ///< FD frames and classical ones; the interface's MTU must be 72
  bool only_fd = false;  ///< with `fd`: all frames are sent as FD frames
  /// Requested receive buffer [bytes]. Chosen: at some 800 bytes a frame, as the kernel counts them, it holds 1300
  /// frames.
  int receive_buffer = 1 << 20;
  std::span<const std::uint16_t> identifiers{};  ///< COB-IDs that the kernel passes, own frames too; empty: all
};

enum class OpenStatus : std::uint8_t {
  kOk,
  kNoCan,          ///< the kernel has no CAN sockets
  kSocket,         ///< the socket could not be made for another reason
  kNoInterface,    ///< no interface has this name
  kNotCan,         ///< the interface is no CAN interface
  kInterfaceDown,  ///< the interface is down
  kNoFd,           ///< the interface has classical frames only, and FD frames were requested
  kOption,         ///< an option of the socket was refused
  kBind,           ///< the socket could not be bound
};

/// The status as one clause with the cure. Never null.
const char* describe(OpenStatus status) noexcept;

struct OpenResult {
  OpenStatus status = OpenStatus::kOk;
  int error = 0;           ///< errno, or 0
  int receive_buffer = 0;  ///< granted [bytes]
};

/// A CAN interface of Linux by a raw socket. `send` is one send(), `receive` one recvmmsg() for each 16 frames and one
/// that finds no frame, both without waiting; there are no other system calls. Own frames return after they were on the
/// wire. Extended frames, remote frames and impossible lengths are counted and dropped. Error frames become `health`.
///
/// An interface that was down, or a controller that was bus-off, stays so in `health` until the next `open`: it is not
/// known which frames were lost meanwhile. Cost: the system calls. After 64 dropped frames `receive` returns false
/// once, whether there are more frames or not.
class SocketCan final : public CanBus {
 public:
  SocketCan() noexcept = default;

  /// Uses, and finally closes, a socket that carries one frame a message.
  explicit SocketCan(int descriptor) noexcept : descriptor_(descriptor) {}

  ~SocketCan() override;
  SocketCan(const SocketCan&) = delete;
  SocketCan& operator=(const SocketCan&) = delete;

  /// Opens an interface, before `send` and `receive`.
  OpenResult open(const char* interface, const SocketCanOptions& options) noexcept;

  /// For poll(), outside the real-time loop.
  int descriptor() const noexcept { return descriptor_; }

  SendResult send(const CanFrame& frame) noexcept override;
  bool receive(ReceivedFrame& received) noexcept override;
  BusHealth health() const noexcept override { return health_; }

 private:
  static constexpr std::size_t kBatch = 16;
  static constexpr std::size_t kControlBytes = 64;  // a time stamp and a drop counter

  bool fetch() noexcept;
  bool take(const mmsghdr& message, const canfd_frame& raw, ReceivedFrame& received) noexcept;
  void read_control(const msghdr& header, ReceivedFrame& received) noexcept;
  void read_error(const canfd_frame& raw) noexcept;

  int descriptor_ = -1;
  bool only_fd_ = false;
  BusHealth health_;
  std::uint32_t drop_counter_ = 0;  // last value of the kernel's 32 bit counter
  std::size_t fetched_ = 0;
  std::size_t taken_ = 0;
  int left_out_ = 0;  // since the socket was last empty
  std::array<canfd_frame, kBatch> frames_{};
  std::array<iovec, kBatch> vectors_{};
  std::array<mmsghdr, kBatch> messages_{};
  alignas(cmsghdr) std::array<std::array<std::uint8_t, kControlBytes>, kBatch> controls_{};
};

}  // namespace godobject::hal
