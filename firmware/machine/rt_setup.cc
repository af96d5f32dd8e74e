#include "firmware/machine/rt_setup.h"

#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include <fmt/format.h>

namespace godobject::firmware {
namespace {

/// Touches the stack that the loop may use. 256 KiB, chosen: five times the measured need. `ulimit -s 48` (KiB) is
/// enough for a whole run in virtual time with `--log`, `ulimit -s 32` is not.
void touch_stack() noexcept {
  constexpr std::size_t kBytes = 256 * 1024;
  char stack[kBytes];
  ::explicit_bzero(stack, kBytes);  // an optimiser may not remove it
}

}  // namespace

std::vector<std::string> set_up_real_time(const RealTimeSettings& settings) {
  std::vector<std::string> missing;
  if (::mlockall(MCL_CURRENT | MCL_FUTURE) != 0) {
    missing.push_back(fmt::format(
        "memory is not locked ({}); raise memlock in /etc/security/limits.d, or LimitMEMLOCK=", std::strerror(errno)));
  }
  touch_stack();
  if (settings.cpu >= 0) {
    cpu_set_t cpus;
    CPU_ZERO(&cpus);
    CPU_SET(static_cast<std::size_t>(settings.cpu), &cpus);
    if (::sched_setaffinity(0, sizeof cpus, &cpus) != 0) {
      missing.push_back(
          fmt::format("not bound to processor {} ({}); choose another loop.cpu", settings.cpu, std::strerror(errno)));
    }
  }
  sched_param parameter{};
  parameter.sched_priority = settings.priority;
  if (::sched_setscheduler(0, SCHED_FIFO, &parameter) != 0) {
    missing.push_back(fmt::format(
        "no real-time priority {} ({}); raise rtprio in /etc/security/limits.d, or LimitRTPRIO=", settings.priority,
        std::strerror(errno)));
  }
  return missing;
}

long page_faults() noexcept {
  rusage usage{};
  ::getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_minflt + usage.ru_majflt;
}

std::string describe_machine() {
  utsname kernel{};
  ::uname(&kernel);
  double load[1] = {0.0};
  if (::getloadavg(load, 1) != 1) load[0] = 0.0;
  return fmt::format("{} {} {} {}, {} processors, load {:.2f}", kernel.sysname, kernel.release, kernel.version,
                     kernel.machine, ::sysconf(_SC_NPROCESSORS_ONLN), load[0]);
}

}  // namespace godobject::firmware
