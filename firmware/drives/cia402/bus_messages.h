#pragma once

#include <string>
#include <vector>

#include "hal/cia402/alarm_latch.h"
#include "hal/cia402/bring_up.h"
#include "hal/cia402/can_statistics.h"

namespace godobject::firmware {

/// The reason of a failed start as one clause: interface, node, joint, object, numbers, cure. `interfaces`: names of
/// the buses, bus 0 first.
std::string explain(const hal::BringUpResult& result, const std::vector<std::string>& interfaces);

/// The reason of an alarm as one clause, in the same form.
std::string explain(const hal::cia402::AlarmDetail& alarm, const std::vector<std::string>& interfaces);

/// Figures of the buses as two lines, and a third one if drives tell their temperatures.
std::string bus_summary(const hal::CanStatistics& statistics, int joint_count);

}  // namespace godobject::firmware
