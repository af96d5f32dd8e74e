#pragma once

#include <string>

#include "hal/cia402/bus_plan.h"

namespace godobject::firmware {

/// The plan for the user's eye: a line a bus with its worst case in microseconds, then collection, delay and each
/// joint's torque step. Each line ends with a line feed.
std::string bus_plan_table(const hal::BusLayout& layout, const hal::BusPlan& plan);

/// Which bus does not fit, by how much, and what helps, as one line without its end; empty if all fit.
std::string bus_plan_objection(const hal::BusLayout& layout, const hal::BusPlan& plan);

}  // namespace godobject::firmware
