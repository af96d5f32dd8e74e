#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace godobject::command {

/// Numbers of a CSV file, row by row. Lines that are empty or begin with # are passed over.
struct CsvTable {
  std::size_t columns = 0;
  std::vector<double> values;      ///< rows x columns
  std::vector<std::size_t> lines;  ///< the file's line of each row, from 1

  std::size_t rows() const { return lines.size(); }
  std::span<const double> row(std::size_t i) const { return std::span(values).subspan(i * columns, columns); }
};

/// `text` without the blanks, tabs and carriage returns around it.
std::string_view trimmed(std::string_view text);

/// Reads a file whose first line names exactly `columns`. NaN and Inf are numbers here (`nan`, `inf`).
/// Throws Failure: kNoInput if it cannot be read, kBadData naming the line.
CsvTable read_csv(const std::filesystem::path& file, std::span<const std::string_view> columns);

}  // namespace godobject::command
