#include "toolchain/bench/table.h"

#include <cmath>

#include <fmt/format.h>

#include "toolchain/figures/table.h"
#include "toolchain/files/html_text.h"

namespace godobject::bench {
namespace {

std::string field(const std::string& text) {
  return text.find(',') == std::string::npos ? text : fmt::format("\"{}\"", text);
}

std::string csv_line(const std::vector<std::string>& fields) {
  std::vector<std::string> quoted;
  for (const std::string& text : fields) quoted.push_back(field(text));
  return fmt::format("{}\n", fmt::join(quoted, ","));
}

std::string html_row(const std::vector<std::string>& cells, const char* tag) {
  std::string row = "<tr>";
  for (const std::string& cell : cells) row += fmt::format("<{0}>{1}</{0}>", tag, files::html_text(cell));
  return row + "</tr>\n";
}

}  // namespace

std::string text_of(const Table& table) {
  std::vector<std::vector<std::string>> columns;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    columns.push_back({table.columns[c]});
    for (const auto& row : table.rows) columns.back().push_back(row[c]);
  }
  return table.title + "\n" + figures::laid_out(columns) + (table.note.empty() ? "" : table.note + "\n");
}

std::string csv_of(const Table& table) {
  std::string text = csv_line(table.columns);
  for (const auto& row : table.rows) text += csv_line(row);
  return text;
}

std::string html_of(const Table& table) {
  std::string text = fmt::format("<h2>{}</h2>\n<div class=\"wide\"><table>{}", files::html_text(table.title),
                                 html_row(table.columns, "th"));
  for (const auto& row : table.rows) text += html_row(row, "td");
  return text + fmt::format("</table></div>\n<p>{} <a href=\"{}.csv\">CSV</a></p>\n", files::html_text(table.note),
                            table.name);
}

std::string digits(double value) {
  if (!std::isfinite(value)) return "-";
  const double size = std::fabs(value);
  return fmt::format("{:.{}f}", value, size < 0.9995 ? 3 : size < 9.995 ? 2 : size < 99.95 ? 1 : 0);
}

}  // namespace godobject::bench
