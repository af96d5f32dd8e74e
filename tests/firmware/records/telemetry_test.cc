#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "firmware/loop/controller_run.h"
#include "firmware/loop/telemetry_ring.h"
#include "firmware/machine/worker_thread.h"
#include "firmware/records/telemetry_writer.h"
#include "sim/virtual_clock.h"
#include "tests/firmware/cycle/fake_drives.h"
#include "tests/firmware/records/open_log.h"
#include "tests/support/allocation_guard.h"
#include "tests/support/arms.h"
#include "tests/support/fault_record.h"
#include "tests/support/folder_test.h"
#include "tests/support/scene_image_builder.h"
#include "tests/support/small_scenes.h"
#include "toolchain/files/aligned_bytes.h"

namespace godobject::firmware::telemetry_test {
namespace {

class TelemetryTest : public test::FolderTest {
 protected:
  std::vector<std::string> lines() const {
    std::ifstream stream(folder_ / "telemetry.csv");
    std::vector<std::string> all;
    for (std::string line; std::getline(stream, line);) all.push_back(line);
    return all;
  }

  static TelemetryRecord record(int i) {
    TelemetryRecord record;
    record.times.deadline_ns = i * 1'000'000LL;
    record.cycle.mode = Mode::kRunning;
    record.cycle.q[1] = 0.25;
    record.cycle.absorbed = -0.125;
    record.cycle.injected_damping = 7.5;
    return record;
  }

  /// Writes all records that are in the ring.
  void drain(TelemetryWriter& writer) const {
    TelemetryRecord record;
    while (ring_->pop(record)) writer.add(record);
    writer.flush();
  }

  std::unique_ptr<TelemetryRing> ring_ = std::make_unique<TelemetryRing>();
};

TEST_F(TelemetryTest, WritesAHeaderWithUnitsAndARowARecord) {
  {
    TelemetryWriter writer(open_log(folder_ / "telemetry.csv"), {3}, 1);
    for (int i = 0; i < 100; ++i) ring_->push(record(i));
    drain(writer);
    EXPECT_EQ(writer.written(), 100u);
    EXPECT_EQ(writer.lost(), 0u);
  }
  const std::vector<std::string> all = lines();
  ASSERT_EQ(all.size(), 101u);
  const auto columns = [](const std::string& line) { return 1 + std::count(line.begin(), line.end(), ','); };
  EXPECT_EQ(columns(all[0]), 9 + 3 * 3 + 14 + 9 + 9);
  for (const std::string& line : all) EXPECT_EQ(columns(line), columns(all[0]));
  EXPECT_EQ(all[0].substr(0, 22), "t_s,late_us,compute_us");
  EXPECT_EQ(all[43].substr(0, 39), "0.042000,0.000,0.000,running,0,0,free,0");
  EXPECT_NE(all[0].find("q2_rad"), std::string::npos);
  EXPECT_TRUE(
      all[0].ends_with(",depth_m,absorbed_J,injected_Ns_per_m,fault_joint,alarm,alarm_joint,drives_limited,drives_warm,"
                       "wqw,wqx,wqy,wqz"));
  EXPECT_TRUE(all[43].ends_with(",-0.125,7.5,0,0,0,0,0,1,0,0,0"));
}

TEST_F(TelemetryTest, HasEachNumberInItsColumn) {
  TelemetryRecord record;
  record.times = {1'234'567'000, 2'500, 99'999, 3'250};
  CycleRecord& cycle = record.cycle;
  cycle.mode = Mode::kFade;
  cycle.fault = Fault::kPositionLost;
  cycle.share = 0.4;
  cycle.outcome = Outcome::kContact;
  cycle.contacts = 6;
  cycle.lost = 7;
  cycle.q.head<3>() << 1.5, -2.5, 99.0;
  cycle.qd.head<3>() << 3.5, -4.5, 99.0;
  cycle.torque.head<3>() << 5.5, -6.5, 99.0;
  cycle.H_WM = {Quaternion(0.5, -0.5, 0.25, 0.75), Vector3(0.1, 0.2, 0.3)};
  cycle.god_object_W = {Quaternion(1.0, 2.0, 3.0, 4.0), Vector3(-0.1, -0.2, -0.3)};
  cycle.F_G_R = {Vector3(11, 12, 13), Vector3(14, 15, 16)};
  cycle.penetration = 0.001;
  cycle.absorbed = -0.02;
  cycle.injected_damping = 21.0;
  cycle.limited = 0b1010001;
  cycle.warm = 0b0001011;
  cycle.temperature_lost = 0b1000010;
  cycle.fault_joint = 1;
  cycle.alarm = hal::Alarm::kForeignWrite;
  cycle.alarm_joint = 5;
  {
    TelemetryWriter writer(open_log(folder_ / "telemetry.csv"), {2, Quaternion(0.6, 0.0, -0.8, 0.0)}, 1);
    EXPECT_EQ(writer.file(), folder_ / "telemetry.csv");
    ring_->push(record);
    drain(writer);
    drain(writer);
    EXPECT_EQ(writer.written(), 1u);
  }
  const std::vector<std::string> all = lines();
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0],
            "t_s,late_us,compute_us,mode,fault,share,outcome,contacts,lost,q1_rad,q2_rad,qd1_rad_s,qd2_rad_s,"
            "torque1_Nm,torque2_Nm,dpx_m,dpy_m,dpz_m,dqw,dqx,dqy,dqz,gpx_m,gpy_m,gpz_m,gqw,gqx,gqy,gqz,fx_N,fy_N,"
            "fz_N,tx_Nm,ty_Nm,tz_Nm,depth_m,absorbed_J,injected_Ns_per_m,fault_joint,alarm,alarm_joint,drives_limited,"
            "drives_warm,wqw,wqx,wqy,wqz");
  EXPECT_EQ(all[1],
            "1.234567,2.500,3.250,fade,3,0.4,contact,6,7,1.5,-2.5,3.5,-4.5,5.5,-6.5,0.1,0.2,0.3,0.5,-0.5,0.25,0.75,"
            "-0.1,-0.2,-0.3,1,2,3,4,11,12,13,14,15,16,0.001,-0.02,21,2,8,6,3,4,0.6,0,-0.8,0");
}

