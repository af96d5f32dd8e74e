#include "toolchain/mcap/cdr_writer.h"

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "tests/mcap/bytes_reader.h"
#include "toolchain/mcap/ros_messages.h"

namespace godobject::mcap {
namespace {

/// Returns the bytes of hexadecimal digits in pairs; blanks are ignored.
std::string bytes_of(std::string_view digits) {
  std::string bytes;
  std::string pair;
  for (const char digit : digits) {
    if (digit == ' ') continue;
    pair += digit;
    if (pair.size() < 2) continue;
    bytes += static_cast<char>(std::stoi(pair, nullptr, 16));
    pair.clear();
  }
  return bytes;
}

TEST(CdrWriter, AlignsNumbersToTheirSizeBehindTheHeader) {
  CdrWriter cdr;
  cdr.boolean(true);
  cdr.uint32(0x01020304);
  cdr.float64(1.0);
  cdr.boolean(false);
  cdr.float32(-2.0f);
  cdr.int32(-2);
  cdr.float64(0.5);
  EXPECT_EQ(cdr.bytes(), bytes_of("00 01 00 00  01 00 00 00  04 03 02 01  00 00 00 00 00 00 f0 3f  "
                                  "00 00 00 00  00 00 00 c0  fe ff ff ff  00 00 00 00  00 00 00 00 00 00 e0 3f"));
}

TEST(CdrWriter, EndsStringsWithNul) {
  CdrWriter cdr;
  cdr.string("ab");
  cdr.string("");
  cdr.string(std::string_view("c\0d", 3));
  cdr.count(2);
  EXPECT_EQ(cdr.bytes(), bytes_of("00 01 00 00  03 00 00 00 61 62 00  00  01 00 00 00 00  00 00 00  "
                                  "02 00 00 00 63 00  00 00  02 00 00 00"));
}

TEST(CdrWriter, WritesAWrenchAsComputedByHand) {
  // header: 1 s, 2 ns, "W"; then five bytes up to 14, so that the first number begins at 16
  EXPECT_EQ(wrench_message(1'000'000'002, "W", {Vector3(1.0, -2.0, 0.0), Vector3(0.0, 0.0, 0.25)}),
            bytes_of("00 01 00 00  01 00 00 00  02 00 00 00  02 00 00 00 57 00  00 00  "
                     "00 00 00 00 00 00 f0 3f  00 00 00 00 00 00 00 c0  00 00 00 00 00 00 00 00  "
                     "00 00 00 00 00 00 00 00  00 00 00 00 00 00 00 00  00 00 00 00 00 00 d0 3f"));
}

TEST(CdrWriter, WritesTransformsOneAfterTheOther) {
  const Pose H_WA{Quaternion(0.5, -0.5, 0.5, -0.5), Vector3(1.0, 2.0, 3.0)};
  const std::array transforms{FrameTransform{"W", "a", H_WA}, FrameTransform{"a", "long name", Pose{}}};
  CdrReader reader(transform_message(1, transforms));
  ASSERT_EQ(reader.number<std::uint32_t>(), 2u);
  EXPECT_EQ(reader.number<std::int32_t>(), 0);
  EXPECT_EQ(reader.number<std::uint32_t>(), 1u);
  EXPECT_EQ(reader.text(), "W");
  EXPECT_EQ(reader.text(), "a");
  for (const double expected : {1.0, 2.0, 3.0, -0.5, 0.5, -0.5, 0.5}) EXPECT_EQ(reader.real(), expected);
  reader.number<std::uint64_t>();  // at 96, a multiple of 8: the stamp
  EXPECT_EQ(reader.text(), "a");
  EXPECT_EQ(reader.text(), "long name");
  for (const double expected : {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0}) EXPECT_EQ(reader.real(), expected);
  EXPECT_TRUE(reader.at_end());
}

TEST(CdrWriter, WritesOneNumberForEachJoint) {
  const std::array q{0.1, 0.2}, qd{0.3, 0.4}, torque{5.0, 6.0};
  CdrReader reader(joint_message(2'147'483'647'999'999'999, q, qd, torque));
  EXPECT_EQ(reader.number<std::int32_t>(), 2'147'483'647);
  EXPECT_EQ(reader.number<std::uint32_t>(), 999'999'999u);
  EXPECT_EQ(reader.text(), "");
  ASSERT_EQ(reader.number<std::uint32_t>(), 2u);
  EXPECT_EQ(reader.text(), "joint1");
  EXPECT_EQ(reader.text(), "joint2");
  for (const auto& numbers : {q, qd, torque}) {
    ASSERT_EQ(reader.number<std::uint32_t>(), 2u);
    for (const double number : numbers) EXPECT_EQ(reader.real(), number);
  }
  EXPECT_TRUE(reader.at_end());
}

}  // namespace
}  // namespace godobject::mcap
