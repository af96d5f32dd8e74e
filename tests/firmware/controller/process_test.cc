// godobject-controller as a process: signals, and a log that cannot be written. It waits for what it wants to see; how
// long that takes decides nothing.
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <thread>
#include <vector>

#include "tests/firmware/controller/controller_folder.h"
#include "tests/firmware/controller/process.h"
#include "tests/support/fault_record.h"
#include "tests/support/ordinary_user.h"

namespace godobject::firmware::process_test {
namespace {

class ControllerProcessTest : public ControllerFolderTest {
 protected:
  /// A condition that is not seen within this time counts as never seen. The value measures nothing else.
  static constexpr std::chrono::seconds kNever{600};

  /// Waits until the condition holds. False if it never does, or not although the controller has ended.
  bool see(const std::function<bool()>& what) const {
    const auto end = std::chrono::steady_clock::now() + kNever;
    while (!what()) {
      if (has_ended()) return what();
      if (std::chrono::steady_clock::now() > end) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return true;
  }

  /// True if a child process has ended; it stays as it is.
  static bool has_ended() {
    siginfo_t child{};
    return ::waitid(P_ALL, 0, &child, WEXITED | WNOHANG | WNOWAIT) == 0 && child.si_pid != 0;
  }

  /// Modes of the rows that are whole, in their order.
  std::vector<std::string> modes() const {
    std::vector<std::string> found;
    const std::string log = text("logs/telemetry.csv");
    for (std::size_t begin = log.find('\n') + 1, end; (end = log.find('\n', begin)) != std::string::npos;
         begin = end + 1) {
      std::size_t from = begin;
      for (int column = 0; column < 3; ++column) from = log.find(',', from) + 1;
      found.push_back(log.substr(from, log.find(',', from) - from));
    }
    return found;
  }

  bool has(const std::string& mode) const {
    const auto all = modes();
    return std::find(all.begin(), all.end(), mode) != all.end();
  }

  /// The line of log.txt that has `what` in it.
  std::string line_with(const std::string& what) const {
    std::istringstream lines(text("log.txt"));
    std::string line;
    while (std::getline(lines, line)) {
      if (line.find(what) != std::string::npos) return line;
    }
    return {};
  }

  /// For the report: a run with an end of its own, whose log was hindered.
  void record_going_on(int exit_code) const {
    const std::string cycles = line_with("overruns ");
    const bool in_time = cycles.find("overruns 0, periods skipped 0") != std::string::npos;
    test::record({.reaction = exit_code == 0 && in_time ? "goes on" : "ends early or late",
                  .found = line_with("telemetry.csv: ") + "; " + cycles,
                  .after = "exit " + std::to_string(exit_code),
                  .cycles = -1});
  }

  bool says(const std::string& what) const { return text("log.txt").find(what) != std::string::npos; }

  Process start(const std::vector<std::string>& more = {}, rlim_t largest_file = RLIM_INFINITY) const {
    std::vector<std::string> arguments{"c.toml", "--log", "logs"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return Process(folder_, GODOBJECT_CONTROLLER, arguments, {.largest_file = largest_file});
  }
};

const char* const kSeldom = "[start]\nsign_test = false\n[telemetry]\nevery = 200\n";
const char* const kRealTime = "[start]\nsign_test = false\n[loop]\nreal_time = true\npriority = 1\n";

TEST_F(ControllerProcessTest, EndsInOrderWhenItIsAskedTo) {
  write_controller("[start]\nsign_test = false\n");
  std::ptrdiff_t most = 0;
  std::string codes;
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) {
    std::filesystem::remove_all(folder_ / "logs");
    Process process = start();
    ASSERT_TRUE(see([&] { return has("running"); })) << text("log.txt");
    process.send(signal);
    const int code = process.wait();
    EXPECT_EQ(code, 0) << signal << ": " << text("log.txt");
    EXPECT_TRUE(says("rendered in")) << signal;
    EXPECT_FALSE(says("stopped:")) << signal;
    const std::vector<std::string> all = modes();
    most = std::max(most, all.end() - std::find(all.begin(), all.end(), "ending"));
    codes += (codes.empty() ? "exit " : ", ") + std::to_string(code);
    EXPECT_LE(most, 200) << signal;
  }
  test::record({.reaction = codes == "exit 0, 0, 0" && most > 1 ? "ends" : "fails",
                .found = "SIGTERM, SIGINT, SIGHUP",
                .after = codes,
                .cycles = static_cast<int>(most)});
}

TEST_F(ControllerProcessTest, TakesAResetWithoutAFaultForNothing) {
  write_controller(kSeldom);
  Process process = start();
  ASSERT_TRUE(see([&] { return has("running"); }));
  for (int i = 0; i < 5; ++i) {
    process.send(SIGUSR1);
    const std::size_t rows = modes().size();
    ASSERT_TRUE(see([&] { return modes().size() > rows + 2; }));
  }
  EXPECT_EQ(modes().back(), "running");
  process.send(SIGTERM);
  EXPECT_EQ(process.wait(), 0);
}

TEST_F(ControllerProcessTest, IsStoppedForGoodByAPauseOfTheProcess) {
  write_controller(kRealTime);
  Process process = start();
  ASSERT_TRUE(see([&] { return has("running") || has("stopped"); })) << text("log.txt");
  if (has("stopped")) {
    process.send(SIGTERM);
    process.wait();
    GTEST_SKIP() << "this machine is too busy for a loop in real time: " << line_with("stopped: ");
  }
  process.send(SIGSTOP);
  ASSERT_TRUE(see([&] { return process.is_stopped(); }));
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  process.send(SIGCONT);
  ASSERT_TRUE(see([&] { return has("stopped"); }));
  ASSERT_TRUE(see([&] { return says("kill -USR1 "); })) << "the operator is told at once, with the cure";
  const std::size_t rows = modes().size();
  ASSERT_TRUE(see([&] { return modes().size() > rows + 300; })) << "it waits for the operator";
  process.send(SIGTERM);
  EXPECT_EQ(process.wait(), 0);
  EXPECT_TRUE(says("stopped: ")) << text("log.txt");
  const std::vector<std::string> all = modes();
  const auto stopping = std::find(all.begin(), all.end(), "stopping");
  ASSERT_NE(stopping, all.end());
  const std::set<std::string> allowed{"stopping", "stopped", "ended"};
  const bool stays = std::all_of(stopping, all.end(), [&](const auto& mode) { return allowed.contains(mode); });
  EXPECT_TRUE(stays) << "no power again";
  test::record({.reaction = stays ? "STOP" : "powered again",
                .found = line_with("stopped: "),
                .after = "stopped for " + std::to_string(rows) + " cycles and more",
                .cycles = -1});
}

/// A hand moves the tool at 0.1 m/s, which no torque may stop here. The fault is of no single joint.
TEST_F(ControllerProcessTest, WaitsAfterAFaultUntilItIsAskedToEndAndThenNamesTheFaultLast) {
  write_path();
  write_controller(
      "[start]\nsign_test = false\n[limits]\nforce = 0.5\nspeed = 0.02\nspeed_stop = 0.03\n"
      "[simulation]\npath = \"path.csv\"\nbegin = 3.0\n");
  Process process(folder_, GODOBJECT_CONTROLLER, {"c.toml", "--duration", "1e7"});
  ASSERT_TRUE(see([&] { return says("kill -USR1 "); })) << text("log.txt");
  process.send(SIGTERM);
  EXPECT_EQ(process.wait(), 0) << "a fault that a reset clears does not make an end that was asked for a failure";
  const std::string words = text("log.txt");
  EXPECT_NE(words.find(", stopped "), std::string::npos) << "the summary has the time in this mode: " << words;
  EXPECT_TRUE(words.ends_with("\ngodobject-controller: stopped: hand or joint was faster than its stop speed; reset\n"))
      << words;
}

TEST_F(ControllerProcessTest, LeavesNothingHalfWrittenButTheLastRowWhenItIsKilled) {
  write_controller("[start]\nsign_test = false\n");
  Process process = start();
  ASSERT_TRUE(see([&] { return has("running"); }));
  process.send(SIGKILL);
  EXPECT_EQ(process.wait(), -SIGKILL);
  const std::filesystem::path killed = folder_ / "logs" / std::filesystem::read_symlink(folder_ / "logs" / "latest");
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(killed)) {
    files[entry.path().filename()] = text(entry.path());
  }
  for (const char* file : {"telemetry.csv", "hand.csv"}) {
    const std::string& log = files[file];
    std::istringstream lines(log.substr(0, log.rfind('\n') + 1));
    std::string line;
    std::getline(lines, line);
    const auto columns = std::count(line.begin(), line.end(), ',');
    EXPECT_GT(columns, 0);
    while (std::getline(lines, line)) ASSERT_EQ(std::count(line.begin(), line.end(), ','), columns) << file;
  }
  // the next run has a folder of its own
  Process again = start({"--duration", "0.5"});
  EXPECT_EQ(again.wait(), 0) << text("log.txt");
  EXPECT_NE(folder_ / "logs" / std::filesystem::read_symlink(folder_ / "logs" / "latest"), killed);
  for (const auto& [file, log] : files) EXPECT_TRUE(text(killed / file) == log) << file << " has changed";
}

TEST_F(ControllerProcessTest, SharesItsFolderWithARunThatStartsAtTheSameTime) {
  write_controller("[start]\nsign_test = false\n");
  constexpr int kRuns = 6;
  std::vector<std::unique_ptr<Process>> runs;
  for (int i = 0; i < kRuns; ++i) {
    runs.push_back(std::make_unique<Process>(folder_, GODOBJECT_CONTROLLER,
                                             std::vector<std::string>{"c.toml", "--log", "logs", "--duration", "0.1"}));
  }
  for (const std::unique_ptr<Process>& run : runs) EXPECT_EQ(run->wait(), 0) << text("log.txt");
  int folders = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "logs")) {
    if (entry.is_symlink()) continue;
    ++folders;
    const std::string log = text(entry.path() / "telemetry.csv");
    EXPECT_EQ(std::count(log.begin(), log.end(), '\n'), 1 + 101) << entry.path();
  }
  EXPECT_EQ(folders, kRuns);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "logs" / "telemetry.csv"));
}

