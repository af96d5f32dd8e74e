#include "firmware/doctor.h"

#include <sys/resource.h>
#include <unistd.h>

#include <fstream>
#include <optional>
#include <sstream>
#include <system_error>

#include <fmt/format.h>

namespace godobject::firmware {
namespace {

using Path = std::filesystem::path;

/// The file's first line; nothing if it cannot be read.
std::optional<std::string> first_line(const Path& file) {
  std::ifstream stream(file);
  std::string line;
  if (!stream || !std::getline(stream, line)) return std::nullopt;
  return line;
}

/// Whether a list such as 1-3,6 has it.
bool has_number(const std::string& list, int number) {
  std::istringstream parts(list);
  std::string part;
  while (std::getline(parts, part, ',')) {
    int first = 0;
    int last = 0;
    char dash = 0;
    std::istringstream range(part);
    if (!(range >> first)) continue;
    if (!(range >> dash >> last)) last = first;
    if (number >= first && number <= last) return true;
  }
  return false;
}

Finding kernel(const Path& root) {
  if (first_line(root / "sys/kernel/realtime") == "1") return {true, "kernel: PREEMPT_RT", ""};
  return {false, "kernel: not PREEMPT_RT", "apt-get install linux-image-rt-amd64 (or -arm64) and boot it"};
}

Finding limit(const char* name, rlim_t have, bool enough, const std::string& wanted) {
  const std::string text = have == RLIM_INFINITY ? "unlimited" : std::to_string(have);
  if (enough || ::geteuid() == 0) return {true, fmt::format("{}: {}{}", name, text, enough ? "" : ", but root"), ""};
  return {false, fmt::format("{}: {}", name, text),
          fmt::format("put '@realtime - {} {}' into /etc/security/limits.d/godobject.conf, join the group realtime and "
                      "log in again",
                      name, wanted)};
}

std::vector<Finding> limits(int priority) {
  rlimit rtprio{};
  rlimit memlock{};
  ::getrlimit(RLIMIT_RTPRIO, &rtprio);
  ::getrlimit(RLIMIT_MEMLOCK, &memlock);
  return {limit("rtprio", rtprio.rlim_cur, rtprio.rlim_cur >= static_cast<rlim_t>(priority), std::to_string(priority)),
          limit("memlock", memlock.rlim_cur, memlock.rlim_cur == RLIM_INFINITY, "unlimited")};
}

Finding isolation(int cpu, const Path& root) {
  const std::string isolated = first_line(root / "sys/devices/system/cpu/isolated").value_or("");
  if (isolated.empty()) {
    return {false, "isolated processors: none",
            "boot with isolcpus=N nohz_full=N rcu_nocbs=N and set loop.cpu = N, N not 0"};
  }
  if (cpu < 0) {
    return {false, fmt::format("isolated processors: {}, but the loop is bound to none", isolated),
            "set loop.cpu to one of them"};
  }
  if (!has_number(isolated, cpu)) {
    return {false, fmt::format("isolated processors: {}, the loop's {} is not among them", isolated, cpu),
            "set loop.cpu to one of them"};
  }
  return {true, fmt::format("isolated processors: {}, the loop has {}", isolated, cpu), ""};
}

Finding governor(int cpu, const Path& root) {
  const Path file = root / fmt::format("sys/devices/system/cpu/cpu{}/cpufreq/scaling_governor", cpu < 0 ? 0 : cpu);
  const std::optional<std::string> name = first_line(file);
  if (!name) return {true, "clock rate: not scaled here", ""};
  if (*name == "performance") return {true, "clock rate: governor performance", ""};
  return {false, fmt::format("clock rate: governor {}", *name), fmt::format("echo performance > {}", file.string())};
}

Finding clock_source(const Path& root) {
  const Path file = root / "sys/devices/system/clocksource/clocksource0/current_clocksource";
  const std::string name = first_line(file).value_or("unknown");
  if (name == "tsc" || name == "arch_sys_counter" || name == "kvm-clock") return {true, "clock source: " + name, ""};
  return {false, "clock source: " + name + ", slow to read", "boot with tsc=reliable if the processor's counter is"};
}

Finding throttling(const Path& root) {
  const std::string runtime = first_line(root / "proc/sys/kernel/sched_rt_runtime_us").value_or("-1");
  if (runtime == "-1") return {true, "real-time throttling: off", ""};
  return {true, fmt::format("real-time throttling: {} us a second for all real-time threads", runtime), ""};
}

Finding can(const Path& root) {
  std::error_code error;
  if (std::filesystem::exists(root / "proc/net/can", error)) return {true, "CAN: in the kernel", ""};
  return {false, "CAN: not in the kernel, or its module is not loaded",
          "modprobe can can_raw; for a simulated bus vcan"};
}

}  // namespace

std::vector<Finding> examine_machine(int cpu, int priority, const std::filesystem::path& root) {
  std::vector<Finding> findings{kernel(root)};
  for (Finding& finding : limits(priority)) findings.push_back(std::move(finding));
  findings.push_back(isolation(cpu, root));
  findings.push_back(governor(cpu, root));
  findings.push_back(clock_source(root));
  findings.push_back(throttling(root));
  findings.push_back(can(root));
  return findings;
}

}  // namespace godobject::firmware
