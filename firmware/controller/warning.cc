#include "firmware/controller/warning.h"

#include <cerrno>
#include <cstdio>

#include <fmt/format.h>

namespace godobject::firmware {

void warn(const std::string& line) {
  std::fflush(stdout);
  fmt::print(stderr, "{}: {}\n", program_invocation_short_name, line);
}

}  // namespace godobject::firmware
