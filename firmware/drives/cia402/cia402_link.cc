#include "firmware/drives/cia402/cia402_link.h"

#include "firmware/drives/cia402/bus_messages.h"
#include "firmware/drives/cia402/commissioning.h"
#include "firmware/drives/cia402/serial_numbers.h"
#include "toolchain/command_line/failure.h"

namespace godobject::firmware {

Cia402Link::Cia402Link(const LinkRequest& request, const hal::BusLayout& layout, const hal::BusTiming& timing)
    : layout_(layout),
      transport_(open_can_transport(request, layout_)),
      drives_(layout_, transport_->buses(), timing, request.tap),
      warnings_(transport_->warnings()) {
  const bool real = transport_->simulated_arm() == nullptr;
  if (real && !(layout_.drive_delay > 0.0)) {
    warnings_.emplace_back(
        "bus.drive_delay = 0: the gain check does not count the drives' own delay; take it from their manual");
  }
  const Finding serials = check_serial_numbers(layout_);
  if (real && !serials.good) warnings_.push_back(serials.what + "; " + serials.cure);
}

bool Cia402Link::start(hal::Clock& clock, const std::atomic<bool>& end) {
  const hal::BringUpResult result = drives_.bring_up(clock, &end);
  if (result.status == hal::BringUpStatus::kOk) return true;
  drives_.stop_nodes();
  if (result.status == hal::BringUpStatus::kEnded) return false;
  throw command::Failure(command::ExitCode::kUnavailable, explain(result, bus_names()));
}

std::string Cia402Link::statistics() const { return bus_summary(drives_.statistics(), drives_.joint_count()); }

std::string Cia402Link::alarm() const { return explain(drives_.alarm_detail(), bus_names()); }

CommissioningReport Cia402Link::commission(hal::Clock& clock, const std::atomic<bool>& end) {
  const std::vector<JointTrial> trials = try_drives(drives_, layout_, transport_->buses(), clock, bus_names(), end);
  return {trial_table(layout_, trials), identity_keys(layout_, trials), trial_objection(trials)};
}

}  // namespace godobject::firmware
