#pragma once

#include <string>
#include <vector>

#include "toolchain/figures/statistics.h"

namespace godobject::figures {

/// One column of the table: its heading with the unit (on the page), its name (in the CSV file), an entry's value.
struct Column {
  const char* heading;
  const char* name;
  std::string (*value)(const Entry& entry);
  const char* narrow = nullptr;  ///< its heading in the table for a terminal; null: not there
};

/// scene, solver, penetration in mm and in voxels (whether it reached the band: then it is a lower bound), how far the
/// god object went behind the scene's barrier, peak force and largest step of it, peak colliding points, cycles by
/// status, times, cycles over 1 ms.
const std::vector<Column>& columns();

/// Columns, the heading of each first, as lines padded with blanks: the first two to the left, the others to the right.
std::string laid_out(const std::vector<std::vector<std::string>>& columns);

/// For a terminal of 120 characters: the narrow columns padded with blanks, headings first, then a line that explains
/// them.
std::string text_table(const std::vector<Entry>& entries);

/// The same numbers as CSV; the first line names the columns.
std::string csv_table(const std::vector<Entry>& entries);

}  // namespace godobject::figures
