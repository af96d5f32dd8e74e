#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "firmware/loop/telemetry_ring.h"
#include "firmware/records/log_file.h"
#include "firmware/records/telemetry_rows.h"

namespace godobject::firmware {

/// Writes records to a file, telemetry.csv: a header with units, then one row a record. A full or stalled disk costs
/// rows, which are counted, and nothing else.
class TelemetryWriter {
 public:
  static constexpr const char* kFileName = "telemetry.csv";

  /// Writes the header. `every`: cycles a row.
  TelemetryWriter(LogFile file, const TelemetryFormat& format, std::uint32_t every);

  /// Takes the record of the next cycle.
  void add(const TelemetryRecord& record);

  /// Writes the rows that were added.
  void flush();

  const std::filesystem::path& file() const noexcept { return file_.path(); }
  std::uint64_t written() const noexcept { return file_.written(); }  ///< rows
  std::uint64_t lost() const noexcept { return file_.lost(); }        ///< rows that could not be written

 private:
  LogFile file_;
  TelemetryFormat format_;
  std::uint32_t every_;
  std::uint64_t cycles_ = 0;
  std::string text_;
  std::uint64_t rows_ = 0;  // in text_
};

}  // namespace godobject::firmware
