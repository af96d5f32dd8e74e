#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <stop_token>
#include <string_view>
#include <thread>
#include <utility>

namespace godobject::firmware {

/// A log file beside the loop. A full or stalled disk costs records, which are counted, and nothing else. A block that
/// was written in part is removed, so the file always ends with a whole record.
class LogFile {
 public:
  /// `descriptor`: of the open, empty file, which this closes. `path`: its name in messages. RecordFolder::create makes
  /// such files.
  LogFile(std::filesystem::path path, int descriptor) : path_(std::move(path)), descriptor_(descriptor) {}
  ~LogFile();
  LogFile(LogFile&& other) noexcept;
  LogFile& operator=(LogFile&&) = delete;

  /// Appends a block with this number of records, whole or not at all.
  void write(std::string_view block, std::uint64_t records);

  const std::filesystem::path& path() const noexcept { return path_; }
  std::uint64_t written() const noexcept { return written_; }  ///< records
  std::uint64_t lost() const noexcept { return lost_; }        ///< records that could not be written

 private:
  std::filesystem::path path_;
  int descriptor_;        // -1: moved from
  std::size_t size_ = 0;  // of whole blocks
  bool torn_ = false;     // a partial block could not be removed; nothing more is written
  std::uint64_t written_ = 0;
  std::uint64_t lost_ = 0;
};

/// Calls `writer.drain()` every 50 ms until it is asked to stop, and once more at the end: the work of a thread beside
/// the loop.
template <class Writer>
void drain_until_stopped(Writer& writer, const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    writer.drain();
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  writer.drain();
}

}  // namespace godobject::firmware