TEST_F(TelemetryTest, WritesARowForSeveralCyclesOnRequest) {
  TelemetryWriter writer(open_log(folder_ / "telemetry.csv"), {1}, 7);
  for (int i = 1; i <= 121; ++i) ring_->push(record(i));
  drain(writer);
  const std::vector<std::string> all = lines();
  ASSERT_EQ(all.size(), 1u + 17u) << "cycles 7, 14, .. 119";
  for (std::size_t i = 1; i < all.size(); ++i) EXPECT_NEAR(std::stod(all[i]), 7e-3 * static_cast<double>(i), 1e-9);
}

/// Any number of rows, also at the number that one write call takes.
TEST_F(TelemetryTest, WritesEveryRowOnceWhateverTheirNumber) {
  std::int64_t next = 0;
  TelemetryWriter writer(open_log(folder_ / "telemetry.csv"), {1}, 1);
  for (const int rows : {0, 1, 63, 64, 65, 127, 128, 129, 200}) {
    for (int i = 0; i < rows; ++i) ring_->push(record(static_cast<int>(next++)));
    drain(writer);
    const std::vector<std::string> all = lines();
    ASSERT_EQ(all.size(), static_cast<std::size_t>(1 + next)) << rows;
    EXPECT_EQ(writer.written(), static_cast<std::uint64_t>(next));
    for (std::int64_t i = 0; i < next; ++i) {
      ASSERT_NEAR(std::stod(all[static_cast<std::size_t>(1 + i)]), 1e-3 * static_cast<double>(i), 1e-9) << rows;
    }
  }
}

TEST_F(TelemetryTest, CarriesEveryRecordInOrderBetweenTwoThreads) {
  constexpr int kRecords = 200'000;
  std::thread reader([&] {
    TelemetryRecord got;
    std::int64_t last = -1;
    int seen = 0;
    while (seen + static_cast<int>(ring_->lost()) < kRecords) {
      if (!ring_->pop(got)) {
        std::this_thread::yield();
        continue;
      }
      ++seen;
      ASSERT_GT(got.times.deadline_ns, last);
      ASSERT_EQ(got.cycle.q[1], 0.25);
      last = got.times.deadline_ns;
    }
  });
  for (int i = 0; i < kRecords; ++i) ring_->push(record(i));
  reader.join();
}

