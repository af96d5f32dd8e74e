#include "firmware/drives/cia402/cia402_family.h"

#include <fmt/format.h>

#include "firmware/drives/cia402/bus_plan_table.h"
#include "firmware/drives/cia402/can_buses.h"
#include "firmware/drives/cia402/cia402_link.h"
#include "firmware/drives/cia402/serial_numbers.h"
#include "firmware/machine/can_interfaces.h"
#include "toolchain/command_line/failure.h"

namespace godobject::firmware {

std::string Cia402Family::plan() const { return bus_plan_table(layout_, plan_); }

void Cia402Family::require_plan() const {
  if (plan_.fits) return;
  fmt::print(stderr, "{}", plan());
  throw command::Failure(command::ExitCode::kBadConfig, bus_plan_objection(layout_, plan_));
}

std::vector<Finding> Cia402Family::examine(const std::string& transport) const {
  if (transport == kSimulatedTransport) return {};
  std::vector<Finding> findings = examine_can_interfaces(split_names(transport), layout_);
  if (layout_.joint_count > 0) findings.push_back(check_serial_numbers(layout_));
  return findings;
}

std::unique_ptr<DriveLink> Cia402Family::connect(const LinkRequest& request) const {
  return std::make_unique<Cia402Link>(request, layout_, plan_.timing);
}

}  // namespace godobject::firmware
