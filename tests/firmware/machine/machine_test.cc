// Tests the examination of a machine for real-time work, and the real-time setup of the loop.
#include <gtest/gtest.h>
#include <sched.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/device/kinematics.h"
#include "firmware/cycle/control_cycle.h"
#include "firmware/machine/doctor.h"
#include "firmware/machine/rt_setup.h"
#include "firmware/machine/signals.h"
#include "hal/linux/monotonic_clock.h"
#include "tests/firmware/cycle/fake_drives.h"
#include "tests/support/arms.h"
#include "tests/support/folder_test.h"
#include "tests/support/ordinary_user.h"
#include "tests/support/small_scenes.h"
#include "toolchain/files/aligned_bytes.h"

namespace {

constexpr double kUnknown = -1.0;
double load_of_last_minute = kUnknown;
bool limits_are_off = false;

}  // namespace

// The linker takes these before those of the C library.

extern "C" int getloadavg(double* loads, int count) noexcept {
  std::fill_n(loads, count, 7.5);  // of no meaning
  if (load_of_last_minute == kUnknown) return -1;
  loads[0] = load_of_last_minute;
  return count;
}

extern "C" int getrlimit(__rlimit_resource_t resource, rlimit* limits) noexcept {
  const auto result = static_cast<int>(::syscall(SYS_prlimit64, 0, resource, nullptr, limits));
  if (limits_are_off) limits->rlim_cur = RLIM_INFINITY;
  return result;
}

namespace godobject::firmware::machine_test {
namespace {

namespace fs = std::filesystem;

/// A root folder with what a test puts below /proc and /sys.
class DoctorTest : public test::FolderTest {
 protected:
  void put(const std::string& file, const std::string& text) const {
    fs::create_directories((folder_ / file).parent_path());
    std::ofstream(folder_ / file) << text << '\n';
  }