TEST_F(TelemetryTest, TakesNoMemoryToPush) {
  if (!test::AllocationGuard::works()) GTEST_SKIP() << "a sanitizer needs malloc for itself";
  const test::AllocationGuard guard;
  for (int i = 0; i < 10'000; ++i) ring_->push(record(i));
  EXPECT_EQ(guard.allocations(), 0);
}

TEST_F(TelemetryTest, LosesTheNewestAndCountsThemWhenNobodyReads) {
  for (int i = 0; i < 10'000; ++i) ring_->push(record(i));
  EXPECT_EQ(ring_->lost(), 10'000u - TelemetryRing::kCapacity);
  TelemetryRecord first;
  ASSERT_TRUE(ring_->pop(first));
  EXPECT_EQ(first.times.deadline_ns, 0);
}

TEST_F(TelemetryTest, CountsRowsThatAFullDiskDoesNotTake) {
  std::filesystem::create_symlink("/dev/full", folder_ / "telemetry.csv");
  TelemetryWriter writer(open_log(folder_ / "telemetry.csv"), {3}, 1);
  for (int i = 0; i < 1000; ++i) ring_->push(record(i));
  drain(writer);
  EXPECT_EQ(writer.written(), 0u);
  EXPECT_EQ(writer.lost(), 1000u);
  EXPECT_EQ(ring_->lost(), 0u);
}

/// Virtual time in which nothing else happens.
class EmptyWorld final : public sim::World {
 public:
  std::int64_t now_ns() const noexcept override { return now_ns_; }
  void advance_to(std::int64_t ns) noexcept override { now_ns_ = std::max(now_ns_, ns); }

 private:
  std::int64_t now_ns_ = 0;
};

/// Whoever takes the rows stands still for ten seconds of the loop.
TEST_F(TelemetryTest, DoesNotHoldUpTheLoopWhenTheDiskStalls) {
  constexpr std::uint64_t kCycles = 10'000;
  const test::Arm arm = test::lwr();
  const test::SceneImage image = test::ball_over_plate();
  const SceneView scene = test::open_scene(image);
  FakeDrives drives(7);
  CycleSetup cycle_setup;
  cycle_setup.scene = &scene;
  cycle_setup.arm = &arm.model;
  cycle_setup.joint_torque = &arm.parameters;
  cycle_setup.supervisor.sign_test = false;
  files::AlignedBytes memory(GodObject::least_memory_size());
  cycle_setup.memory = memory.span();
  const auto cycle = std::make_unique<ControlCycle>(cycle_setup, drives);
  ASSERT_EQ(cycle->start(), Status::kOk);

  ASSERT_EQ(::mkfifo((folder_ / "telemetry.csv").c_str(), 0600), 0);
  const int pipe = ::open((folder_ / "telemetry.csv").c_str(), O_RDONLY | O_NONBLOCK);
  ASSERT_GE(pipe, 0);
  auto writer = std::make_unique<TelemetryWriter>(open_log(folder_ / "telemetry.csv"), TelemetryFormat{7}, 1);
  struct Worker {
    std::function<void()> drain;
  };
  std::jthread beside([&](const std::stop_token& stop) {
    Worker worker{[&] { drain(*writer); }};
    drain_until_stopped(worker, stop);
  });
  EmptyWorld world;
  sim::VirtualClock clock(world);
  RunRequests requests;
  RunReport report;
  run_controller({.cycles = kCycles, .stopwatch = &clock}, clock, *cycle, requests, *ring_, report, [] {});
  EXPECT_EQ(cycle->counters().overruns + cycle->counters().skipped, 0u);
  const std::uint64_t pushed = cycle->counters().cycles;
  EXPECT_GE(pushed, kCycles);
  EXPECT_GT(ring_->lost(), pushed - TelemetryRing::kCapacity - 1000) << "a pipe takes some before it is full";

  ASSERT_EQ(::fcntl(pipe, F_SETFL, 0), 0);
  std::size_t lines = 0;
  std::thread reader([&] {
    char buffer[4096];
    for (ssize_t got; (got = ::read(pipe, buffer, sizeof buffer)) > 0;) {
      lines += static_cast<std::size_t>(std::count(buffer, buffer + got, '\n'));
    }
  });
  beside.request_stop();
  beside.join();
  EXPECT_EQ(writer->written() + writer->lost() + ring_->lost(), pushed);
  const std::uint64_t written = writer->written();
  writer.reset();
  reader.join();
  ::close(pipe);
  EXPECT_EQ(lines, 1 + written);
  const std::uint64_t overruns = cycle->counters().overruns + cycle->counters().skipped;
  godobject::test::record({.reaction = overruns == 0 && pushed >= kCycles ? "goes on" : "late",
                           .found = std::to_string(pushed - written) + " of " + std::to_string(pushed) +
                                    " rows lost, overruns " + std::to_string(overruns),
                           .after = "",
                           .cycles = -1});
}

/// Runs `work` on a worker thread and returns the text that the thread writes to stderr.
template <class Work>
std::string said_by(Work work) {
  testing::internal::CaptureStderr();
  start_worker("a worker", std::move(work)).join();
  return testing::internal::GetCapturedStderr();
}

TEST(WorkerThread, EndsAloneWithALineWhenItThrows) {
  EXPECT_EQ(said_by([](const std::stop_token&) { throw std::runtime_error("no memory"); }),
            "a worker has ended: no memory\n");
  EXPECT_EQ(said_by([](const std::stop_token&) { throw 1; }), "a worker has ended: unknown exception\n");
  EXPECT_EQ(said_by([](const std::stop_token&) {}), "");
}

TEST(WorkerThread, EndsAloneThoughNobodyReadsStderr) {
  const int kept = ::dup(STDERR_FILENO);
  const int full = ::open("/dev/full", O_WRONLY | O_CLOEXEC);
  ASSERT_GE(full, 0);
  ::dup2(full, STDERR_FILENO);
  start_worker("a worker", [](const std::stop_token&) { throw std::runtime_error("no memory"); }).join();
  ::dup2(kept, STDERR_FILENO);
  ::close(full);
  ::close(kept);
}

TEST(WorkerThread, IsAskedToStop) {
  bool stopped = false;
  {
    const std::jthread worker = start_worker("a worker", [&stopped](const std::stop_token& stop) {
      while (!stop.stop_requested()) std::this_thread::yield();
      stopped = true;
    });
  }
  EXPECT_TRUE(stopped);
}

}  // namespace
}  // namespace godobject::firmware::telemetry_test
