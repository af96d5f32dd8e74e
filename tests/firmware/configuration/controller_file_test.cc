#include "firmware/configuration/controller_file.h"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <string>

#include "core/device/kinematics.h"
#include "tests/support/fault_record.h"
#include "tests/support/folder_test.h"
#include "toolchain/command_line/failure.h"

namespace godobject::firmware::controller_file_test {
namespace {

using command::ExitCode;
using command::Failure;

constexpr const char* kLeast = "[device]\nfile = \"" GODOBJECT_FIRMWARE_DIR
                               "/devices/desktop6.toml\"\n"
                               "[workspace]\nposture = [0.1, 0.6, -0.2, 0.3, 0.2, 0.0]\n";

class ControllerFileTest : public test::FolderTest {
 protected:
  ControllerConfig read(const std::string& text) const {
    std::ofstream(file_) << text;
    return read_controller_file(file_);
  }

  std::string refusal(const std::string& text) {
    try {
      read(text);
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.exit_code(), ExitCode::kBadConfig);
      code_ = static_cast<int>(failure.exit_code());
      return failure.what();
    }
    return {};
  }

  const std::filesystem::path file_ = folder_ / "controller.toml";
  int code_ = 0;  // of the last refusal
};

TEST_F(ControllerFileTest, HasDefaultsForAllButDeviceAndPosture) {
  const ControllerConfig config = read(kLeast);
  EXPECT_EQ(config.device.name, "desktop6");
  EXPECT_EQ(config.workspace.posture[3], 0.3);
  EXPECT_EQ(config.loop.priority, 80);
  EXPECT_EQ(config.limits.joint_speed_stop, 1.0);
  EXPECT_FALSE(config.scene.solver);
  EXPECT_TRUE(config.scene.image.empty());
  EXPECT_NE(refusal("[workspace]\n").find("device.file is missing"), std::string::npos);
}

TEST_F(ControllerFileTest, ReadsTheFilesOfBothDevices) {
  struct File {
    std::string name, device, image;
  };
  for (const File& file : {File{"lwr", "lwr", "bunny-teapot.scene"},
                           {"lwr-bunny-plate", "lwr", "bunny-plate.scene"},
                           {"lwr-peg-hole", "lwr", "peg-hole.scene"},
                           {"desktop6", "desktop6", "bunny-teapot.scene"}}) {
    const ControllerConfig config = read_controller_file(GODOBJECT_FIRMWARE_DIR "/controllers/" + file.name + ".toml");
    EXPECT_EQ(config.device.name, file.device);
    EXPECT_EQ(config.scene.image.filename(), file.image);
    EXPECT_FALSE(config.simulation.path.empty()) << file.name;
  }
}

TEST_F(ControllerFileTest, TakesPathsAsRelativeToItself) {
  const ControllerConfig config =
      read(std::string(kLeast) + "[scene]\nimage = \"a/b.scene\"\n[telemetry]\nfolder = \"logs\"\n");
  EXPECT_EQ(config.scene.image, file_.parent_path() / "a/b.scene");
  EXPECT_EQ(config.telemetry.folder, file_.parent_path() / "logs");
}

TEST_F(ControllerFileTest, NamesLineAndKeyOfWhatIsWrong) {
  int refused = 0;
  std::string words;
  for (const auto& [more, says] : std::initializer_list<std::array<const char*, 2>>{
           {"[loop]\nvelocity_window = 1\n", ".toml:6: loop.velocity_window = 1 is out of range"},
           {"[loop]\npriority = 99\n", ".toml:6: loop.priority = 99 is out of range"},
           {"[loop]\ncpu = 1.5\n", "loop.cpu must be a whole number"},
           {"[limits]\nforce = nan\n", "limits.force = nan is out of range"},
           {"[limits]\nforce = inf\n", "limits.force = inf is out of range"},
           {"[limits]\ntorque_rate = 0.06\n", "limits.torque_rate = 0.06 is out of range"},
           {"[limits]\nspeed = 1.0\nspeed_stop = 1.0\n", ".toml:7: limits.speed_stop = 1 is out of range"},
           {"[limits]\nforces = 1.0\n", "limits.forces is not a known key"},
           {"[engage]\nforce = 31.0\n", "engage.force = 31 is out of range"},
           {"[gains]\nmargin = 0.9\n", "gains.margin = 0.9 is out of range"},
           {"[passivity]\ndamping = -1.0\n", "passivity.damping = -1 is out of range"},
           {"[passivity]\ndampng = 1.0\n", "passivity.dampng"},
           {"[scene]\nsolver = \"best\"\n", "scene.solver = \"best\" is not known"},
           {"[scene]\nfriction = 1\n", "scene.friction must be true or false"},
           {"[gain]\nmargin = 2.0\n", "gain is not a known table"},
           {"[start]\nsign_test = \"no\"\n", "start.sign_test must be true or false"},
           {"[simulation]\ndelay = 0.001\n", "simulation.delay is not a known key"},
       }) {
    const std::string message = refusal(std::string(kLeast) + more);
    EXPECT_NE(message.find(says), std::string::npos) << "'" << message << "' should say: " << says;
    refused += message.find(says) != std::string::npos ? 1 : 0;
    words = message.substr(message.rfind('/') + 1);
  }
  test::record_start(code_, std::to_string(refused) + " cases, the last: " + words);
  const std::string device = std::string("[device]\nfile = \"" GODOBJECT_FIRMWARE_DIR "/devices/desktop6.toml\"\n");
  EXPECT_NE(refusal(device + "[workspace]\nposture = [0, 0, 0]\n").find("must be an array of 6 numbers"),
            std::string::npos);
  EXPECT_NE(refusal(device + "[workspace]\nposture = [0, 2.0, 0, 0, 0, 0]\n").find("joint 2 is beyond its limits"),
            std::string::npos);
}

TEST_F(ControllerFileTest, RefusesADeviceFileThatIsNotThere) {
  try {
    read("[device]\nfile = \"nowhere.toml\"\n");
    FAIL();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.exit_code(), ExitCode::kNoInput);
    EXPECT_NE(std::string(failure.what()).find("nowhere.toml"), std::string::npos);
  }
}

