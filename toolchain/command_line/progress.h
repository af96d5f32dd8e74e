#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace godobject::command {

/// What to write about long work, and when. On a terminal "phase  42 %", rewritten in place. Elsewhere (a pipe, a file)
/// lines "  12 s  phase": nothing in the first second, so that short work leaves no line and its error is the only one;
/// from then on one for each phase, those of the first second as well, and one with the share every ten seconds.
class ProgressText {
 public:
  explicit ProgressText(bool on_terminal) : on_terminal_(on_terminal) {}

  /// What is due now; mostly nothing. `share` of the phase's work done, 0 .. 1; `now` since the work began, not
  /// falling.
  std::string show(std::string_view phase, double share, std::chrono::nanoseconds now);

  /// What clears a terminal's line.
  std::string end() const;

 private:
  std::string rewritten(std::string_view phase, double share, std::chrono::nanoseconds now);
  std::string appended(std::string_view phase, double share, std::chrono::nanoseconds now);

  bool on_terminal_;
  std::string phase_;
  std::string waiting_;              // lines of the first second
  std::chrono::nanoseconds next_{};  // nothing more of this phase before
};

/// ProgressText of this moment, on stderr.
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
