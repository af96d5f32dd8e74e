// Tests the examination of a machine for real-time work, and the real-time setup of the loop.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "core/device/kinematics.h"
#include "firmware/cycle/control_cycle.h"
#include "firmware/machine/doctor.h"
#include "firmware/machine/rt_setup.h"
#include "hal/linux/monotonic_clock.h"
#include "tests/firmware/cycle/fake_drives.h"
#include "tests/support/arms.h"
#include "tests/support/folder_test.h"
#include "tests/support/small_scenes.h"
#include "toolchain/files/aligned_bytes.h"

namespace godobject::firmware {
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

TEST(MonotonicClock, NeverWakesBeforeItsTimeAndTellsAtOnceWhatHasPassed) {
  hal::MonotonicClock clock;
  for (int i = 0; i < 20; ++i) {
    const std::int64_t until = clock.now_ns() + 100'000;
    clock.sleep_until(until);
    EXPECT_GE(clock.now_ns(), until);
    clock.sleep_until(until - 1'000'000'000);
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
    std::printf("not permitted here: %s\n", line.c_str());
  }
  EXPECT_NE(describe_machine().find("processors"), std::string::npos);
}

}  // namespace
}  // namespace godobject::firmware
