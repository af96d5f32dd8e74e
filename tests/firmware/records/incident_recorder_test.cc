#include "firmware/records/incident_recorder.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "firmware/cycle/fault.h"
#include "firmware/records/bus_log_writer.h"
#include "tests/support/folder_test.h"

namespace godobject::firmware::incident_recorder_test {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kMillisecond_ns = 1'000'000;
constexpr std::int64_t kSecond_ns = 1'000'000'000;

hal::LoggedFrame frame(int bus, std::int64_t time_ns, std::uint8_t length = 8, bool fd = false) {
  hal::LoggedFrame logged{bus, {{static_cast<std::uint16_t>(0x180 + bus), length, fd, {}}, time_ns, true}};
  for (std::size_t i = 0; i < length; ++i) logged.received.frame.data[i] = static_cast<std::uint8_t>(i + 1);
  return logged;
}

std::string line(const hal::LoggedFrame& logged) {
  std::string text;
  append_candump_line(logged.received, "can" + std::to_string(logged.bus), text);
  return text;
}

TEST(RecentFrames, GivesEachFrameBackOnceAsItWas) {
  RecentFrames frames;
  std::vector<hal::LoggedFrame> all;
  for (int i = 0; i < 1000; ++i) {
    const bool fd = i % 3 == 0;
    all.push_back(frame(i % 8, i * 7LL, static_cast<std::uint8_t>(fd ? 1 + i % 64 : i % 9), fd));
    frames.push(i, all.back());
  }
  for (int pass = 0; pass < 2; ++pass) {
    hal::LoggedFrame got;
    for (const hal::LoggedFrame& one : all) {
      ASSERT_TRUE(frames.take(got));
      ASSERT_EQ(line(got), line(one));
    }
    EXPECT_FALSE(frames.take(got));
    EXPECT_TRUE(frames.all_taken());
    frames.rewind();
    EXPECT_FALSE(frames.all_taken());
  }
}

TEST(RecentFrames, DropsOldFramesButOnRequestNoneThatWasNotTaken) {
  RecentFrames frames;
  for (int i = 0; i < 10; ++i) frames.push(i, frame(0, i));
  hal::LoggedFrame got;
  frames.drop_before(3, true);
  ASSERT_TRUE(frames.take(got));
  EXPECT_EQ(got.received.time_ns, 0) << "none was taken, so none was dropped";
  frames.take(got);
  frames.drop_before(5, true);
  ASSERT_TRUE(frames.take(got));
  EXPECT_EQ(got.received.time_ns, 2) << "the mark stays at its frame";
  frames.drop_before(5, false);
  ASSERT_TRUE(frames.take(got));
  EXPECT_EQ(got.received.time_ns, 5);
  frames.drop_before(100, false);
  EXPECT_FALSE(frames.take(got));
  EXPECT_EQ(frames.bytes(), 0u);
}

class IncidentRecorderTest : public test::FolderTest {
 protected:
  IncidentRecorder recorder(std::uintmax_t least_room = 0, std::string name = "incident") {
    return IncidentRecorder({.folder = folder_,
                             .name = std::move(name),
                             .format = {2},
                             .bus_names = {"can0", "can1"},
                             .facts = {{"run.toml", "program = \"x\"\n"}, {"controller.toml", "[scene]\n"}},
                             .least_room = least_room,
                             .say = [this](const std::string& words) { said_.push_back(words); }});
  }

  /// Cycles of a millisecond from `begin` to `end` [s], each with a frame.
  static void run(IncidentRecorder& recorder, double begin, double end, Fault fault = Fault::kNone) {
    for (auto ms = static_cast<std::int64_t>(1e3 * begin + 0.5); ms < static_cast<std::int64_t>(1e3 * end + 0.5);
         ++ms) {
      TelemetryRecord record;
      record.times.deadline_ns = ms * kMillisecond_ns;
      record.cycle.fault = fault;
      record.cycle.mode = fault == Fault::kNone ? Mode::kRunning : Mode::kStopping;
      recorder.add(record);
      recorder.add(frame(static_cast<int>(ms % 2), ms * kMillisecond_ns));
      if (ms % 50 == 0) write(recorder);
    }
    write(recorder);
  }
  static void write(IncidentRecorder& recorder) {
    while (recorder.write_some()) {
    }
  }

