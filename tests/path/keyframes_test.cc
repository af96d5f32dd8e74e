#include "toolchain/path/keyframes.h"

#include <cmath>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "toolchain/command_line/failure.h"

namespace godobject::path {
namespace {

using command::ExitCode;
using command::Failure;

const std::string kTwo = R"(
[[keyframe]]
t = 0.0
position = [0, 0, 0.1]
[[keyframe]]
t = 1.0
position = [0.2, 0, 0.1]
axis_angle = [0, 0, 2, 90]
)";

void expect_refused(const std::string& text, ExitCode exit_code, const std::string& part) {
  try {
    (void)parse_keyframes(text, "motion.toml");
    FAIL() << "accepted: " << text;
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.exit_code(), exit_code) << failure.what();
    EXPECT_NE(std::string(failure.what()).find(part), std::string::npos) << failure.what();
    EXPECT_EQ(std::string(failure.what()).find("motion.toml:"), 0u) << failure.what();
  }
}

TEST(Keyframes, AreReadWithTheirUnits) {
  const Keyframes motion = parse_keyframes("pivot = [1, 2, 3]\n" + kTwo + R"(
[[oscillation]]
from = 0.2
to = 0.8
frequency = 9
phase_deg = 180
translation = [0.001, 0, 0]
rotation_deg = [0, 90, 0]
)",
                                           "motion.toml");
  EXPECT_EQ(motion.pivot, Vector3(1, 2, 3));
  ASSERT_EQ(motion.keyframes.size(), 2u);
  EXPECT_EQ(motion.keyframes[1].position, Vector3(0.2, 0, 0.1));
  EXPECT_TRUE(motion.keyframes[0].rotation.isApprox(Quaternion::Identity()));
  EXPECT_NEAR(motion.keyframes[1].rotation.w(), std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(motion.keyframes[1].rotation.z(), std::sqrt(0.5), 1e-12);
  ASSERT_EQ(motion.oscillations.size(), 1u);
  EXPECT_DOUBLE_EQ(motion.oscillations[0].phase, std::numbers::pi);
  EXPECT_DOUBLE_EQ(motion.oscillations[0].rotation.y(), std::numbers::pi / 2);
  EXPECT_DOUBLE_EQ(motion.oscillations[0].fade, 0.1);
}

TEST(Keyframes, RefuseWhatIsNotToml) {
  expect_refused("[[keyframe]]\nt = = 1\n", ExitCode::kBadConfig, "motion.toml:2");
  std::string key = "a";
  for (int i = 0; i < 50'000; ++i) key += ".a";
  expect_refused("\n" + key + " = 1\n", ExitCode::kBadConfig, "motion.toml:2: tables and arrays nest deeper");
  EXPECT_THROW((void)read_keyframes("/dev/zero"), Failure);
}

TEST(Keyframes, RefuseAnUnknownKeyByName) {
  expect_refused("pivto = [0, 0, 0]\n" + kTwo, ExitCode::kBadConfig,
                 "pivto is not a known key; known here: pivot, keyframe, oscillation");
  expect_refused(kTwo + "postion = [0, 0, 0]\n", ExitCode::kBadConfig, "keyframe[2].postion");
}

TEST(Keyframes, RefuseAMissingKeyByName) {
  expect_refused("[[keyframe]]\nt = 0.0\n", ExitCode::kBadConfig,
                 "keyframe[1].position is missing and has no default; below [[keyframe]] write position = ");
  expect_refused("[[keyframe]]\nposition = [0, 0, 0]\n", ExitCode::kBadConfig,
                 "keyframe[1].t is missing and has no default");
}

TEST(Keyframes, RefuseASingleOneAndNone) {
  expect_refused("[[keyframe]]\nt = 0.0\nposition = [0, 0, 0]\n", ExitCode::kBadConfig, "keyframe");
  expect_refused("", ExitCode::kBadConfig, "keyframe");
  expect_refused("keyframe = 3", ExitCode::kBadConfig, "keyframe");
}

TEST(Keyframes, RefuseTimesThatDoNotAscend) {
  expect_refused(kTwo + "[[keyframe]]\nt = 1.0\nposition = [0, 0, 0]\n", ExitCode::kBadConfig, "keyframe[3].t");
}

TEST(Keyframes, RefuseNumbersOutOfRange) {
  expect_refused(kTwo + "[[keyframe]]\nt = 4e9\nposition = [0, 0, 0]\n", ExitCode::kBadConfig,
                 "keyframe[3].t must be at most 4000 s after the first keyframe; split the motion");
  expect_refused("[[keyframe]]\nt = nan\nposition = [0, 0, 0]\n", ExitCode::kBadConfig, "keyframe[1].t");
  expect_refused("[[keyframe]]\nt = 0\nposition = [0, 0]\n", ExitCode::kBadConfig, "keyframe[1].position");
  expect_refused("[[keyframe]]\nt = 0\nposition = [0, inf, 0]\n", ExitCode::kBadConfig, "keyframe[1].position");
  expect_refused("[[keyframe]]\nt = 0\nposition = [0, 0, 0]\nquaternion = [1, 1, 0, 0]\n", ExitCode::kBadConfig,
                 "keyframe[1].quaternion");
  expect_refused("[[keyframe]]\nt = 0\nposition = [0, 0, 0]\naxis_angle = [0, 0, 0, 9]\n", ExitCode::kBadConfig,
                 "keyframe[1].axis_angle");
}

TEST(Keyframes, RefuseAnOscillationThatCannotBe) {
  expect_refused(kTwo + "[[oscillation]]\nfrom = 1\nto = 1\nfrequency = 9\n", ExitCode::kBadConfig,
                 "oscillation[1].to");
  expect_refused(kTwo + "[[oscillation]]\nfrom = 0\nto = 1\nfrequency = 0\n", ExitCode::kBadConfig,
                 "oscillation[1].frequency");
  expect_refused(kTwo + "[[oscillation]]\nfrom = 0\nto = 1\nfrequency = 9\nfade = 0.6\n", ExitCode::kBadConfig,
                 "oscillation[1].fade");
}

TEST(Keyframes, NameAFileThatIsNotThere) {
  try {
    (void)read_keyframes("no/such.toml");
    FAIL();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.exit_code(), ExitCode::kNoInput);
    EXPECT_NE(std::string(failure.what()).find("no/such.toml"), std::string::npos);
  }
}

}  // namespace
}  // namespace godobject::path
