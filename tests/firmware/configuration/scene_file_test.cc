#include "firmware/configuration/scene_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

#include "tests/support/fault_record.h"
#include "tests/support/folder_test.h"
#include "tests/support/ordinary_user.h"
#include "tests/support/small_scenes.h"
#include "toolchain/command_line/failure.h"

namespace {

/// A disk under this program's files: it gives few bytes at a time, is interrupted before each, and has an end.
struct SlowDisk {
  std::size_t most = 0;  ///< bytes at a time
  off_t end = 0;         ///< no byte from here on
  int error = 0;         ///< there; 0: as at the end of a file
  bool interrupted = false;
  int reads = 0;
};
SlowDisk* slow_disk = nullptr;

}  // namespace

/// The linker takes this one before that of the C library.
extern "C" ssize_t pread(int descriptor, void* data, std::size_t size, off_t at) {
  if (slow_disk != nullptr) {
    slow_disk->interrupted = !slow_disk->interrupted && at > 0;
    if (slow_disk->interrupted || (at >= slow_disk->end && slow_disk->error != 0)) {
      errno = slow_disk->interrupted ? EINTR : slow_disk->error;
      return -1;
    }
    if (at >= slow_disk->end) return 0;
    size = std::min(size, slow_disk->most);
    ++slow_disk->reads;
  }
  return ::syscall(SYS_pread64, descriptor, data, size, at);
}

