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

/// A row that is missed and known to be.
struct KnownMiss {
  std::string chapter;
  std::string row;
  std::string quantity;
  double measured = 0.0;  ///< in the unit of the row; no number where none was measured
};

/// From a TOML file, one table [[missed]] each. Throws Failure (kNoInput, kBadConfig).
std::vector<KnownMiss> read_known_misses(const std::filesystem::path& file);

/// A line for each row that was computed, not timed, and is missed without being known, or by a tenth more than is
/// known.
std::vector<std::string> news(const std::vector<PageVerdict>& verdicts, const std::vector<KnownMiss>& known);

}  // namespace godobject::report
