#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace godobject::command {

/// The text about the progress of long work. On a terminal: "phase  42 %", rewritten in place. Elsewhere (a pipe, a
/// file): lines "  12 s  phase". Nothing is written in the first second, so short work leaves no line. Later there is
/// one line for each phase, those of the first second included, and one with the share every ten seconds.
class ProgressText {
 public:
  explicit ProgressText(bool on_terminal) : on_terminal_(on_terminal) {}

  /// Returns the text that is due now, which is mostly empty. `share` of the phase's work done, 0 .. 1. `now`: time
  /// since the start of the work, not decreasing.
  std::string show(std::string_view phase, double share, std::chrono::nanoseconds now);

  /// Returns the text that clears a terminal's line.
  std::string end() const;

 private:
  std::string rewritten(std::string_view phase, double share, std::chrono::nanoseconds now);
  std::string appended(std::string_view phase, double share, std::chrono::nanoseconds now);

  bool on_terminal_;
  std::string phase_;
  std::string waiting_;              // lines of the first second
  std::chrono::nanoseconds next_{};  // no text of this phase before this time
};

/// Writes ProgressText to stderr.
class Progress {
 public:
  Progress();
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(std::string_view phase, double share);

 private:
  ProgressText text_;
  std::chrono::steady_clock::time_point begin_;
};

}  // namespace godobject::command