  std::string content(const fs::path& file) const {
    std::ifstream stream(folder_ / file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  /// Times of the rows [ms]; each row has as many columns as the header.
  std::vector<int> rows(const fs::path& folder = "incident") const {
    std::istringstream lines(content(folder / "telemetry.csv"));
    std::string header;
    std::getline(lines, header);
    std::vector<int> times;
    for (std::string row; std::getline(lines, row);) {
      EXPECT_EQ(std::count(row.begin(), row.end(), ','), std::count(header.begin(), header.end(), ','));
      times.push_back(static_cast<int>(1e3 * std::stod(row) + 0.5));
    }
    return times;
  }

  std::size_t frames(const fs::path& folder = "incident") const {
    const std::string text = content(folder / "can.log");
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  }

  static void expect_each(const std::vector<int>& times, int first, int last) {
    ASSERT_EQ(times.size(), static_cast<std::size_t>(last - first + 1));
    for (std::size_t i = 0; i < times.size(); ++i) ASSERT_EQ(times[i], first + static_cast<int>(i));
  }

  std::vector<std::string> said_;
};

TEST_F(IncidentRecorderTest, WritesNothingWithoutAFault) {
  IncidentRecorder incidents = recorder();
  run(incidents, 0.0, 40.0);
  EXPECT_TRUE(fs::is_empty(folder_));
  EXPECT_TRUE(said_.empty());
  EXPECT_EQ(incidents.summary(), "");
  incidents.write_words("stopped");
  EXPECT_TRUE(fs::is_empty(folder_));
}

/// A release is how the work ends; the fault of another stop, later in the same run, is an incident.
TEST_F(IncidentRecorderTest, WritesNothingWhenTheOperatorReleasesTheEnableSwitch) {
  IncidentRecorder incidents = recorder();
  run(incidents, 0.0, 1.0);
  run(incidents, 1.0, 2.0, Fault::kEnableReleased);
  EXPECT_TRUE(fs::is_empty(folder_));
  run(incidents, 2.0, 3.0);
  run(incidents, 3.0, 4.0, Fault::kEmergencyStop);
  expect_each(rows(), 0, 3'999);
}

TEST(IncidentRoom, GrowsWithTheRate) {
  EXPECT_EQ(IncidentRecorder::least_room(1e-3), 200'000'000u);
  EXPECT_EQ(IncidentRecorder::least_room(1e-2), 200'000'000u);
  EXPECT_NEAR(static_cast<double>(IncidentRecorder::least_room(1.25e-4)), 1.6e9, 1.0);
}

TEST_F(IncidentRecorderTest, HasThe30SecondsBeforeTheStopAndTheTimeAfterIt) {
  IncidentRecorder incidents = recorder();
  run(incidents, 0.0, 40.0);
  run(incidents, 40.0, 42.5, Fault::kTooFast);
  expect_each(rows(), 10'000, 42'499);
  // a frame follows the row of its cycle, so the window may have one more
  EXPECT_NEAR(static_cast<double>(frames()), 32'500.0, 1.0);
  EXPECT_EQ(content("incident/controller.toml"), "[scene]\n");
  const std::string facts = content("incident/run.toml");
  EXPECT_TRUE(facts.starts_with("program = \"x\"\n\n[stop]\nutc = \"20")) << facts;
  EXPECT_NE(facts.find("\nt_s = 40.000000\nfault = 15\n"), std::string::npos) << facts;
  ASSERT_EQ(said_.size(), 1u);
  EXPECT_NE(said_[0].find("godobject-controller explain " + (folder_ / "incident").string()), std::string::npos);
  EXPECT_NE(incidents.summary().find("incident: 32500 rows, 3250"), std::string::npos) << incidents.summary();
  incidents.write_words("stopped: too fast");
  EXPECT_EQ(content("incident/words.txt"), "stopped: too fast\n");
}

/// The last rows before a kill do not depend on an end in order.
TEST_F(IncidentRecorderTest, IsOnTheDiskAtOnce) {
  IncidentRecorder incidents = recorder();
  run(incidents, 0.0, 1.0);
  run(incidents, 1.0, 1.001, Fault::kAlarm);
  expect_each(rows(), 0, 1000);
  EXPECT_EQ(frames(), 1001u);
}

TEST_F(IncidentRecorderTest, IsClosedToOthers) {
  const mode_t before = ::umask(0);
  {
    IncidentRecorder incidents = recorder();
    run(incidents, 0.0, 0.1, Fault::kTooFast);
  }
  ::umask(before);
  const auto mode = [&](const char* name) {
    struct stat status {};
    EXPECT_EQ(::lstat((folder_ / name).c_str(), &status), 0) << name;
    return status.st_mode & 07777u;
  };
  EXPECT_EQ(mode("incident"), 0750u);
  for (const char* name :
       {"incident/telemetry.csv", "incident/can.log", "incident/run.toml", "incident/controller.toml"}) {
    EXPECT_EQ(mode(name), 0640u) << name;
  }
}

/// An arm that stays stopped for a night must not fill the disk.
TEST_F(IncidentRecorderTest, EndsAMinuteAfterTheStop) {
  IncidentRecorder incidents = recorder();
  run(incidents, 0.0, 1.0);
  run(incidents, 1.0, 200.0, Fault::kTooFast);
  const std::vector<int> times = rows();
  EXPECT_EQ(times.front(), 0);
  EXPECT_GE(times.back(), 61'000);
  EXPECT_LE(times.back(), 61'060) << "one drain more";
  incidents.write_words("still stopped");
  EXPECT_EQ(content("incident/words.txt"), "still stopped\n");
  EXPECT_NE(incidents.summary().find("incident: "), std::string::npos);
}

TEST_F(IncidentRecorderTest, OfASecondStopHasAFolderOfItsOwn) {
  IncidentRecorder incidents = recorder();
  run(incidents, 0.0, 1.0);
  run(incidents, 1.0, 2.0, Fault::kTooFast);
  run(incidents, 2.0, 5.0);
  const std::string first = content("incident/telemetry.csv");
  run(incidents, 5.0, 6.0, Fault::kAlarm);
  expect_each(rows("incident"), 0, 2000);
  EXPECT_EQ(content("incident/telemetry.csv"), first);
  expect_each(rows("incident-2"), 0, 5999);
  EXPECT_NEAR(static_cast<double>(frames("incident-2")), 6000.0, 1.0);
  const std::string summary = incidents.summary();
  EXPECT_EQ(std::count(summary.begin(), summary.end(), '\n'), 2) << summary;
}

TEST_F(IncidentRecorderTest, OverwritesNothingAndFollowsNoLink) {
  fs::create_directory(folder_ / "elsewhere");
  fs::create_symlink("elsewhere", folder_ / "incident");
  std::ofstream(folder_ / "incident-2") << "kept";
  IncidentRecorder incidents = recorder();
  run(incidents, 0.0, 1.0, Fault::kTooFast);
  EXPECT_TRUE(fs::is_empty(folder_ / "elsewhere"));
  EXPECT_EQ(content("incident-2"), "kept");
  expect_each(rows("incident-3"), 0, 999);
}

TEST_F(IncidentRecorderTest, IsNamedByItsTimeWhereManyRunsShareAFolder) {
  IncidentRecorder incidents = recorder(0, "");
  run(incidents, 0.0, 0.1, Fault::kTooFast);
  const std::string name = fs::directory_iterator(folder_)->path().filename();
  ASSERT_EQ(name.size(), std::string("20261130T143055Z").size());
  EXPECT_EQ(name[8], 'T');
}

TEST_F(IncidentRecorderTest, IsRefusedWithoutRoomOnTheDisk) {
  IncidentRecorder incidents = recorder(std::numeric_limits<std::uintmax_t>::max());
  run(incidents, 0.0, 1.0, Fault::kTooFast);
  EXPECT_TRUE(fs::is_empty(folder_));
  ASSERT_EQ(said_.size(), 1u);
  EXPECT_NE(said_[0].find("the stop is not recorded: " + folder_.string() + " has "), std::string::npos) << said_[0];
  EXPECT_NE(said_[0].find("make room on the disk"), std::string::npos);
}

TEST_F(IncidentRecorderTest, GoesOnWhereItsFolderCannotBeMade) {
  std::ofstream(folder_ / "file") << "x";
  IncidentRecorder incidents({.folder = folder_ / "file" / "incidents",
                              .least_room = 0,
                              .say = [this](const std::string& words) { said_.push_back(words); }});
  run(incidents, 0.0, 1.0, Fault::kTooFast);
  ASSERT_EQ(said_.size(), 1u);
  EXPECT_NE(said_[0].find("the stop is not recorded: "), std::string::npos);
  EXPECT_NE(said_[0].find("Not a directory"), std::string::npos);
}

/// The operator's terminal is closed.
TEST_F(IncidentRecorderTest, GoesOnWhereNobodyCanBeTold) {
  IncidentRecorder incidents({.folder = folder_, .name = "incident", .least_room = 0, .say = [](const std::string&) {
                                throw std::runtime_error("closed");
                              }});
  run(incidents, 0.0, 1.0, Fault::kTooFast);
  expect_each(rows(), 0, 999);
}

/// Neither rows nor frames block or throw, and both are counted.
TEST_F(IncidentRecorderTest, CountsWhatAFullDiskDoesNotTake) {
  const auto before = std::signal(SIGXFSZ, SIG_IGN);
  rlimit usual{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &usual), 0);
  IncidentRecorder incidents = recorder();
  run(incidents, 0.0, 1.0, Fault::kTooFast);
  const rlimit full{0, usual.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &full), 0);
  run(incidents, 1.0, 2.0, Fault::kTooFast);
  ::setrlimit(RLIMIT_FSIZE, &usual);
  std::signal(SIGXFSZ, before);
  expect_each(rows(), 0, 999);
  EXPECT_NE(incidents.summary().find("incident: 1000 rows, 1000 frames, 2000 lost\n"), std::string::npos)
      << incidents.summary();
}

}  // namespace
}  // namespace godobject::firmware::incident_recorder_test