  Finding find(const std::string& begin, int cpu = 3) const {
    for (const Finding& finding : examine_machine(cpu, 80, folder_)) {
      if (finding.what.starts_with(begin)) return finding;
    }
    ADD_FAILURE() << begin;
    return {};
  }
};

TEST_F(DoctorTest, NamesACureForAllThatABareMachineLacks) {
  for (const char* what : {"kernel", "isolated", "CAN", "clock source"}) {
    const Finding finding = find(what);
    EXPECT_FALSE(finding.good) << what;
    EXPECT_FALSE(finding.cure.empty()) << what;
  }
}

TEST_F(DoctorTest, FindsAMachineGoodThatHasAll) {
  put("sys/kernel/realtime", "1");
  put("sys/devices/system/cpu/isolated", "1,3-5");
  put("sys/devices/system/cpu/cpu3/cpufreq/scaling_governor", "performance");
  put("sys/devices/system/clocksource/clocksource0/current_clocksource", "tsc");
  put("proc/net/can/stats", "");
  for (const char* what : {"kernel", "isolated", "clock rate", "clock source", "CAN"}) {
    EXPECT_TRUE(find(what).good) << what;
  }
  EXPECT_FALSE(find("isolated", 2).good);
  EXPECT_FALSE(find("isolated", -1).good);
  EXPECT_TRUE(find("isolated", 1).good);
  put("sys/devices/system/cpu/cpu3/cpufreq/scaling_governor", "powersave");
  EXPECT_FALSE(find("clock rate").good);
}

TEST_F(DoctorTest, TellsWhichKernelItFound) {
  put("proc/version", "Linux version 6.1.0 (gcc) #1 SMP PREEMPT_DYNAMIC Debian");
  EXPECT_EQ(find("kernel").what, "kernel: PREEMPT_DYNAMIC, not PREEMPT_RT");
  EXPECT_TRUE(find("kernel").needed);
  put("proc/version", "Linux version 6.1.0 (gcc) #1 SMP PREEMPT_RT Debian");
  EXPECT_TRUE(find("kernel").good);
}

TEST_F(DoctorTest, ReadsHowRealTimeThreadsAreThrottled) {
  EXPECT_FALSE(find("real-time throttling").good) << "not read is not off";
  put("proc/sys/kernel/sched_rt_runtime_us", "-1");
  EXPECT_EQ(find("real-time throttling").what, "real-time throttling: off");
  put("proc/sys/kernel/sched_rt_runtime_us", "700000");
  EXPECT_NE(find("real-time throttling").what.find("700000 of 1000000 us"), std::string::npos);
  put("proc/sys/kernel/sched_rt_runtime_us", "0");
  EXPECT_FALSE(find("real-time throttling").good);
  EXPECT_TRUE(find("real-time throttling").needed);
}

TEST_F(DoctorTest, TakesCapabilitiesForRightsAndNotTheNameOfRoot) {
  rlimit locked{};
  ASSERT_EQ(::getrlimit(RLIMIT_MEMLOCK, &locked), 0);
  rlimit small = locked;
  small.rlim_cur = std::min<rlim_t>(locked.rlim_cur, 65536);
  ASSERT_EQ(::setrlimit(RLIMIT_MEMLOCK, &small), 0);
  put("proc/self/status", "Name:\tx\nCapEff:\t0000000000000000");
  EXPECT_FALSE(find("memlock").good);
  EXPECT_TRUE(find("memlock").needed);
  EXPECT_FALSE(find("memlock").cure.empty());
  put("proc/self/status", "Name:\tx\nCapEff:\t0000000000004000");
  EXPECT_EQ(find("memlock").what, "memlock: by CAP_IPC_LOCK");
  EXPECT_TRUE(find("memlock").good);
  ASSERT_EQ(::setrlimit(RLIMIT_MEMLOCK, &locked), 0);
}

/// One finding, as one line.
std::string line_of(const Finding& finding) {
  return std::string(finding.good ? "ok " : "LACK ") + (finding.needed ? "needed " : "") + finding.what + " -> " +
         finding.cure;
}

TEST_F(DoctorTest, TellsEachStateOfTheKernel) {
  const std::string cure = " -> " + find("kernel").cure;
  EXPECT_TRUE(cure.starts_with(" -> apt-get install linux-image-rt-") && cure.ends_with(" and boot it")) << cure;
  for (const auto& [version, state] : std::initializer_list<std::pair<const char*, std::string>>{
           {"Linux #1 SMP PREEMPT_DYNAMIC Debian", "LACK needed kernel: PREEMPT_DYNAMIC, not PREEMPT_RT" + cure},
           {"Linux #1 SMP PREEMPT Debian", "LACK needed kernel: PREEMPT, not PREEMPT_RT" + cure},
           {"Linux #1 SMP Debian", "LACK needed kernel: not PREEMPT_RT" + cure},
           {"Linux #1 SMP PREEMPT_RT Debian", "ok needed kernel: PREEMPT_RT -> "}}) {
    put("proc/version", version);
    EXPECT_EQ(line_of(find("kernel")), state);
  }
  put("proc/version", "Linux #1 SMP Debian");
  put("sys/kernel/realtime", "0");
  EXPECT_FALSE(find("kernel").good);
  put("sys/kernel/realtime", "1");
  EXPECT_EQ(line_of(find("kernel")), "ok needed kernel: PREEMPT_RT -> ");
}

TEST_F(DoctorTest, TellsEachStateOfTheProcessors) {
  EXPECT_EQ(line_of(find("isolated")),
            "LACK isolated processors: none -> boot with isolcpus=N nohz_full=N rcu_nocbs=N and set loop.cpu = N, N "
            "not 0");
  put("sys/devices/system/cpu/isolated", "");
  EXPECT_EQ(find("isolated").what, "isolated processors: none");
  put("sys/devices/system/cpu/isolated", "1,4-6,9");
  EXPECT_EQ(line_of(find("isolated", -1)),
            "LACK isolated processors: 1,4-6,9, but the loop is bound to none -> set loop.cpu to one of them");
  for (int cpu = 0; cpu <= 11; ++cpu) {
    const bool among = cpu == 1 || (cpu >= 4 && cpu <= 6) || cpu == 9;
    EXPECT_EQ(line_of(find("isolated", cpu)),
              among ? "ok isolated processors: 1,4-6,9, the loop has " + std::to_string(cpu) + " -> "
                    : "LACK isolated processors: 1,4-6,9, the loop's " + std::to_string(cpu) +
                          " is not among them -> set loop.cpu to one of them");
  }
  put("sys/devices/system/cpu/isolated", "0-2");
  for (int cpu = 0; cpu <= 3; ++cpu) EXPECT_EQ(find("isolated", cpu).good, cpu <= 2) << cpu;
  put("sys/devices/system/cpu/isolated", "x,3");
  EXPECT_TRUE(find("isolated", 3).good);
  EXPECT_FALSE(find("isolated", 0).good);
}

TEST_F(DoctorTest, TellsEachStateOfTheClocks) {
  EXPECT_EQ(line_of(find("clock rate")), "ok clock rate: not scaled here -> ");
  const std::string governor = "sys/devices/system/cpu/cpu0/cpufreq/scaling_governor";
  put(governor, "powersave");
  EXPECT_EQ(line_of(find("clock rate", 3)), "ok clock rate: not scaled here -> ") << "processor 3 is the loop's";
  for (const int cpu : {-1, 0}) {
    EXPECT_EQ(line_of(find("clock rate", cpu)),
              "LACK clock rate: governor powersave -> echo performance > " + (folder_ / governor).string());
  }
  put(governor, "performance");
  EXPECT_EQ(line_of(find("clock rate", 0)), "ok clock rate: governor performance -> ");

  const std::string cure = ", which is slow to read -> boot with tsc=reliable if the processor's counter is";
  EXPECT_EQ(line_of(find("clock source")), "LACK clock source: unknown" + cure);
  for (const char* source : {"tsc", "arch_sys_counter", "kvm-clock"}) {
    put("sys/devices/system/clocksource/clocksource0/current_clocksource", source);
    EXPECT_EQ(line_of(find("clock source")), std::string("ok clock source: ") + source + " -> ");
  }
  put("sys/devices/system/clocksource/clocksource0/current_clocksource", "hpet");
  EXPECT_EQ(line_of(find("clock source")), "LACK clock source: hpet" + cure);
}

TEST_F(DoctorTest, TellsEachStateOfThrottlingAndCan) {
  const std::string file = (folder_ / "proc/sys/kernel/sched_rt_runtime_us").string();
  EXPECT_EQ(line_of(find("real-time throttling")),
            "LACK real-time throttling: " + file + " cannot be read -> mount /proc");
  put("proc/sys/kernel/sched_rt_runtime_us", "-1");
  EXPECT_EQ(line_of(find("real-time throttling")), "ok real-time throttling: off -> ");
  put("proc/sys/kernel/sched_rt_runtime_us", "0");
  EXPECT_EQ(line_of(find("real-time throttling")),
            "LACK needed real-time throttling: real-time threads get no time -> echo 950000 > " + file);
  put("proc/sys/kernel/sched_rt_runtime_us", "900000");
  put("proc/sys/kernel/sched_rt_period_us", "2000000");
  EXPECT_EQ(line_of(find("real-time throttling")),
            "ok real-time throttling: 900000 of 2000000 us for all real-time threads, the loop needs less -> ");
  EXPECT_EQ(line_of(find("CAN")),
            "LACK CAN: not in the kernel, or its module is not loaded -> modprobe can can_raw; for a simulated bus "
            "vcan");
  put("proc/net/can/stats", "");
  EXPECT_EQ(line_of(find("CAN")), "ok CAN: in the kernel -> ");
}

/// A limit of this process, lowered for a test.
class LoweredLimit {
 public:
  LoweredLimit(decltype(RLIMIT_RTPRIO) which, rlim_t value) : which_(which) {
    EXPECT_EQ(::getrlimit(which_, &before_), 0);
    rlimit lowered = before_;
    lowered.rlim_cur = std::min(before_.rlim_cur, value);
    EXPECT_EQ(::setrlimit(which_, &lowered), 0);
  }
  ~LoweredLimit() { EXPECT_EQ(::setrlimit(which_, &before_), 0); }

