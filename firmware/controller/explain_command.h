#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace godobject::firmware {

/// `godobject-controller explain FOLDER`: says in plain words why the arm stopped, and draws the last seconds before
/// it.
class ExplainCommand {
 public:
  /// Adds the subcommand to `app`.
  explicit ExplainCommand(CLI::App& app);

  bool is_asked() const { return command_->parsed(); }

  /// After parsing. Throws command::Failure with the codes of its help.
  void run() const;

 private:
  CLI::App* command_;
  std::string folder_;
  std::string output_;
};

}  // namespace godobject::firmware
