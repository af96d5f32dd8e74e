// godobject-simdevice as a process, alone, with a master that only sends SYNC, and with godobject-controller.
#include <fcntl.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <functional>
#include <regex>
#include <sstream>
#include <thread>
#include <utility>
#include <vector>

#include "tests/firmware/controller/controller_folder.h"
#include "tests/firmware/controller/process.h"
#include "tests/support/fake_can.h"

namespace godobject::firmware::simdevice_test {
namespace {

class SimdeviceTest : public ControllerFolderTest {
 protected:
  SimdeviceTest() { std::filesystem::create_directories(folder_ / "can"); }

  Process start(const char* program, const std::vector<std::string>& arguments, const char* words = "log.txt",
                bool real_time_rights = true) const {
    return Process(folder_, program, arguments,
                   {.library = GODOBJECT_FAKE_CAN_LIBRARY,
                    .interfaces = folder_ / "can",
                    .real_time_rights = real_time_rights,
                    .words = words});
  }
  Process device(std::vector<std::string> arguments, const char* words = "log.txt") const {
    return start(GODOBJECT_SIMDEVICE, arguments, words);
  }
  int run(const std::vector<std::string>& arguments) const { return device(arguments).wait(); }

  bool says(const std::string& what, const char* words = "log.txt") const {
    return text(words).find(what) != std::string::npos;
  }

  /// The pipes of the device's sockets, bus 0 first; waits until there are three.
  std::vector<std::string> pipes(const Process& process) const {
    std::vector<std::string> found;
    wait_until([&] {
      found.clear();
      for (const auto& entry : std::filesystem::directory_iterator(folder_ / "can")) {
        if (entry.path().string().find('.' + std::to_string(process.id()) + '.') != std::string::npos) {
          found.push_back(entry.path());
        }
      }
      return found.size() == 3;
    });
    std::sort(found.begin(), found.end());
    return found;
  }

  static void wait_until(const std::function<bool()>& condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(10);  // never; measures nothing else
    while (!condition() && std::chrono::steady_clock::now() < end) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }

