#include "toolchain/report/study/known_misses.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "toolchain/files/toml_file.h"
#include "toolchain/files/toml_table.h"

namespace godobject::report {
namespace {

constexpr double kGrown = 1.1;  // processors differ in rounding

bool is_known(const PageVerdict& verdict, const std::vector<KnownMiss>& known) {
  return std::any_of(known.begin(), known.end(), [&](const KnownMiss& miss) {
    return miss.chapter == verdict.chapter && miss.row == verdict.finding.row &&
           miss.quantity == verdict.finding.what &&
           (std::isnan(miss.measured) || verdict.finding.value <= kGrown * miss.measured);
  });
}

}  // namespace

std::vector<KnownMiss> read_known_misses(const std::filesystem::path& file) {
  const toml::table root = files::parse_toml_file(file);
  files::allow_tables(root, file, {"missed"});
  std::vector<KnownMiss> known;
  for (const files::TomlTable& table : files::TomlTable::each(root, "missed", file)) {
    table.allow({"chapter", "row", "quantity", "measured"});
    constexpr double kMost = std::numeric_limits<double>::max();
    known.push_back({table.text("chapter"), table.text("row"), table.text("quantity"),
                     table.number("measured", {-kMost, kMost}, std::nan(""))});
  }
  return known;
}

std::vector<std::string> news(const std::vector<PageVerdict>& verdicts, const std::vector<KnownMiss>& known) {
  std::vector<std::string> lines;
  for (const PageVerdict& verdict : verdicts) {
    const Finding& finding = verdict.finding;
    if (finding.timed || !finding.not_judged.empty() || is_held(finding) || is_known(verdict, known)) continue;
    lines.push_back(fmt::format("{}: {}, {}: {:.4g} {}, {} ({})", verdict.chapter, finding.row, finding.what,
                                finding.value, finding.unit, verdict_text(finding), finding.where));
  }
  return lines;
}

}  // namespace godobject::report
