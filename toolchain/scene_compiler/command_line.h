#pragma once

#include <functional>

#include <CLI/CLI.hpp>

namespace godobject::scene_compiler {

/// Parses the arguments and runs `work`; turns every way to end into an exit code of sysexits.h and at most one line on
/// stderr that begins with the command's name.
int run_command(CLI::App& app, int argc, const char* const* argv, const std::function<void()>& work);

/// "phase  42 %" on stderr, rewritten in place, where that is a terminal; else silent.
class ProgressLine {
 public:
  ProgressLine();
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(const char* phase, double done);

 private:
  bool terminal_;
  const char* phase_ = nullptr;
  int percent_ = -1;
};

}  // namespace godobject::scene_compiler
