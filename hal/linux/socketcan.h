#pragma once

#include <array>
#include <cstdint>
#include <span>

#include <linux/can.h>
#include <sys/socket.h>

#include "hal/can_bus.h"

namespace godobject::hal {

struct SocketCanOptions {
  bool fd = false;                               ///< FD frames beside classical ones; the interface's MTU must be 72
  int receive_buffer = 1 << 20;                  ///< wanted [bytes], as the kernel counts them: some 800 a frame
  std::span<const std::uint16_t> identifiers{};  ///< those let through, own ones too; none: all
};

enum class OpenStatus : std::uint8_t {
  kOk,
  kNoCan,          ///< the kernel has no CAN sockets
  kSocket,         ///< another reason not to make a socket
  kNoInterface,    ///< none of this name
  kNotCan,         ///< the interface is none of CAN
  kInterfaceDown,  ///< it is there, but down
  kNoFd,           ///< FD frames are wanted, and the interface has classical ones only
  kOption,         ///< an option of the socket was refused
  kBind,           ///< it could not be bound
};

/// A clause in lower case with the cure, for the user's eye. Never null.
const char* describe(OpenStatus status) noexcept;

struct OpenResult {
  OpenStatus status = OpenStatus::kOk;
  int error = 0;           ///< errno where there is one
  int receive_buffer = 0;  ///< granted [bytes]
};

/// A CAN interface of Linux by a raw socket. `send` is one send(), `receive` one recvmmsg() for each 16 frames and one
/// that finds nothing, both without waiting; no other system calls. Own frames come back once they have been on the
/// wire. Extended and remote frames and impossible lengths are counted and left out; error frames become health.
///
/// An interface that goes down and a controller that leaves the bus stay so in `health` until it is opened anew: what
/// was lost meanwhile nobody knows. Cost: of the system calls; at most 64 frames are left out until `receive` has been
/// false, which it then is whether there are more or not.
class SocketCan final : public CanBus {
 public:
  SocketCan() noexcept = default;

  /// Over a socket that carries one frame a message, and closes it in the end.
  explicit SocketCan(int descriptor) noexcept : descriptor_(descriptor) {}

  ~SocketCan() override;
  SocketCan(const SocketCan&) = delete;
  SocketCan& operator=(const SocketCan&) = delete;

  /// At the start, before anything is sent or received.
  OpenResult open(const char* interface, const SocketCanOptions& options) noexcept;

  /// To wait with poll() until something has come, where that may take time.
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
  BusHealth health_;
  std::uint32_t drop_counter_ = 0;  // the kernel's last, of 32 bit
  std::size_t fetched_ = 0;
  std::size_t taken_ = 0;
  int left_out_ = 0;  // since all that there was has been taken
  std::array<canfd_frame, kBatch> frames_{};
  std::array<iovec, kBatch> vectors_{};
  std::array<mmsghdr, kBatch> messages_{};
  alignas(cmsghdr) std::array<std::array<std::uint8_t, kControlBytes>, kBatch> controls_{};
};

}  // namespace godobject::hal
