#include "toolchain/bench/table.h"

#include <limits>

#include <gtest/gtest.h>

#include "toolchain/bench/target.h"

namespace godobject::bench {
namespace {

const Table kTable{.name = "t",
                   .title = "Title",
                   .columns = {"what", "how", "us"},
                   .rows = {{"a, b", "<fast>", "1.00"}, {"c", "d", "10.0"}},
                   .note = "Note."};

TEST(Table, AsTextPadsItsColumns) {
  EXPECT_EQ(text_of(kTable),
            "Title\n"
            "what  how       us\n"
            "a, b  <fast>  1.00\n"
            "c     d       10.0\n"
            "Note.\n");
}

TEST(Table, AsCsvQuotesAFieldWithAComma) { EXPECT_EQ(csv_of(kTable), "what,how,us\n\"a, b\",<fast>,1.00\nc,d,10.0\n"); }

TEST(Table, AsHtmlKeepsTextFromBeingMarkup) {
  const std::string html = html_of(kTable);
  EXPECT_NE(html.find("<td>&lt;fast&gt;</td>"), std::string::npos);
  EXPECT_NE(html.find("t.csv"), std::string::npos);
}

TEST(Targets, AreHeldUpToTheFigureItself) {
  const Table table = table_of({{"time", "us", 4.0, 4.0, false},
                                {"time", "us", 4.0, 4.01, false},
                                {"ratio", "1", 100.0, 100.0, true},
                                {"ratio", "1", 100.0, 99.0, true}});
  ASSERT_EQ(table.rows.size(), 4u);
  EXPECT_EQ(table.rows[0], (std::vector<std::string>{"time", "us", "<= 4.00", "4.00", "held"}));
  EXPECT_EQ(table.rows[1].back(), "missed");
  EXPECT_EQ(table.rows[2], (std::vector<std::string>{"ratio", "1", ">= 100", "100", "held"}));
  EXPECT_EQ(table.rows[3].back(), "missed");
}

TEST(Digits, ShowsAboutThree) {
  EXPECT_EQ(digits(0.2134), "0.213");
  EXPECT_EQ(digits(0.9996), "1.00");
  EXPECT_EQ(digits(4.312), "4.31");
  EXPECT_EQ(digits(9.996), "10.0");
  EXPECT_EQ(digits(163.2), "163");
  EXPECT_EQ(digits(std::numeric_limits<double>::infinity()), "-");
}

}  // namespace
}  // namespace godobject::bench