  /// A number of the report: the group of the expression.
  double number(const std::string& expression) const {
    const std::string words = text("log.txt");
    std::smatch match;
    if (!std::regex_search(words, match, std::regex(expression))) {
      ADD_FAILURE() << expression << " in " << words;
      return -1.0;
    }
    return std::stod(match[1]);
  }
};

void send(const std::string& pipe, std::uint32_t id) {
  test::FakeCanFrame frame{};
  frame.size = CAN_MTU;
  frame.frame.can_id = id;
  const int to = ::open(pipe.c_str(), O_WRONLY);
  EXPECT_EQ(::write(to, &frame, sizeof frame), static_cast<ssize_t>(sizeof frame));
  ::close(to);
}

void send_syncs(const std::vector<std::string>& pipes, int count) {
  for (int k = 0; k < count; ++k) {
    for (const std::string& pipe : pipes) send(pipe, 0x80);
  }
}

/// Bytes that wait in a pipe.
int size_of(const std::string& pipe) {
  const int from = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  int size = 0;
  ::ioctl(from, FIONREAD, &size);
  ::close(from);
  return size;
}

TEST_F(SimdeviceTest, RefusesInOneLineWithTheRightCode) {
  const std::string buses = "can0,can1,can2";
  const std::string none = "none0,none1,none2";
  using Arguments = std::vector<std::string>;
  EXPECT_EQ(run({"--help"}), 0);
  EXPECT_TRUE(says("Exit codes: 0 done")) << text("log.txt");
  EXPECT_TRUE(says("at the earliest; default: 3")) << text("log.txt");
  const std::initializer_list<std::pair<Arguments, std::pair<int, const char*>>> cases = {
      {{}, {64, "CONTROLLER"}},
      {{"c.toml"}, {64, "--bus"}},
      {{"--bus", buses}, {64, "CONTROLLER"}},
      {{"nothing.toml", "--bus", buses}, {66, "nothing.toml"}},
      {{"c.toml", "--bus", "can0,can1"}, {78, "names 2 CAN interfaces, the device has 3 buses"}},
      {{"c.toml", "--bus", "can0,can1,can2,can3"}, {78, "names 4 CAN interfaces, the device has 3 buses"}},
      {{"c.toml", "--bus", "can0,can1,can0"}, {78, "names an interface twice"}},
      {{"c.toml", "--bus", none}, {69, "--bus none0: no such interface"}},
      {{"c.toml", "--bus", "can0,can1,down2"}, {69, "--bus down2: the interface is down"}},
      {{"c.toml", "--bus", "can0,eth1,can2"}, {69, "--bus eth1: not a CAN interface"}},
      {{"c.toml", "--bus", "can0,closed1,can2"}, {77, "--bus closed1: "}},
      {{"c.toml", "--bus", buses, "--scene", "nothing.scene"}, {66, "nothing.scene"}},
      {{"c.toml", "--bus", buses, "--scene", "c.toml"}, {65, "c.toml"}},
      // the times, at their limits and beyond
      {{"c.toml", "--bus", none, "--duration", "0.0009"}, {64, "--duration"}},
      {{"c.toml", "--bus", none, "--duration", "0.001"}, {69, "none0"}},
      {{"c.toml", "--bus", none, "--duration", "1e7"}, {69, "none0"}},
      {{"c.toml", "--bus", none, "--duration", "1.01e7"}, {64, "--duration"}},
      {{"c.toml", "--bus", none, "--enable-after", "-0.001"}, {64, "--enable-after"}},
      {{"c.toml", "--bus", none, "--enable-after", "0"}, {69, "none0"}},
      {{"c.toml", "--bus", none, "--enable-after", "1e6"}, {69, "none0"}},
      {{"c.toml", "--bus", none, "--enable-after", "1.01e6"}, {64, "--enable-after"}}};
  for (const auto& [arguments, expected] : cases) {
    EXPECT_EQ(run(arguments), expected.first) << text("log.txt");
    EXPECT_TRUE(says(expected.second)) << expected.second << ": " << text("log.txt");
  }
}

TEST_F(SimdeviceTest, NeedsASceneFromItsFileOrItsCommand) {
  std::string file = text("c.toml");
  file.erase(0, file.find("[device]"));
  std::ofstream(folder_ / "c.toml") << file;
  EXPECT_EQ(run({"c.toml", "--bus", "can0,can1,can2", "--duration", "0.01"}), 78);
  EXPECT_TRUE(says("c.toml: scene.image is missing")) << text("log.txt");
  EXPECT_EQ(run({"c.toml", "--bus", "can0,can1,can2", "--scene", "plate.scene", "--duration", "0.01"}), 0);
}

TEST_F(SimdeviceTest, FollowsTheClockWithoutAControllerForItsDuration) {
  EXPECT_EQ(run({"c.toml", "--bus", "can0,can1,can2", "--duration", "0.4"}), 0) << text("log.txt");
  EXPECT_FALSE(says("godobject-simdevice:")) << "there is nothing to warn of: " << text("log.txt");
  const double seconds =
      number("\n?0 cycles, ([0-9.]+) s of the arm; 8 frames sent, 0 not sent; 0 received, 0 dropped");
  EXPECT_LE(seconds, 0.4011) << "the last look at the clock was before the end";
  EXPECT_GT(seconds, 0.0) << "an idle machine looks at the clock every 0.1 s, a busy one less often";
  EXPECT_TRUE(says("controller silent: 0 times\n"));
  for (int joint = 1; joint <= 7; ++joint) {
    EXPECT_TRUE(says(fmt::format("joint {}: 0 commands, 0 trips, switch on disabled\n", joint))) << text("log.txt");
  }
  EXPECT_FALSE(says("joint 0") || says("joint 8"));
  EXPECT_TRUE(says("work of the hand on the tool: 0 J\n"));
}

TEST_F(SimdeviceTest, WarnsOfASmallReceiveBufferAndGoesOn) {
  EXPECT_EQ(run({"c.toml", "--bus", "can0,small1,can2", "--duration", "0.01"}), 0) << text("log.txt");
  EXPECT_TRUE(
      says("godobject-simdevice: small1: the receive buffer has only 4096 bytes; sysctl -w "
           "net.core.rmem_max=262144\n"));
  EXPECT_FALSE(says("can0: ") || says("can2: "));
}

/// 40 times SYNC on each of the three buses. A SYNC whose partners are late begins a cycle without them.
TEST_F(SimdeviceTest, AdvancesWithEachSync) {
  Process process = device({"c.toml", "--bus", "can0,can1,can2", "--duration", "0.5"});
  send_syncs(pipes(process), 40);
  EXPECT_EQ(process.wait(), 0);
  const double cycles = number("([0-9]+) cycles, ");
  EXPECT_EQ(number("; ([0-9]+) received, 0 dropped"), 120.0);
  EXPECT_GE(cycles, 40.0);
  EXPECT_LE(cycles, 120.0);
  EXPECT_GE(number(" cycles, ([0-9.]+) s of the arm"), 1e-3 * cycles);
  EXPECT_LE(number(" cycles, ([0-9.]+) s of the arm"), 1e-3 * cycles + 0.6);
  EXPECT_GE(number("controller silent: ([0-9]+) times"), 1.0);
  EXPECT_TRUE(says(" 0 not sent;"));
}

TEST_F(SimdeviceTest, EndsAtASignalWithItsReport) {
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) {
    Process process = device({"c.toml", "--bus", "can0,can1,can2"});
    const std::vector<std::string> wires = pipes(process);
    send_syncs(wires, 1);
    wait_until([&] { return size_of(wires.at(0)) == 0; });  // it reads them after it has prepared for signals
    process.send(signal);
    ASSERT_EQ(process.wait(), 0) << signal;
    EXPECT_EQ(number("; ([0-9]+) received, 0 dropped"), 3.0) << signal;
    EXPECT_TRUE(says("work of the hand on the tool: 0 J\n")) << signal;
  }
}

/// The device answers each frame at once and pauses only at an error of the interface. A pause kills it here.
TEST_F(SimdeviceTest, PausesForNoFrame) {
  const int planted = Process(folder_, "/bin/sleep", {"0.001"}, {.may_pause = false}).wait();
  if (planted == Process::kNoFilters) GTEST_SKIP() << "not run: this kernel has no seccomp filters";
  ASSERT_EQ(planted, -SIGSYS) << "the rule holds";
  Process process(folder_, GODOBJECT_SIMDEVICE, {"c.toml", "--bus", "can0,can1,can2"},
                  {.library = GODOBJECT_FAKE_CAN_LIBRARY, .interfaces = folder_ / "can", .may_pause = false});
  const std::string wire = pipes(process).at(0);
  const int open = ::open(wire.c_str(), O_RDWR | O_NONBLOCK);  // else `send` would wait for a device that has ended
  for (int k = 0; k < 20 && !process.has_ended(); ++k) {
    send(wire, 0x80);
    wait_until([&] { return size_of(wire) == 0 || process.has_ended(); });
  }
  ::close(open);
  process.send(SIGTERM);
  EXPECT_EQ(process.wait(), 0) << text("log.txt");
}

TEST_F(SimdeviceTest, IsExaminedByTheDoctorAsInterfacesOfTheMachine) {
  const int code = start(GODOBJECT_CONTROLLER, {"doctor", "c.toml", "--bus", "can0,down1,none2"}).wait();
  EXPECT_EQ(code, 69);
  std::istringstream lines(text("log.txt"));
  std::string lacking;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("bus plan: ")) break;
    const bool good = line.starts_with("ok   ");
    EXPECT_TRUE(good || line.starts_with("LACK ")) << line;
    EXPECT_EQ(line.find(" -> ") == std::string::npos, good) << "a lack has a cure: " << line;
  }
  EXPECT_TRUE(says("ok   can0: up, simulated (vcan)\n")) << text("log.txt");
  EXPECT_TRUE(says("LACK down1: down -> ip link set down1 up\n")) << text("log.txt");
  EXPECT_TRUE(says("LACK none2: no such interface -> ")) << text("log.txt");
  EXPECT_TRUE(says("joint 7: bus 2, node 7")) << "the plan: " << text("log.txt");
  std::smatch match;
  const std::string words = text("log.txt");
  ASSERT_TRUE(std::regex_search(words, match, std::regex("no real-time work on this machine \\((.*)\\); see")))
      << words;
  EXPECT_TRUE(match[1].str().ends_with("down1: down; none2: no such interface")) << match[1];
  EXPECT_EQ(match[1].str().find("isolated"), std::string::npos) << "useful, not needed";
}

