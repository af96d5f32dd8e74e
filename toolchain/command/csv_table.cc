#include "toolchain/command/csv_table.h"

#include <charconv>
#include <fstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "toolchain/command/failure.h"

namespace godobject::command {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r";
  const std::size_t begin = text.find_first_not_of(kBlank);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlank) - begin + 1);
}

namespace {

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
  std::ifstream stream(file);
  if (!stream) throw Failure(ExitCode::kNoInput, fmt::format("{}: cannot be read; check the path", file.string()));
  CsvTable table;
  table.columns = columns.size();
  const auto refuse = [&](std::size_t line, const std::string& what) {
    throw Failure(ExitCode::kBadData, fmt::format("{}:{}: {}", file.string(), line, what));
  };

  std::string text;
  bool named = false;
  for (std::size_t line = 1; std::getline(stream, text); ++line) {
    const std::string_view content = trimmed(text);
    if (content.empty() || content.front() == '#') continue;
    if (!named) {
      std::vector<std::string_view> names;
      each_field(content, [&](std::string_view name) { names.push_back(name); });
      if (!std::equal(names.begin(), names.end(), columns.begin(), columns.end())) {
        refuse(line, fmt::format("the first line must be \"{}\"", fmt::join(columns, ",")));
      }
      named = true;
      continue;
    }
    std::size_t count = 0;
    each_field(content, [&](std::string_view field) {
      double value = 0.0;
      const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
      if (error != std::errc{} || end != field.data() + field.size()) {
        refuse(line, fmt::format("\"{}\" is not a number", field));
      }
      table.values.push_back(value);
      ++count;
    });
    if (count != columns.size())
      refuse(line, fmt::format("has {} fields, not {} ({})", count, columns.size(), fmt::join(columns, ",")));
    table.lines.push_back(line);
  }
  if (stream.bad()) throw Failure(ExitCode::kIo, fmt::format("{}: could not be read to its end", file.string()));
  if (!named) refuse(1, fmt::format("is empty; the first line must be \"{}\"", fmt::join(columns, ",")));
  return table;
}

}  // namespace godobject::command
