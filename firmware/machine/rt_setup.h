#pragma once

#include <string>
#include <vector>

namespace godobject::firmware {

struct RealTimeSettings {
  int cpu = -1;       ///< that the thread is bound to; -1: none
  int priority = 80;  ///< SCHED_FIFO
};

/// Makes the calling thread a real-time one: memory locked, present and to come; the stack touched so that it needs no
/// page later; bound to its processor; SCHED_FIFO. Returns what was not permitted, one line each with its cure; empty
/// if nothing is missing.
std::vector<std::string> set_up_real_time(const RealTimeSettings& settings);

/// Page faults of the calling thread so far.
long page_faults() noexcept;

/// One line: kernel, processors, load. For figures, which mean nothing without.
std::string describe_machine();

}  // namespace godobject::firmware
