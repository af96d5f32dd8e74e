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

const char* const kDoctorFooter = R"(Example:
  godobject-controller doctor firmware/controllers/lwr.toml --bus can0,can1,can2

Prints one line a check: ok, or LACK with its cure. CONTROLLER.toml gives loop.cpu, loop.priority and the buses of the device:
their bit rates are compared with the interfaces, and the time plan of a cycle is printed.

Exit codes: 0 done, 64 usage, 66 CONTROLLER.toml is missing or cannot be read, 69 real-time work is impossible: kernel, rtprio,
memlock or a working CAN interface is lacking, 78 bad configuration.)";

}  // namespace

DoctorCommand::DoctorCommand(CLI::App& app, std::string& transport)
    : transport_(transport),
      command_(app.add_subcommand("doctor", "checks this machine for real-time work and prints a cure for each lack")) {
  command_->footer(kDoctorFooter);
  command_->add_option("CONTROLLER.toml", file_, "controller file with loop and buses")->type_name("");
  command_->add_option("--bus", transport_, "CAN interfaces to check, such as can0,can1")->type_name("BUS");
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