TEST_F(ControllerProcessTest, OverwritesNothingByALinkInPlaceOfItsTelemetry) {
  write_controller("[start]\nsign_test = false\n");
  std::filesystem::create_directories(folder_ / "logs");
  std::ofstream(folder_ / "precious") << "kept";
  std::filesystem::create_symlink("../precious", folder_ / "logs" / "telemetry.csv");
  Process process = start({"--duration", "0.1"});
  EXPECT_EQ(process.wait(), 74);
  EXPECT_TRUE(says("logs/telemetry.csv: is not a link to latest/telemetry.csv")) << text("log.txt");
  EXPECT_EQ(text("precious"), "kept");
}

TEST_F(ControllerProcessTest, GoesOnWithoutItsTelemetryOnAFullDisk) {
  write_controller("[start]\nsign_test = false\n");
  Process process(folder_, GODOBJECT_CONTROLLER, {"c.toml", "--log", "logs", "--duration", "2"},
                  {.library = GODOBJECT_FULL_DISK_LIBRARY});
  const int code = process.wait();
  EXPECT_EQ(code, 0) << text("log.txt");
  EXPECT_TRUE(says("telemetry.csv: 0 rows, ")) << text("log.txt");
  EXPECT_TRUE(says("overruns 0, periods skipped 0")) << text("log.txt");
  record_going_on(code);
}

