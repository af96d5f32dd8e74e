#include "firmware/controller/doctor_command.h"

#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "firmware/configuration/controller_file.h"
#include "firmware/controller/drive_choice.h"
#include "firmware/machine/doctor.h"
#include "toolchain/command_line/failure.h"

namespace godobject::firmware {
namespace {

const char* const kFooter = R"(Example:
  godobject-controller doctor firmware/controllers/lwr.toml --bus can0,can1,can2

A line each: ok, or LACK with its cure. CONTROLLER.toml is looked at for loop.cpu, loop.priority and the device's buses: their bit
rates, and what each carries in a cycle.

Exit codes: 0 done, 64 usage, 66 CONTROLLER.toml is missing or may not be read, 69 something is lacking without which there is no
real-time work: kernel, rtprio, memlock or a working CAN interface, 78 bad configuration.)";

}  // namespace

DoctorCommand::DoctorCommand(CLI::App& app, std::string& transport)
    : transport_(transport),
      command_(app.add_subcommand("doctor", "says what this machine lacks for real-time work, each with its cure")) {
  command_->footer(kFooter);
  command_->add_option("CONTROLLER.toml", file_, "controller file, for loop and buses")->type_name("");
  command_->add_option("--bus", transport_, "CAN interfaces to look at, such as can0,can1")->type_name("BUS");
}

void DoctorCommand::run() const {
  ControllerConfig config;
  if (!file_.empty()) config = read_controller_file(file_);
  const std::unique_ptr<DriveFamily> family = choose_drives(config.device);
  std::vector<Finding> findings = examine_machine(config.loop.cpu, config.loop.priority);
  for (const Finding& finding : family->examine(transport_)) findings.push_back(finding);
  std::vector<std::string> missing;
  for (const Finding& finding : findings) {
    fmt::print("{} {}{}{}\n", finding.good ? "ok  " : "LACK", finding.what, finding.good ? "" : " -> ", finding.cure);
    if (!finding.good && finding.needed) missing.push_back(finding.what);
  }
  if (!file_.empty()) {
    family->require_plan();
    fmt::print("{}", family->plan());
  }
  if (!missing.empty()) {
    throw command::Failure(
        command::ExitCode::kUnavailable,
        fmt::format("no real-time work on this machine ({}); see the cures above", fmt::join(missing, "; ")));
  }
}

}  // namespace godobject::firmware
