// godobject-controller as its users meet it: the program is run, its exit codes, words and files are looked at.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <sys/wait.h>

#include "tests/firmware/controller/controller_folder.h"
#include "tests/support/fault_record.h"
#include "tests/support/image_parts.h"

namespace godobject::firmware::command_test {
namespace {

class ControllerCommandTest : public ControllerFolderTest {
 protected:
  /// Exit code; `words_` gets stdout and stderr.
  int run(const std::string& arguments, const std::string& before = "") {
    const std::string command =
        fmt::format("cd {} && {} {} {} > log.txt 2>&1", folder_.string(), before, GODOBJECT_CONTROLLER, arguments);
    const int status = std::system(command.c_str());
    words_ = text("log.txt");
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  /// Lets c.toml use the light-weight robot with the `number`-th line that begins with `key` replaced.
  void change_device(const std::string& key, int number, const std::string& line) const {
    const std::string lwr = GODOBJECT_FIRMWARE_DIR "/devices/lwr.toml";
    std::string device = text(lwr);
    std::size_t at = 0;
    for (int k = 0; k < number; ++k) at = device.find("\n" + key, at + 1);
    ASSERT_NE(at, std::string::npos) << key;
    device.replace(at + 1, device.find('\n', at + 1) - at - 1, line);
    std::ofstream(folder_ / "changed.toml") << device;
    std::string file = text("c.toml");
    file.replace(file.find(lwr), lwr.size(), "changed.toml");
    std::ofstream(folder_ / "c.toml") << file;
  }

  /// Lets c.toml use the light-weight robot at a period [s], each joint on a bus of its own, with FD frames alone.
  void change_period(double period) const {
    std::istringstream lwr(text(GODOBJECT_FIRMWARE_DIR "/devices/lwr.toml"));
    std::ofstream device(folder_ / "fast.toml");
    int joint = 0;
    for (std::string line; std::getline(lwr, line);) {
      if (line.starts_with("bus = ")) line = fmt::format("bus = {}", joint++);
      if (line.starts_with("panel_bus = ")) line = "panel_bus = 7";
      if (line == "[bus]") line += fmt::format("\nperiod = {}\nfd = true\nfd_services = true\ndata_rate = 8e6", period);
      device << line << '\n';
    }
    std::string file = text("c.toml");
    const std::string key = "file = \"";
    const std::size_t at = file.find(key) + key.size();
    file.replace(at, file.find('"', at) - at, "fast.toml");
    std::ofstream(folder_ / "c.toml") << file;
  }

  static std::vector<std::string> fields(const std::string& line) {
    std::vector<std::string> all;
    std::istringstream text(line);
    for (std::string field; std::getline(text, field, ',');) all.push_back(field);
    return all;
  }

  bool says(const std::string& what) const { return words_.find(what) != std::string::npos; }

  /// A number in the words: the group of the expression.
  double number(const std::string& expression) const {
    std::smatch match;
    if (std::regex_search(words_, match, std::regex(expression))) return std::stod(match[1]);
    ADD_FAILURE() << expression << " in " << words_;
    return -1.0;
  }

  std::string words_;
};

TEST_F(ControllerCommandTest, RendersAPathAndLogsIt) {
  write_path();
  write_controller("[simulation]\npath = \"path.csv\"\nbegin = 6.0\n");
  ASSERT_EQ(run("c.toml --log logs"), 0) << words_;
  EXPECT_TRUE(says("stable up to")) << words_;
  EXPECT_FALSE(says("in contact in 0:")) << words_;
  EXPECT_TRUE(says(" 0 lost")) << words_;
  std::ifstream log(folder_ / "logs" / "telemetry.csv");
  std::string line;
  ASSERT_TRUE(std::getline(log, line));
  EXPECT_EQ(line.substr(0, 4), "t_s,");
  int rows = 0;
  bool contact = false;
  while (std::getline(log, line)) {
    ++rows;
    contact = contact || line.find(",running,0,1,contact,") != std::string::npos;
  }
  EXPECT_GE(rows, 6000);
  std::ifstream hand(folder_ / "logs" / "hand.csv");
  ASSERT_TRUE(std::getline(hand, line));
  EXPECT_EQ(line, "t_s,hand_J");
  int hand_rows = 0;
  std::string last;
  for (; std::getline(hand, line); ++hand_rows) last = line;
  EXPECT_EQ(hand_rows, rows);
  EXPECT_GT(std::stod(last.substr(last.find(',') + 1)), 0.0) << "it was moved and pressed";
  EXPECT_TRUE(contact);
}

TEST_F(ControllerCommandTest, LogsHowTheWorkspaceIsTurned) {
  write_controller("");
  std::string file = text("c.toml");
  const std::string table = "[workspace]\n";
  file.insert(file.find(table) + table.size(), "turn = [0.8, 0.0, -0.6, 0.0]\n");
  std::ofstream(folder_ / "c.toml") << file;
  ASSERT_EQ(run("c.toml --duration 0.01 --log logs"), 0) << words_;
  const std::string log = text("logs/telemetry.csv");
  EXPECT_NE(log.find(",wqw,wqx,wqy,wqz\n"), std::string::npos);
  EXPECT_TRUE(log.ends_with(",0.8,0,-0.6,0\n")) << log;
}

/// The cycle after the last one takes the power away.
TEST_F(ControllerCommandTest, EndsAfterItsDurationAlsoAlongAPath) {
  write_path();
  write_controller("[simulation]\npath = \"path.csv\"\nbegin = 6.0\n");
  EXPECT_EQ(run("c.toml --duration 0.25"), 0) << words_;
  EXPECT_TRUE(says("rendered in 0 of 251 cycles")) << words_;
}

TEST_F(ControllerCommandTest, WarnsWhereTheSignTestIsLeftOut) {
  write_controller("[start]\nsign_test = false\n");
  EXPECT_EQ(run("c.toml --duration 0.5"), 0) << words_;
  EXPECT_TRUE(says("start.sign_test = false: ")) << words_;
}

TEST_F(ControllerCommandTest, RefusesInOneLineWithTheRightCode) {
  EXPECT_EQ(run("c.toml --bus none0,none1"), 78);
  EXPECT_TRUE(says("--bus names 2 CAN interfaces, the device has 3 buses"));
  EXPECT_EQ(run("c.toml --bus none0,none1,none0"), 78);
  EXPECT_TRUE(says("names an interface twice"));
  EXPECT_EQ(run("c.toml --bus none0,none1,none2"), 69);  // on machines with CAN and without it
  EXPECT_TRUE(says("--bus none0: ")) << words_;
  EXPECT_EQ(run(""), 64);
  EXPECT_EQ(run("c.toml --duration -1"), 64);
  EXPECT_EQ(run("c.toml --log-bus"), 64) << "with no folder to write it to";
  EXPECT_EQ(run("nothing.toml"), 66);
  EXPECT_EQ(run("c.toml --scene nothing.scene"), 66);
  EXPECT_EQ(run("c.toml --scene c.toml"), 65);
  EXPECT_TRUE(says("is not a scene image")) << words_;
  write_controller("[limits]\nforce = nan\n");
  EXPECT_EQ(run("c.toml"), 78);
  EXPECT_TRUE(says("limits.force = nan")) << words_;
  EXPECT_EQ(std::count(words_.begin(), words_.end(), '\n'), 1) << words_;
  write_controller("[limits]\nforce = 10000.0\n");
  EXPECT_EQ(run("c.toml"), 78);
  EXPECT_TRUE(says("limits.force = 10000 N does not protect the hand of a person")) << words_;
  write_path();
  write_controller("[simulation]\npath = \"path.csv\"\n");
  std::ofstream(folder_ / "path.csv") << "t,px,py,pz,qw,qx,qy,qz\n0,0.2,0,0.06,1,0,0,0\n";
  EXPECT_EQ(run("c.toml"), 78);
  EXPECT_TRUE(says("set workspace.start to its first pose")) << words_;
}

/// The panel has the emergency stop. A simulated arm needs none.
TEST_F(ControllerCommandTest, DrivesHardwareOnlyWithAPanel) {
  const std::string lwr = GODOBJECT_FIRMWARE_DIR "/devices/lwr.toml";
  std::string device = text(lwr);
  for (const std::string key : {"panel_bus = 2\n", "panel_node = 32\n"}) {
    ASSERT_NE(device.find(key), std::string::npos) << key;
    device.erase(device.find(key), key.size());
  }
  std::ofstream(folder_ / "without_panel.toml") << device;
  std::string file = text("c.toml");
  file.replace(file.find(lwr), lwr.size(), "without_panel.toml");
  std::ofstream(folder_ / "c.toml") << file;
  for (const char* command : {"", "commission "}) {
    EXPECT_EQ(run(std::string(command) + "c.toml --bus none0,none1,none2"), 78) << words_;
    EXPECT_TRUE(says("lwr: bus.panel_bus is missing; without a panel there is no emergency stop")) << words_;
    EXPECT_FALSE(says("none0")) << "it looks for no interface: " << words_;
  }
  EXPECT_EQ(run("c.toml --duration 0.01"), 0) << words_;
}

/// Runs the command of the unit with interfaces that no machine has: it must look for them and simulate nothing.
TEST_F(ControllerCommandTest, UnitOfSystemdDrivesBuses) {
  std::ifstream unit(GODOBJECT_FIRMWARE_DIR "/systemd/godobject-controller.service");
  std::string arguments;
  for (std::string line; std::getline(unit, line);) {
    const std::string start = "ExecStart=/usr/local/bin/godobject-controller ";
    if (line.rfind(start, 0) == 0) arguments = line.substr(start.size());
  }
  const auto replace = [&](const std::string& what, const std::string& with) {
    ASSERT_NE(arguments.find(what), std::string::npos) << what << " in " << arguments;
    arguments.replace(arguments.find(what), what.size(), with);
  };
  replace("/etc/godobject/controller.toml", "c.toml");
  replace("can0,can1,can2", "none0,none1,none2");
  EXPECT_EQ(run(arguments + " --duration 0.1"), 69) << words_;
  EXPECT_TRUE(says("--bus none0: ")) << words_;
}

TEST_F(ControllerCommandTest, NamesTheFolderOfALogThatCannotBeMade) {
  EXPECT_EQ(run("c.toml --duration 0.1 --log c.toml/logs"), 74);
  EXPECT_TRUE(says("c.toml/logs: cannot make this folder (Not a directory)")) << words_;
}

TEST_F(ControllerCommandTest, SaysThatStopsOfARealArmAreNotRecordedWithoutAHome) {
  const std::string no_home = "env -u HOME -u XDG_STATE_HOME -u STATE_DIRECTORY";
  const std::string line = "a stop will not be recorded: this user has no HOME; name a folder by --incidents";
  EXPECT_EQ(run("c.toml --bus none0,none1,none2", no_home), 69);
  EXPECT_TRUE(says(line)) << words_;
  for (const char* arguments : {"c.toml --bus none0,none1,none2 --log logs",
                                "c.toml --bus none0,none1,none2 --incidents i", "c.toml --duration 0.01"}) {
    run(arguments, no_home);
    EXPECT_FALSE(says(line)) << arguments;
  }
}

TEST_F(ControllerCommandTest, SaysWhereItsTimeWentAndThatNothingRendersFromInside) {
  write_controller("[start]\nsign_test = false\n");
  std::string file = text("c.toml");
  file.replace(file.find("0.06, 1.0"), 4, "0.00");
  std::ofstream(folder_ / "c.toml") << file;
  EXPECT_EQ(run("c.toml --duration 6"), 0) << words_;
  EXPECT_TRUE(says("waits with the arm held: ")) << words_;
  EXPECT_TRUE(says("rendered in 0 of ")) << words_;
  EXPECT_TRUE(says("modes: boot ") && says(", armed ") && !says("running")) << words_;
  EXPECT_LT(words_.find("waits with the arm held: "), words_.find("rendered in 0 of ")) << "in the order it happened";
}

TEST_F(ControllerCommandTest, RefusesGainsBeyondTheBoundary) {
  write_controller("", "damping = 20.0\n");
  EXPECT_EQ(run("c.toml"), 78);
  EXPECT_TRUE(says("no stiffness is stable")) << words_;
  write_controller("", "damping = 5.0\nrotational = 0.003\nstiffness = 20000.0\n");
  const int code = run("c.toml");
  EXPECT_EQ(code, 78);
  EXPECT_TRUE(says("stability boundary")) << words_;
  test::record_start(code, words_);
}

/// At 4 kHz, over CAN FD, a wall stands that the same arm at 1 kHz must not render: the gain check refuses it there.
/// The hand presses 10 mm into it, and the force is the spring's.
TEST_F(ControllerCommandTest, RendersAStifferWallAt4kHz) {
  write_path();
  write_controller("[simulation]\npath = \"path.csv\"\nbegin = 6.0\n[loop]\nvelocity_window = 2\n",
                   "damping = 5.0\nrotational = 0.003\nstiffness = 12000.0\nmargin = 1.0\n");
  EXPECT_EQ(run("c.toml"), 78) << words_;
  EXPECT_TRUE(says("stability boundary")) << words_;
  change_period(0.25e-3);
  ASSERT_EQ(run("c.toml --log logs --duration 9.5"), 0) << words_;
  EXPECT_GT(number("stable up to ([0-9.]+) times that at a delay of 0.2"), 1.5);
  EXPECT_TRUE(says(" 0 lost")) << words_;
  EXPECT_TRUE(says("positions lost in 0 cycles, jumps in 0, sends failed 0")) << words_;
  EXPECT_FALSE(says("in contact in 0:")) << words_;
  std::ifstream log(folder_ / "logs" / "telemetry.csv");
  std::string line;
  std::getline(log, line);
  const std::vector<std::string> names = fields(line);
  const auto force = static_cast<std::size_t>(std::ranges::find(names, "fz_N") - names.begin());
  ASSERT_LT(force, names.size()) << line;
  std::vector<double> t, f;
  while (std::getline(log, line)) {
    const std::vector<std::string> row = fields(line);
    t.push_back(std::stod(row.at(0)));
    f.push_back(std::stod(row.at(force)));
    if (t.size() > 1) {
      ASSERT_NEAR(t.back() - t[t.size() - 2], 0.25e-3, 1e-9) << line;
    }
  }
  ASSERT_GE(t.size(), 4u * 9500);
  // the hand bounces, since it holds the tool loosely, and comes to rest
  const auto swing = [&](double begin) {
    const auto first = f.begin() + std::lround((begin - t.front()) / 0.25e-3);
    const auto [low, high] = std::minmax_element(first, first + 4 * 200);
    EXPECT_GT(*low, 0.0) << "in contact at " << begin;
    return *high - *low;
  };
  EXPECT_LT(swing(9.2), 0.5);
  EXPECT_LT(swing(9.2), 0.5 * swing(8.0));
}

TEST_F(ControllerCommandTest, RefusesInjectedDampingBeyondTheBoundary) {
  write_controller("[passivity]\ndamping = 0.0\n");
  EXPECT_EQ(run("c.toml --duration 0.01"), 0) << words_;
  write_controller("[passivity]\ndamping = 10000.0\n");
  EXPECT_EQ(run("c.toml --duration 0.01"), 78) << words_;
  EXPECT_TRUE(says("passivity.damping = 10000 Ns/m")) << words_;
}

TEST_F(ControllerCommandTest, WritesNothingWithoutAFolderForLogs) {
  write_controller("[start]\nsign_test = false\n");
  EXPECT_EQ(run("c.toml --duration 0.1"), 0) << words_;
  std::set<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_)) {
    files.insert(entry.path().filename());
  }
  EXPECT_EQ(files, (std::set<std::string>{"c.toml", "log.txt", "plate.scene"}));
}

TEST_F(ControllerCommandTest, WritesItsLogsWhereItsFileSaysUnlessTheCommandNamesAFolder) {
  write_controller("[start]\nsign_test = false\n[telemetry]\nfolder = \"usual\"\n");
  EXPECT_EQ(run("c.toml --duration 0.01"), 0) << words_;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "usual" / "telemetry.csv")) << words_;
  std::filesystem::remove_all(folder_ / "usual");
  EXPECT_EQ(run("c.toml --duration 0.01 --log other"), 0) << words_;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "other" / "telemetry.csv")) << words_;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "usual")) << words_;
}

