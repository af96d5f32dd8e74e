#include "firmware/drives/cia402/can_buses.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "toolchain/command_line/failure.h"

namespace {

int can_socket_error = 0;  // of a new CAN socket; 0: the kernel answers

}  // namespace

/// The linker takes this one before that of the C library.
extern "C" int socket(int domain, int type, int protocol) noexcept {
  if (domain == AF_CAN && can_socket_error != 0) {
    errno = can_socket_error;
    return -1;
  }
  return static_cast<int>(::syscall(SYS_socket, domain, type, protocol));
}

namespace godobject::firmware::can_buses_test {
namespace {

using command::ExitCode;

/// Exit code and message for a kernel that refuses a CAN socket.
std::pair<ExitCode, std::string> refusal_of_a_socket(int error) {
  hal::BusLayout layout;
  layout.bus_count = 1;
  layout.joint_count = 1;
  can_socket_error = error;
  std::pair<ExitCode, std::string> refusal{ExitCode::kOk, ""};
  try {
    const CanBuses buses({"can0"}, layout);
  } catch (const command::Failure& failure) {
    refusal = {failure.exit_code(), failure.what()};
  }
  can_socket_error = 0;
  return refusal;
}

/// The kernel asks for a capability with EPERM, a security module refuses with EACCES.
TEST(CanBuses, TellsAMissingRightFromEachOtherRefusal) {
  for (const auto& [error, expected] :
       std::initializer_list<std::pair<int, ExitCode>>{{EPERM, ExitCode::kNoPermission},
                                                       {EACCES, ExitCode::kNoPermission},
                                                       {EMFILE, ExitCode::kUnavailable},
                                                       {ENOBUFS, ExitCode::kUnavailable},
                                                       {EAFNOSUPPORT, ExitCode::kUnavailable}}) {
    const auto [code, words] = refusal_of_a_socket(error);
    EXPECT_EQ(code, expected) << words;
    EXPECT_EQ(words.rfind("--bus can0: ", 0), 0u) << words;
    EXPECT_NE(words.find(std::string("(") + std::strerror(error) + ")"), std::string::npos) << words;
  }
}

TEST(CanBuses, SplitsNamesAtTheirCommas) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(split_names("can0"), Names{"can0"});
  EXPECT_EQ(split_names("can0,vcan1"), (Names{"can0", "vcan1"}));
  EXPECT_EQ(split_names(",can0,,"), (Names{"", "can0", "", ""}));
}

}  // namespace
}  // namespace godobject::firmware::can_buses_test
