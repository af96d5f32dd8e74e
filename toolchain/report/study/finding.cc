#include "toolchain/report/study/finding.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

namespace godobject::report {
namespace {

constexpr std::size_t kNamed = 4;  ///< rows in a sentence

/// Returns 2 for missed, 1 for not judged, 0 for held.
int rank(const Finding& finding) {
  if (!finding.not_judged.empty()) return 1;
  return is_held(finding) ? 0 : 2;
}

bool is_worse(const Finding& a, const Finding& b) {
  if (rank(a) != rank(b)) return rank(a) > rank(b);
  if (std::isnan(a.value) != std::isnan(b.value)) return std::isnan(a.value);
  return a.value > b.value;
}

}  // namespace

bool is_held(const Finding& finding) {
  return finding.not_judged.empty() && (!finding.most || finding.value <= *finding.most);
}

std::string verdict_text(const Finding& finding) {
  if (!finding.not_judged.empty()) return finding.not_judged;
  if (!finding.most) return "-";
  if (std::isnan(finding.value)) return "missed: no number";
  if (is_held(finding)) return "held";
  const std::string unit = finding.unit.empty() ? "" : " " + finding.unit;
  return fmt::format("missed by {:.2g}{}", finding.value - *finding.most, unit);
}

std::vector<Finding> worst_of(const std::vector<Finding>& findings) {
  std::vector<Finding> worst;
  for (const Finding& finding : findings) {
    const auto same = std::find_if(worst.begin(), worst.end(), [&](const Finding& other) {
      return other.row == finding.row && other.what == finding.what;
    });
    if (same == worst.end()) {
      worst.push_back(finding);
    } else if (is_worse(finding, *same)) {
      *same = finding;
    }
  }
  return worst;
}

std::string summary(const std::vector<Finding>& findings) {
  std::size_t judged = 0;
  std::size_t held = 0;
  std::map<std::string, std::vector<std::string>> others;
  for (const Finding& finding : findings) {
    if (!finding.most && finding.not_judged.empty()) continue;
    ++judged;
    if (is_held(finding)) {
      ++held;
    } else {
      others[finding.not_judged.empty() ? "missed" : finding.not_judged].push_back(finding.row + ": " + finding.what);
    }
  }
  std::string text = fmt::format("{} rows: {} held", judged, held);
  for (const auto& [verdict, rows] : others) {
    // names all missed rows, and some of the others
    const std::size_t named = verdict == "missed" ? rows.size() : std::min(kNamed, rows.size());
    text += fmt::format(", {} {} ({}", rows.size(), verdict,
                        fmt::join(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(named), "; "));
    text += named < rows.size() ? fmt::format("; and {} more)", rows.size() - named) : ")";
  }
  return text;
}

}  // namespace godobject::report
