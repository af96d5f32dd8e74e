#include "toolchain/files/csv_table.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "tests/support/folder_test.h"
#include "toolchain/command_line/failure.h"

namespace godobject::files {
namespace {

using command::ExitCode;
using command::Failure;

class CommandFiles : public test::FolderTest {
 protected:
  std::filesystem::path file(const std::string& text) const {
    std::ofstream(folder_ / "table.csv", std::ios::binary) << text;
    return folder_ / "table.csv";
  }

  /// Returns the message with which `text` is refused; empty if it is accepted.
  std::string refusal(const std::string& text, ExitCode expected) const {
    try {
      read_csv(file(text), kColumns);
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.exit_code(), expected);
      return failure.what();
    }
    return {};
  }

  static constexpr std::array<std::string_view, 3> kColumns = {"a", "b", "c"};
};

TEST_F(CommandFiles, CsvIsReadWithItsLineNumbers) {
  const CsvTable table = read_csv(file("# made by hand\r\na, b ,c\r\n1,2e-3,-3\r\n\r\nnan,inf,-inf\r\n"), kColumns);
  ASSERT_EQ(table.rows(), 2u);
  EXPECT_EQ(table.lines[0], 3u);
  EXPECT_EQ(table.lines[1], 5u);
  EXPECT_DOUBLE_EQ(table.row(0)[1], 2e-3);
  EXPECT_TRUE(std::isnan(table.row(1)[0]));
  EXPECT_TRUE(std::isinf(table.row(1)[2]));
}

TEST_F(CommandFiles, CsvMayBeginWithAByteOrderMarkAndNumbersWithAPlus) {
  const CsvTable table = read_csv(file("\xef\xbb\xbf"
                                       "a,b,c\n+1,+2.5e1,-3\n"),
                                  kColumns);
  ASSERT_EQ(table.rows(), 1u);
  EXPECT_EQ(table.row(0)[0], 1.0);
  EXPECT_EQ(table.row(0)[1], 25.0);
  for (const char* const bad : {"+-1", "++1", "+", "-+1"}) {
    EXPECT_NE(refusal("a,b,c\n1,2," + std::string(bad) + "\n", ExitCode::kBadData).find("is not a number"),
              std::string::npos)
        << bad;
  }
}

TEST_F(CommandFiles, CsvThatIsWrongIsRefusedByLine) {
  EXPECT_NE(
      refusal("a,b,c\n1,2,3\n1,x,3\n", ExitCode::kBadData).find("table.csv:3: \"x\" is not a number; correct the row"),
      std::string::npos);
  EXPECT_NE(refusal("a,b,c\n1,2\n", ExitCode::kBadData).find(":2: has 2 fields, not 3 (a,b,c); correct the row"),
            std::string::npos);
  EXPECT_NE(refusal("a,b,c\n1,2,3,\n", ExitCode::kBadData).find(":2: \"\" is not a number"), std::string::npos);
  EXPECT_NE(refusal("a,c,b\n", ExitCode::kBadData).find(":1: the first line must be \"a,b,c\""), std::string::npos);
  EXPECT_NE(refusal("", ExitCode::kBadData).find("is empty"), std::string::npos);
  EXPECT_THROW(read_csv(folder_ / "absent.csv", kColumns), Failure);
}

}  // namespace
}  // namespace godobject::files
