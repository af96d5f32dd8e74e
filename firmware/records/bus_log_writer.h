#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <stop_token>
#include <string>
#include <vector>

#include "firmware/records/log_file.h"
#include "hal/can_log_ring.h"

namespace godobject::firmware {

/// One line of a `candump -L` log, its end included: `(1400000000.123456) can0 203#0F00CEFF`, identifier and data in
/// hexadecimal digits. FD frames have `##` and a digit of flags, 1: data at the higher bit rate.
void append_candump_line(const hal::ReceivedFrame& received, const std::string& interface, std::string& text);

/// The header of a pcap file of LINKTYPE_CAN_SOCKETCAN (227) with times in nanoseconds, in this machine's byte order.
std::string pcap_header();

/// A frame as a packet of it: the kernel's can_frame (16 bytes) or canfd_frame (72), the identifier in network order.
void append_pcap_packet(const hal::ReceivedFrame& received, std::string& bytes);

/// Writes what comes through a ring to DIR/can.log, all buses in the format of `candump -L`, and to DIR/INTERFACE.pcap,
/// one a bus. A disk that is full or does not answer costs frames, which are counted, and nothing else.
class BusLogWriter {
 public:
  /// `interfaces`: the buses' names in their order. Throws command::Failure (kIo) if folder or files cannot be made.
  BusLogWriter(const std::filesystem::path& folder, const std::vector<std::string>& interfaces, hal::CanLogRing& ring);

  /// Writes what is there.
  void drain();

  /// Drains until it is asked to stop, some times a second: the thread beside the loop.
  void run(const std::stop_token& stop) { drain_until_stopped(*this, stop); }

  const std::filesystem::path& file() const noexcept { return text_file_.path(); }  ///< the one of text
  std::uint64_t written() const noexcept { return text_file_.written(); }           ///< frames in it
  std::uint64_t lost() const noexcept;  ///< frames that the disk did not take, of the file that lacks most

 private:
  struct Bus {
    Bus(const std::filesystem::path& folder, const std::string& its_name);

    std::string name;
    LogFile file;
    std::string packets;
    std::uint64_t count = 0;
  };

  void write_all();

  hal::CanLogRing& ring_;
  LogFile text_file_;
  std::string text_;
  std::uint64_t lines_ = 0;
  std::deque<Bus> buses_;
};

}  // namespace godobject::firmware
