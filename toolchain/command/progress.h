#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace godobject::command {

/// "phase  42 %" on stderr, rewritten in place, where that is a terminal; silent elsewhere.
class Progress {
 public:
  Progress();
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `share` of the phase's work done, 0 .. 1. Cheap: writes when the phase changes, and at most ten times a second.
  void show(std::string_view phase, double share);

 private:
  std::string phase_;
  bool on_terminal_;
  std::chrono::steady_clock::time_point next_{};
};

}  // namespace godobject::command
