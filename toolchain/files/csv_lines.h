#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace godobject::files {

/// Returns `text` without the blanks, tabs and carriage returns around it.
std::string_view trimmed(std::string_view text);

/// Reads all of `word` as a number. A leading + is allowed, and so are `nan` and `inf`. False if it is no number.
bool read_number(std::string_view word, double& value);

/// The content lines of a CSV file. Skips empty lines, lines that begin with #, and the UTF-8 byte order mark.
class CsvLines {
 public:
  /// Throws Failure (kNoInput) if the file cannot be read.
  explicit CsvLines(const std::filesystem::path& file);

  /// Reads the next line, trimmed and valid until the next call. False at the end. Throws Failure (kIo) if reading
  /// fails.
  bool next(std::string_view& content);

  std::size_t number() const { return number_; }  ///< of the last line read, from 1
  std::size_t bytes() const { return bytes_; }    ///< read so far

  /// Throws Failure (kBadData): file, line and `what`.
  [[noreturn]] void refuse(std::string_view what) const;

 private:
  std::filesystem::path file_;
  std::ifstream stream_;
  std::string line_;
  std::size_t number_ = 0;
  std::size_t bytes_ = 0;
};

}  // namespace godobject::files
