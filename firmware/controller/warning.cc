#include "firmware/controller/warning.h"

#include <cstdio>

#include <fmt/format.h>

namespace godobject::firmware {

void warn(const std::string& line) {
  std::fflush(stdout);
  fmt::print(stderr, "godobject-controller: {}\n", line);
}

}  // namespace godobject::firmware
