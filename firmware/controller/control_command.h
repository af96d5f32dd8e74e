#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "firmware/configuration/controller_file.h"

namespace godobject::firmware {

/// `godobject-controller CONTROLLER.toml`: controls the arm until it is asked to end, or a fault refuses the start.
class ControlCommand {
 public:
  /// Adds the command's options and help to `app`. `transport`: of --bus, shared with the subcommands; outlives this.
  ControlCommand(CLI::App& app, std::string& transport);

  /// After parsing. Throws command::Failure with the codes of its help.
  void run() const;

 private:
  ControllerConfig read_configuration() const;
  void choose_incidents(ControllerConfig::Telemetry& telemetry) const;

  std::string& transport_;
  const CLI::Option* file_option_ = nullptr;  // not required: a subcommand does without
  std::string file_;
  std::string scene_;
  std::string log_;
  std::string incidents_;
  bool log_bus_ = false;
  bool real_time_ = false;
  std::optional<double> duration_;
};

}  // namespace godobject::firmware
