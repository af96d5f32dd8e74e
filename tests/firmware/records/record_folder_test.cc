#include "firmware/records/record_folder.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/support/folder_test.h"
#include "toolchain/command_line/failure.h"

namespace godobject::firmware::record_folder_test {
namespace {

namespace fs = std::filesystem;
using std::chrono::seconds;
using std::chrono::system_clock;

TEST(RunName, IsTheStartInUtc) {
  EXPECT_EQ(run_name(system_clock::time_point(seconds(0))), "19700101T000000Z");
  EXPECT_EQ(run_name(system_clock::time_point(seconds(1'796'049'055))), "20261130T143055Z");
  EXPECT_EQ(run_name(system_clock::time_point(seconds(1'709'164'799))), "20240228T235959Z");
  EXPECT_EQ(run_name(system_clock::time_point(seconds(1'709'164'800))), "20240229T000000Z");
}

/// A umask for a scope.
class Umask {
 public:
  explicit Umask(mode_t mask) : before_(::umask(mask)) {}
  ~Umask() { ::umask(before_); }
  Umask(const Umask&) = delete;
  Umask& operator=(const Umask&) = delete;

 private:
  mode_t before_;
};

class RecordFolderTest : public test::FolderTest {
 protected:
  static std::string content(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  static unsigned mode(const fs::path& path) {
    struct stat status {};
    EXPECT_EQ(::lstat(path.c_str(), &status), 0) << path;
    return status.st_mode & 07777u;
  }

  template <class Act>
  static std::string refusal(Act act) {
    try {
      act();
    } catch (const command::Failure& failure) {
      EXPECT_EQ(failure.exit_code(), command::ExitCode::kIo);
      return failure.what();
    }
    return "";
  }
};

TEST_F(RecordFolderTest, HoldsItsFiles) {
  const RecordFolder run(folder_ / "a" / "b", "run");
  EXPECT_EQ(run.path(), folder_ / "a" / "b" / "run");
  LogFile file = run.create("x.csv");
  EXPECT_EQ(file.path(), run.path() / "x.csv");
  file.write("one\n", 1);
  EXPECT_EQ(content(run.path() / "x.csv"), "one\n");
}

/// The umask takes rights away from 0640 and 0750. It adds none.
TEST_F(RecordFolderTest, IsClosedToOthersWhateverTheUmask) {
  for (const mode_t mask : {0000u, 0002u, 0022u, 0027u, 0077u}) {
    const Umask umask(mask);
    const fs::path parent = folder_ / std::to_string(mask) / "logs";
    const RecordFolder run(parent, "run");
    const LogFile file = run.create("x.csv");
    EXPECT_EQ(mode(parent.parent_path()), 0750u & ~mask) << mask;
    EXPECT_EQ(mode(parent), 0750u & ~mask) << mask;
    EXPECT_EQ(mode(run.path()), 0750u & ~mask) << mask;
    EXPECT_EQ(mode(file.path()), 0640u & ~mask) << mask;
  }
}

TEST_F(RecordFolderTest, OfATakenNameGetsANumber) {
  fs::create_directory(folder_ / "run");
  std::ofstream(folder_ / "run-2") << "a file";
  fs::create_directory(folder_ / "elsewhere");
  fs::create_symlink("elsewhere", folder_ / "run-3");
  fs::create_symlink("nothing", folder_ / "run-4");
  const RecordFolder run(folder_, "run");
  EXPECT_EQ(run.path(), folder_ / "run-5");
  const LogFile file = run.create("x.csv");
  EXPECT_TRUE(fs::is_empty(folder_ / "run"));
  EXPECT_TRUE(fs::is_empty(folder_ / "elsewhere")) << "no link is followed";
  EXPECT_FALSE(fs::exists(folder_ / "nothing"));
  EXPECT_EQ(content(folder_ / "run-2"), "a file");
}

TEST_F(RecordFolderTest, WritesIntoNoFileThatExists) {
  const RecordFolder run(folder_, "run");
  std::ofstream(folder_ / "precious") << "kept";
  std::ofstream(run.path() / "file.csv") << "kept";
  fs::create_symlink("../precious", run.path() / "link.csv");
  fs::create_symlink("../new", run.path() / "dangling.csv");
  fs::create_directory(run.path() / "folder.csv");
  for (const char* name : {"file.csv", "link.csv", "dangling.csv", "folder.csv"}) {
    EXPECT_EQ(refusal([&] { run.create(name); }),
              (run.path() / name).string() + ": cannot be written (File exists); check the folder");
  }
  EXPECT_EQ(content(folder_ / "precious"), "kept");
  EXPECT_EQ(content(run.path() / "file.csv"), "kept");
  EXPECT_FALSE(fs::exists(folder_ / "new"));
}

/// Another process puts a link in the place of the folder: the files stay in the folder that was made.
TEST_F(RecordFolderTest, KeepsToTheFolderThatItHasMade) {
  const RecordFolder run(folder_, "run");
  fs::create_directory(folder_ / "elsewhere");
  fs::rename(run.path(), folder_ / "moved");
  fs::create_symlink("elsewhere", folder_ / "run");
  const LogFile file = run.create("x.csv");
  EXPECT_TRUE(fs::is_empty(folder_ / "elsewhere"));
  EXPECT_TRUE(fs::exists(folder_ / "moved" / "x.csv"));
}

TEST_F(RecordFolderTest, SaysWhichFolderCannotBeMade) {
  std::ofstream(folder_ / "file") << "x";
  EXPECT_EQ(refusal([&] { const RecordFolder run(folder_ / "file" / "logs", "run"); }),
            (folder_ / "file" / "logs").string() + ": cannot make this folder (Not a directory); name another one");
  EXPECT_EQ(refusal([&] { const RecordFolder run(folder_ / "file", "run"); }),
            (folder_ / "file").string() + ": cannot make this folder (Not a directory); name another one");
}

/// Whoever names a folder of logs by a link of his own means its target.
TEST_F(RecordFolderTest, TakesAFolderOfLogsThatIsALink) {
  fs::create_directory(folder_ / "disk");
  fs::create_symlink("disk", folder_ / "logs");
  const RecordFolder run(folder_ / "logs", "run");
  EXPECT_TRUE(fs::is_directory(folder_ / "disk" / "run"));
}

TEST_F(RecordFolderTest, IsTheLatestOneByALinkThatIsReplaced) {
  const LatestLinks links(folder_ / "logs", {"a.csv", "b.csv"});
  EXPECT_FALSE(fs::exists(folder_ / "logs" / "a.csv")) << "no run yet";
  for (const char* name : {"one", "two"}) {
    const RecordFolder run(folder_ / "logs", name);
    run.create("a.csv").write(name, 1);
    links.point_to(run.path().filename());
    EXPECT_EQ(content(folder_ / "logs" / "a.csv"), name);
    EXPECT_FALSE(fs::exists(folder_ / "logs" / "b.csv"));
  }
  const LatestLinks again(folder_ / "logs", {"b.csv", "c.csv"});
  EXPECT_EQ(content(folder_ / "logs" / "a.csv"), "two") << "the links of another run stay";
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "logs"), {}), 6) << "2 runs, latest, 3 names";
}

TEST_F(RecordFolderTest, IsNotTheLatestOneInPlaceOfAFileOrFolder) {
  const fs::path latest = folder_ / "latest";
  const std::string words = latest.string() + ": is not a link; move it away or name another folder";
  std::ofstream(latest) << "kept";
  EXPECT_EQ(refusal([&] { const LatestLinks links(folder_, {}); }), words);
  EXPECT_EQ(content(latest), "kept");
  fs::remove(latest);
  fs::create_directory(latest);
  EXPECT_EQ(refusal([&] { const LatestLinks links(folder_, {}); }), words);
  EXPECT_TRUE(fs::is_directory(latest));
}

}  // namespace
}  // namespace godobject::firmware::record_folder_test
