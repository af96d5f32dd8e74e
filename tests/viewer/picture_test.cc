#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include <unistd.h>

#include <gtest/gtest.h>

#include "tests/viewer/boxes.h"
#include "toolchain/command_line/external_program.h"
#include "toolchain/command_line/failure.h"
#include "toolchain/viewer/pov_text.h"
#include "toolchain/viewer/render.h"
#include "toolchain/viewer/scene_bodies.h"

namespace godobject::viewer {
namespace {

Picture picture() {
  Picture p;
  p.width = 32;
  p.height = 24;
  p.camera.eye = Vector3(0, -0.5, 0);
  p.camera.forward = Vector3(0, 1, 0);
  p.camera.right = Vector3(1, 0, 0);
  p.camera.up = Vector3(0, 0, 1);
  p.placement.H_WS = {exp_rotation(Vector3(0, 0, std::numbers::pi / 2)), Vector3(0, 0, 0.03)};
  p.placement.H_WD = {Quaternion::Identity(), Vector3(0, 0, 0.02)};
  return p;
}

const auto kPlate = box(Vector3(0.2, 0.2, 0.01));
const auto kBody = box(Vector3(0.02, 0.02, 0.02));

TEST(PovText, HoldsTheMeshesInMillimetres) {
  const std::string text = pov_text(kPlate, kBody, picture());
  EXPECT_NE(text.find("#declare Still = mesh2 {\nvertex_vectors { 8,\n<-200,-200,-10>"), std::string::npos);
  EXPECT_NE(text.find("#declare Moving = mesh2 {\nvertex_vectors { 8,\n<-20,-20,-20>"), std::string::npos);
  EXPECT_NE(text.find("face_indices { 12,\n<0,2,3>"), std::string::npos);
}

TEST(PovText, PlacesGodObjectAndDeviceByTransposedRotationAndMillimetres) {
  const std::string text = pov_text(kPlate, kBody, picture());
  const std::size_t blue = text.find("object { Moving matrix <");
  const std::size_t red = text.find("object { Ghost matrix <1,0,0, 0,1,0, 0,0,1, 0,0,20> texture { Red }");
  ASSERT_NE(blue, std::string::npos);
  EXPECT_NE(red, std::string::npos);
  // A quarter turn about z takes x to y: the first row of POV-Ray's matrix is the image of x.
  double m[12] = {};
  ASSERT_EQ(
      std::sscanf(text.c_str() + blue, "object { Moving matrix <%lf,%lf,%lf, %lf,%lf,%lf, %lf,%lf,%lf, %lf,%lf,%lf>",
                  &m[0], &m[1], &m[2], &m[3], &m[4], &m[5], &m[6], &m[7], &m[8], &m[9], &m[10], &m[11]),
      12);
  EXPECT_NEAR(m[0], 0.0, 1e-9);
  EXPECT_NEAR(m[1], 1.0, 1e-9);
  EXPECT_NEAR(m[3], -1.0, 1e-9);
  EXPECT_NEAR(m[11], 30.0, 1e-9);
}

TEST(PovText, DrawsTheDevicePoseSmallerSoThatTheGodObjectHidesIt) {
  const std::string text = pov_text(kPlate, kBody, picture());
  const std::size_t ghost = text.find("#declare Ghost");
  ASSERT_NE(ghost, std::string::npos);
  double x = 0.0;
  ASSERT_EQ(std::sscanf(text.c_str() + text.find('<', ghost), "<%lf", &x), 1);
  EXPECT_GT(x, -20.0);
  EXPECT_LT(x, -19.9);
}

TEST(PovText, CutsTheStillBodyWhenAsked) {
  Picture p = picture();
  EXPECT_EQ(pov_text(kPlate, kBody, p).find("intersection"), std::string::npos);
  p.cut = Cut{Vector3(0, 0.005, 0), Vector3(0, 1, 0)};
  EXPECT_NE(pov_text(kPlate, kBody, p).find("plane { <0,1,0>, 5 "), std::string::npos);
}

TEST(Render, MakesAPngOfATinyScene) {
  if (!command::find_program("povray")) GTEST_SKIP() << "povray is not installed";
  const auto png =
      std::filesystem::path(testing::TempDir()) / ("godobject_picture_test_" + std::to_string(::getpid()) + ".png");
  std::filesystem::remove(png);
  const Picture p = picture();
  render(pov_text(kPlate, kBody, p), p.width, p.height, png);
  std::string head(24, '\0');
  std::ifstream(png, std::ios::binary).read(head.data(), 24);
  EXPECT_EQ(head.substr(1, 3), "PNG");
  EXPECT_EQ(static_cast<int>(head[19]), 32);  // width and height, big-endian
  EXPECT_EQ(static_cast<int>(head[23]), 24);
  std::filesystem::remove(png);
}

TEST(Render, SaysWhatPovRaySaidAndLeavesNothingBehind) {
  if (!command::find_program("povray")) GTEST_SKIP() << "povray is not installed";
  const auto png =
      std::filesystem::path(testing::TempDir()) / ("godobject_broken_picture_" + std::to_string(::getpid()) + ".png");
  try {
    render("this is no scene", 32, 24, png);
    FAIL();
  } catch (const command::Failure& failure) {
    EXPECT_NE(std::string(failure.what()).find("povray: failed"), std::string::npos);
  }
  EXPECT_FALSE(std::filesystem::exists(png));
}

TEST(SceneBodies, AskForTheSceneFileWhenGivenAnImage) {
  try {
    (void)read_scene_bodies("some/peg.scene");
    FAIL();
  } catch (const command::Failure& failure) {
    EXPECT_EQ(failure.exit_code(), command::ExitCode::kBadData);
    EXPECT_NE(std::string(failure.what()).find("some/peg.scene: "), std::string::npos);
    EXPECT_NE(std::string(failure.what()).find("give the scene file peg.toml"), std::string::npos);
  }
}

TEST(SceneBodies, NameAFileThatIsNotThere) {
  try {
    (void)read_scene_bodies("no/such.toml");
    FAIL();
  } catch (const command::Failure& failure) {
    EXPECT_EQ(failure.exit_code(), command::ExitCode::kNoInput);
  }
}

}  // namespace
}  // namespace godobject::viewer
