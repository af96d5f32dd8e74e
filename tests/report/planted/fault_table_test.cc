// Each row of the table of faults is held by a record of the required reaction and missed by another one.
#include <fstream>

#include "tests/report/planted/planted.h"
#include "tests/support/folder_test.h"
#include "toolchain/report/fault_table/chapter.h"
#include "toolchain/report/fault_table/requirements.h"

namespace godobject::report {
namespace {

const char* reaction(Reaction kind) {
  switch (kind) {
    case Reaction::kGoesOn: return "goes on";
    case Reaction::kStop: return "STOP";
    case Reaction::kDrive: return "DRIVE";
    case Reaction::kRefuse: return "REFUSE";
    case Reaction::kEnd: return "ends";
  }
  return "";
}

/// The record of an injection, as its test writes it.
struct Record {
  bool passed = true;
  bool required = true;  ///< reaction
  int late = 0;          ///< cycles beyond the allowed ones
};

class FaultRows : public test::FolderTest {
 protected:
  FaultRows() {
    for (const Requirement& requirement : requirements()) {
      for (const Injection& injection : requirement.injections) std::ofstream(folder_ / injection.program) << "none";
    }
  }

  /// Returns the chapter's findings if the injections of `faulty` have this record and all others are as required.
  std::vector<Finding> findings(const std::string& faulty, const Record& record) const {
    const Chapter chapter = fault_chapter(folder_);
    CaseResult result;
    for (const Requirement& requirement : requirements()) add(requirement, {}, result);
    for (const Requirement& requirement : requirements()) {
      if (requirement.fault == faulty) add(requirement, record, result);  // the last record of a test counts
    }
    return chapter.conclude({{&chapter.cases.front(), &result}}, folder_).findings;
  }

 private:
  static void add(const Requirement& requirement, const Record& record, CaseResult& result) {
    const char* const other = requirement.kind == Reaction::kEnd ? "STOP" : "ends";
    for (const Injection& injection : requirement.injections) {
      result.sheets.push_back(
          {.name = "fault_tests",
           .columns = {"program", "test", "ran", "passed", "why_not", "reaction", "found", "after", "cycles"},
           .rows = {{injection.program, injection.test, "1", record.passed ? "1" : "0", "",
                     record.required ? reaction(requirement.kind) : other, "", "",
                     std::to_string(std::max(0, requirement.most) + record.late)}}});
    }
  }
};

TEST_F(FaultRows, AreHeldAndEachIsMissedByAnotherRecord) {
  const std::vector<Finding> sound = findings("", {});
  for (const Requirement& requirement : requirements()) {
    const Bound bound{requirement.fault, "injections with another reaction than: " + requirement.reaction, "", 0.0};
    if (requirement.injections.empty()) continue;
    planting::expect(true, bound, sound);
    planting::expect(false, bound, findings(requirement.fault, {.passed = false}));
    planting::expect(false, bound, findings(requirement.fault, {.required = false}));
    if (requirement.most >= 0) planting::expect(false, bound, findings(requirement.fault, {.late = 1}));
  }
}

TEST_F(FaultRows, HaveABoundEach) {
  std::vector<Bound> covered;
  for (const Requirement& requirement : requirements()) {
    covered.push_back({requirement.fault, "injections with another reaction than: " + requirement.reaction, "", 0.0});
  }
  EXPECT_EQ(planting::without_fault(fault_chapter(folder_).bounds, covered), "");
}

}  // namespace
}  // namespace godobject::report
