#pragma once

#include <linux/can.h>
#include <sys/types.h>

#include <cstdint>

namespace godobject::test {

/// A frame in the pipe of a socket of fake_can.cc, and its sender.
struct FakeCanFrame {
  pid_t process;
  int descriptor;
  std::uint32_t size;  ///< bytes of `frame`: CAN_MTU or CANFD_MTU
  canfd_frame frame;
};

}  // namespace godobject::test
