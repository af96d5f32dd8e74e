#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <vector>

namespace godobject::files {

/// Returns `text` without the blanks, tabs and carriage returns around it.
std::string_view trimmed(std::string_view text);

/// Reads all of `word` as a number. A leading + is allowed, and so are `nan` and `inf`. False if it is no number.
bool read_number(std::string_view word, double& value);

/// The content lines of a CSV file or a pipe. Skips empty lines, lines that begin with #, and the UTF-8 byte order
/// mark. The memory and the time for an endless input have limits.
class CsvLines {
 public:
  static constexpr std::size_t kLongest = std::size_t{1} << 16;    ///< length of a line that is read [bytes]
  static constexpr std::size_t kMostLines = std::size_t{1} << 22;  ///< 70 minutes at 1 kHz

  /// Throws Failure (kNoInput) if the file cannot be read. `most`: number of lines that are read, skipped ones
  /// included.
  explicit CsvLines(const std::filesystem::path& file, std::size_t most = kMostLines);

  /// Reads the next line, trimmed and valid until the next call. False at the end. Throws Failure: kIo if reading
  /// fails, kBadData if the line is longer than kLongest or if there are more lines than `most`.
  bool next(std::string_view& content);

  std::size_t number() const { return number_; }  ///< of the last line read, from 1
  std::size_t bytes() const { return bytes_; }    ///< read so far

  /// Throws Failure (kBadData): file, line and `what`.
  [[noreturn]] void refuse(std::string_view what) const;

 private:
  std::filesystem::path file_;
  std::ifstream stream_;
  std::vector<char> line_;
  std::size_t most_;
  std::size_t number_ = 0;
  std::size_t bytes_ = 0;
};

}  // namespace godobject::files
