#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace godobject::firmware {

/// One thing that real-time work needs.
struct Finding {
  bool good = false;
  std::string what;     ///< how it is
  std::string cure;     ///< how to mend it; empty where it is good
  bool needed = false;  ///< without it there is no real-time work at all
};

/// What the machine has of a real-time kernel, rights (by limits or by capabilities: being root is not enough), an
/// isolated processor, full clock rate, a quick clock source, unthrottled real-time threads and CAN. `cpu`: that the
/// loop is to be bound to, -1 for none; `priority` is the loop's. `root`: where /proc and /sys are.
std::vector<Finding> examine_machine(int cpu, int priority, const std::filesystem::path& root = "/");

}  // namespace godobject::firmware
