#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "toolchain/bench/chapters.h"

namespace godobject::bench {

/// Writes the results to a folder: NAME.csv for each table, NAME.png for each plot, index.html with all of them. Throws
/// Failure if a file cannot be written or gnuplot is not installed.
void write_page(const Chapter& found, const std::vector<std::pair<std::string, std::string>>& machine,
                const std::filesystem::path& folder);

}  // namespace godobject::bench