TEST_F(ControllerCommandTest, KeepsToTheClockOnRequest) {
  write_controller("[loop]\nreal_time = true\npriority = 1\n");
  const auto begin = std::chrono::steady_clock::now();
  const int code = run("c.toml --duration 0.3");
  EXPECT_GE(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(290)) << "on no machine it is earlier";
  EXPECT_TRUE(code == 0 || (code == 69 && says("stopped: "))) << code << words_;  // a busy machine may be too late
  EXPECT_TRUE(says("waking late: p50")) << words_;
  EXPECT_TRUE(says("\nround trip: p50 ") && !says(" of 0 cycles")) << "each figure has cycles: " << words_;
  EXPECT_LE(number("\nround trip: .* of ([0-9]+) cycles"), number("\ncomputing: .* of ([0-9]+) cycles") - 4.0)
      << "a cycle without samples has no round trip: the probe after the start has four of them";
}

TEST_F(ControllerCommandTest, CommissionsTheSimulatedDrives) {
  EXPECT_EQ(run("commission c.toml"), 0) << words_;
  EXPECT_EQ(std::count(words_.begin(), words_.end(), '\n'), 8 + 2 + 7) << words_;
  EXPECT_TRUE(says("\n\nThe drives tell these identities. Paste each line ")) << words_;
  EXPECT_TRUE(says("serial = 7 }  # joint 7: bus 2, node 7\n")) << words_;
  std::size_t seen = 0;
  for (std::size_t at = words_.find("emergency 8250"); at != std::string::npos;
       at = words_.find("emergency 8250", at + 1)) {
    ++seen;
  }
  EXPECT_EQ(seen, 7u) << words_;
  EXPECT_EQ(run("commission nothing.toml"), 66);
  EXPECT_EQ(run("commission"), 64);
  EXPECT_EQ(run("commission --help"), 0);
  EXPECT_TRUE(says("Exit codes: 0 ")) << words_;
}

