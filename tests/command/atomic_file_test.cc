#include "toolchain/command/atomic_file.h"

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "firmware/command/failure.h"
#include "toolchain/command/output_target.h"
#include "toolchain/command/work_folder.h"

namespace godobject::command {
namespace {

namespace fs = std::filesystem;

class AtomicFileTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              (std::string("godobject_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  static void write(const fs::path& file) {
    AtomicFile output(file);
    output.write("whole");
    output.commit();
  }

  /// With which code, and saying what, `file` is refused as an output of either kind.
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
    expect([&] { AtomicFile output(file); });
    expect([&] { WorkFolder output(file); });
  }

  fs::path folder_;
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

/// Rights do not bind the superuser: there the test acts as another user for as long as it lasts.
class AsOrdinaryUser {
 public:
  AsOrdinaryUser() : user_(::geteuid()), changed_(user_ == 0 && ::seteuid(kNobody) == 0) {}
  ~AsOrdinaryUser() {
    if (changed_ && ::seteuid(user_) != 0) std::abort();
  }
  AsOrdinaryUser(const AsOrdinaryUser&) = delete;
  AsOrdinaryUser& operator=(const AsOrdinaryUser&) = delete;

  bool holds() const { return ::geteuid() != 0; }

 private:
  static constexpr uid_t kNobody = 65534;
  uid_t user_;
  bool changed_;
};

TEST_F(AtomicFileTest, EndsWithItsOwnCodeWhereOneMayNotWrite) {
  fs::permissions(folder_, fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_exec);
  bool bound = false;
  {
    const AsOrdinaryUser user;
    bound = user.holds();
    if (bound) expect_refusal(folder_ / "out.txt", ExitCode::kNoPermission, "choose a folder that you may write to");
  }
  fs::permissions(folder_, fs::perms::owner_all);
  if (!bound) GTEST_SKIP() << "not run: as the superuser, who cannot become another user here, every folder is open";
}

}  // namespace
}  // namespace godobject::command
