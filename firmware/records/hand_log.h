#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>

namespace godobject::firmware {

/// Writes FOLDER/hand.csv, one row a cycle: the work that the simulated hand has done on the tool. Not real-time safe.
class HandLog {
 public:
  /// Makes the file. Throws command::Failure (kIo) if it cannot be written.
  explicit HandLog(const std::filesystem::path& folder);

  /// `work`: of the hand on the tool since the start [J].
  void write_row(std::int64_t now_ns, double work);

  /// Writes the last rows to the disk. Throws command::Failure (kIo) if the file could not be written.
  void close();

 private:
  void check() const;

  std::filesystem::path file_;
  std::ofstream stream_;
};

}  // namespace godobject::firmware