/// Real interfaces without real-time rights are refused; a simulated bus is not.
TEST_F(SimdeviceTest, IsNotControlledWithoutRealTimeRights) {
  Process process = device({"c.toml", "--bus", "can0,can1,can2"}, "device.txt");
  ASSERT_EQ(pipes(process).size(), 3u) << text("device.txt");
  for (const bool commission : {false, true}) {
    std::vector<std::string> arguments{"c.toml", "--bus", "can0,can1,can2"};
    if (commission) arguments.insert(arguments.begin(), "commission");
    EXPECT_EQ(start(GODOBJECT_CONTROLLER, arguments, "log.txt", false).wait(), 77) << text("log.txt");
    EXPECT_TRUE(says("LimitMEMLOCK=") || says("LimitRTPRIO=")) << text("log.txt");
    EXPECT_FALSE(says("going on")) << text("log.txt");
    EXPECT_TRUE(says("godobject-controller: bus.drive_delay = 0: ")) << "it warns before: " << text("log.txt");
  }
  write_controller("[start]\nsign_test = false\n");
  const int code = start(GODOBJECT_CONTROLLER, {"c.toml", "--real-time", "--duration", "0.1"}, "log.txt", false).wait();
  EXPECT_TRUE(code == 0 || (code == 69 && says("stopped: "))) << code << text("log.txt");
  EXPECT_TRUE(says("no real-time priority 80 (Operation not permitted)")) << text("log.txt");
  EXPECT_TRUE(says("going on, since the bus is simulated")) << text("log.txt");
}

