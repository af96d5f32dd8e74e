#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace godobject::firmware {

/// `godobject-controller doctor`: checks whether this machine can do real-time work, and prints a cure for each lack.
class DoctorCommand {
 public:
  /// Adds the subcommand to `app`. `transport`: of --bus, shared with the other commands; outlives this.
  DoctorCommand(CLI::App& app, std::string& transport);

  bool is_asked() const { return command_->parsed(); }

  /// After parsing. Throws command::Failure with the codes of its help.
  void run() const;

 private:
  std::string& transport_;
  CLI::App* command_;
  std::string file_;  // empty: the machine alone is checked
};

}  // namespace godobject::firmware