TEST_F(ControllerProcessTest, GoesOnWhenItsFileMayNotGrow) {
  write_controller("[start]\nsign_test = false\n");
  Process process = start({"--duration", "2"}, 200 * 1024);
  const int code = process.wait();
  EXPECT_EQ(code, 0) << text("log.txt");
  EXPECT_TRUE(says("overruns 0, periods skipped 0")) << text("log.txt");
  EXPECT_FALSE(says(" 0 lost")) << text("log.txt");
  EXPECT_LE(std::filesystem::file_size(folder_ / "logs" / "telemetry.csv"), 200u * 1024u);
  EXPECT_GT(modes().size(), 100u);
  record_going_on(code);
}

/// A hand that moves faster than its stop speed 3 s after the begin.
class IncidentProcessTest : public ControllerProcessTest {
 protected:
  void SetUp() override {
    ControllerProcessTest::SetUp();
    write_path();
    write_controller(
        "[start]\nsign_test = false\n[limits]\nforce = 0.5\nspeed = 0.02\nspeed_stop = 0.03\n"
        "[simulation]\npath = \"path.csv\"\nbegin = 3.0\n");
  }

  int run(const std::vector<std::string>& arguments, const std::string& library = "") const {
    return Process(folder_, GODOBJECT_CONTROLLER, arguments, {.library = library}).wait();
  }

  /// Lines of a file.
  std::vector<std::string> lines(const std::filesystem::path& file) const {
    std::istringstream stream(text(file));
    std::vector<std::string> all;
    for (std::string line; std::getline(stream, line);) all.push_back(line);
    return all;
  }

  static double seconds(const std::string& row) { return std::stod(row); }
  static std::string fault(const std::string& row) {
    std::size_t from = 0;
    for (int column = 0; column < 4; ++column) from = row.find(',', from) + 1;
    return row.substr(from, row.find(',', from) - from);
  }

