#include "toolchain/command/progress.h"

#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

namespace godobject::command {

Progress::Progress() : on_terminal_(::isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (!phase_.empty()) fmt::print(stderr, "\r\x1b[K");
}

void Progress::show(std::string_view phase, double share) {
  if (!on_terminal_) return;
  const auto now = std::chrono::steady_clock::now();
  if (phase == phase_ && now < next_) return;
  next_ = now + std::chrono::milliseconds(100);
  phase_ = phase;
  fmt::print(stderr, "\r{} {:3.0f} %\x1b[K", phase, 100.0 * share);
  std::fflush(stderr);
}

}  // namespace godobject::command
