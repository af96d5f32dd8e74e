#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace godobject::files {

/// `text` without the blanks, tabs and carriage returns around it.
std::string_view trimmed(std::string_view text);

/// Reads all of `word` as a number; a leading + is allowed, NaN and Inf are numbers (`nan`, `inf`). False if it is
/// none.
bool read_number(std::string_view word, double& value);

/// The lines of a CSV file that say something: those that are empty or begin with # are passed over, and so is the mark
/// (of UTF-8) that some programs put before the first.
class CsvLines {
 public:
  /// Throws Failure (kNoInput) if the file cannot be read.
  explicit CsvLines(const std::filesystem::path& file);

  /// The next line, trimmed, valid until the next call; false at the end. Throws Failure (kIo) if reading breaks off.
  bool next(std::string_view& content);

  std::size_t number() const { return number_; }  ///< of the last line read, from 1
  std::size_t bytes() const { return bytes_; }    ///< read so far

  /// Throws Failure (kBadData): `what` with file and line before it.
  [[noreturn]] void refuse(std::string_view what) const;

 private:
  std::filesystem::path file_;
  std::ifstream stream_;
  std::string line_;
  std::size_t number_ = 0;
  std::size_t bytes_ = 0;
};

}  // namespace godobject::files
