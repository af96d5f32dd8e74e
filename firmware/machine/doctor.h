#pragma once

#include <filesystem>
#include <vector>

#include "firmware/machine/finding.h"

namespace godobject::firmware {

/// Checks this machine for real-time work: real-time kernel, rights (by limits or by capabilities; being root is not
/// enough), isolated processor, full clock rate, fast clock source, unthrottled real-time threads, CAN. `cpu`: the
/// loop's processor, -1: none; `priority`: of the loop. `root`: the folder with /proc and /sys.
std::vector<Finding> examine_machine(int cpu, int priority, const std::filesystem::path& root = "/");

}  // namespace godobject::firmware
