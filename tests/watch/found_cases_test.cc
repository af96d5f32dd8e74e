// Runs that the fuzzer has found, and that were violated once.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/folder_test.h"
#include "toolchain/report/extremes/run.h"
#include "toolchain/report/extremes/setup.h"

namespace godobject::test {
namespace {

/// Returns the names of the case files.
std::vector<std::string> found_cases() {
  std::istringstream list(GODOBJECT_FOUND_CASES);
  std::vector<std::string> names;
  for (std::string name; std::getline(list, name, ',');) names.push_back(name);
  return names;
}

class FoundCases : public FolderTest, public testing::WithParamInterface<std::string> {};

TEST_P(FoundCases, AreHeld) {
  std::ostringstream text;
  text << std::ifstream(std::filesystem::path(GODOBJECT_FOUND_FOLDER) / GetParam()).rdbuf();
  const report::Setup setup = report::read_case(text.str());
  const watch::Findings found = report::run_setup(setup, *report::make_rig(setup, folder_));
  EXPECT_EQ(found.violations(), 0) << found.first();
  EXPECT_EQ(found.cycles, setup.cycles);
}

INSTANTIATE_TEST_SUITE_P(Fuzzer, FoundCases, testing::ValuesIn(found_cases()),
                         [](const auto& file) { return std::filesystem::path(file.param).stem().string(); });

}  // namespace
}  // namespace godobject::test
