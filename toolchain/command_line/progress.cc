#include "toolchain/command_line/progress.h"

#include <cstdio>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

namespace godobject::command {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

constexpr nanoseconds kRewritten = 100ms;
constexpr nanoseconds kSilent = 1s;
constexpr nanoseconds kRepeated = 10s;

void write(const std::string& text) {
  if (text.empty()) return;
  fmt::print(stderr, "{}", text);
  std::fflush(stderr);
}

}  // namespace

std::string ProgressText::show(std::string_view phase, double share, nanoseconds now) {
  return on_terminal_ ? rewritten(phase, share, now) : appended(phase, share, now);
}

std::string ProgressText::end() const { return on_terminal_ && !phase_.empty() ? "\r\x1b[K" : ""; }

std::string ProgressText::rewritten(std::string_view phase, double share, nanoseconds now) {
  if (phase == phase_ && now < next_) return {};
  next_ = now + kRewritten;
  phase_ = phase;
  return fmt::format("\r{} {:3.0f} %\x1b[K", phase, 100.0 * share);
}

std::string ProgressText::appended(std::string_view phase, double share, nanoseconds now) {
  const bool begins = phase != phase_;
  if (begins || now >= next_) {
    const double seconds = std::chrono::duration<double>(now).count();
    waiting_ += begins ? fmt::format("{:4.0f} s  {}\n", seconds, phase)
                       : fmt::format("{:4.0f} s  {} {:3.0f} %\n", seconds, phase, 100.0 * share);
    next_ = now + kRepeated;
    phase_ = phase;
  }
  return now < kSilent ? std::string() : std::exchange(waiting_, {});
}

Progress::Progress() : text_(::isatty(STDERR_FILENO) == 1), begin_(std::chrono::steady_clock::now()) {}

Progress::~Progress() { write(text_.end()); }

void Progress::show(std::string_view phase, double share) {
  write(text_.show(phase, share, std::chrono::steady_clock::now() - begin_));
}

}  // namespace godobject::command
