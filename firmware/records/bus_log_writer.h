#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <string>
#include <utility>

#include "firmware/records/log_file.h"
#include "hal/can_log_ring.h"

namespace godobject::firmware {

/// Appends one line of a `candump -L` log with its line feed: `(1400000000.123456) can0 203#0F00CEFF`, identifier and
/// data in hexadecimal digits. FD frames have `##` and a digit of flags, 1: data at the higher bit rate.
void append_candump_line(const hal::ReceivedFrame& received, const std::string& interface, std::string& text);

/// The header of a pcap file with LINKTYPE_CAN_SOCKETCAN (227) and times in nanoseconds, in this machine's byte order.
std::string pcap_header();

/// Appends a frame as a packet of that file: the kernel's can_frame (16 bytes) or canfd_frame (72 bytes), with the
/// identifier in network order.
void append_pcap_packet(const hal::ReceivedFrame& received, std::string& bytes);

/// Writes frames to can.log, all buses in the format of `candump -L`, and to INTERFACE.pcap, one file a
/// bus. A full or stalled disk costs frames, which are counted, and nothing else.
class BusLogWriter {
 public:
  static constexpr const char* kFileName = "can.log";

  /// The name of the file with the packets of an interface.
  static std::string packet_file_name(const std::string& interface) { return interface + ".pcap"; }

  /// `text`: file for the lines.
  explicit BusLogWriter(LogFile text) : text_file_(std::move(text)) {}

  /// Adds the next bus, bus 0 first. `packets`: file for its packets; writes the header.
  void add_bus(const std::string& interface, LogFile packets);

  /// Takes the next frame.
  void add(const hal::LoggedFrame& logged);

  /// Writes the frames that were added.
  void flush();

  const std::filesystem::path& file() const noexcept { return text_file_.path(); }  ///< can.log
  std::uint64_t written() const noexcept { return text_file_.written(); }           ///< frames in can.log
  std::uint64_t lost() const noexcept;  ///< frames that could not be written: of can.log or of all .pcap, the larger

 private:
  struct Bus {
    std::string name;
    LogFile file;
    std::string packets{};
    std::uint64_t count = 0;
  };

  LogFile text_file_;
  std::string text_;
  std::uint64_t lines_ = 0;
  std::deque<Bus> buses_;
};

}  // namespace godobject::firmware
