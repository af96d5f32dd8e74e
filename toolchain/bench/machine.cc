#include "toolchain/bench/machine.h"

#include <cstdlib>
#include <fstream>
#include <thread>

#include <fmt/format.h>
#include <sys/utsname.h>
#include <unistd.h>

#include "toolchain/bench/cycle_times.h"
#include "toolchain/command_line/source_commit.h"

namespace godobject::bench {
namespace {

/// Returns the text after the colon in the first line of /proc/cpuinfo that begins with `key`, or "unknown".
std::string cpu_fact(const std::string& key) {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const auto colon = line.find(':');
    if (line.starts_with(key) && colon != std::string::npos && colon + 2 <= line.size()) return line.substr(colon + 2);
  }
  return "unknown";
}

std::string cache_sizes() {
  const auto size = [](int name) {
    const long bytes = ::sysconf(name);
    return bytes > 0 ? fmt::format("{} KiB", bytes / 1024) : std::string("unknown");
  };
  return fmt::format("L1d {}, L2 {}, L3 {}", size(_SC_LEVEL1_DCACHE_SIZE), size(_SC_LEVEL2_CACHE_SIZE),
                     size(_SC_LEVEL3_CACHE_SIZE));
}

std::string load() {
  double averages[3] = {};
  if (::getloadavg(averages, 3) != 3) return "unknown";
  return fmt::format("{:.2f} {:.2f} {:.2f} over 1, 5, 15 min", averages[0], averages[1], averages[2]);
}

}  // namespace

std::vector<std::pair<std::string, std::string>> machine_facts() {
  utsname system{};
  ::uname(&system);
  const Distribution clock = clock_cost();
  return {
      {"processor", fmt::format("{}, family {} model {}, {} cores", cpu_fact("model name"), cpu_fact("cpu family"),
                                cpu_fact("model\t"), std::thread::hardware_concurrency())},
      {"caches", cache_sizes()},
      {"system", fmt::format("{} {}, {}", system.sysname, system.release, system.machine)},
      {"compiler", __VERSION__},
      {"commit", command::kSourceCommit},
      {"load", load()},
      {"clock", fmt::format("two readings in a row: {:.0f} ns (p50), {:.0f} ns (p99), in every time of a cycle",
                            clock.p50, clock.p99)},
  };
}

}  // namespace godobject::bench
