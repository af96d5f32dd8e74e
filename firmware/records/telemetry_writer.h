#pragma once

#include <cstdint>
#include <filesystem>
#include <stop_token>
#include <string>

#include "firmware/loop/telemetry_ring.h"
#include "firmware/records/log_file.h"

namespace godobject::firmware {

/// Writes the records of a ring to a file, telemetry.csv: a header with units, then one row a record. A full or stalled
/// disk costs rows, which are counted, and nothing else.
class TelemetryWriter {
 public:
  static constexpr const char* kFileName = "telemetry.csv";

  /// Writes the header. The ring outlives this.
  TelemetryWriter(LogFile file, int joint_count, TelemetryRing& ring);

  /// Writes all records that are in the ring.
  void drain();

  /// Drains every 50 ms until it is asked to stop: the work of a thread beside the loop.
  void run(const std::stop_token& stop) { drain_until_stopped(*this, stop); }

  const std::filesystem::path& file() const noexcept { return file_.path(); }
  std::uint64_t written() const noexcept { return file_.written(); }  ///< rows
  std::uint64_t lost() const noexcept { return file_.lost(); }        ///< rows that could not be written

 private:
  void write_rows(std::uint64_t rows);

  LogFile file_;
  int joint_count_;
  TelemetryRing& ring_;
  std::string text_;
};

}  // namespace godobject::firmware
