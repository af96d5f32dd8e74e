#pragma once

#include <cstdint>
#include <string>

#include "firmware/records/log_file.h"

namespace godobject::firmware {

/// Writes hand.csv, one row a cycle: the work that the simulated hand has done on the tool. Not real-time safe.
class HandLog {
 public:
  static constexpr const char* kFileName = "hand.csv";

  /// Writes the header.
  explicit HandLog(LogFile file);

  /// `work`: of the hand on the tool since the start [J].
  void write_row(std::int64_t now_ns, double work);

  /// Writes the last rows to the disk. Throws command::Failure (kIo) if the disk did not take a row.
  void close();

 private:
  void write_rows();

  LogFile file_;
  std::string text_;
  std::uint64_t rows_ = 0;
};

}  // namespace godobject::firmware
