#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <stop_token>
#include <string_view>
#include <thread>

namespace godobject::firmware {

/// A log beside the loop. A disk that is full or does not answer costs records, which are counted, and nothing else: a
/// block that was not taken whole is taken back, so that the file ends with a whole record.
class LogFile {
 public:
  /// Makes folder and file; what it held is gone. Throws command::Failure (kIo) if that cannot be done.
  explicit LogFile(const std::filesystem::path& file);
  ~LogFile();
  LogFile(const LogFile&) = delete;
  LogFile& operator=(const LogFile&) = delete;

  /// Appends a block that carries so many records: all of it or nothing.
  void write(std::string_view block, std::uint64_t records);

  const std::filesystem::path& path() const noexcept { return path_; }
  std::uint64_t written() const noexcept { return written_; }  ///< records
  std::uint64_t lost() const noexcept { return lost_; }        ///< records that the disk did not take

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::size_t size_ = 0;  // of whole blocks
  bool torn_ = false;     // what is beyond them could not be taken back
  std::uint64_t written_ = 0;
  std::uint64_t lost_ = 0;
};

/// Calls `writer.drain()` some times a second until it is asked to stop, and once more then: the thread beside the
/// loop.
template <class Writer>
void drain_until_stopped(Writer& writer, const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    writer.drain();
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  writer.drain();
}

}  // namespace godobject::firmware