/// A busy machine may be too late for a loop in real time, or for the device, so that a fault stops the arm.
TEST_F(SimdeviceTest, IsControlledByAnotherProcessOverItsInterfaces) {
  write_contact_controller("[start]\nsign_test = false\n[loop]\npriority = 1\n");
  Process process = device({"c.toml", "--bus", "can0,can1,can2", "--enable-after", "0.2"}, "device.txt");
  ASSERT_EQ(pipes(process).size(), 3u) << text("device.txt");
  const sched_param priority{1};
  ::sched_setscheduler(process.id(), SCHED_FIFO, &priority);  // helps where it is permitted
  const int code = start(GODOBJECT_CONTROLLER,
                         {"c.toml", "--bus", "can0,can1,can2", "--duration", "0.5", "--log", "logs", "--log-bus"})
                       .wait();
  if (code == 77) GTEST_SKIP() << "no right to real-time work: " << text("log.txt");
  const std::string words = text("log.txt");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "state")) << "stops are recorded beside the logs";
  EXPECT_TRUE(code == 0 || (code == 69 && says("stopped: "))) << code << words;
  EXPECT_TRUE(says("bus.drive_delay = 0: ")) << words;
  EXPECT_TRUE(says("budget: 77 us a cycle for the god object, ")) << "interfaces are real time: " << words;
  EXPECT_TRUE(says("round trip: p50 ")) << words;
  EXPECT_FALSE(says("godobject-controller: can")) << "there is nothing to warn of: " << words;
  const double cycles = number("rendered in [0-9]+ of ([0-9]+) cycles");
  if (code == 0) {
    EXPECT_EQ(cycles, 501.0) << "the last one takes the power away";
  } else {
    EXPECT_LE(cycles, 501.0);
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "logs" / "hand.csv")) << "the hand is not of this process";
  std::istringstream rows(text("logs/telemetry.csv"));
  std::string row;
  for (std::string next; std::getline(rows, next);) row = next;
  const std::string after_three_columns = row.substr(row.find(',', row.find(',', row.find(',') + 1) + 1) + 1);
  if (code == 0) {
    EXPECT_TRUE(after_three_columns.starts_with("ended,")) << row;
  }
  for (const char* bus : {"can0", "can1", "can2"}) {
    EXPECT_TRUE(std::filesystem::exists(folder_ / "logs" / (std::string(bus) + ".pcap"))) << bus;
    EXPECT_NE(text("logs/can.log").find(std::string(" ") + bus + " 080#"), std::string::npos) << "SYNC on " << bus;
  }
  process.send(SIGTERM);
  EXPECT_EQ(process.wait(), 0);
  EXPECT_FALSE(says("joint 1: 0 commands", "device.txt") || says("joint 7: 0 commands", "device.txt"));
}