/// Not even a path that cannot be read matters.
TEST_F(ControllerCommandTest, CommissionsUnderAHandThatHoldsStillWhateverItsPath) {
  ASSERT_EQ(run("commission c.toml"), 0) << words_;
  const std::string still = words_;
  write_path();
  for (const char* path : {"path.csv", "nothing.csv"}) {
    write_controller(fmt::format("[simulation]\npath = \"{}\"\nbegin = 0.0\n", path));
    EXPECT_EQ(run("commission c.toml"), 0) << words_;
    EXPECT_EQ(words_, still) << path;
  }
}

TEST_F(ControllerCommandTest, CountsCyclesThatComputeForLongerThanThePlanSays) {
  write_controller("[loop]\ncompute = 1e-6\n");
  EXPECT_EQ(run("c.toml --duration 0.5"), 0) << words_;
  EXPECT_TRUE(says("longer than loop.compute in ")) << words_;
  EXPECT_FALSE(says("longer than loop.compute in 0\n")) << words_;
}

/// The summary of a run has the median of the computing times, too. Where it is above loop.compute, at least half of
/// the cycles are counted, and at most half where it is below. Seven tenths of the last run's median tell a factor of
/// two.
TEST_F(ControllerCommandTest, CountsHalfOfTheCyclesWhereTheirMedianIsLoopCompute) {
  double compute = 1e-6;
  bool tells = false;
  for (int round = 0; round < 6; ++round) {
    write_controller(fmt::format("[loop]\ncompute = {}\n", compute));
    ASSERT_EQ(run("c.toml --duration 0.5"), 0) << words_;
    const double median = 1e-6 * number("\ncomputing: p50 ([0-9.]+) us");
    const double half = 0.5 * number("\ncomputing: .* of ([0-9]+) cycles");
    const double counted = number("longer than loop.compute in ([0-9]+)\n");
    constexpr double kWidth = 1.1;  // a median is known up to 1/16 and 0.05 us
    EXPECT_TRUE(!(median > kWidth * compute) || counted >= half) << compute << words_;
    EXPECT_TRUE(!(kWidth * median < compute) || counted <= half) << compute << words_;
    tells = tells || (median > kWidth * compute && kWidth * median < 2.0 * compute);
    compute = std::max(1e-6, 0.7 * median);  // the least that is allowed
  }
  if (!tells) GTEST_SKIP() << "this machine is too busy: the median of a run is not that of the last one";
}

