#pragma once

#include <string>
#include <vector>

namespace godobject::bench {

/// One table of the bench, as text, CSV and HTML show it.
struct Table {
  std::string name;                  ///< of the CSV file, without the extension
  std::string title;                 ///< a line above it
  std::vector<std::string> columns;  ///< headings, with units
  std::vector<std::vector<std::string>> rows;
  std::string note;  ///< a line below it; may be empty
};

/// Returns the table for a terminal: columns padded with blanks, the first two aligned left.
std::string text_of(const Table& table);

/// Returns headings and rows as CSV; a field with a comma is quoted.
std::string csv_of(const Table& table);

/// Returns title, table and note as HTML.
std::string html_of(const Table& table);

/// Formats with three digits or more: "0.213", "4.31", "163", "12345".
std::string digits(double value);

}  // namespace godobject::bench