  /// Begins at most 30 s before the stop, contains it, and has each cycle.
  void expect_a_record_of_the_stop(const std::filesystem::path& folder) const {
    const std::vector<std::string> rows = lines(folder / "telemetry.csv");
    ASSERT_GT(rows.size(), 2000u);
    const auto stop = std::find_if(rows.begin() + 1, rows.end(), [](const auto& row) { return fault(row) == "15"; });
    ASSERT_NE(stop, rows.end());
    EXPECT_LE(seconds(*stop) - seconds(rows[1]), 30.0);
    EXPECT_GT(seconds(*stop) - seconds(rows[1]), 2.0) << "the rows before";
    EXPECT_GT(seconds(rows.back()) - seconds(*stop), 0.5) << "the rows after";
    for (std::size_t i = 2; i < rows.size(); ++i) ASSERT_NEAR(seconds(rows[i]) - seconds(rows[i - 1]), 1e-3, 1e-9);
    EXPECT_GT(lines(folder / "can.log").size(), 10 * rows.size()) << "seven joints on three buses";
    EXPECT_EQ(text(folder / "controller.toml"), text("c.toml"));
    EXPECT_EQ(text(folder / "device.toml"), text(GODOBJECT_FIRMWARE_DIR "/devices/lwr.toml"));
    const std::string facts = text(folder / "run.toml");
    for (const char* fact :
         {"program = 'godobject-controller ", "machine = 'Linux", "image_checksum = '", "fault = 15"}) {
      EXPECT_NE(facts.find(fact), std::string::npos) << fact << " in " << facts;
    }
    EXPECT_EQ(text(folder / "words.txt"), "stopped: hand or joint was faster than its stop speed; reset\n");
  }
};

TEST_F(IncidentProcessTest, RecordsAStopBesideTheLogs) {
  EXPECT_EQ(run({"c.toml", "--log", "logs"}), 69) << text("log.txt");
  EXPECT_TRUE(says("the stop is recorded in logs/")) << text("log.txt");
  const std::filesystem::path incident = folder_ / "logs" / "latest" / "incident";
  expect_a_record_of_the_stop(incident);
  EXPECT_EQ(lines("logs/telemetry.csv"), lines(incident / "telemetry.csv")) << "of a run that is shorter than 30 s";
  using std::filesystem::perms;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(std::filesystem::canonical(incident))) {
    EXPECT_EQ(entry.status().permissions() & (perms::others_all | perms::group_write), perms::none) << entry.path();
  }
}

/// The log has a row for 200 cycles, the incident each cycle.
TEST_F(IncidentProcessTest, RecordsEachCycleWhateverTheLogHas) {
  std::ofstream(folder_ / "c.toml", std::ios::app) << "[telemetry]\nevery = 200\n";
  EXPECT_EQ(run({"c.toml", "--log", "logs"}), 69) << text("log.txt");
  EXPECT_LT(lines("logs/telemetry.csv").size(), 40u);
  expect_a_record_of_the_stop("logs/latest/incident");
}

TEST_F(IncidentProcessTest, RecordsAStopWithoutLogsWhereItIsAskedTo) {
  EXPECT_EQ(run({"c.toml", "--incidents", "incidents"}), 69) << text("log.txt");
  EXPECT_TRUE(says("a stop will be recorded in incidents")) << text("log.txt");
  const std::filesystem::path incident = std::filesystem::directory_iterator(folder_ / "incidents")->path();
  expect_a_record_of_the_stop(incident);
  EXPECT_EQ(run({"c.toml", "--incidents", "c.toml/incidents"}), 74);
  EXPECT_TRUE(says("c.toml/incidents: cannot make this folder")) << text("log.txt");
}

/// Tests and demos run in virtual time.
TEST_F(IncidentProcessTest, WritesNothingInVirtualTimeUnlessItIsAskedTo) {
  EXPECT_EQ(run({"c.toml"}), 69) << text("log.txt");
  EXPECT_FALSE(says("record")) << text("log.txt");
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    EXPECT_FALSE(entry.is_directory()) << entry.path();
  }
}

