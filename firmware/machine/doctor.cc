#include "firmware/machine/doctor.h"

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

/// The first line of a file; none if it cannot be read.
std::optional<std::string> first_line(const Path& file) {
  std::ifstream stream(file);
  std::string line;
  if (!std::getline(stream, line)) return std::nullopt;
  return line;
}

/// True if a list such as 1-3,6 contains the number.
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
  const std::string version = first_line(root / "proc/version").value_or("");
  const auto has = [&version](const char* word) { return version.find(word) != std::string::npos; };
  if (first_line(root / "sys/kernel/realtime") == "1" || has("PREEMPT_RT"))
    return {true, "kernel: PREEMPT_RT", "", true};
  const char* found = has("PREEMPT_DYNAMIC") ? "PREEMPT_DYNAMIC, not PREEMPT_RT"
                      : has("PREEMPT")       ? "PREEMPT, not PREEMPT_RT"
                                             : "not PREEMPT_RT";
#if defined(__aarch64__)
  const char* package = "linux-image-rt-arm64";
#else
  const char* package = "linux-image-rt-amd64";
#endif
  return {false, fmt::format("kernel: {}", found), fmt::format("apt-get install {} and boot it", package), true};
}

/// True if this process has a capability, by its number in capabilities(7).
bool has_capability(const Path& root, int number) {
  std::ifstream stream(root / "proc/self/status");
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with("CapEff:")) continue;
    return ((std::stoull(line.substr(7), nullptr, 16) >> number) & 1) != 0;
  }
  return false;
}

struct Right {
  const char* limit;       // its name in limits.conf
  const char* capability;  // grants the right whatever the limit
  bool by_capability;
  bool by_limit;
  rlim_t have;
  std::string wanted;
};

Finding judge(const Right& right) {
  const std::string have = right.have == RLIM_INFINITY ? "unlimited" : std::to_string(right.have);
  if (right.by_limit) return {true, fmt::format("{}: {}", right.limit, have), "", true};
  if (right.by_capability) return {true, fmt::format("{}: by {}", right.limit, right.capability), "", true};
  if (::geteuid() == 0) {
    return {false, fmt::format("{}: {}, and root without {}", right.limit, have, right.capability),
            fmt::format("give {} back, a container's with --cap-add", right.capability), true};
  }
  return {
      false, fmt::format("{}: {}", right.limit, have),
      fmt::format("put '@realtime - {} {}' into /etc/security/limits.d/godobject.conf, groupadd -f realtime, usermod "
                  "-aG realtime USER, and log in again",
                  right.limit, right.wanted),
      true};
}

std::vector<Finding> rights(int priority, const Path& root) {
  constexpr int kIpcLock = 14;
  constexpr int kSysNice = 23;
  rlimit rtprio{};
  rlimit memlock{};
  ::getrlimit(RLIMIT_RTPRIO, &rtprio);
  ::getrlimit(RLIMIT_MEMLOCK, &memlock);
  const bool enough = rtprio.rlim_cur >= static_cast<rlim_t>(priority);
  return {judge({"rtprio", "CAP_SYS_NICE", has_capability(root, kSysNice), enough, rtprio.rlim_cur,
                 std::to_string(priority)}),
          judge({"memlock", "CAP_IPC_LOCK", has_capability(root, kIpcLock), memlock.rlim_cur == RLIM_INFINITY,
                 memlock.rlim_cur, "unlimited"})};
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
  return {false, "clock source: " + name + ", which is slow to read",
          "boot with tsc=reliable if the processor's counter is"};
}

Finding throttling(const Path& root) {
  const Path file = root / "proc/sys/kernel/sched_rt_runtime_us";
  const std::optional<std::string> runtime = first_line(file);
  const std::string period = first_line(root / "proc/sys/kernel/sched_rt_period_us").value_or("1000000");
  if (!runtime) return {false, fmt::format("real-time throttling: {} cannot be read", file.string()), "mount /proc"};
  if (*runtime == "-1") return {true, "real-time throttling: off", ""};
  if (*runtime == "0") {
    return {false, "real-time throttling: real-time threads get no time",
            fmt::format("echo 950000 > {}", file.string()), true};
  }
  return {
      true,
      fmt::format("real-time throttling: {} of {} us for all real-time threads, the loop needs less", *runtime, period),
      ""};
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
  for (Finding& finding : rights(priority, root)) findings.push_back(std::move(finding));
  findings.push_back(isolation(cpu, root));
  findings.push_back(governor(cpu, root));
  findings.push_back(clock_source(root));
  findings.push_back(throttling(root));
  findings.push_back(can(root));
  return findings;
}

}  // namespace godobject::firmware
