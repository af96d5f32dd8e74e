#pragma once

#include <string>
#include <vector>

namespace godobject::bench {

/// One table of the bench, as text, CSV and HTML show it.
struct Table {
  std::string name;                  ///< of the CSV file, without its ending
  std::string title;                 ///< a line above it
  std::vector<std::string> columns;  ///< headings, with units
  std::vector<std::vector<std::string>> rows;
  std::string note;  ///< a line below it; may be empty
};

/// For a terminal: columns padded with blanks, the first two to the left.
std::string text_of(const Table& table);

/// Headings, then rows; a field that holds a comma stands in quotes.
std::string csv_of(const Table& table);

/// Title, table, note.
std::string html_of(const Table& table);

/// Three digits or more: "0.213", "4.31", "163", "12345".
std::string digits(double value);

}  // namespace godobject::bench