TEST_F(IncidentProcessTest, LeavesAReadableRecordWhenItIsKilled) {
  Process process = start({"--duration", "1e7"});
  ASSERT_TRUE(see([&] { return says("kill -USR1 "); })) << text("log.txt");
  process.send(SIGKILL);
  EXPECT_EQ(process.wait(), -SIGKILL);
  EXPECT_EQ(Process(folder_, GODOBJECT_CONTROLLER, {"explain", "logs"}, {.words = "words.txt"}).wait(), 0)
      << text("words.txt");
  EXPECT_NE(text("words.txt").find("fault 15: hand or joint was faster"), std::string::npos) << text("words.txt");
  EXPECT_TRUE(text("logs/latest/incident/incident.svg").starts_with("<svg ")) << text("words.txt");
}

TEST_F(IncidentProcessTest, GoesOnWhereTheDiskIsFull) {
  EXPECT_EQ(run({"c.toml", "--log", "logs"}, GODOBJECT_FULL_DISK_LIBRARY), 69) << text("log.txt");
  EXPECT_TRUE(says("/incident: 0 rows, 0 frames, ")) << text("log.txt");
  EXPECT_FALSE(says("/incident: 0 rows, 0 frames, 0 lost")) << text("log.txt");
  EXPECT_TRUE(says("overruns 0, periods skipped 0")) << text("log.txt");
  EXPECT_EQ(Process(folder_, GODOBJECT_CONTROLLER, {"explain", "logs"}, {.words = "words.txt"}).wait(), 65);
  EXPECT_NE(text("words.txt").find("telemetry.csv: is empty"), std::string::npos) << text("words.txt");
}

TEST_F(IncidentProcessTest, ExplainNamesTheCureWhereThereIsNoRecord) {
  const auto refused = [&](const std::vector<std::string>& arguments, int code, const std::string& words) {
    std::vector<std::string> all{"explain"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    EXPECT_EQ(run(all), code) << text("log.txt");
    EXPECT_TRUE(says(words)) << text("log.txt");
  };
  refused({}, 64, "FOLDER is required");
  refused({"none"}, 66, "none: is no folder; name the folder of a run or of an incident");
  refused({"c.toml"}, 66, "c.toml: is no folder");
  std::filesystem::create_directories(folder_ / "many" / "a");
  refused({"many"}, 66, "many: has no telemetry.csv; name the folder of a run");
  std::ofstream(folder_ / "many" / "a" / "telemetry.csv") << "a,b\n1,2\n";
  refused({"many"}, 66, "many: has no telemetry.csv; name one of its folders, such as many/a");
  refused({"many/a"}, 65, "many/a/telemetry.csv:1: has no column t_s; it is no telemetry");
  EXPECT_EQ(run({"c.toml", "--incidents", "incidents"}), 69);
  refused({std::filesystem::directory_iterator(folder_ / "incidents")->path().string(), "-o", "none/x.svg"}, 74,
          "none/x.svg");
  EXPECT_TRUE(says("fault 15: ")) << "the words come first: " << text("log.txt");
}

TEST_F(ControllerProcessTest, OpensNoSocketOnASimulatedBus) {
  write_controller(kSeldom);
  Process process = start();
  ASSERT_TRUE(see([&] { return has("running"); })) << text("log.txt");
  const int sockets = process.sockets();
  EXPECT_EQ(sockets, 0);
  process.send(SIGTERM);
  EXPECT_EQ(process.wait(), 0);
  test::record({.reaction = sockets == 0 ? "goes on" : "opens sockets",
                .found = std::to_string(sockets) + " sockets while it logs",
                .after = "",
                .cycles = -1});
}

/// Another user without rights to real-time work; on a real bus that is refused.
TEST_F(ControllerProcessTest, SaysWhatItMayNotDoAndRunsOnASimulatedBus) {
  write_controller(kRealTime);
  std::filesystem::permissions(folder_, std::filesystem::perms::all);
  int code = 0;
  {
    const test::AsOrdinaryUser user;
    if (!user.holds()) GTEST_SKIP() << "rights do not bind this user, who cannot become another";
    if (::faccessat(AT_FDCWD, GODOBJECT_CONTROLLER, X_OK, AT_EACCESS) != 0) {
      GTEST_SKIP() << "the program lies in a folder that is closed to other users";
    }
    Process process = start({"--duration", "0.3"});
    code = process.wait();
  }
  EXPECT_TRUE(says("going on, since the bus is simulated")) << text("log.txt");
  EXPECT_TRUE(code == 0 || (code == 69 && says("stopped: "))) << code << text("log.txt");  // a busy machine is late
  const std::string words = line_with("going on, since");
  test::record({.reaction = words.empty() ? "silent" : "goes on",
                .found = words,
                .after = "exit " + std::to_string(code),
                .cycles = -1});
}

}  // namespace
}  // namespace godobject::firmware::process_test
