#pragma once

#include <string>
#include <vector>

namespace godobject::firmware {

struct RealTimeSettings {
  int cpu = -1;       ///< processor of the thread; -1: any
  int priority = 80;  ///< of SCHED_FIFO
};

/// Makes the calling thread a real-time thread: locks present and future memory, touches the stack so that it causes no
/// page fault later, binds the thread to its processor, sets SCHED_FIFO. Returns one line with the cure for each right
/// that is missing.
std::vector<std::string> set_up_real_time(const RealTimeSettings& settings);

/// Number of page faults of the calling thread so far.
long page_faults() noexcept;

/// Kernel, processors and load as one line: figures of a run mean nothing without them.
std::string describe_machine();

}  // namespace godobject::firmware
