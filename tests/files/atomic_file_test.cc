#include "toolchain/files/atomic_file.h"

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/support/folder_test.h"
#include "tests/support/ordinary_user.h"
#include "toolchain/command_line/failure.h"
#include "toolchain/files/output_target.h"
#include "toolchain/files/work_folder.h"

namespace godobject::files {
namespace {

using command::ExitCode;
using command::Failure;

namespace fs = std::filesystem;

class AtomicFileTest : public test::FolderTest {
 protected:
  static void write(const fs::path& file) {
    AtomicFile output(file);
    output.write("whole");
    output.commit();
  }

  /// Expects that `file` is refused as an output of either kind, with this code and these words.
  static void expect_refusal(const fs::path& file, ExitCode code, const std::string& words) {
    const auto expect = [&](const auto& open) {
      try {
        open();
        ADD_FAILURE() << "took " << file;
      } catch (const Failure& failure) {
        EXPECT_EQ(failure.exit_code(), code) << failure.what();
        EXPECT_NE(std::string(failure.what()).find(words), std::string::npos) << failure.what();
        EXPECT_NE(std::string(failure.what()).find(file.string()), std::string::npos) << failure.what();
      }
    };
    expect([&] { output_target(file); });
    expect([&] { AtomicFile output(file); });
    expect([&] { WorkFolder output(file); });
  }
};

TEST_F(AtomicFileTest, AppearsWholeOrNotAtAll) {
  const fs::path path = folder_ / "out.txt";
  {
    AtomicFile abandoned(path);
    abandoned.write("half");
  }
  EXPECT_TRUE(fs::is_empty(folder_));
  AtomicFile file(path);
  file.write("whole");
  EXPECT_FALSE(fs::exists(path));
  file.commit();
  EXPECT_EQ(fs::file_size(path), 5u);
  expect_refusal(folder_ / "absent" / "out.txt", ExitCode::kIo, "choose a folder that exists");
  expect_refusal(path / "out.txt", ExitCode::kIo, "choose a folder that exists");
}

TEST_F(AtomicFileTest, NeedsNoFolderInTheName) {
  const fs::path before = fs::current_path();
  fs::current_path(folder_);
  write("out.txt");
  fs::current_path(before);
  EXPECT_EQ(fs::file_size(folder_ / "out.txt"), 5u);
}

TEST_F(AtomicFileTest, MakesFoldersOfOutputsWhereItMay) {
  make_output_folder(folder_ / "a" / "b");
  make_output_folder(folder_ / "a" / "b");
  EXPECT_TRUE(fs::is_directory(folder_ / "a" / "b"));
  write(folder_ / "file");
  for (const fs::path& bad : {folder_ / "file", folder_ / "file" / "below"}) {
    try {
      make_output_folder(bad);
      ADD_FAILURE() << "made " << bad;
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.exit_code(), ExitCode::kIo) << failure.what();
      EXPECT_NE(std::string(failure.what()).find(bad.string()), std::string::npos) << failure.what();
    }
  }
}

TEST_F(AtomicFileTest, ReplacesNothingButRegularFiles) {
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  expect_refusal(pipe, ExitCode::kIo, "is a pipe");
  expect_refusal("/dev/null", ExitCode::kIo, "is a device");
  expect_refusal(folder_, ExitCode::kIo, "is a folder");
  fs::create_symlink("/dev/null", folder_ / "link");
  expect_refusal(folder_ / "link", ExitCode::kIo, "is a device");
  EXPECT_TRUE(fs::is_fifo(pipe));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  write(folder_ / "old.txt");
  EXPECT_NO_THROW(write(folder_ / "old.txt"));
}

TEST_F(AtomicFileTest, FollowsLinksAndLeavesThem) {
  fs::create_directory(folder_ / "store");
  std::ofstream(folder_ / "store" / "there.txt") << "x";
  fs::create_symlink("store/there.txt", folder_ / "relative");
  fs::create_symlink(folder_ / "relative", folder_ / "chain");
  fs::create_symlink("store/new.txt", folder_ / "dangling");
  for (const char* name : {"chain", "dangling"}) {
    write(folder_ / name);
    EXPECT_TRUE(fs::is_symlink(folder_ / name)) << name;
    EXPECT_EQ(fs::file_size(folder_ / name), 5u) << name;
  }
  EXPECT_TRUE(fs::is_symlink(folder_ / "relative"));
  EXPECT_TRUE(fs::is_regular_file(folder_ / "store" / "new.txt"));

  const WorkFolder work(folder_ / "chain");
  work.write("made", "delivered");
  work.deliver("made", folder_ / "chain");
  EXPECT_TRUE(fs::is_symlink(folder_ / "chain"));
  EXPECT_EQ(fs::file_size(folder_ / "store" / "there.txt"), 9u);

  fs::create_symlink("circle", folder_ / "circle");
  expect_refusal(folder_ / "circle", ExitCode::kIo, "circle");
}

TEST_F(AtomicFileTest, TellsForbiddenFromFailed) {
  for (const int error : {EACCES, EPERM})
    EXPECT_EQ(output_failure("o", "x", error).exit_code(), ExitCode::kNoPermission);
  for (const int error : {ENOENT, ENOSPC, EIO, EROFS})
    EXPECT_EQ(output_failure("o", "x", error).exit_code(), ExitCode::kIo);
}

TEST_F(AtomicFileTest, EndsWithItsOwnCodeWhereOneMayNotWrite) {
  fs::permissions(folder_, fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_exec);
  bool bound = false;
  {
    const test::AsOrdinaryUser user;
    bound = user.holds();
    if (bound) expect_refusal(folder_ / "out.txt", ExitCode::kNoPermission, "choose a folder that you may write to");
    for (const fs::path& folder : {folder_, folder_ / "new"}) {
      try {
        if (bound) make_output_folder(folder);
        EXPECT_FALSE(bound) << "made " << folder;
      } catch (const Failure& failure) {
        EXPECT_EQ(failure.exit_code(), ExitCode::kNoPermission) << failure.what();
      }
    }
  }
  fs::permissions(folder_, fs::perms::owner_all);
  if (!bound) GTEST_SKIP() << "not run: as the superuser, who cannot become another user here, every folder is open";
}

}  // namespace
}  // namespace godobject::files
