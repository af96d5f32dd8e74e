#include "firmware/records/log_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "firmware/records/hand_log.h"
#include "firmware/records/record_folder.h"
#include "firmware/records/run_records.h"
#include "tests/firmware/records/open_log.h"
#include "tests/support/folder_test.h"
#include "toolchain/command_line/failure.h"

namespace {

/// A disk under this program's files: it takes few bytes at a time and is interrupted before each part.
struct HesitantDisk {
  std::size_t most = 0;  ///< bytes at a time
  bool interrupted = false;
  int parts = 0;
};
HesitantDisk* hesitant_disk = nullptr;

}  // namespace

/// The linker takes this one before that of the C library.
extern "C" ssize_t write(int descriptor, const void* data, std::size_t size) {
  if (hesitant_disk != nullptr) {
    hesitant_disk->interrupted = !hesitant_disk->interrupted;
    if (hesitant_disk->interrupted) {
      errno = EINTR;
      return -1;
    }
    size = std::min(size, hesitant_disk->most);
    ++hesitant_disk->parts;
  }
  return ::syscall(SYS_write, descriptor, data, size);
}

namespace godobject::firmware::log_file_test {
namespace {

class LogFileTest : public test::FolderTest {
 protected:
  std::string content(const std::filesystem::path& name) const {
    std::ifstream stream(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  /// Descriptors of this process that are open on the file.
  static std::vector<int> descriptors_on(const std::filesystem::path& file) {
    std::vector<int> found;
    for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
      std::error_code gone;
      if (std::filesystem::read_symlink(entry.path(), gone) == file)
        found.push_back(std::atoi(entry.path().filename().c_str()));
    }
    return found;
  }
};

TEST_F(LogFileTest, HoldsItsBlocksInTheirOrderAndCountsTheirRecords) {
  std::filesystem::create_directory(folder_ / "new");
  LogFile file = open_log(folder_ / "new" / "a.log");
  EXPECT_EQ(file.path(), folder_ / "new" / "a.log");
  EXPECT_EQ(content("new/a.log"), "");
  file.write("one\n", 1);
  EXPECT_EQ(content("new/a.log"), "one\n") << "nothing is kept back";
  file.write("", 0);
  file.write("two\nthree\n", 2);
  EXPECT_EQ(content("new/a.log"), "one\ntwo\nthree\n");
  EXPECT_EQ(file.written(), 3u);
  EXPECT_EQ(file.lost(), 0u);
}

/// A process whose standard input is closed gets its descriptor, 0, for the file.
TEST_F(LogFileTest, MayHaveTheDescriptorOfTheStandardInput) {
  const int input = ::fcntl(0, F_DUPFD_CLOEXEC, 100);
  ::close(0);
  {
    LogFile file = open_log(folder_ / "a.log");
    EXPECT_EQ(descriptors_on(folder_ / "a.log"), std::vector<int>{0});
    file.write("one\n", 1);
    EXPECT_EQ(file.written(), 1u);
  }
  EXPECT_TRUE(descriptors_on(folder_ / "a.log").empty());
  if (input >= 0) {
    ::dup2(input, 0);
    ::close(input);
  }
  EXPECT_EQ(content("a.log"), "one\n");
}

/// A file that another program empties goes on at its new end, without a hole.
TEST_F(LogFileTest, GoesOnAtTheEndOfTheFile) {
  LogFile file = open_log(folder_ / "a.log");
  file.write("one\n", 1);
  std::filesystem::resize_file(folder_ / "a.log", 0);
  file.write("two\n", 1);
  EXPECT_EQ(content("a.log"), "two\n");
}

/// A program that the controller starts does not get the file, and the end closes it.
TEST_F(LogFileTest, KeepsItsDescriptorToItself) {
  {
    const LogFile file = RecordFolder(folder_, "run").create("a.log");
    const std::vector<int> open = descriptors_on(folder_ / "run" / "a.log");
    ASSERT_EQ(open.size(), 1u);
    EXPECT_NE(::fcntl(open[0], F_GETFD) & FD_CLOEXEC, 0);
    EXPECT_EQ(::fcntl(open[0], F_GETFL) & O_ACCMODE, O_WRONLY);
  }
  EXPECT_TRUE(descriptors_on(folder_ / "run" / "a.log").empty());
  EXPECT_TRUE(std::filesystem::exists(folder_ / "run" / "a.log"));
}

/// A pipe whose reader goes away in the middle of a block: the part cannot be removed, so nothing follows it.
TEST_F(LogFileTest, WritesNothingMoreBehindAPartThatItCannotRemove) {
  const auto before = std::signal(SIGPIPE, SIG_IGN);
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  int reader = ::open((folder_ / "pipe").c_str(), O_RDONLY | O_NONBLOCK);
  ASSERT_GE(reader, 0);
  LogFile file = open_log(folder_ / "pipe");
  std::thread leaves([reader] {
    char byte = 0;
    while (::read(reader, &byte, 1) <= 0) std::this_thread::yield();
    ::close(reader);
  });
  file.write(std::string(1 << 20, 'x'), 5);  // more than a pipe holds
  leaves.join();
  EXPECT_EQ(file.written(), 0u);
  EXPECT_EQ(file.lost(), 5u);
  reader = ::open((folder_ / "pipe").c_str(), O_RDONLY | O_NONBLOCK);
  file.write("more\n", 1);
  EXPECT_EQ(file.lost(), 6u);
  std::string left;
  char bytes[4096];
  for (ssize_t got; (got = ::read(reader, bytes, sizeof bytes)) > 0;) left.append(bytes, static_cast<std::size_t>(got));
  EXPECT_EQ(left.find("more"), std::string::npos);
  ::close(reader);
  std::signal(SIGPIPE, before);
}

/// A signal that interrupts a write, and a disk that takes a part of a block, lose and repeat nothing.
TEST_F(LogFileTest, IsWrittenInPartsByADiskThatIsInterrupted) {
  for (const std::size_t most : {1u, 3u, 7u, 8u, 9u}) {
    std::filesystem::remove(folder_ / "a.log");
    LogFile file = open_log(folder_ / "a.log");
    HesitantDisk disk{.most = most};
    hesitant_disk = &disk;
    file.write("one\ntwo\n", 2);
    file.write("four\n", 1);
    hesitant_disk = nullptr;
    EXPECT_EQ(content("a.log"), "one\ntwo\nfour\n") << most;
    EXPECT_EQ(file.written(), 3u) << most;
    EXPECT_EQ(file.lost(), 0u) << most;
    EXPECT_EQ(disk.parts, static_cast<int>((8 + most - 1) / most + (5 + most - 1) / most)) << most;
  }
}

/// Without a byte written there is no part: the next block finds the file as it was.
TEST_F(LogFileTest, GoesOnAfterABlockOfWhichNothingWasWritten) {
  const auto before = std::signal(SIGPIPE, SIG_IGN);
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  int reader = ::open((folder_ / "pipe").c_str(), O_RDONLY | O_NONBLOCK);
  LogFile file = open_log(folder_ / "pipe");
  ::close(reader);
  file.write("lost\n", 2);
  EXPECT_EQ(file.lost(), 2u);
  reader = ::open((folder_ / "pipe").c_str(), O_RDONLY | O_NONBLOCK);
  file.write("kept\n", 3);
  EXPECT_EQ(file.lost(), 2u);
  EXPECT_EQ(file.written(), 3u);
  char text[16] = {};
  EXPECT_EQ(::read(reader, text, sizeof text), 5);
  EXPECT_STREQ(text, "kept\n");
  ::close(reader);
  std::signal(SIGPIPE, before);
}

TEST_F(LogFileTest, IsDrainedOnceMoreWhenItIsAskedToStop) {
  struct Writer {
    int drained = 0;
    std::stop_source* stop = nullptr;
    void drain() {
      if (++drained == 2 && stop != nullptr) stop->request_stop();
    }
  };
  std::stop_source stop;
  Writer writer{0, &stop};
  drain_until_stopped(writer, stop.get_token());
  EXPECT_EQ(writer.drained, 3);
  Writer late;
  drain_until_stopped(late, stop.get_token());
  EXPECT_EQ(late.drained, 1) << "what came before the stop";
}

TEST_F(LogFileTest, OfTheHandHasARowACycle) {
  HandLog log(open_log(folder_ / "hand.csv"));
  log.write_row(1'000'000, 0.25);
  log.write_row(2'500'000'000, -1.23456789012);
  log.close();
  EXPECT_EQ(content("hand.csv"), "t_s,hand_J\n0.001000,0.25\n2.500000,-1.23456789\n");
}

TEST_F(LogFileTest, OfTheHandRefusesADiskThatIsFull) {
  HandLog full(open_log("/dev/full"));
  for (int i = 0; i < 100; ++i) full.write_row(0, 1.0);
  try {
    full.close();
    FAIL();
  } catch (const command::Failure& failure) {
    EXPECT_EQ(failure.exit_code(), command::ExitCode::kIo);
    EXPECT_EQ(std::string(failure.what()), "/dev/full: 100 rows could not be written; check the disk");
  }
}

class RunRecordsTest : public LogFileTest {
 protected:
  static constexpr std::uint64_t kTooMany = 5;
  void fill() {
    for (std::uint64_t i = 0; i < TelemetryRing::kCapacity + kTooMany; ++i) ring_->push({});
    for (std::uint64_t i = 0; i < hal::CanLogRing::kCapacity + kTooMany + 1; ++i) bus_ring_->on_frame(0, {});
  }
  RunRecords::Setup setup(int joint_count, bool buses) const {
    return {.folder = folder_,
            .start = std::chrono::system_clock::time_point(std::chrono::seconds(1'796'049'055)),
            .format = {joint_count},
            .buses = buses,
            .bus_names = {"can0"}};
  }
  static bool is_link_to(const std::filesystem::path& link, const std::filesystem::path& target) {
    return std::filesystem::is_symlink(link) && std::filesystem::read_symlink(link) == target;
  }

  std::unique_ptr<TelemetryRing> ring_ = std::make_unique<TelemetryRing>();
  std::unique_ptr<hal::CanLogRing> bus_ring_ = std::make_unique<hal::CanLogRing>();
  const std::filesystem::path run_ = folder_ / "20261130T143055Z";
};

TEST_F(RunRecordsTest, WritesNothingWithoutAFolder) {
  RunRecords::Setup none = setup(2, true);
  none.folder.clear();
  RunRecords records(none, *ring_, *bus_ring_);
  fill();
  records.drain();
  EXPECT_FALSE(records.any());
  EXPECT_EQ(records.summary(), "");
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

TEST_F(RunRecordsTest, WritesTheTelemetryAloneUnlessTheBusesAreAskedFor) {
  RunRecords records(setup(2, false), *ring_, *bus_ring_);
  fill();
  records.drain();
  EXPECT_EQ(records.summary(),
            (run_ / "telemetry.csv").string() + ": " + std::to_string(TelemetryRing::kCapacity) + " rows, 5 lost\n");
  EXPECT_FALSE(std::filesystem::exists(run_ / "can.log"));
  const std::string text = content("telemetry.csv");
  EXPECT_EQ(static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')), 1 + TelemetryRing::kCapacity);
  EXPECT_NE(text.find(",q2_rad,qd1_rad_s,"), std::string::npos);
}

/// Without a number of joints it has none, and without a request no log of the buses.
TEST_F(RunRecordsTest, HasNoJointsAndNoBusesUnlessItIsTold) {
  RunRecords records(setup(0, false), *ring_, *bus_ring_);
  ring_->push({});
  records.drain();
  EXPECT_EQ(content("telemetry.csv").find("q1_rad"), std::string::npos);
}

/// Lines that the rings lost and lines that the disk did not take count together.
TEST_F(RunRecordsTest, CountsWhatWasLostOnTheWayAndByTheDisk) {
  RunRecords records(setup(2, true), *ring_, *bus_ring_);
  fill();
  const auto before = std::signal(SIGXFSZ, SIG_IGN);
  rlimit usual{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &usual), 0);
  const rlimit full{0, usual.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &full), 0);
  records.drain();
  ::setrlimit(RLIMIT_FSIZE, &usual);
  std::signal(SIGXFSZ, before);
  EXPECT_EQ(records.summary(), (run_ / "telemetry.csv").string() + ": 0 rows, " +
                                   std::to_string(TelemetryRing::kCapacity + 5) + " lost\n" +
                                   (run_ / "can.log").string() + ": 0 frames, " +
                                   std::to_string(hal::CanLogRing::kCapacity + 6) + " lost\n");
}

TEST_F(RunRecordsTest, DrainsBothRings) {
  RunRecords records(setup(1, true), *ring_, *bus_ring_);
  ring_->push({});
  bus_ring_->on_frame(0, {});
  records.drain();
  EXPECT_EQ(records.summary(), (run_ / "telemetry.csv").string() + ": 1 rows, 0 lost\n" + (run_ / "can.log").string() +
                                   ": 1 frames, 0 lost\n");
}

/// Readers find the newest run by links. A log that the newest run does not write is missing there, not the one of
/// another run.
TEST_F(RunRecordsTest, LeadsReadersToTheNewestRun) {
  { const RunRecords first(setup(1, true), *ring_, *bus_ring_); }
  EXPECT_TRUE(is_link_to(folder_ / "latest", run_.filename()));
  for (const char* name : {"telemetry.csv", "can.log", "can0.pcap"}) {
    EXPECT_TRUE(is_link_to(folder_ / name, std::filesystem::path("latest") / name)) << name;
    EXPECT_TRUE(std::filesystem::exists(folder_ / name)) << name;
  }
  RunRecords::Setup of_hand = setup(1, false);
  of_hand.hand = true;
  const RunRecords second(of_hand, *ring_, *bus_ring_);
  EXPECT_TRUE(is_link_to(folder_ / "latest", run_.filename().string() + "-2")) << "in the same second";
  EXPECT_EQ(content("hand.csv"), "t_s,hand_J\n");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "can.log")) << "this run has none";
  EXPECT_TRUE(std::filesystem::exists(run_ / "can.log"));
}

TEST_F(RunRecordsTest, LeavesEarlierRunsAsTheyWere) {
  const auto one_run = [&](std::int64_t t_ns) {
    TelemetryRecord record;
    record.times.deadline_ns = t_ns;
    RunRecords records(setup(1, true), *ring_, *bus_ring_);
    ring_->push(record);
    bus_ring_->on_frame(0, {{0x181, 8, false, {}}, t_ns, true});
    records.drain();
  };
  one_run(1'000'000);
  const std::vector<std::string> names{"telemetry.csv", "can.log", "can0.pcap"};
  std::vector<std::string> before;
  for (const std::string& name : names) before.push_back(content(run_ / name));
  one_run(2'000'000);
  one_run(3'000'000);
  for (std::size_t i = 0; i < names.size(); ++i) EXPECT_EQ(content(run_ / names[i]), before[i]) << names[i];
  EXPECT_EQ(content("telemetry.csv"), content(run_.string() + "-3/telemetry.csv"));
}

/// An older version overwrote whatever such a link led to.
TEST_F(RunRecordsTest, RefusesALinkOrFileInThePlaceOfALog) {
  std::ofstream(folder_ / "precious") << "kept";
  for (const bool is_link : {true, false}) {
    for (const char* name : {"telemetry.csv", "can.log", "can0.pcap"}) {
      const std::filesystem::path logs = folder_ / "logs";
      std::filesystem::create_directory(logs);
      if (is_link) std::filesystem::create_symlink("../precious", logs / name);
      if (!is_link) std::ofstream(logs / name) << "of an older version";
      RunRecords::Setup refused = setup(1, true);
      refused.folder = logs;
      try {
        const RunRecords records(refused, *ring_, *bus_ring_);
        ADD_FAILURE() << name;
      } catch (const command::Failure& failure) {
        EXPECT_EQ(failure.exit_code(), command::ExitCode::kIo);
        EXPECT_EQ(failure.what(), (logs / name).string() + ": is not a link to latest/" + name +
                                      ", perhaps a log of an older version; move it away or name another folder");
      }
      EXPECT_EQ(content("precious"), "kept");
      EXPECT_EQ(content(logs / name), is_link ? "kept" : "of an older version");
      EXPECT_FALSE(std::filesystem::exists(logs / run_.filename())) << "no run has begun";
      std::filesystem::remove_all(logs);
    }
  }
}

}  // namespace
}  // namespace godobject::firmware::log_file_test
