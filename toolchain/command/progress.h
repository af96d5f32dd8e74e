#pragma once

#include <chrono>
#include <string>

namespace godobject::command {

/// One line on a terminal's stderr that tells how far a long piece of work is; silent elsewhere.
class Progress {
 public:
  explicit Progress(std::string label);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `share` of the work done, 0 .. 1. Cheap: writes at most ten times a second.
  void update(double share);

 private:
  std::string label_;
  bool on_terminal_;
  std::chrono::steady_clock::time_point next_{};
};

}  // namespace godobject::command
