#pragma once

#include <string>
#include <vector>

#include "hal/cia402/alarm_latch.h"
#include "hal/cia402/bring_up.h"
#include "hal/cia402/can_statistics.h"

namespace godobject::firmware {

/// Why the nodes could not be started, as one clause: interface, node, joint, object, numbers, cure. `interfaces`: the
/// buses' names in their order.
std::string explain(const hal::BringUpResult& result, const std::vector<std::string>& interfaces);

/// The same of an alarm in mid-run.
std::string explain(const hal::cia402::AlarmDetail& alarm, const std::vector<std::string>& interfaces);

/// Two lines of what went over the buses.
std::string bus_summary(const hal::CanStatistics& statistics, int joint_count);

}  // namespace godobject::firmware
