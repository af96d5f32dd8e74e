// The table of faults: verdicts, and reading of the tests' results.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include "tests/support/folder_test.h"
#include "toolchain/command_line/failure.h"
#include "toolchain/report/fault_table/results.h"

namespace godobject::report {
namespace {

Requirement stop_within(int cycles) {
  return {.fault = "f", .reaction = "STOP", .kind = Reaction::kStop, .most = cycles, .injections = {}};
}

TestResult seen(const std::string& reaction, int cycles) {
  return {.test = "A.b", .ran = true, .passed = true, .reaction = reaction, .cycles = cycles};
}

TEST(FaultTable, HoldsWhatIsAsRequiredAndInTime) {
  EXPECT_EQ(judge(stop_within(8), seen("STOP", 8)), FaultVerdict::kHeld);
  EXPECT_EQ(judge(stop_within(8), seen("FADE, STOP", 7)), FaultVerdict::kHeld);
  EXPECT_EQ(judge(stop_within(8), seen("STOP", 9)), FaultVerdict::kMissed);
  EXPECT_EQ(judge(stop_within(8), seen("STOP", -1)), FaultVerdict::kMissed) << "never";
  EXPECT_EQ(judge(stop_within(8), seen("goes on", -1)), FaultVerdict::kMissed);
  EXPECT_EQ(judge(stop_within(-1), seen("STOP", -1)), FaultVerdict::kHeld) << "not counted in cycles";
  TestResult failed = seen("STOP", 1);
  failed.passed = false;
  EXPECT_EQ(judge(stop_within(8), failed), FaultVerdict::kMissed);
  failed.ran = false;
  EXPECT_EQ(judge(stop_within(8), failed), FaultVerdict::kNotRun);
  EXPECT_EQ(judge(stop_within(8), {}), FaultVerdict::kNotCovered);
  EXPECT_FALSE(is(Reaction::kGoesOn, "renders less"));
  EXPECT_FALSE(is(Reaction::kRefuse, "starts"));
}

TEST(FaultTable, HasEachRowAndInjectionOnce) {
  std::set<std::string> faults;
  std::set<std::string> injections;
  for (const Requirement& requirement : requirements()) {
    EXPECT_TRUE(faults.insert(requirement.fault).second) << requirement.fault;
    for (const Injection& injection : requirement.injections) {
      EXPECT_TRUE(injections.insert(requirement.fault + injection.program + injection.test).second) << injection.test;
    }
  }
}

class FaultResultsTest : public test::FolderTest {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_ / "hil" / "can"); }

  std::vector<TestResult> read(const std::string& tests) const {
    std::ofstream(folder_ / "r.json") << R"({"testsuites": [{"testsuite": [)" << tests << "]}]}";
    return read_test_results(folder_ / "r.json");
  }
};

TEST_F(FaultResultsTest, ReadWhatATestSays) {
  const auto results = read(
      R"({"name": "StopsInTime/a_b", "classname": "Rows/X", "status": "RUN", "result": "COMPLETED",
          "fault_reaction": "STOP", "fault_found": "one\n\"two\"\n", "fault_after": "x", "fault_cycles": "3"},
         {"name": "skips", "classname": "Y", "status": "RUN", "result": "SKIPPED"},
         {"name": "silent", "classname": "Y", "status": "RUN", "result": "COMPLETED"},
         {"name": "fails", "classname": "Y", "status": "RUN", "result": "COMPLETED", "fault_reaction": "STOP",
          "failures": [{"failure": "file.cc:1\nExpected", "type": ""}]},
         {"name": "DISABLED_off", "classname": "Y", "status": "NOTRUN", "result": "SUPPRESSED"})");
  ASSERT_EQ(results.size(), 5u);
  EXPECT_EQ(results[0].test, "Rows/X.StopsInTime/a_b");
  EXPECT_TRUE(results[0].passed);
  EXPECT_EQ(results[0].found, "one \"two\"");
  EXPECT_EQ(results[0].cycles, 3);
  EXPECT_FALSE(results[1].ran);
  EXPECT_FALSE(results[2].passed) << "it has recorded nothing";
  EXPECT_FALSE(results[3].passed);
  EXPECT_EQ(results[3].why_not, "file.cc:1 Expected");
  EXPECT_FALSE(results[4].ran);

  const std::vector<FaultRow> rows{
      {.requirement = stop_within(8), .result = results[0], .verdict = FaultVerdict::kHeld},
      {.requirement = stop_within(8)}};
  EXPECT_NE(fault_csv(rows).find("f,STOP,8,a b,unit,Rows/X.StopsInTime/a_b,STOP,\"one \"\"two\"\"\",3,x,held\n"),
            std::string::npos)
      << fault_csv(rows);
  EXPECT_NE(fault_page(rows, "<here>").find("&lt;here&gt;"), std::string::npos);
  EXPECT_EQ(fault_summary(rows), "1 rows, 2 injections: 0 rows held, 1 not covered (f)") << "as good as its worst";
}

TEST_F(FaultResultsTest, AreRefusedWhereTheyAreNone) {
  EXPECT_THROW(read("{"), command::Failure);
  EXPECT_THROW(read(R"({"name": 5})"), command::Failure);
  EXPECT_THROW(read_test_results(folder_ / "nothing.json"), command::Failure);
}

TEST_F(FaultResultsTest, OfTheVirtualMachineAreThoseItHasLeft) {
  EXPECT_FALSE(read_hil_case(folder_, "killed").ran);
  std::ofstream(folder_ / "hil/can/killed.code") << "0\n";
  std::ofstream(folder_ / "hil/can/killed.log") << "x\nc: stopped: why\n";
  EXPECT_TRUE(read_hil_case(folder_, "killed").passed);
  EXPECT_EQ(read_hil_case(folder_, "killed").found, "c: stopped: why");
  std::ofstream(folder_ / "hil/can/killed.code") << "77\n";
  EXPECT_FALSE(read_hil_case(folder_, "killed").ran);
  std::ofstream(folder_ / "hil/can/killed.code") << "1\n";
  EXPECT_TRUE(read_hil_case(folder_, "killed").ran);
  EXPECT_FALSE(read_hil_case(folder_, "killed").passed);
}

}  // namespace
}  // namespace godobject::report