/// In virtual time a budget gives the same run each time; a cycle of 2 us lags, one of 100 us does not.
TEST_F(ControllerCommandTest, KeepsToABudgetOfWork) {
  write_path();
  const std::string simulation = "[simulation]\npath = \"path.csv\"\nbegin = 6.0\n";
  const auto run_with = [&](const char* budget) {
    write_contact_controller(fmt::format("[loop]\ncycle_budget = {}\n{}", budget, simulation));
    ASSERT_EQ(run(fmt::format("c.toml --log logs{}", budget)), 0) << words_;
  };
  run_with("2e-6");
  const double spent = number("\nbudget of work: spent in ([0-9]+) cycles");
  const double in_row = number("\nbudget of work: spent in .* at most ([0-9]+) in a row");
  EXPECT_GT(spent, 10.0) << words_;
  EXPECT_LE(in_row, spent);
  EXPECT_GT(in_row, 0.0);
  run_with("2e-6");
  EXPECT_EQ(number("\nbudget of work: spent in ([0-9]+) cycles"), spent);
  run_with("100e-6");
  EXPECT_FALSE(says("budget of work: ")) << words_;
}

TEST_F(ControllerCommandTest, RefusesABudgetThatThePlanDoesNotLeave) {
  write_contact_controller("[loop]\ncycle_budget = 111e-6\n");
  EXPECT_EQ(run("c.toml --duration 0.1"), 78);
  EXPECT_TRUE(
      says("loop.cycle_budget = 0.000111 exceeds loop.compute = 0.00012 less 1e-05 s for the rest of a cycle: set "
           "it to at most 0.00011, or raise loop.compute"))
      << words_;
  // as much as is left, whatever rounding says
  write_contact_controller("[loop]\ncompute = 0.00003\ncycle_budget = 0.00002\n");
  EXPECT_EQ(run("c.toml --duration 0.1"), 0) << words_;
  write_controller("[loop]\ncycle_budget = 50e-6\n[simulation]\nbegin = 0.0\n");
  const std::string lines = text("c.toml");
  std::ofstream(folder_ / "c.toml") << "[scene]\nsolver = \"paper\"\n" << lines.substr(lines.find('\n') + 1);
  EXPECT_EQ(run("c.toml --duration 0.1"), 0) << words_;
  EXPECT_TRUE(says("loop.cycle_budget has no effect: only the solver contact has a budget of work")) << words_;
  write_controller("[loop]\nreal_time = true\npriority = 1\n");
  std::string paper = text("c.toml");
  std::ofstream(folder_ / "c.toml") << paper.insert(paper.find("image"), "solver = \"paper\"\n");
  run("c.toml --duration 0.01");
  EXPECT_FALSE(says("has no effect")) << "nobody has set it: " << words_;
}

