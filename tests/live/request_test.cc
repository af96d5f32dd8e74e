#include "toolchain/live/request.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/support/random.h"

namespace godobject::live::request_test {
namespace {

template <class Kind>
Kind read(const std::string& message) {
  const auto result = read_request(message);
  if (const auto* error = std::get_if<std::string>(&result)) throw std::runtime_error(message + ": " + *error);
  return std::get<Kind>(std::get<Request>(result));
}

std::string refusal(const std::string& message) {
  const auto result = read_request(message);
  const auto* error = std::get_if<std::string>(&result);
  return error != nullptr ? *error : "";
}

TEST(ReadRequest, ReadsEachKind) {
  const auto hand = read<HandRequest>(R"({"type":"hand","pose":[0.1,-0.2,0.3,0.7071,0.7071,0,0]})");
  EXPECT_EQ(hand.H_WM.translation, Vector3(0.1, -0.2, 0.3));
  EXPECT_NEAR(hand.H_WM.rotation.norm(), 1.0, 1e-15);
  EXPECT_NEAR(hand.H_WM.rotation.w(), 0.70710678, 1e-8);
  EXPECT_NEAR(hand.H_WM.rotation.x(), 0.70710678, 1e-8);
  const auto change = read<ChangeRequest>(R"({"type":"set","solver":"paper","stiffness":500,"beyond":true})");
  EXPECT_EQ(change.solver, Solver::kPaper);
  EXPECT_EQ(change.stiffness, 500.0);
  EXPECT_TRUE(change.beyond);
  EXPECT_FALSE(change.friction || change.damping);
  EXPECT_EQ(read<ChangeRequest>(R"({"type":"set","friction":false})").friction, false);
  read<ReleaseRequest>(R"({"type":"release"})");
  read<ResetRequest>(R"({"type":"reset"})");
}

TEST(ReadRequest, RefusesEverythingElseWithAReason) {
  const std::string unit = "1,0,0,0]}";
  EXPECT_EQ(refusal(""), "not JSON");
  EXPECT_EQ(refusal("{"), "not JSON");
  EXPECT_EQ(refusal(std::string(2000, '[')), "not JSON");
  EXPECT_EQ(refusal("[]"), "not an object with a \"type\"");
  EXPECT_EQ(refusal("3"), "not an object with a \"type\"");
  EXPECT_NE(refusal(R"({"type":"boom"})").find("must be hand"), std::string::npos);
  EXPECT_NE(refusal(R"({"type":7})").find("must be hand"), std::string::npos);
  EXPECT_NE(refusal(R"({"type":"reset","x":1})").find("unknown key \"x\""), std::string::npos);
  EXPECT_NE(refusal(R"({"type":"hand"})").find("\"pose\" wants"), std::string::npos);
  EXPECT_NE(refusal(R"({"type":"hand","pose":[0,0,0,1,0,0]})").find("\"pose\" wants"), std::string::npos);
  EXPECT_NE(refusal(R"({"type":"hand","pose":[0,0,"a",)" + unit).find("no number"), std::string::npos);
  EXPECT_NE(refusal(R"({"type":"hand","pose":[0,0,null,)" + unit).find("no number"), std::string::npos);
  EXPECT_NE(refusal(R"({"type":"hand","pose":[0,0,1e999,)" + unit), "");
  EXPECT_NE(refusal(R"({"type":"hand","pose":[0,0,1e9,)" + unit).find("m away"), std::string::npos);
  EXPECT_NE(refusal(R"({"type":"hand","pose":[0,0,0,0,0,0,0]})").find("unit length"), std::string::npos);
  EXPECT_NE(refusal(R"({"type":"set","solver":"best"})").find("contact, corrected or paper"), std::string::npos);
  EXPECT_NE(refusal(R"({"type":"set","friction":1})").find("neither true nor false"), std::string::npos);
  EXPECT_NE(refusal(R"({"type":"set","stiffness":"soft"})").find("no number"), std::string::npos);
  EXPECT_NE(refusal(R"({"type":"set","pose":[]})").find("unknown key"), std::string::npos);
  EXPECT_NE(refusal("{\"type\":\"reset\"," + std::string(5000, ' ') + "}").find("longer than"), std::string::npos);
}

/// Damaged messages are refused, or still are requests of finite poses.
TEST(ReadRequest, AcceptsNoDamagedPose) {
  test::Random random(3);
  const std::string message = R"({"type":"hand","pose":[0.1,-0.2,0.3,0.7071,0.7071,0,0]})";
  for (int trial = 0; trial < 20000; ++trial) {
    std::string damaged = message;
    for (int k = 0; k <= trial % 3; ++k) {
      const auto at = static_cast<std::size_t>(random.between(0.0, static_cast<double>(damaged.size()) - 0.5));
      damaged[at] = static_cast<char>(random.between(0.0, 255.9));
    }
    const auto result = read_request(damaged);
    if (const auto* request = std::get_if<Request>(&result)) {
      if (const auto* hand = std::get_if<HandRequest>(request)) {
        EXPECT_TRUE(hand->H_WM.is_finite()) << damaged;
        EXPECT_NEAR(hand->H_WM.rotation.norm(), 1.0, 1e-12) << damaged;
      }
    }
  }
}

}  // namespace
}  // namespace godobject::live::request_test
