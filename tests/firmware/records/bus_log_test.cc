#include <gtest/gtest.h>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <random>
#include <regex>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "firmware/records/bus_log_writer.h"
#include "hal/can_log_ring.h"
#include "tests/firmware/records/open_log.h"
#include "tests/support/allocation_guard.h"
#include "tests/support/fault_record.h"
#include "tests/support/folder_test.h"

namespace godobject::firmware::bus_log_test {
namespace {

using hal::CanFrame;
using hal::ReceivedFrame;

constexpr std::int64_t kTime_ns = 1'700'000'000'123'456'789;

std::string candump_line(const ReceivedFrame& received, const std::string& interface) {
  std::string text;
  append_candump_line(received, interface, text);
  return text;
}

TEST(BusLog, LinesAreThoseOfCandump) {
  EXPECT_EQ(candump_line({{0x203, 4, false, {0x0F, 0x00, 0xCE, 0xFF}}, kTime_ns, true}, "vcan0"),
            "(1700000000.123456) vcan0 203#0F00CEFF\n");
  EXPECT_EQ(candump_line({{0x080, 0, false, {}}, 1'000'000, false}, "can1"), "(0000000000.001000) can1 080#\n");
  EXPECT_EQ(candump_line({{0x7FF, 8, false, {1, 2, 3, 4, 5, 6, 7, 8}}, kTime_ns, false}, "can0"),
            "(1700000000.123456) can0 7FF#0102030405060708\n");
  CanFrame fd{0x181, 12, true, {}};
  fd.data.fill(0xAB);
  EXPECT_EQ(candump_line({fd, kTime_ns, false}, "vcan0"), "(1700000000.123456) vcan0 181##1ABABABABABABABABABABABAB\n");
}

/// As libpcap's description of the file and of the link type says; numbers of the file itself are little-endian on
/// every machine that builds this.
TEST(BusLog, PcapBytesByHand) {
  const auto text_of = [](std::initializer_list<int> bytes) {
    std::string text;
    for (const int byte : bytes) text += static_cast<char>(byte);
    return text;
  };
  EXPECT_EQ(pcap_header(),
            text_of({0x4D, 0x3C, 0xB2, 0xA1, 2, 0, 4, 0, 0, 0, 0, 0, 0, 0, 0, 0, 72, 0, 0, 0, 227, 0, 0, 0}));

  std::string packet;
  append_pcap_packet({{0x203, 4, false, {0x0F, 0x00, 0xCE, 0xFF, 0x99}}, kTime_ns, true}, packet);
  // 1700000000 = 0x6553F100, 123456789 = 0x075BCD15
  EXPECT_EQ(packet, text_of({0x00, 0xF1, 0x53, 0x65, 0x15, 0xCD, 0x5B, 0x07, 16,   0, 0,    0,    16, 0, 0, 0,
                             0,    0,    0x02, 0x03, 4,    0,    0,    0,    0x0F, 0, 0xCE, 0xFF, 0,  0, 0, 0}));
  CanFrame fd{0x181, 12, true, {}};
  fd.data.fill(0xAB);
  packet.clear();
  append_pcap_packet({fd, 0, false}, packet);
  ASSERT_EQ(packet.size(), 16u + 72u);
  EXPECT_EQ(packet.substr(8, 4), text_of({72, 0, 0, 0}));
  EXPECT_EQ(packet.substr(16, 8), text_of({0, 0, 0x01, 0x81, 12, 0x05, 0, 0}));
  EXPECT_EQ(packet.substr(24, 12), std::string(12, '\xAB'));
  EXPECT_EQ(packet.substr(36), std::string(52, '\0'));
}

class BusLogTest : public test::FolderTest {
 protected:
  std::string content(const std::string& name) const {
    std::ifstream stream(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  static ReceivedFrame frame(int i) {
    ReceivedFrame received{{static_cast<std::uint16_t>(0x180 + i % 8), 8, false, {}}, i * 1'000LL, i % 2 == 0};
    std::memcpy(received.frame.data.data(), &i, sizeof i);
    return received;
  }

  /// Writes all frames that are in the ring.
  void drain(BusLogWriter& writer) const {
    hal::LoggedFrame frame;
    while (ring_->pop(frame)) writer.add(frame);
    writer.flush();
  }

  BusLogWriter writer_of(const std::vector<std::string>& interfaces) const {
    BusLogWriter writer(open_log(folder_ / BusLogWriter::kFileName));
    for (const std::string& name : interfaces) writer.add_bus(name, open_log(folder_ / (name + ".pcap")));
    return writer;
  }

  std::unique_ptr<hal::CanLogRing> ring_ = std::make_unique<hal::CanLogRing>();
};

TEST_F(BusLogTest, WritesAllBusesAsTextAndEachAsPackets) {
  {
    BusLogWriter writer = writer_of({"vcan0", "vcan1"});
    for (int i = 0; i < 1000; ++i) ring_->on_frame(i % 4 == 0 ? 1 : 0, frame(i));
    drain(writer);
    EXPECT_EQ(writer.written(), 1000u);
    EXPECT_EQ(writer.lost(), 0u);
  }
  std::string text;
  std::string first = pcap_header();
  std::string second = pcap_header();
  for (int i = 0; i < 1000; ++i) {
    append_candump_line(frame(i), i % 4 == 0 ? "vcan1" : "vcan0", text);
    append_pcap_packet(frame(i), i % 4 == 0 ? second : first);
  }
  EXPECT_EQ(content("can.log"), text);
  EXPECT_EQ(content("vcan0.pcap"), first);
  EXPECT_EQ(content("vcan1.pcap"), second);
}

/// Any number of frames, also at the number that one write call takes; a drain without frames writes nothing.
TEST_F(BusLogTest, WritesEveryFrameOnceWhateverTheirNumber) {
  BusLogWriter writer = writer_of({"vcan0", "vcan1"});
  EXPECT_EQ(writer.file(), folder_ / "can.log");
  std::string text;
  std::string first = pcap_header();
  int next = 0;
  for (const int count : {0, 1, 255, 256, 257, 511, 512, 513, 0, 2}) {
    for (int i = 0; i < count; ++i, ++next) {
      ring_->on_frame(0, frame(next));
      append_candump_line(frame(next), "vcan0", text);
      append_pcap_packet(frame(next), first);
    }
    drain(writer);
    ASSERT_EQ(content("can.log"), text) << count;
    ASSERT_EQ(content("vcan0.pcap"), first) << count;
    ASSERT_EQ(content("vcan1.pcap"), pcap_header()) << count;
    ASSERT_EQ(writer.written(), static_cast<std::uint64_t>(next));
  }
}

/// The larger of both losses: a frame that is in neither file is lost once.
TEST_F(BusLogTest, CountsAFrameThatNeitherFileHasOnce) {
  std::filesystem::create_symlink("/dev/full", folder_ / "vcan0.pcap");
  std::filesystem::create_symlink("/dev/full", folder_ / "vcan1.pcap");
  {
    BusLogWriter writer = writer_of({"vcan0", "vcan1"});
    for (int i = 0; i < 100; ++i) ring_->on_frame(i % 4 == 0 ? 1 : 0, frame(i));
    drain(writer);
    EXPECT_EQ(writer.written(), 100u);
    EXPECT_EQ(writer.lost(), 100u) << "of both buses";
  }
  std::filesystem::remove(folder_ / "can.log");
  std::filesystem::create_symlink("/dev/full", folder_ / "can.log");
  BusLogWriter writer = writer_of({"vcan0", "vcan1"});
  for (int i = 0; i < 100; ++i) ring_->on_frame(0, frame(i));
  drain(writer);
  EXPECT_EQ(writer.lost(), 100u) << "lost in both";
}

/// Reads a log back by its published format, written apart from the writer.
TEST_F(BusLogTest, EveryFrameCanBeReadBack) {
  std::mt19937 random(11);
  std::vector<ReceivedFrame> frames;
  constexpr std::uint8_t kLengths[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 20, 24, 32, 48, 64};
  for (int i = 0; i < 2000; ++i) {
    ReceivedFrame received;
    received.frame.id = static_cast<std::uint16_t>(random() % 0x800);
    received.frame.fd = random() % 2 == 0;
    received.frame.length = kLengths[random() % (received.frame.fd ? 16 : 9)];
    for (std::size_t b = 0; b < received.frame.length; ++b) {
      received.frame.data[b] = static_cast<std::uint8_t>(random());
    }
    received.time_ns = kTime_ns + i * 1'000'000LL;
    frames.push_back(received);
  }
  {
    BusLogWriter writer = writer_of({"vcan0"});
    for (const ReceivedFrame& received : frames) ring_->on_frame(0, received);
    drain(writer);
  }
  std::istringstream lines(content("can.log"));
  const std::string packets = content("vcan0.pcap");
  std::size_t at = 24;
  for (const ReceivedFrame& expected : frames) {
    std::string line;
    ASSERT_TRUE(std::getline(lines, line));
    long long seconds = 0;
    long long micros = 0;
    char interface[16];
    unsigned id = 0;
    int used = 0;
    ASSERT_EQ(std::sscanf(line.c_str(), "(%lld.%lld) %15s%n", &seconds, &micros, interface, &used), 3);
    ASSERT_EQ(std::sscanf(line.c_str() + used, " %3x#%n", &id, &used), 1);
    EXPECT_EQ(seconds * 1'000'000 + micros, expected.time_ns / 1000);
    EXPECT_EQ(id, expected.frame.id);
    const std::string digits = line.substr(line.find_last_of('#') + (expected.frame.fd ? 2 : 1));
    ASSERT_EQ(digits.size(), 2u * expected.frame.length);
    const std::size_t size = expected.frame.fd ? 72 : 16;
    ASSERT_LE(at + 16 + size, packets.size());
    for (std::size_t b = 0; b < expected.frame.length; ++b) {
      EXPECT_EQ(std::stoi(digits.substr(2 * b, 2), nullptr, 16), expected.frame.data[b]);
      EXPECT_EQ(static_cast<std::uint8_t>(packets[at + 24 + b]), expected.frame.data[b]);
    }
    at += 16 + size;
  }
  EXPECT_EQ(at, packets.size());
}

TEST_F(BusLogTest, CarriesEveryFrameInOrderBetweenTwoThreads) {
  constexpr int kFrames = 200'000;
  std::thread reader([&] {
    hal::LoggedFrame got;
    int last = -1;
    std::uint64_t seen = 0;
    while (seen + ring_->lost() < kFrames) {
      if (!ring_->pop(got)) {
        std::this_thread::yield();
        continue;
      }
      ++seen;
      int i = 0;
      std::memcpy(&i, got.received.frame.data.data(), sizeof i);
      ASSERT_GT(i, last);
      ASSERT_EQ(got.received.time_ns, i * 1'000LL);
      last = i;
    }
  });
  for (int i = 0; i < kFrames; ++i) ring_->on_frame(0, frame(i));
  reader.join();
}

TEST_F(BusLogTest, LosesTheNewestAndCountsThemWhenNobodyReads) {
  if (!test::AllocationGuard::works()) GTEST_SKIP() << "not run: heap calls are not counted under a sanitizer";
  constexpr std::uint64_t kFrames = hal::CanLogRing::kCapacity + 100;
  const test::AllocationGuard guard;
  for (std::uint64_t i = 0; i < kFrames; ++i) ring_->on_frame(0, frame(static_cast<int>(i)));
  EXPECT_EQ(guard.allocations(), 0);
  EXPECT_EQ(ring_->lost(), 100u);
  hal::LoggedFrame first;
  ASSERT_TRUE(ring_->pop(first));
  EXPECT_EQ(first.received.time_ns, 0);
}

TEST_F(BusLogTest, CountsFramesThatAFullDiskDoesNotTake) {
  std::filesystem::create_symlink("/dev/full", folder_ / "can.log");
  BusLogWriter writer = writer_of({"vcan0"});
  for (int i = 0; i < 1000; ++i) ring_->on_frame(0, frame(i));
  drain(writer);
  EXPECT_EQ(writer.written(), 0u);
  EXPECT_EQ(writer.lost(), 1000u);
  EXPECT_EQ(ring_->lost(), 0u);
  godobject::test::record({.reaction = writer.lost() + writer.written() == 1000 ? "goes on" : "loses count",
                           .found = std::to_string(writer.lost()) + " of 1000 frames lost",
                           .after = "",
                           .cycles = -1});
}

/// A file that may grow to so many bytes only, in a process of its own: its limit stays there.
TEST_F(BusLogTest, ADiskThatFillsUpLeavesWholeRecords) {
  constexpr rlim_t kRoom = 100'000;  // within a block of either file
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{kRoom, kRoom};
    if (::setrlimit(RLIMIT_FSIZE, &limit) != 0) ::_exit(2);
    BusLogWriter writer = writer_of({"vcan0"});
    for (int i = 0; i < 10'000; ++i) ring_->on_frame(0, frame(i));
    drain(writer);
    ::_exit(writer.lost() > 0 && writer.written() > 0 && writer.written() < 10'000 ? 0 : 1);
  }
  int status = -1;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
  const std::string text = content("can.log");
  EXPECT_GT(text.size(), kRoom / 2);
  EXPECT_EQ(text.back(), '\n');
  const std::string packets = content("vcan0.pcap");
  EXPECT_GT(packets.size(), kRoom / 2);
  EXPECT_EQ((packets.size() - 24) % 32, 0u);
}

// ---------------------------------------------------------------- read by a foreign program

/// Returns tshark's output for a file, one line a frame. Removes leading zeros: their number depends on the version.
std::vector<std::string> tshark(const std::filesystem::path& file, const std::string& fields) {
  const std::string command = "tshark -r '" + file.string() + "' -d can.subdissector,canopen -T fields " + fields +
                              " -E separator=, 2>/dev/null";
  std::vector<std::string> lines;
  FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return lines;
  char line[512];
  while (std::fgets(line, sizeof line, pipe) != nullptr) {
    lines.push_back(std::regex_replace(line, std::regex("0x0*([0-9a-f])"), "0x$1"));
    lines.back().pop_back();
  }
  ::pclose(pipe);
  return lines;
}

TEST_F(BusLogTest, TsharkReadsBothFormatsAsCanopen) {
  if (std::system("command -v tshark >/dev/null 2>&1") != 0) GTEST_SKIP() << "not run: no tshark";
  {
    BusLogWriter writer = writer_of({"vcan0"});
    const std::vector<ReceivedFrame> frames = {
        {{0x000, 2, false, {0x01, 0x03}}, kTime_ns, true},                                // NMT start of node 3
        {{0x080, 0, false, {}}, kTime_ns + 1'000'000, true},                              // SYNC
        {{0x083, 8, false, {0x50, 0x82, 0x11}}, kTime_ns + 2'000'000, false},             // EMCY 8250
        {{0x203, 4, false, {0x0F, 0x00, 0xCE, 0xFF}}, kTime_ns + 3'000'000, true},        // RPDO1
        {{0x603, 8, false, {0x2F, 0x60, 0x60, 0x00, 0x0A}}, kTime_ns + 4'000'000, true},  // SDO write of 6060
        {{0x583, 8, false, {0x80, 0x60, 0x60, 0x00, 0x00, 0x00, 0x02, 0x06}}, kTime_ns, false},
        {{0x703, 1, false, {0x05}}, kTime_ns + 5'000'000, false},  // heartbeat
    };
    for (const ReceivedFrame& received : frames) ring_->on_frame(0, received);
    drain(writer);
  }
  const std::string fields =
      "-e canopen.cob_id -e canopen.em.err_code -e canopen.sdo.main_idx -e canopen.sdo.abort_code -e "
      "canopen.nmt_guard.state "
      "-e _ws.malformed";
  const std::vector<std::string> expected = {"0x0,,,,,",     "0x80,,,,,",        "0x83,0x8250,,,,",
                                             "0x203,,,,,",   "0x603,,0x6060,,,", "0x583,,0x6060,0x6020000,,",
                                             "0x703,,,,0x5,"};
  EXPECT_EQ(tshark(folder_ / "vcan0.pcap", fields), expected);
  EXPECT_EQ(tshark(folder_ / "can.log", fields), expected);
  EXPECT_EQ(tshark(folder_ / "vcan0.pcap", "-e frame.time_epoch").front(), "1700000000.123456789");
}

TEST_F(BusLogTest, TsharkReadsFdFrames) {
  if (std::system("command -v tshark >/dev/null 2>&1") != 0) GTEST_SKIP() << "not run: no tshark";
  {
    BusLogWriter writer = writer_of({"vcan0"});
    CanFrame fd{0x181, 12, true, {}};
    fd.data.fill(0xAB);
    ring_->on_frame(0, {fd, kTime_ns, false});
    drain(writer);
  }
  for (const char* name : {"vcan0.pcap", "can.log"}) {
    EXPECT_EQ(tshark(folder_ / name, "-e can.id -e can.len -e canfd.flags.brs"), std::vector<std::string>{"385,12,1"})
        << name;
  }
}

}  // namespace
}  // namespace godobject::firmware::bus_log_test
