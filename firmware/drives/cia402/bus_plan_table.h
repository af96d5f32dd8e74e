#pragma once

#include <string>

#include "hal/cia402/bus_plan.h"

namespace godobject::firmware {

/// The plan as a table for the user: one line a bus with its worst case in microseconds, then collection time, delay
/// and each joint's torque step. Each line ends with a line feed.
std::string bus_plan_table(const hal::BusLayout& layout, const hal::BusPlan& plan);

/// The first bus that does not fit, the excess and the cure, as one line without a line feed; empty if all buses fit.
std::string bus_plan_objection(const hal::BusLayout& layout, const hal::BusPlan& plan);

}  // namespace godobject::firmware
