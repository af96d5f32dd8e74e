#pragma once

#include <poll.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string>

#include "hal/can_frame.h"

namespace godobject::test {

/// Receives frames on stdin and sends them on stdout, one line of text each: 203#0F00CEFF.
class FramePipe {
 public:
  /// Returns true and a frame if one has arrived. Does not wait.
  bool read(hal::CanFrame& frame) {
    std::size_t end = 0;
    while ((end = text_.find('\n')) == std::string::npos) {
      if (!fetch(0)) return false;
    }
    const std::string line = text_.substr(0, end);
    text_.erase(0, end + 1);
    frame = {};
    frame.id = static_cast<std::uint16_t>(std::strtoul(line.c_str(), nullptr, 16));
    for (std::size_t i = line.find('#') + 1; i + 1 < line.size() && frame.length < 8; i += 2) {
      frame.data[frame.length++] = static_cast<std::uint8_t>(std::strtoul(line.substr(i, 2).c_str(), nullptr, 16));
    }
    return true;
  }

  void write(const hal::CanFrame& frame) {
    std::printf("%03X#", frame.id);
    for (std::size_t i = 0; i < frame.length; ++i) std::printf("%02X", frame.data[i]);
    std::printf("\n");
    std::fflush(stdout);
  }

  /// Waits for input, for at most this time. Returns false after the other side has ended.
  bool wait(int milliseconds) {
    fetch(milliseconds);
    return !ended_;
  }

 private:
  bool fetch(int milliseconds) {
    pollfd descriptor{STDIN_FILENO, POLLIN, 0};
    if (ended_ || ::poll(&descriptor, 1, milliseconds) <= 0) return false;
    char bytes[4096];
    const ssize_t count = ::read(STDIN_FILENO, bytes, sizeof bytes);
    if (count > 0) text_.append(bytes, static_cast<std::size_t>(count));
    ended_ = count <= 0;
    return !ended_;
  }

  std::string text_;
  bool ended_ = false;
};

}  // namespace godobject::test
