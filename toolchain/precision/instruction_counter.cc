#include "toolchain/precision/instruction_counter.h"

#include <cstdint>
#include <limits>

#include <linux/perf_event.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace godobject::precision {

InstructionCounter::InstructionCounter() {
  perf_event_attr attributes{};
  attributes.type = PERF_TYPE_HARDWARE;
  attributes.size = sizeof(attributes);
  attributes.config = PERF_COUNT_HW_INSTRUCTIONS;
  attributes.disabled = 1;
  attributes.exclude_kernel = 1;
  attributes.exclude_hv = 1;
  constexpr pid_t kThisThread = 0;
  constexpr int kAnyProcessor = -1;
  constexpr int kNoGroup = -1;
  descriptor_ = static_cast<int>(
      ::syscall(SYS_perf_event_open, &attributes, kThisThread, kAnyProcessor, kNoGroup, PERF_FLAG_FD_CLOEXEC));
}

InstructionCounter::~InstructionCounter() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void InstructionCounter::start() {
  if (descriptor_ < 0) return;
  ::ioctl(descriptor_, PERF_EVENT_IOC_RESET, 0);
  ::ioctl(descriptor_, PERF_EVENT_IOC_ENABLE, 0);
}

double InstructionCounter::stop() {
  std::uint64_t count = 0;
  const bool counted = descriptor_ >= 0 && ::ioctl(descriptor_, PERF_EVENT_IOC_DISABLE, 0) == 0 &&
                       ::read(descriptor_, &count, sizeof(count)) == sizeof(count) && count > 0;
  return counted ? static_cast<double>(count) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace godobject::precision
