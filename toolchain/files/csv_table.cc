#include "toolchain/files/csv_table.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "toolchain/command_line/failure.h"
#include "toolchain/files/csv_lines.h"

namespace godobject::files {
namespace {

using command::ExitCode;
using command::Failure;

/// Calls take(field) for each comma-separated field.
template <class Take>
void each_field(std::string_view line, const Take& take) {
  for (;;) {
    const std::size_t comma = line.find(',');
    take(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return;
    line.remove_prefix(comma + 1);
  }
}

}  // namespace

CsvTable read_csv(const std::filesystem::path& file, std::span<const std::string_view> columns) {
  CsvLines lines(file);
  CsvTable table;
  table.columns = columns.size();
  const std::string names = fmt::format("{}", fmt::join(columns, ","));

  std::string_view content;
  if (!lines.next(content)) {
    throw Failure(ExitCode::kBadData, fmt::format("{}: is empty; the first line must be \"{}\"", file.string(), names));
  }
  std::vector<std::string_view> found;
  each_field(content, [&](std::string_view name) { found.push_back(name); });
  if (!std::equal(found.begin(), found.end(), columns.begin(), columns.end()))
    lines.refuse(fmt::format("the first line must be \"{}\"", names));

  while (lines.next(content)) {
    std::size_t count = 0;
    each_field(content, [&](std::string_view field) {
      double value = 0.0;
      if (!read_number(field, value)) lines.refuse(fmt::format("\"{}\" is not a number; correct the row", field));
      table.values.push_back(value);
      ++count;
    });
    if (count != columns.size())
      lines.refuse(fmt::format("has {} fields, not {} ({}); correct the row", count, columns.size(), names));
    table.lines.push_back(lines.number());
  }
  return table;
}

}  // namespace godobject::files
