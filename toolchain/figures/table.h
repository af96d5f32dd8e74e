#pragma once

#include <string>
#include <vector>

#include "toolchain/figures/statistics.h"

namespace godobject::figures {

/// One column of the table: its heading on the page (with the unit), its name in the CSV file, and its value.
struct Column {
  const char* heading;
  const char* name;
  std::string (*value)(const Entry& entry);
  const char* narrow = nullptr;  ///< heading in the table for a terminal; null: not in that table
  bool on_phone = false;         ///< the page shows the column on a narrow screen, too
};

/// Returns the columns: scene, solver, penetration in mm and in voxels (a lower bound if it reaches the limit of the
/// stored distances), distance behind the scene's barrier, peak force and its largest step, peak number of colliding
/// points, cycles by status, times, cycles over 1 ms.
const std::vector<Column>& columns();

/// Returns the columns, each beginning with its heading, as lines padded with blanks. The first two are aligned left,
/// the others right.
std::string laid_out(const std::vector<std::vector<std::string>>& columns);

/// Returns the table for a terminal of 120 characters: headings, the narrow columns padded with blanks, and an
/// explanation of the columns.
std::string text_table(const std::vector<Entry>& entries);

/// Returns all columns as CSV; the first line names them.
std::string csv_table(const std::vector<Entry>& entries);

}  // namespace godobject::figures
