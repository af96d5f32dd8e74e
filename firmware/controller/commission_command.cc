#include "firmware/controller/commission_command.h"

#include <memory>

#include <fmt/format.h>

#include "firmware/configuration/controller_file.h"
#include "firmware/controller/drive_choice.h"
#include "firmware/controller/real_time_thread.h"
#include "firmware/controller/warning.h"
#include "firmware/machine/signals.h"
#include "toolchain/command_line/failure.h"

namespace godobject::firmware {
namespace {

using command::ExitCode;
using command::Failure;

const char* const kCommissionFooter = R"(Examples:
  godobject-controller commission firmware/controllers/lwr.toml --bus can0,can1,can2
  godobject-controller commission firmware/controllers/lwr.toml          # on simulated drives

Starts the drives without giving them power. Sets each drive to no mode and back: its TPDO2 must show both changes at once. Then
omits the torque frames (RPDO) of one joint after the other: the drive must report by emergency message 8250, or by a fault, that
its deadline has expired. Prints one line a joint: identity of the drive, sign and zero of the device file and the position that
follows from them, and the observed reaction. Then it prints the identities as lines for the device file. With them each start
compares vendor, product, revision and serial number (object 1018), so that two swapped drives get no power.

A drive that watches its deadline in the state operation enabled only shows no reaction here. firmware/README.md describes the
test for such a drive.

Exit codes: 0 all joints showed mode and deadline in time, 64 usage, 66 CONTROLLER.toml is missing or cannot be read, 69 drives or
bus not available, or a joint showed no mode or deadline in time, 77 no right, 78 bad configuration.)";

}  // namespace

CommissionCommand::CommissionCommand(CLI::App& app, std::string& transport)
    : transport_(transport),
      command_(app.add_subcommand(
          "commission", "tests, without power, that each drive reports its mode and stops without torque frames")) {
  command_->footer(kCommissionFooter);
  command_->add_option("CONTROLLER.toml", file_, "controller file")->required()->type_name("");
  command_->add_option("--bus", transport_, "sim, or CAN interfaces such as can0,can1; default: sim")->type_name("BUS");
}

void CommissionCommand::run() const {
  ControllerConfig config = read_controller_file(file_);
  config.simulation.path.clear();  // the simulated hand holds still
  const Placement placement = place(config.workspace, config.device, Vector3::Zero());
  const std::unique_ptr<DriveFamily> family = choose_drives(config.device);
  family->require_plan();
  const std::unique_ptr<DriveLink> link =
      family->connect({.transport = transport_, .config = &config, .placement = &placement, .tap = nullptr});
  for (const std::string& line : link->warnings()) warn(line);
  RunRequests& requests = signal_requests();
  catch_end_signals();
  catch_reset_signal();
  ignore_write_signals();
  if (link->real_time()) set_up_loop_thread(config.loop, link->simulated_arm() != nullptr);
  const std::unique_ptr<hal::Clock> clock = link->make_clock();
  if (!link->start(*clock, requests.end)) {
    throw Failure(ExitCode::kUnavailable, "ended before the drives were started");
  }
  CommissioningReport report;
  try {
    report = link->commission(*clock, requests.end);
  } catch (const Failure&) {
    link->stop();
    throw;
  }
  link->stop();
  fmt::print("{}", report.table);
  if (!report.keys.empty()) {
    fmt::print("\nThe drives tell these identities. Paste each line below the [[joint]] of the device file:\n{}",
               report.keys);
  }
  if (!report.objection.empty()) throw Failure(ExitCode::kUnavailable, report.objection);
}

}  // namespace godobject::firmware