TEST_F(ControllerFileTest, PlacesTheMeshAtItsStartInThePosture) {
  const ControllerConfig config = read(std::string(kLeast) +
                                       "turn = [0.5, 0.5, 0.5, 0.5]\nscale = 2.0\n"
                                       "start = [0.1, -0.2, 0.3, 0.0, 0.6, 0.8, 0.0]\n");
  const Vector3 p_MB(0.02, -0.04, 0.06);
  const Placement placement = place(config.workspace, config.device, p_MB);
  const Pose H_RT = forward_kinematics(config.device.model, config.workspace.posture).H_RM;
  const Pose H_RM = forward_kinematics(placement.device.model, config.workspace.posture).H_RM;
  WorkspaceMapping mapping(placement.mapping, H_RM);
  EXPECT_LT((mapping.scene_pose().translation - Vector3(0.1, -0.2, 0.3)).norm(), 1e-12);
  EXPECT_LT(mapping.scene_pose().rotation.angularDistance(Quaternion(0.0, 0.6, 0.8, 0.0)), 1e-7);
  const Vector3 centre_W = mapping.scene_pose() * p_MB;

  // the turn takes x of the room to y of the scene; doubled
  Pose moved = H_RM;
  moved.translation.x() += 0.01;
  ASSERT_EQ(mapping.update(moved, true, 1e-3), Status::kOk);
  EXPECT_LT((mapping.scene_pose().translation - Vector3(0.1, -0.18, 0.3)).norm(), 1e-12);

  // a turn of the hand about the tool's origin leaves the centre of mass where it is
  Pose turned = H_RT;
  turned.rotation = turned.rotation * exp_rotation(Vector3(0.3, -0.2, 0.5));
  ASSERT_EQ(mapping.update(turned * placement.H_TM, true, 1e-3), Status::kOk);
  EXPECT_LT((mapping.scene_pose() * p_MB - centre_W).norm(), 1e-12);
}

/// A placement is a rigid motion even where the rotations that it is made of are of unit length to a thousandth only.
TEST_F(ControllerFileTest, PlacesTheMeshByARotationOfUnitLength) {
  ControllerConfig config = read(kLeast);
  config.workspace.turn.coeffs() *= 1.0009;
  config.workspace.start.rotation.coeffs() *= 1.0007;
  const Placement placement = place(config.workspace, config.device, Vector3(0.02, -0.04, 0.06));
  EXPECT_NEAR(placement.H_TM.rotation.norm(), 1.0, 1e-12);
}

}  // namespace
}  // namespace godobject::firmware::controller_file_test
