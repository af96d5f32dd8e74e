#pragma once

#include <optional>
#include <string>

#include "firmware/cycle/control_cycle.h"
#include "firmware/loop/controller_run.h"

namespace godobject::firmware {

/// The text at the end of a run: rendering, modes, losses, `transport` (DriveLink::statistics), limits, times, machine.
/// `period`: T [s].
/// `page_faults`: of the loop's thread in a real-time run; none: the run was in virtual time, and its text has no
/// latencies. Each line ends with a line feed.
std::string run_summary(const RunReport& report, const CycleCounters& counters, double period,
                        const std::string& transport, std::optional<long> page_faults);

}  // namespace godobject::firmware
