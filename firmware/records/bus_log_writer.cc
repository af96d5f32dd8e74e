#include "firmware/records/bus_log_writer.h"

#include <linux/can.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <iterator>
#include <utility>

#include <fmt/format.h>

namespace godobject::firmware {
namespace {

constexpr std::uint64_t kFramesAtOnce = 256;  // frames a write call; chosen: some 10 KiB of text
constexpr std::int64_t kSecond_ns = 1'000'000'000;

// the pcap format, and struct can_frame and canfd_frame of linux/can.h
constexpr std::uint32_t kMagicOfNanoseconds = 0xA1B23C4D;
constexpr std::uint16_t kMajorVersion = 2;
constexpr std::uint16_t kMinorVersion = 4;
constexpr std::uint32_t kLinkTypeCanSocketcan = 227;
constexpr std::uint32_t kFrameBytes = 16;
constexpr std::uint32_t kFdFrameBytes = 72;
static_assert(kFrameBytes == sizeof(can_frame) && kFdFrameBytes == sizeof(canfd_frame));
constexpr std::uint8_t kFdHigherRate = 0x01;  // CANFD_BRS
constexpr std::uint8_t kFdFormat = 0x04;      // CANFD_FDF

template <class Number>
void append_number(Number number, std::string& bytes) {
  std::array<char, sizeof number> raw{};
  std::memcpy(raw.data(), &number, sizeof number);
  bytes.append(raw.data(), raw.size());
}

}  // namespace

void append_candump_line(const hal::ReceivedFrame& received, const std::string& interface, std::string& text) {
  const hal::CanFrame& frame = received.frame;
  auto out = std::back_inserter(text);
  fmt::format_to(out, "({:010}.{:06}) {} {:03X}#{}", received.time_ns / kSecond_ns,
                 received.time_ns % kSecond_ns / 1000, interface, frame.id, frame.fd ? "#1" : "");
  for (std::size_t i = 0; i < frame.length; ++i) fmt::format_to(out, "{:02X}", frame.data[i]);
  text += '\n';
}

std::string pcap_header() {
  std::string bytes;
  append_number(kMagicOfNanoseconds, bytes);
  append_number(kMajorVersion, bytes);
  append_number(kMinorVersion, bytes);
  append_number(std::uint32_t{0}, bytes);  // time zone
  append_number(std::uint32_t{0}, bytes);  // accuracy
  append_number(kFdFrameBytes, bytes);     // length of the longest packet
  append_number(kLinkTypeCanSocketcan, bytes);
  return bytes;
}

void append_pcap_packet(const hal::ReceivedFrame& received, std::string& bytes) {
  const hal::CanFrame& frame = received.frame;
  const std::uint32_t size = frame.fd ? kFdFrameBytes : kFrameBytes;
  append_number(static_cast<std::uint32_t>(received.time_ns / kSecond_ns), bytes);
  append_number(static_cast<std::uint32_t>(received.time_ns % kSecond_ns), bytes);
  append_number(size, bytes);
  append_number(size, bytes);

  const std::size_t begin = bytes.size();
  bytes.resize(begin + size, '\0');
  bytes[begin + 2] = static_cast<char>(frame.id >> 8);
  bytes[begin + 3] = static_cast<char>(frame.id & 0xFF);
  bytes[begin + 4] = static_cast<char>(frame.length);
  bytes[begin + 5] = static_cast<char>(frame.fd ? kFdFormat | kFdHigherRate : 0);
  std::memcpy(&bytes[begin + 8], frame.data.data(), frame.length);
}

void BusLogWriter::add_bus(const std::string& interface, LogFile packets) {
  buses_.push_back({interface, std::move(packets)});
  buses_.back().file.write(pcap_header(), 0);
}

void BusLogWriter::add(const hal::LoggedFrame& logged) {
  Bus& bus = buses_.at(static_cast<std::size_t>(logged.bus));
  append_candump_line(logged.received, bus.name, text_);
  append_pcap_packet(logged.received, bus.packets);
  ++bus.count;
  if (++lines_ == kFramesAtOnce) flush();
}

std::uint64_t BusLogWriter::lost() const noexcept {
  std::uint64_t of_buses = 0;
  for (const Bus& bus : buses_) of_buses += bus.file.lost();
  return std::max(text_file_.lost(), of_buses);
}

void BusLogWriter::flush() {
  text_file_.write(text_, lines_);
  text_.clear();
  lines_ = 0;
  for (Bus& bus : buses_) {
    if (bus.count == 0) continue;
    bus.file.write(bus.packets, bus.count);
    bus.packets.clear();
    bus.count = 0;
  }
}

}  // namespace godobject::firmware
