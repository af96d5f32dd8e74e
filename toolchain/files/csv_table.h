#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace godobject::files {

/// The numbers of a CSV file, row by row. CsvLines defines which lines count.
struct CsvTable {
  std::size_t columns = 0;
  std::vector<double> values;      ///< rows x columns
  std::vector<std::size_t> lines;  ///< the line of each row in the file, from 1

  std::size_t rows() const { return lines.size(); }
  std::span<const double> row(std::size_t i) const { return std::span(values).subspan(i * columns, columns); }
};

/// Reads a file whose first line is exactly the names `columns`. Numbers as in read_number. Throws Failure: kNoInput if
/// the file cannot be read, kBadData naming the line of an error.
CsvTable read_csv(const std::filesystem::path& file, std::span<const std::string_view> columns);

}  // namespace godobject::files
