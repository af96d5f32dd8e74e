#pragma once

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "toolchain/report/study/study.h"

/// A row that no fault misses says nothing. These functions run a case of the study with a planted fault.
namespace godobject::report::planting {

/// Returns the names "row: quantity" of the bounds that are not in `covered`.
inline std::string without_fault(const std::vector<Bound>& bounds, const std::vector<Bound>& covered) {
  std::set<std::string> names;
  for (const Bound& bound : covered) names.insert(bound.row + ": " + bound.what);
  std::string missing;
  for (const Bound& bound : bounds) {
    if (!names.contains(bound.row + ": " + bound.what)) missing += bound.row + ": " + bound.what + "\n";
  }
  return missing;
}

/// Runs cases of a chapter, each in a folder of its own, which stays, and returns the findings of the chapter.
inline std::vector<Finding> findings(const Chapter& chapter, const std::vector<std::string>& cases,
                                     const std::filesystem::path& folder) {
  std::vector<CaseResult> results;
  results.reserve(cases.size());
  std::vector<CaseOutcome> outcomes;
  for (const std::string& name : cases) {
    const std::filesystem::path work = folder / name;
    std::filesystem::create_directories(work);  // a second run uses the images of the first
    const auto found = std::find_if(chapter.cases.begin(), chapter.cases.end(),
                                    [&](const StudyCase& study_case) { return study_case.name == name; });
    if (found == chapter.cases.end()) {
      ADD_FAILURE() << "no case " << name;
      continue;
    }
    results.push_back(found->run(work));
    outcomes.push_back({&*found, &results.back()});
  }
  std::vector<Finding> all = chapter.conclude(outcomes, folder).findings;
  EXPECT_EQ(without_bound(all, chapter.bounds), "");
  return all;
}

/// Expects that the bound is among the findings and is held or missed.
inline void expect(bool held, const Bound& bound, const std::vector<Finding>& findings) {
  const auto found = std::find_if(findings.begin(), findings.end(), [&](const Finding& finding) {
    return finding.row == bound.row && finding.what == bound.what;
  });
  if (found == findings.end()) {
    ADD_FAILURE() << bound.row << ": " << bound.what << ": not measured";
    return;
  }
  EXPECT_EQ(is_held(*found), held) << bound.row << ": " << bound.what << ": " << found->value << " " << bound.unit
                                   << ", at most " << bound.most << ", " << found->where;
}

}  // namespace godobject::report::planting