 private:
  decltype(RLIMIT_RTPRIO) which_;
  rlimit before_{};
};

TEST_F(DoctorTest, TellsEachStateOfTheRights) {
  const LoweredLimit rtprio(RLIMIT_RTPRIO, 0);
  const LoweredLimit memlock(RLIMIT_MEMLOCK, 65536);
  const auto right = [&](const std::string& begin, int priority) {
    for (const Finding& finding : examine_machine(3, priority, folder_)) {
      if (finding.what.starts_with(begin)) return finding;
    }
    return Finding{};
  };
  const auto limits = [](const std::string& what) {
    return "put '@realtime - " + what +
           "' into /etc/security/limits.d/godobject.conf, groupadd -f realtime, usermod -aG realtime USER, and log in "
           "again";
  };
  /// Calls `expect(root)` with this status of the process, as this user and as an ordinary one.
  const auto with = [&](const std::string& status, auto&& expect) {
    put("proc/self/status", status);
    expect(::geteuid() == 0);
    const test::AsOrdinaryUser user;
    ASSERT_TRUE(std::ifstream(folder_ / "proc/self/status").good()) << "an ordinary user may not enter " << folder_;
    expect(::geteuid() == 0);
  };
  with("Name:\tx\nCapEff:\t0000000000000000", [&](bool root) {
    EXPECT_EQ(line_of(right("rtprio", 0)), "ok needed rtprio: 0 -> ");
    EXPECT_EQ(line_of(right("rtprio", 1)),
              root ? "LACK needed rtprio: 0, and root without CAP_SYS_NICE -> give CAP_SYS_NICE back, a container's "
                     "with --cap-add"
                   : "LACK needed rtprio: 0 -> " + limits("rtprio 1"));
    EXPECT_EQ(line_of(right("memlock", 1)),
              root ? "LACK needed memlock: 65536, and root without CAP_IPC_LOCK -> give CAP_IPC_LOCK back, a "
                     "container's with --cap-add"
                   : "LACK needed memlock: 65536 -> " + limits("memlock unlimited"));
  });
  for (int bit = 0; bit < 40; ++bit) {
    const std::string bits = fmt::format("CapPrm:\tffffffffffffffff\nCapEff:\t{:016x}", std::uint64_t{1} << bit);
    with(bits, [&](bool) {
      EXPECT_EQ(right("rtprio", 1).good, bit == 23) << bit;
      EXPECT_EQ(right("memlock", 1).good, bit == 14) << bit;
    });
  }
  with("CapEff:\t0000000000804000", [&](bool) {
    EXPECT_EQ(line_of(right("rtprio", 1)), "ok needed rtprio: by CAP_SYS_NICE -> ");
    EXPECT_EQ(line_of(right("memlock", 1)), "ok needed memlock: by CAP_IPC_LOCK -> ");
  });
}

/// A limit that is off is no number; it grants the right without a capability.
TEST_F(DoctorTest, CallsALimitThatIsOffUnlimited) {
  put("proc/self/status", "CapEff:\t0000000000000000");
  limits_are_off = true;
  const std::string rtprio = line_of(find("rtprio"));
  const std::string memlock = line_of(find("memlock"));
  limits_are_off = false;
  EXPECT_EQ(rtprio, "ok needed rtprio: unlimited -> ");
  EXPECT_EQ(memlock, "ok needed memlock: unlimited -> ");
}

/// A check that sets nothing has found nothing good, and nothing that a run needs.
TEST(Finding, IsNeitherGoodNorNeededByItself) {
  EXPECT_FALSE(Finding().good);
  EXPECT_FALSE(Finding().needed);
}

TEST(Signals, SetTheRequestsThatTheyStandFor) {
  RunRequests& requests = signal_requests();
  EXPECT_FALSE(requests.end || requests.reset);
  catch_end_signals();
  catch_reset_signal();
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) {
    requests.end = false;
    std::raise(signal);
    EXPECT_TRUE(requests.end) << signal;
    EXPECT_FALSE(requests.reset) << signal;
    std::signal(signal, SIG_DFL);
  }
  requests.end = false;
  std::raise(SIGUSR1);
  EXPECT_TRUE(requests.reset);
  EXPECT_FALSE(requests.end);
  requests.reset = false;
  ignore_write_signals();
  for (const int signal : {SIGPIPE, SIGXFSZ}) std::raise(signal);  // would end the process
  for (const int signal : {SIGUSR1, SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_DFL);
}

TEST(MonotonicClock, NeverWakesBeforeItsTimeAndTellsAtOnceWhatHasPassed) {
  hal::MonotonicClock clock;
  for (int i = 0; i < 20; ++i) {
    const std::int64_t until = clock.now_ns() + 100'000;
    clock.sleep_until(until);
    EXPECT_GE(clock.now_ns(), until);
    clock.sleep_until(until - 1'000'000'000);
  }
}

/// The system tells the kernel in /proc, too.
TEST(DescribeMachine, NamesKernelProcessorsAndLoadAsTheSystemTellsThem) {
  std::string release;
  std::ifstream("/proc/sys/kernel/osrelease") >> release;
  for (const auto& [load, told] : {std::pair{2.376, "2.38"}, {0.0, "0.00"}, {kUnknown, "0.00"}}) {
    load_of_last_minute = load;
    const std::string line = describe_machine();
    load_of_last_minute = kUnknown;
    EXPECT_NE(line.find("Linux " + release + " "), std::string::npos) << line;
    EXPECT_TRUE(line.ends_with(fmt::format(", {} processors, load {}", ::sysconf(_SC_NPROCESSORS_ONLN), told))) << line;
  }
}

/// The defaults that firmware/README.md names.
TEST(RealTimeSettings, AreAnyProcessorAndAHighPriority) {
  EXPECT_EQ(RealTimeSettings{}.cpu, -1);
  EXPECT_EQ(RealTimeSettings{}.priority, 80);
}

/// The thread gets the processor that it names, 0 too, and no other; without one it keeps those that it has.
TEST(RealTimeSetup, BindsTheThreadToItsProcessor) {
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  ASSERT_EQ(::sched_getaffinity(0, sizeof allowed, &allowed), 0);
  for (int cpu = -1, tried = 0; cpu < CPU_SETSIZE && tried < 4; ++cpu) {
    if (cpu >= 0 && !CPU_ISSET(static_cast<std::size_t>(cpu), &allowed)) continue;
    ++tried;
    cpu_set_t expected = allowed;
    if (cpu >= 0) {
      CPU_ZERO(&expected);
      CPU_SET(static_cast<std::size_t>(cpu), &expected);
    }
    cpu_set_t bound;
    CPU_ZERO(&bound);
    std::vector<std::string> missing;
    std::thread([&] {
      missing = set_up_real_time({.cpu = cpu, .priority = 1});
      ::sched_getaffinity(0, sizeof bound, &bound);
      ::munlockall();  // or the next thread's whole stack would be locked
    }).join();
    EXPECT_TRUE(CPU_EQUAL(&bound, &expected)) << cpu;
    for (const std::string& line : missing) EXPECT_EQ(line.find("not bound"), std::string::npos) << line;
  }
}

/// Each line tells of a call that fails for this thread, too, and the other way round.
TEST(RealTimeSetup, SaysWhatThisThreadMayNotDoAndNothingElse) {
  const auto has = [](const std::vector<std::string>& lines, const char* begin) {
    return std::any_of(lines.begin(), lines.end(), [&](const std::string& line) { return line.starts_with(begin); });
  };
  const int none = CPU_SETSIZE - 1;  // a processor that no machine has
  ASSERT_LT(::sysconf(_SC_NPROCESSORS_CONF), none);
  for (const bool limited : {false, true}) {
    rlimit before{};
    ASSERT_EQ(::getrlimit(RLIMIT_MEMLOCK, &before), 0);
    rlimit little = before;
    little.rlim_cur = 0;
    std::thread([&] {
      if (limited) {
        ASSERT_EQ(::setrlimit(RLIMIT_MEMLOCK, &little), 0);
      }
      const std::vector<std::string> missing = set_up_real_time({.cpu = none, .priority = 1});
      ::munlockall();
      const bool may_lock = ::mlockall(MCL_CURRENT | MCL_FUTURE) == 0;
      ::munlockall();
      const sched_param priority{1};
      const bool may_have_priority = ::sched_setscheduler(0, SCHED_FIFO, &priority) == 0;
      EXPECT_EQ(has(missing, "memory is not locked ("), !may_lock);
      EXPECT_EQ(has(missing, "no real-time priority 1 ("), !may_have_priority);
      EXPECT_TRUE(has(missing, "not bound to processor 1023 (Invalid argument); choose another loop.cpu"));
      EXPECT_EQ(missing.size(), 1u + (may_lock ? 0u : 1u) + (may_have_priority ? 0u : 1u));
    }).join();
    ASSERT_EQ(::setrlimit(RLIMIT_MEMLOCK, &before), 0);
  }
}

TEST(RealTimeSetup, SaysWhatItMayNotDoAndTheLoopNeedsNoPageAfterIt) {
  const test::Arm arm = test::lwr();
  const test::SceneImage image = test::ball_over_plate();
  const SceneView scene = test::open_scene(image);
  FakeDrives drives(7);
  drives.reading.position << 0.0, -0.5, 0.0, 1.4, 0.0, -1.2, 0.0;
  CycleSetup setup;
  setup.scene = &scene;
  setup.arm = &arm.model;
  setup.joint_torque = &arm.parameters;
  setup.supervisor.sign_test = false;
  setup.mapping.H_WR.translation =
      Vector3(0.0, 0.0, 0.031) - forward_kinematics(arm.model, drives.reading.position).H_RM.translation;
  files::AlignedBytes memory(GodObject::least_memory_size());
  setup.memory = memory.span();
  auto cycle = std::make_unique<ControlCycle>(setup, drives);
  ASSERT_EQ(cycle->start(), Status::kOk);

  const JointVector rest = drives.reading.position;
  long faults = -1;
  std::vector<std::string> missing;
  std::uint64_t in_contact = 0;
  // in a thread of its own: what it becomes must not stay
  std::thread([&] {
    missing = set_up_real_time({.cpu = -1, .priority = 1});
    const auto move_and_run = [&](int cycles) {
      for (int i = 0; i < cycles; ++i) {
        drives.reading.position = rest;
        drives.reading.position.array() += 0.01 * std::sin(2.0 * M_PI * i / 1000.0);
        cycle->run_once({});
        in_contact += cycle->record().outcome == Outcome::kContact ? 1u : 0u;
      }
    };
    for (int i = 0; i < 300; ++i) cycle->run_once({});  // at rest, until it is armed
    move_and_run(2000);
    const long before = page_faults();
    move_and_run(20'000);
    faults = page_faults() - before;
  }).join();
  EXPECT_GT(in_contact, 2000u);
  EXPECT_EQ(faults, 0);
  for (const std::string& line : missing) {
    EXPECT_NE(line.find("limits.d"), std::string::npos) << line;
    EXPECT_EQ(line.find(std::strerror(EINVAL)), std::string::npos) << "no right helps: " << line;
    std::printf("not permitted here: %s\n", line.c_str());
  }
  EXPECT_NE(describe_machine().find("processors"), std::string::npos);
}

}  // namespace
}  // namespace godobject::firmware::machine_test
