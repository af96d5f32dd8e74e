#pragma once

#include <stdexcept>
#include <string>

namespace godobject::command {

/// Exit codes of sysexits.h.
enum class ExitCode : int {
  kOk = 0,
  kUsage = 64,
  kBadData = 65,
  kNoInput = 66,
  kUnavailable = 69,
  kInternal = 70,
  kIo = 74,
  kNoPermission = 77,
  kBadConfig = 78
};

/// Ends a command with an exit code and one line for the user: what happened, where, what to do.
class Failure : public std::runtime_error {
 public:
  Failure(ExitCode exit_code, const std::string& message) : std::runtime_error(message), exit_code_(exit_code) {}
  ExitCode exit_code() const noexcept { return exit_code_; }

 private:
  ExitCode exit_code_;
};

}  // namespace godobject::command