/// In real time the budget is found at the start. By default there is one: seven tenths of what loop.compute leaves.
TEST_F(ControllerCommandTest, FindsTheBudgetInRealTime) {
  const std::pair<const char*, const char*> budgets[] = {
      {"cycle_budget = 100e-6", "100 us"}, {"", "77 us"}, {"compute = 0.45e-3", "308 us"}};
  for (const auto& [line, time] : budgets) {
    write_contact_controller(fmt::format("[loop]\nreal_time = true\npriority = 1\n{}\n", line));
    change_device("[bus]", 1, "[bus]\nfd = true");  // leaves most of the period for computing
    const int code = run("c.toml --duration 0.1");
    const bool is_busy = code == 69 && (says("stopped: ") || says("no budget of work keeps"));
    EXPECT_TRUE(code == 0 || is_busy) << code << words_;
    EXPECT_TRUE(says(fmt::format("budget: {} a cycle for the god object, ", time))) << words_;
    EXPECT_FALSE(says(": 0 cycles computed")) << "there is nothing to warn of: " << words_;
    EXPECT_FALSE(says("godobject-controller: \n")) << "a warning without words: " << words_;
    EXPECT_GT(number("for the god object, ([0-9]+) units"), 0.0);
    EXPECT_EQ(number("they end [0-9]+ of ([0-9]+) cycles"), 401.0);
  }
  write_contact_controller("[loop]\nreal_time = true\npriority = 1\ncycle_budget = 0\n");
  run("c.toml --duration 0.1");
  EXPECT_FALSE(says("budget: ")) << words_;
}

