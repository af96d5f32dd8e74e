#include "toolchain/files/input_file.h"

#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/support/folder_test.h"
#include "tests/support/ordinary_user.h"
#include "toolchain/command_line/failure.h"

namespace godobject::files {
namespace {

using command::ExitCode;
using command::Failure;

namespace fs = std::filesystem;

class InputFileTest : public test::FolderTest {
 protected:
  void SetUp() override { std::ofstream(folder_ / "there") << "x"; }

  /// Returns the message with which `file` is refused; empty if it is accepted.
  static std::string refusal(const fs::path& file, bool regular = false) {
    try {
      regular ? require_regular_input(file, "bake it") : require_input(file, "bake it");
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.exit_code(), ExitCode::kNoInput) << failure.what();
      return failure.what();
    }
    return "";
  }
};

TEST_F(InputFileTest, TakesWhatCanBeRead) {
  fs::create_symlink("there", folder_ / "link");
  for (const bool regular : {false, true}) {
    EXPECT_EQ(refusal(folder_ / "there", regular), "");
    EXPECT_EQ(refusal(folder_ / "link", regular), "");
  }
}

TEST_F(InputFileTest, SaysWhenNothingIsThere) {
  fs::create_symlink("nowhere", folder_ / "dangling");
  for (const char* name : {"absent", "absent/file", "there/file", "dangling"}) {
    const std::string file = (folder_ / name).string();
    EXPECT_EQ(refusal(file), file + ": no such file; bake it");
  }
}

TEST_F(InputFileTest, SaysWhenItIsAFolder) {
  EXPECT_EQ(refusal(folder_), folder_.string() + ": is a folder; name a file in it");
}

TEST_F(InputFileTest, TakesAPipeOnlyWhereItIsReadOnce) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(refusal(folder_ / "pipe"), "");
  EXPECT_NE(refusal(folder_ / "pipe", true).find("is a pipe or a device"), std::string::npos);
  EXPECT_NE(refusal("/dev/zero", true).find("is a pipe or a device"), std::string::npos);
}

TEST_F(InputFileTest, SaysWhenThereIsNoRight) {
  fs::permissions(folder_ / "there", fs::perms::none);
  const test::AsOrdinaryUser user;
  if (!user.holds()) GTEST_SKIP() << "not run: as the superuser, who cannot become another user here, one may read all";
  EXPECT_NE(refusal(folder_ / "there").find("no permission to read it"), std::string::npos);
}

}  // namespace
}  // namespace godobject::files
