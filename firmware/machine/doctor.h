#pragma once

#include <filesystem>
#include <vector>

#include "firmware/machine/finding.h"

namespace godobject::firmware {

/// What the machine has of a real-time kernel, rights (by limits or by capabilities: being root is not enough), an
/// isolated processor, full clock rate, a quick clock source, unthrottled real-time threads and CAN. `cpu`: that the
/// loop is to be bound to, -1 for none; `priority` is the loop's. `root`: where /proc and /sys are.
std::vector<Finding> examine_machine(int cpu, int priority, const std::filesystem::path& root = "/");

}  // namespace godobject::firmware
