#pragma once

#include <algorithm>
#include <filesystem>
#include <string>

#include <unistd.h>

#include <gtest/gtest.h>

namespace godobject::test {

/// A test with a folder of its own: empty at the start of the test, removed at its end.
class FolderTest : public testing::Test {
 protected:
  FolderTest() : folder_(std::filesystem::path(testing::TempDir()) / name()) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~FolderTest() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  const std::filesystem::path folder_;

 private:
  static std::string name() {
    const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string("godobject_") + test.test_suite_name() + "_" + test.name() + "_" +
                       std::to_string(::getpid());     // another tree may run the same test
    std::replace(name.begin(), name.end(), '/', '_');  // of parameterised tests
    return name;
  }
};

}  // namespace godobject::test
