#include "toolchain/files/csv_lines.h"

#include <csignal>
#include <fstream>
#include <string>
#include <thread>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/support/folder_test.h"
#include "toolchain/command_line/failure.h"
#include "toolchain/files/pose_path.h"
#include "toolchain/files/text_file.h"

namespace godobject::files {
namespace {

using command::ExitCode;
using command::Failure;

class CsvLinesTest : public test::FolderTest {
 protected:
  std::filesystem::path file(const std::string& text) const {
    std::ofstream(folder_ / "lines.csv", std::ios::binary) << text;
    return folder_ / "lines.csv";
  }

  /// Returns the message with which all lines are refused; empty if they are accepted.
  static std::string refusal(const std::filesystem::path& file, std::size_t most = CsvLines::kMostLines) {
    try {
      CsvLines lines(file, most);
      for (std::string_view line; lines.next(line);) {
      }
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.exit_code(), ExitCode::kBadData) << failure.what();
      return failure.what();
    }
    return "";
  }
};

/// Writes the same text into a pipe again and again until nobody reads it any more.
class EndlessPipe {
 public:
  EndlessPipe(std::filesystem::path pipe, const std::string& piece) : pipe_(std::move(pipe)) {
    std::signal(SIGPIPE, SIG_IGN);
    EXPECT_EQ(::mkfifo(pipe_.c_str(), 0600), 0);
    std::string text;
    while (text.size() < 60'000) text += piece;
    writer_ = std::thread([this, text] {
      const int descriptor = ::open(pipe_.c_str(), O_WRONLY);
      while (::write(descriptor, text.data(), text.size()) > 0) {
      }
      ::close(descriptor);
    });
  }
  ~EndlessPipe() { writer_.join(); }
  EndlessPipe(const EndlessPipe&) = delete;
  EndlessPipe& operator=(const EndlessPipe&) = delete;

 private:
  std::filesystem::path pipe_;
  std::thread writer_;
};

TEST_F(CsvLinesTest, EndWithOrWithoutALineBreak) {
  const std::string longest(CsvLines::kLongest - 1, 'x');
  for (const std::string end : {"", "\n", "\r\n", "\n\n# c\n"}) {
    CsvLines lines(file("a\n \nb\n" + longest + end));
    std::string all;
    for (std::string_view line; lines.next(line);) all += std::string(line) + "|";
    EXPECT_EQ(all, "a|b|" + longest + "|") << end.size();
    EXPECT_EQ(lines.bytes(), std::filesystem::file_size(folder_ / "lines.csv"));
  }
}

TEST_F(CsvLinesTest, AreRefusedWhereOneIsTooLong) {
  const std::string end = ":2: the line is longer than 65536 bytes; check that this is the CSV file, and end each row";
  for (const std::string& begin : {std::string(), std::string("#"), std::string(1, '\0')}) {
    const std::string text = "a\n" + begin + std::string(CsvLines::kLongest + 1, '1');
    EXPECT_NE(refusal(file(text)).find(end), std::string::npos) << begin;
    EXPECT_NE(refusal(file(text + "\nb\n")).find(end), std::string::npos) << begin;
  }
  EXPECT_NE(refusal("/dev/zero").find("/dev/zero:1: the line is longer"), std::string::npos);
  EXPECT_THROW(read_pose_path("/dev/zero", 1e-3), Failure);
}

TEST_F(CsvLinesTest, AreRefusedWhereThereAreTooManyOfAnyKind) {
  for (const std::string line : {"1\n", "\n", "# c\n", "\r\n"}) {
    const std::string three = line + line + line;
    EXPECT_EQ(refusal(file(three), 3), "") << line;
    EXPECT_NE(refusal(file(three + line), 3).find(":4: more than 3 lines are not read; split the file"),
              std::string::npos);
    EXPECT_NE(refusal(file(three + "1"), 3), "") << line;
  }
}

TEST_F(CsvLinesTest, OfAPipeAreReadAndOfAnEndlessOneRefused) {
  for (const std::string text : {"# c\n", "1,2,3\n", "1"}) {
    const EndlessPipe pipe(folder_ / ("pipe" + std::to_string(text.size())), text);
    EXPECT_NE(refusal(folder_ / ("pipe" + std::to_string(text.size()))), "") << text;
  }
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  std::thread writer([this] { std::ofstream(folder_ / "pipe") << "1\n2\n"; });
  EXPECT_EQ(refusal(folder_ / "pipe"), "");
  writer.join();
}

TEST_F(CsvLinesTest, OfATextEndAtItsLimitToo) {
  EXPECT_EQ(read_text(file("12345"), 5), "12345");
  EXPECT_THROW(read_text(file("123456"), 5), Failure);
  EXPECT_THROW(read_text("/dev/zero"), Failure);
  const EndlessPipe pipe(folder_ / "pipe", "text ");
  EXPECT_THROW(read_text(folder_ / "pipe"), Failure);
}

}  // namespace
}  // namespace godobject::files