namespace godobject::firmware::scene_file_test {
namespace {

using command::ExitCode;
using command::Failure;

class SceneFileTest : public test::FolderTest {
 protected:
  void SetUp() override {
    file_ = folder_ / "a.scene";
    const auto bytes = image_.bytes();
    text_.assign(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    write(text_);
  }

  void write(const std::string& text) const { std::ofstream(file_, std::ios::binary) << text; }

  /// Exit code and message with which the file is refused.
  std::pair<ExitCode, std::string> refusal(const std::filesystem::path& file) const {
    try {
      const SceneFile scene(file);
    } catch (const Failure& failure) {
      return {failure.exit_code(), failure.what()};
    }
    return {ExitCode::kOk, ""};
  }

  test::SceneImage image_ = test::ball_over_plate();
  std::string text_;
  std::filesystem::path file_;
};

TEST_F(SceneFileTest, KeepsACopyThatLaterWritesDoNotReach) {
  const SceneFile scene(file_);
  EXPECT_EQ(scene.size(), text_.size());
  EXPECT_EQ(scene.scene().grid.voxel_size, 0.002);
  const std::size_t points = scene.scene().pointshell.size;
  const float first = *scene.scene().pointshell.x;
  write(std::string(text_.size(), 'x'));
  EXPECT_EQ(scene.scene().pointshell.size, points);
  EXPECT_EQ(*scene.scene().pointshell.x, first);
  const bool unchanged = scene.scene().pointshell.size == points && *scene.scene().pointshell.x == first;
  test::record({.reaction = unchanged ? "goes on" : "changes", .found = "a private copy", .after = "", .cycles = -1});
}

/// The locked memory of this process, as the kernel counts it [bytes].
std::size_t locked_bytes() {
  std::ifstream status("/proc/self/status");
  std::string word;
  while (status >> word && word != "VmLck:") {
  }
  std::size_t kilobytes = 0;
  EXPECT_TRUE(status >> kilobytes);
  return 1024 * kilobytes;
}

/// The user and the limit decide whether it may be locked.
TEST_F(SceneFileTest, TellsWhetherTheKernelHasLockedItsMemory) {
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_MEMLOCK, &before), 0);
  const rlimit nothing{.rlim_cur = 0, .rlim_max = before.rlim_max};
  for (const rlimit& limit : {before, nothing}) {
    ASSERT_EQ(::setrlimit(RLIMIT_MEMLOCK, &limit), 0);
    const std::size_t others = locked_bytes();
    const SceneFile scene(file_);
    EXPECT_EQ(scene.locked(), locked_bytes() >= others + scene.size()) << limit.rlim_cur;
    std::string other(scene.size(), 'x');  // as much memory of this process
    const bool may_lock = ::mlock(other.data(), other.size()) == 0;
    ::munlock(other.data(), other.size());
    EXPECT_EQ(scene.locked(), may_lock) << limit.rlim_cur;
  }
  ASSERT_EQ(::setrlimit(RLIMIT_MEMLOCK, &before), 0);
}

TEST_F(SceneFileTest, RefusesWhatIsNoRegularFile) {
  EXPECT_EQ(refusal(folder_ / "nothing").first, ExitCode::kNoInput);
  EXPECT_EQ(refusal(folder_).first, ExitCode::kNoInput);
  std::filesystem::create_symlink(file_, folder_ / "link");
  EXPECT_EQ(refusal(folder_ / "link").first, ExitCode::kNoInput);
  EXPECT_NE(refusal(folder_ / "link").second.find("symbolic link"), std::string::npos);
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(refusal(folder_ / "pipe").first, ExitCode::kNoInput) << "and does not wait for a writer";
  EXPECT_EQ(refusal("/dev/zero").first, ExitCode::kNoInput);
}

TEST_F(SceneFileTest, RefusesWhatMayNotBeRead) {
  std::filesystem::permissions(file_, std::filesystem::perms::none);
  const test::AsOrdinaryUser user;
  if (!user.holds()) GTEST_SKIP() << "rights do not bind this user, who cannot become another";
  EXPECT_EQ(refusal(file_).first, ExitCode::kNoPermission);
}

/// There the first file that is opened gets the number 0.
TEST_F(SceneFileTest, IsReadByAProcessWithoutStandardInput) {
  const int input = ::dup(STDIN_FILENO);
  ::close(STDIN_FILENO);
  const auto [code, words] = refusal(file_);
  const bool closed = ::fcntl(STDIN_FILENO, F_GETFD) < 0;
  if (input >= 0) {
    ::dup2(input, STDIN_FILENO);
    ::close(input);
  }
  EXPECT_EQ(code, ExitCode::kOk) << words;
  EXPECT_TRUE(closed) << "the file is not needed once it is copied";
}

TEST_F(SceneFileTest, RefusesEveryTruncationAndFlippedBits) {
  for (std::size_t size = text_.size(); size-- > 0;) {
    ASSERT_EQ(::truncate(file_.c_str(), static_cast<off_t>(size)), 0);
    ASSERT_EQ(refusal(file_).first, ExitCode::kBadData) << size;
  }
  for (std::size_t bit = 0; bit < 8 * text_.size(); bit += 1 + 8 * text_.size() / 200) {
    std::string flipped = text_;
    flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << (bit % 8)));
    write(flipped);
    ASSERT_EQ(refusal(file_).first, ExitCode::kBadData) << bit;
  }
  write(text_ + "x");
  const auto [code, words] = refusal(file_);
  EXPECT_EQ(code, ExitCode::kBadData);
  test::record_start(static_cast<int>(code), "all of " + std::to_string(text_.size()) + " lengths, 200 flipped bits");
}

/// The checksum of the image covers every byte.
TEST_F(SceneFileTest, IsReadInPartsByASlowDisk) {
  const auto size = static_cast<off_t>(text_.size());
  for (const std::size_t most : {sizeof(format::Header), sizeof(format::Header) + 1, text_.size() - 1, text_.size()}) {
    SlowDisk disk{.most = most, .end = size};
    slow_disk = &disk;
    EXPECT_EQ(refusal(file_).second, "") << most;
    slow_disk = nullptr;
    EXPECT_EQ(disk.reads, 1 + static_cast<int>((text_.size() + most - 1) / most)) << "the header, and each part once";
  }
  for (const int error : {0, EIO}) {
    SlowDisk disk{.most = sizeof(format::Header), .end = 0, .error = error};  // its end: where the last part begins
    disk.end = static_cast<off_t>(sizeof(format::Header)) * ((size - 1) / static_cast<off_t>(sizeof(format::Header)));
    slow_disk = &disk;
    const auto [code, words] = refusal(file_);
    slow_disk = nullptr;
    EXPECT_EQ(code, ExitCode::kIo) << error;
    EXPECT_NE(words.find("cannot be read; check the disk"), std::string::npos) << words;
  }
}

