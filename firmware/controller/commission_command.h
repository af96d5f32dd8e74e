#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace godobject::firmware {

/// `godobject-controller commission`: tests, without power, that each drive stops by itself when the controller falls
/// silent.
class CommissionCommand {
 public:
  /// Adds the subcommand to `app`. `transport`: of --bus, shared with the other commands; outlives this.
  CommissionCommand(CLI::App& app, std::string& transport);

  bool is_asked() const { return command_->parsed(); }

  /// After parsing. Throws command::Failure with the codes of its help.
  void run() const;

 private:
  std::string& transport_;
  CLI::App* command_;
  std::string file_;
};

}  // namespace godobject::firmware