/// Ten nanoseconds are too little for any cycle. By default the arm stops when cycles are late.
TEST_F(ControllerCommandTest, RefusesABudgetThatTheMachineCannotKeep) {
  write_contact_controller("[loop]\nreal_time = true\npriority = 1\ncycle_budget = 1e-8\n");
  EXPECT_EQ(run("c.toml --duration 0.1"), 69) << words_;
  EXPECT_TRUE(says("no budget of work keeps cycles within 0.01 us: the longest of a test motion takes ")) << words_;
  EXPECT_FALSE(says("computing:")) << "it did not start: " << words_;
  write_contact_controller("[start]\nsign_test = false\n[loop]\nreal_time = true\npriority = 1\ncompute = 1e-6\n");
  EXPECT_EQ(run("c.toml --duration 2"), 69) << words_;
  EXPECT_TRUE(says("budget: 1 us a cycle")) << words_;
  EXPECT_TRUE(says("cycles computed for longer than loop.compute, which bus plan and gain check count on")) << words_;
  EXPECT_TRUE(says("stopped: ")) << "by late cycles; a busy machine may find another reason first: " << words_;
}

/// A command without help of its own would show that of the program.
TEST_F(ControllerCommandTest, HelpsEachCommandWithItsOwnExamplesAndExitCodes) {
  for (const std::string command : {"", "doctor ", "commission "}) {
    EXPECT_EQ(run(command + "--help"), 0) << words_;
    EXPECT_TRUE(says("\nUsage: godobject-controller " + command + "[OPTIONS] ")) << words_;
    const std::size_t examples = words_.find("\nExample");
    ASSERT_NE(examples, std::string::npos) << words_;
    const std::string first = words_.substr(words_.find('\n', examples + 1) + 1);
    EXPECT_TRUE(first.starts_with("  godobject-controller " + command + "firmware/controllers/lwr.toml")) << first;
    const std::size_t codes = words_.find("\nExit codes: 0 ");
    EXPECT_LT(examples, codes) << words_;
    EXPECT_TRUE(words_.ends_with(", 78 bad configuration.\n")) << words_;
    std::istringstream lines(words_.substr(0, examples));
    for (std::string line; std::getline(lines, line);) {
      if (!line.starts_with("  -")) continue;
      EXPECT_TRUE(std::regex_match(line, std::regex("  -[-,a-zA-Z]+( [A-Zx.]+[a-z]*)? +[A-Za-z].{15,}"))) << line;
    }
  }
}

