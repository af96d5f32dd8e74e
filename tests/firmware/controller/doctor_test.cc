// godobject-controller doctor on machines whose /proc and /sys a test writes.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <sys/wait.h>

#include "tests/firmware/controller/controller_folder.h"

namespace godobject::firmware::doctor_test {
namespace {

/// A machine with all that real-time work needs, and nothing else.
class DoctorCommandTest : public ControllerFolderTest {
 protected:
  DoctorCommandTest() {
    put("proc/version", "Linux version 6.1.0 #1 SMP PREEMPT_RT Debian");
    put("proc/self/status", "Name:\tx\nCapEff:\tffffffffffffffff");
    put("proc/sys/kernel/sched_rt_runtime_us", "-1");
  }

  void put(const std::string& file, const std::string& text) const {
    std::filesystem::create_directories((folder_ / "machine" / file).parent_path());
    std::ofstream(folder_ / "machine" / file) << text << '\n';
  }

  /// Exit code; `lines_` gets the lines of stdout, `words_` gets stderr.
  int run(const std::string& arguments) {
    const std::string command = fmt::format(
        "cd {} && GODOBJECT_FAKE_MACHINE=machine LD_PRELOAD={} ASAN_OPTIONS=verify_asan_link_order=0 {} {} "
        "> out.txt 2> words.txt",
        folder_.string(), GODOBJECT_FAKE_MACHINE_LIBRARY, GODOBJECT_CONTROLLER, arguments);
    const int status = std::system(command.c_str());
    lines_.clear();
    std::istringstream out(text("out.txt"));
    for (std::string line; std::getline(out, line);) lines_.push_back(line);
    words_ = text("words.txt");
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  /// The line of the check that begins so, with its verdict.
  std::string line(const std::string& begin) const {
    for (const std::string& each : lines_) {
      if (each.size() > 5 && each.substr(5).starts_with(begin)) return each;
    }
    return {};
  }

  static std::string refusal(const std::string& lacking) {
    return "godobject-controller: no real-time work on this machine (" + lacking + "); see the cures above\n";
  }

  std::vector<std::string> lines_;
  std::string words_;
};

/// Isolated processors, the clock source and CAN may be missing: they are told with their cures and do not fail it.
TEST_F(DoctorCommandTest, IsContentWithAMachineThatHasAllThatIsNeeded) {
  EXPECT_EQ(run("doctor"), 0) << words_;
  EXPECT_EQ(words_, "");
  EXPECT_EQ(line("kernel"), "ok   kernel: PREEMPT_RT");
  EXPECT_EQ(line("real-time throttling"), "ok   real-time throttling: off");
  EXPECT_EQ(line("rtprio").substr(0, 5), "ok   ");
  EXPECT_EQ(line("memlock").substr(0, 5), "ok   ");
  EXPECT_EQ(line("isolated").substr(0, 38), "LACK isolated processors: none -> boot");
  EXPECT_EQ(line("clock source").substr(0, 26), "LACK clock source: unknown");
  EXPECT_EQ(lines_.size(), 8u) << "one line a check";
}

/// Only what is needed stands in the refusal, in the order of the checks.
TEST_F(DoctorCommandTest, RefusesAMachineThatLacksWhatIsNeededAndNamesOnlyThat) {
  put("proc/version", "Linux version 6.1.0 #1 SMP PREEMPT Debian");
  EXPECT_EQ(run("doctor"), 69);
  EXPECT_EQ(words_, refusal("kernel: PREEMPT, not PREEMPT_RT"));
  EXPECT_EQ(line("kernel").substr(0, 52), "LACK kernel: PREEMPT, not PREEMPT_RT -> apt-get inst");
  put("proc/sys/kernel/sched_rt_runtime_us", "0");
  EXPECT_EQ(run("doctor"), 69);
  EXPECT_EQ(words_, refusal("kernel: PREEMPT, not PREEMPT_RT; real-time throttling: real-time threads get no time"));
  put("proc/version", "Linux version 6.1.0 #1 SMP PREEMPT_RT Debian");
  EXPECT_EQ(run("doctor"), 69);
  EXPECT_EQ(words_, refusal("real-time throttling: real-time threads get no time"));
}

/// loop.cpu of a controller file is the processor that is looked at; its plan of the buses follows the checks.
TEST_F(DoctorCommandTest, LooksAtTheProcessorOfTheControllerFileAndShowsItsPlan) {
  put("sys/devices/system/cpu/isolated", "2-3");
  put("sys/devices/system/cpu/cpu0/cpufreq/scaling_governor", "performance");
  put("sys/devices/system/cpu/cpu3/cpufreq/scaling_governor", "powersave");
  EXPECT_EQ(run("doctor"), 0) << words_;
  EXPECT_EQ(line("isolated"),
            "LACK isolated processors: 2-3, but the loop is bound to none -> set loop.cpu to one of them");
  EXPECT_EQ(line("clock rate"), "ok   clock rate: governor performance");
  EXPECT_EQ(text("out.txt").find("bus plan: "), std::string::npos);
  write_controller("[loop]\ncpu = 3\n");
  EXPECT_EQ(run("doctor c.toml"), 0) << words_;
  EXPECT_EQ(line("isolated"), "ok   isolated processors: 2-3, the loop has 3");
  EXPECT_EQ(line("clock rate"),
            "LACK clock rate: governor powersave -> echo performance > "
            "/sys/devices/system/cpu/cpu3/cpufreq/scaling_governor");
  ASSERT_GT(lines_.size(), 9u);
  EXPECT_TRUE(lines_[8].starts_with("bus plan: CAN 1 Mbit/s, cycle 1000 us")) << lines_[8];
  EXPECT_TRUE(lines_.back().starts_with("joint 7: bus 2, node 7")) << lines_.back();
}

}  // namespace
}  // namespace godobject::firmware::doctor_test