TEST_F(SceneFileTest, RefusesAnotherVersion) {
  auto& header = *reinterpret_cast<format::Header*>(image_.bytes().data());
  ++header.version;
  header.checksum = 0;
  header.checksum = format::checksum(image_.bytes().data(), header.header_bytes);
  const auto bytes = image_.bytes();
  write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  const auto [code, words] = refusal(file_);
  EXPECT_EQ(code, ExitCode::kBadData);
  EXPECT_NE(words.find("version"), std::string::npos) << words;
  test::record_start(static_cast<int>(code), words.substr(words.find(": ") + 2));
}

/// The first bytes tell another file from a damaged image, whatever its length.
TEST_F(SceneFileTest, CallsWhatBeginsInAnotherWayOrIsTooShortNoSceneImage) {
  std::string other = text_;  // of the length that its header tells
  other[0] = 'g';
  for (const std::string& text : {other, std::string(), std::string("solid bunny\n"), std::string(100'000, 'x'),
                                  text_.substr(0, 8), text_.substr(0, sizeof(format::Header) - 1)}) {
    write(text);
    const auto [code, words] = refusal(file_);
    EXPECT_EQ(code, ExitCode::kBadData);
    EXPECT_NE(words.find("a.scene: is not a scene image; compile the scene again"), std::string::npos) << words;
  }
  write(text_.substr(0, sizeof(format::Header)));
  const auto [code, words] = refusal(file_);
  EXPECT_EQ(code, ExitCode::kBadData);
  EXPECT_NE(words.find("a.scene: the scene image is truncated"), std::string::npos) << words;
}

TEST_F(SceneFileTest, RefusesWhatIsHugeWithoutTakingMemory) {
  std::filesystem::resize_file(file_, std::uintmax_t{1} << 40);  // a hole
  const auto [code, words] = refusal(file_);
  EXPECT_EQ(code, ExitCode::kBadData);
  EXPECT_NE(words.find("a.scene: is larger than 1 GiB; compile the scene again"), std::string::npos) << words;
  test::record_start(static_cast<int>(code), words.substr(words.find(": ") + 2));
}

/// The length decides before anything else is looked at: a hole without a header, of the largest size and a byte more.
TEST_F(SceneFileTest, NamesTheLengthOfWhatIsLargerThanAnyImage) {
  ASSERT_EQ(SceneFile::kLargest, std::size_t{1} << 30);
  write("");
  for (const std::size_t more : {0u, 1u}) {
    std::filesystem::resize_file(file_, SceneFile::kLargest + more);
    const auto [code, words] = refusal(file_);
    EXPECT_EQ(code, ExitCode::kBadData);
    const char* why = more == 0 ? "a.scene: is not a scene image;" : "a.scene: is larger than 1 GiB;";
    EXPECT_NE(words.find(why), std::string::npos) << words;
  }
}

/// The file is a hole of 1 GiB behind its header; this process may take half of that.
TEST_F(SceneFileTest, RefusesWhatDoesNotFitIntoTheMemory) {
  auto header = *reinterpret_cast<const format::Header*>(image_.bytes().data());
  header.total_bytes = SceneFile::kLargest;
  write({reinterpret_cast<const char*>(&header), sizeof header});
  std::filesystem::resize_file(file_, SceneFile::kLargest);
  rlim_t pages = 0;
  ASSERT_TRUE(std::ifstream("/proc/self/statm") >> pages);
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_AS, &before), 0);
  rlimit small = before;
  small.rlim_cur =
      std::min<rlim_t>(before.rlim_cur, pages * static_cast<rlim_t>(::getpagesize()) + SceneFile::kLargest / 2);
  ASSERT_EQ(::setrlimit(RLIMIT_AS, &small), 0);
  const auto [code, words] = refusal(file_);
  ASSERT_EQ(::setrlimit(RLIMIT_AS, &before), 0);
  EXPECT_EQ(code, ExitCode::kBadData);
  EXPECT_NE(words.find("a.scene: does not fit into the memory"), std::string::npos) << words;
}

TEST_F(SceneFileTest, RefusesALengthThatItsHeaderDoesNotTell) {
  std::filesystem::resize_file(file_, SceneFile::kLargest);  // its header still tells the true size
  EXPECT_EQ(refusal(file_).first, ExitCode::kBadData);
}

}  // namespace
}  // namespace godobject::firmware::scene_file_test
