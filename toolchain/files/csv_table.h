#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace godobject::files {

/// Numbers of a CSV file, row by row; which of its lines count is told by CsvLines.
struct CsvTable {
  std::size_t columns = 0;
  std::vector<double> values;      ///< rows x columns
  std::vector<std::size_t> lines;  ///< the file's line of each row, from 1

  std::size_t rows() const { return lines.size(); }
  std::span<const double> row(std::size_t i) const { return std::span(values).subspan(i * columns, columns); }
};

/// Reads a file whose first line names exactly `columns`; numbers as read_number takes them.
/// Throws Failure: kNoInput if it cannot be read, kBadData naming the line.
CsvTable read_csv(const std::filesystem::path& file, std::span<const std::string_view> columns);

}  // namespace godobject::files