TEST_F(ControllerCommandTest, NeedsASceneFromItsFileOrItsCommand) {
  std::string file = text("c.toml");
  file.erase(0, file.find("[device]"));
  std::ofstream(folder_ / "c.toml") << file;
  EXPECT_EQ(run("c.toml --duration 0.01"), 78);
  EXPECT_EQ(words_, "godobject-controller: c.toml: scene.image is missing; add it or give --scene\n");
  EXPECT_EQ(run("c.toml --duration 0.01 --scene plate.scene"), 0) << words_;
}

TEST_F(ControllerCommandTest, RefusesASceneWithoutTheFrictionOfItsFile) {
  test::ImageParts parts(test::ball_over_plate());
  parts.item<format::Settings>(format::SectionId::kSettings).friction = 0;
  const test::SceneImage image = parts.assemble();
  std::ofstream(folder_ / "smooth.scene", std::ios::binary)
      .write(reinterpret_cast<const char*>(image.bytes().data()), static_cast<std::streamsize>(image.bytes().size()));
  EXPECT_EQ(run("c.toml --duration 0.01 --scene smooth.scene"), 0) << words_;
  const std::string lines = text("c.toml");
  std::ofstream(folder_ / "c.toml") << "[scene]\nfriction = true\n" << lines.substr(lines.find('\n') + 1);
  EXPECT_EQ(run("c.toml --duration 0.01"), 0) << words_;
  EXPECT_EQ(run("c.toml --duration 0.01 --scene smooth.scene"), 65) << words_;
  EXPECT_TRUE(says("godobject-controller: smooth.scene: ")) << words_;
  EXPECT_TRUE(
      says("; compile it again without --only-solver and with a [friction] table, or change scene.solver or "
           "scene.friction\n"))
      << words_;
}

/// A cycle of 1 ms holds no frames at 10 kbit/s. The plan shows by how much; nothing is started.
TEST_F(ControllerCommandTest, RefusesBusesThatAreTooSlowForACycleAndShowsTheirPlan) {
  change_device("bit_rate", 1, "bit_rate = 1e4");
  for (const char* command : {"", "commission ", "doctor "}) {
    EXPECT_EQ(run(std::string(command) + "c.toml"), 78) << words_;
    const std::size_t plan = words_.find("bus plan: CAN 0.01 Mbit/s");
    ASSERT_NE(plan, std::string::npos) << words_;
    EXPECT_EQ(words_.find("bus plan: ", plan + 1), std::string::npos) << "once: " << words_;
    EXPECT_NE(words_.find("does not fit\n", plan), std::string::npos) << words_;
    const std::size_t objection = words_.find("godobject-controller: bus 0: a cycle needs ", plan);
    ASSERT_NE(objection, std::string::npos) << words_;
    EXPECT_EQ(words_.find('\n', objection), words_.size() - 1) << "last: " << words_;
    EXPECT_FALSE(says("rendered in") || says("joint bus node")) << words_;
  }
}