/// The controller's device file has other serial numbers than the device's one: joints 2 and 5 are swapped.
TEST_F(SimdeviceTest, GivesNoPowerToSwappedDrives) {
  const std::string controller = text("c.toml");
  std::string file;
  {
    std::ostringstream all;
    all << std::ifstream(GODOBJECT_FIRMWARE_DIR "/devices/lwr.toml").rdbuf();
    file = all.str();
  }
  const auto replace = [](std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
  };
  file = replace(file, "serial = 2 }", "serial = 55 }");
  file = replace(file, "serial = 5 }", "serial = 2 }");
  file = replace(file, "serial = 55 }", "serial = 5 }");
  std::ofstream(folder_ / "swapped.toml") << file;
  std::ofstream(folder_ / "other.toml") << replace(controller, GODOBJECT_FIRMWARE_DIR "/devices/lwr.toml",
                                                   "swapped.toml");
  Process process = device({"c.toml", "--bus", "can0,can1,can2"}, "device.txt");
  ASSERT_EQ(pipes(process).size(), 3u) << text("device.txt");
  for (const bool commission : {false, true}) {
    std::vector<std::string> arguments{"other.toml", "--bus", "can0,can1,can2"};
    if (commission) arguments.insert(arguments.begin(), "commission");
    const int code = start(GODOBJECT_CONTROLLER, arguments).wait();
    if (code == 77) GTEST_SKIP() << "no right to real-time work: " << text("log.txt");
    EXPECT_EQ(code, 69) << text("log.txt");
    EXPECT_TRUE(
        says("can0, node 2, joint 2, object 1018:4: the drives of joints 2 and 5 are swapped, or their cables or "
             "node numbers; swap them back, or correct identity in the device file (serial 2 instead of 5)\n"))
        << text("log.txt");
  }
  process.send(SIGTERM);
  EXPECT_EQ(process.wait(), 0);
  for (int joint = 1; joint <= 7; ++joint) {
    EXPECT_TRUE(says("joint " + std::to_string(joint) + ": 0 commands, 0 trips, switch on disabled", "device.txt"));
  }
}

/// The warning comes once a run, and only if real drives have no serial number in the device file.
TEST_F(SimdeviceTest, WarnsOfDrivesWithoutASerialNumber) {
  const std::string warning =
      "the device file does not name the drives' serial numbers; two swapped drives would not be found";
  const auto warnings = [&](const std::vector<std::string>& arguments) {
    start(GODOBJECT_CONTROLLER, arguments, "log.txt", false).wait();
    const std::string words = text("log.txt");
    int count = 0;
    for (std::size_t at = 0; (at = words.find(warning, at)) != std::string::npos; ++at) ++count;
    return count;
  };
  EXPECT_EQ(warnings({"c.toml", "--bus", "can0,can1,can2"}), 0) << text("log.txt");
  EXPECT_EQ(warnings({"doctor", "c.toml", "--bus", "can0,can1,can2"}), 0) << text("log.txt");
  EXPECT_TRUE(says("ok   serial numbers of the drives in the device file\n")) << text("log.txt");
  std::ostringstream all;
  all << std::ifstream(GODOBJECT_FIRMWARE_DIR "/devices/lwr.toml").rdbuf();
  std::string file = std::regex_replace(all.str(), std::regex(", serial = [35] \\}"), " }");
  std::ofstream(folder_ / "unnamed.toml") << file;
  const std::string controller = text("c.toml");
  std::ofstream(folder_ / "c.toml") << std::regex_replace(controller, std::regex("file = \"[^\"]*\""),
                                                          "file = \"unnamed.toml\"");
  EXPECT_EQ(warnings({"c.toml", "--bus", "can0,can1,can2"}), 1) << text("log.txt");
  EXPECT_TRUE(says("(joints 3, 5)")) << text("log.txt");
  EXPECT_EQ(warnings({"doctor", "c.toml", "--bus", "can0,can1,can2"}), 1) << text("log.txt");
  EXPECT_TRUE(says("LACK " + warning)) << text("log.txt");
  EXPECT_EQ(warnings({"c.toml", "--duration", "0.01"}), 0) << "a simulated bus: " << text("log.txt");
}

TEST_F(SimdeviceTest, EndsAControllerThatHasNoDrivesWhenItIsAskedTo) {
  const std::string pipe = folder_ / "can" / "can0.0.0";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const int open = ::open(pipe.c_str(), O_RDWR | O_NONBLOCK);
  Process process = start(GODOBJECT_CONTROLLER, {"c.toml", "--bus", "can0,can1,can2"});
  // it sends after it has prepared for signals
  wait_until([&] { return size_of(pipe) > 0 || says("LimitMEMLOCK") || says("LimitRTPRIO"); });
  process.send(SIGTERM);
  const int code = process.wait();
  ::close(open);
  if (code == 77) GTEST_SKIP() << "no right to real-time work: " << text("log.txt");
  EXPECT_EQ(code, 0) << text("log.txt");
  EXPECT_TRUE(says("ended before the drives were started; no drive was enabled")) << text("log.txt");
  const std::filesystem::path incidents = folder_ / "state" / "incidents";
  EXPECT_TRUE(says("a stop will be recorded in " + incidents.string())) << "of a real arm: " << text("log.txt");
  EXPECT_TRUE(std::filesystem::is_empty(incidents));
}

}  // namespace
}  // namespace godobject::firmware::simdevice_test
