#pragma once

#include <cstdint>
#include <filesystem>
#include <stop_token>
#include <string>

#include "firmware/telemetry_ring.h"

namespace godobject::firmware {

/// Writes what comes through a ring to DIR/telemetry.csv: a header with units, then a row a record. A disk that is full
/// or does not answer costs rows, which are counted, and nothing else.
class TelemetryWriter {
 public:
  /// Throws command::Failure (kIo) if folder or file cannot be made.
  TelemetryWriter(const std::filesystem::path& folder, int joint_count, TelemetryRing& ring);
  ~TelemetryWriter();
  TelemetryWriter(const TelemetryWriter&) = delete;
  TelemetryWriter& operator=(const TelemetryWriter&) = delete;

  /// Writes what is there.
  void drain();

  /// Drains until it is asked to stop, a few times a second: the thread beside the loop.
  void run(const std::stop_token& stop);

  const std::filesystem::path& file() const noexcept { return file_; }
  std::uint64_t written() const noexcept { return written_; }  ///< rows
  std::uint64_t lost() const noexcept { return lost_; }        ///< rows that the disk did not take

 private:
  void write_rows(std::uint64_t rows);

  std::filesystem::path file_;
  int joint_count_;
  TelemetryRing& ring_;
  int descriptor_ = -1;
  std::string text_;
  bool line_is_open_ = false;  // the disk took part of a row
  std::uint64_t written_ = 0;
  std::uint64_t lost_ = 0;
};

}  // namespace godobject::firmware
