#include "toolchain/command_line/progress.h"

#include <string>

#include <gtest/gtest.h>

namespace godobject::command {
namespace {

using namespace std::chrono_literals;

TEST(ProgressText, LeavesNoLineOfShortWorkOnAPipe) {
  ProgressText text(false);
  EXPECT_EQ(text.show("mesh", 0.0, 0ms), "");
  EXPECT_EQ(text.show("points", 0.0, 400ms), "");
  EXPECT_EQ(text.show("points", 0.9, 999ms), "");
  EXPECT_EQ(text.end(), "");
}

TEST(ProgressText, GivesEveryPhaseOfLongWorkALineOnAPipe) {
  ProgressText text(false);
  EXPECT_EQ(text.show("mesh", 0.0, 0ms), "");
  EXPECT_EQ(text.show("points", 0.0, 600ms), "");
  EXPECT_EQ(text.show("points", 0.5, 1200ms), "   0 s  mesh\n   1 s  points\n");
  EXPECT_EQ(text.show("points", 0.7, 1300ms), "");
  EXPECT_EQ(text.show("check", 0.0, 1400ms), "   1 s  check\n");
  EXPECT_EQ(text.show("write", 0.0, 123s), " 123 s  write\n");
}

TEST(ProgressText, IsNeverSilentForLongOnAPipe) {
  ProgressText text(false);
  std::string all;
  for (int second = 0; second <= 35; ++second) {
    const std::string now = text.show("points", second / 40.0, std::chrono::seconds(second));
    EXPECT_EQ(now.find('\r'), std::string::npos);
    all += now;
  }
  EXPECT_EQ(all, "   0 s  points\n  10 s  points  25 %\n  20 s  points  50 %\n  30 s  points  75 %\n");
}

TEST(ProgressText, RewritesOneLineOfATerminal) {
  ProgressText text(true);
  EXPECT_EQ(text.end(), "");
  EXPECT_EQ(text.show("mesh", 0.0, 0ms), "\rmesh   0 %\x1b[K");
  EXPECT_EQ(text.show("mesh", 0.1, 99ms), "");
  EXPECT_EQ(text.show("points", 0.5, 99ms), "\rpoints  50 %\x1b[K");
  EXPECT_EQ(text.show("points", 1.0, 199ms), "\rpoints 100 %\x1b[K");
  EXPECT_EQ(text.end(), "\r\x1b[K");
}

}  // namespace
}  // namespace godobject::command
