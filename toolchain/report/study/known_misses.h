#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "toolchain/report/study/finding.h"

namespace godobject::report {

/// A finding on the page.
struct PageVerdict {
  std::string chapter;
  Finding finding;
};

/// A row that is known to be missed.
struct KnownMiss {
  std::string chapter;
  std::string row;
  std::string quantity;
  double measured = 0.0;  ///< in the unit of the row; NaN if no value was measured
};

/// Reads the known misses from a TOML file, one table [[missed]] each. Throws Failure (kNoInput, kBadConfig).
std::vector<KnownMiss> read_known_misses(const std::filesystem::path& file);

/// Returns a line for each computed row that is missed and not known, or missed by a tenth more than known. Rows that
/// depend on run times do not count.
std::vector<std::string> news(const std::vector<PageVerdict>& verdicts, const std::vector<KnownMiss>& known);

}  // namespace godobject::report