/// A motor of 10 t m^2 does not move when the start pushes it. Its joint is named, and the run has failed.
TEST_F(ControllerCommandTest, NamesTheJointThatDoesNotMoveWhenItIsPushed) {
  for (const int joint : {1, 4}) {
    write_controller("");
    change_device("rotor", joint, "rotor = 1e4");
    EXPECT_EQ(run("c.toml --duration 20"), 69) << words_;
    EXPECT_TRUE(says("rendered in 0 of ")) << words_;
    EXPECT_TRUE(
        words_.ends_with(fmt::format("godobject-controller: stopped: joint {}: a joint did not move when "
                                     "pushed; keep the hand still, check its brake and encoder\n",
                                     joint)))
        << words_;
  }
}

/// The hand moves the tool at 0.1 m/s, some 2 s after the first cycle. A fault of no single joint that lasts until the
/// end is a failure.
TEST_F(ControllerCommandTest, FailsWithTheFaultThatLastsUntilItsEnd) {
  write_path();
  write_controller(
      "[start]\nsign_test = false\n[limits]\nforce = 0.5\nspeed = 0.02\nspeed_stop = 0.03\n"
      "[simulation]\npath = \"path.csv\"\nbegin = 3.0\n");
  EXPECT_EQ(run("c.toml --duration 4"), 69) << words_;
  EXPECT_TRUE(
      words_.ends_with("\ngodobject-controller: stopped: hand or joint was faster than its stop speed; reset\n"))
      << words_;
  EXPECT_EQ(run("c.toml --duration 1.5"), 0) << "before the motion: " << words_;
  EXPECT_FALSE(says("stopped: ")) << words_;
}

/// 101 cycles: each seventh has a row.
TEST_F(ControllerCommandTest, LogsOneRowInSoManyCycles) {
  for (const int every : {1, 7, 101, 102}) {
    write_controller(fmt::format("[start]\nsign_test = false\n[telemetry]\nevery = {}\n", every));
    EXPECT_EQ(run("c.toml --duration 0.1 --log logs"), 0) << words_;
    const std::string log = text("logs/telemetry.csv");
    EXPECT_EQ(std::count(log.begin(), log.end(), '\n'), 1 + 101 / every) << every;
    EXPECT_TRUE(says(fmt::format("telemetry.csv: {} rows, 0 lost\n", 101 / every))) << words_;
  }
}

/// They do not forbid the run.
TEST_F(ControllerCommandTest, WarnsOfGainsThatAreStableButNotPassive) {
  EXPECT_EQ(run("c.toml --duration 0.01"), 0) << words_;
  EXPECT_TRUE(says("godobject-controller: stable by a factor of ") && says(", but not passive by the linear rule: "))
      << words_;
  EXPECT_TRUE(says("godobject-controller: gains.rotational counts a radian as ")) << words_;
}

/// 1 us is worth one unit of work, so the god object stays where it is, however fast the machine is.
TEST_F(ControllerCommandTest, WarnsOfABudgetThatHoldsTheGodObject) {
  const std::string warning = "godobject-controller: with 1 us a cycle the god object stops on the way: ";
  write_contact_controller("[loop]\nreal_time = true\npriority = 1\ncompute = 1e-6\n");
  run("c.toml --duration 0.01");
  EXPECT_TRUE(says(warning)) << words_;
  write_contact_controller("[loop]\ncycle_budget = 1e-6\n");
  EXPECT_EQ(run("c.toml --duration 0.01"), 0) << words_;
  EXPECT_FALSE(says("budget: 1 us a cycle") || says(warning)) << "in virtual time nothing is measured: " << words_;
}

TEST_F(ControllerCommandTest, ExaminesTheMachine) {
  for (const char* arguments : {"doctor", "doctor c.toml"}) {
    const int code = run(arguments);
    const bool able = !says("LACK kernel: ") && !says("LACK rtprio: ") && !says("LACK memlock: ");
    EXPECT_EQ(code, able ? 0 : 69) << words_;
    EXPECT_EQ(says("no real-time work on this machine"), !able) << words_;
    EXPECT_TRUE(says("kernel: ") && says("memlock: ") && says("rtprio: ")) << words_;
  }
  EXPECT_EQ(run("doctor nothing.toml"), 66);
  EXPECT_EQ(run("doctor --help"), 0);
  EXPECT_TRUE(says("Exit codes: 0 done")) << words_;
}

}  // namespace
}  // namespace godobject::firmware::command_test
