#include "toolchain/live/state_message.h"

#include <gtest/gtest.h>

#include <limits>

#include <nlohmann/json.hpp>

#include "core/device/kinematics.h"
#include "tests/live/live_scene.h"
#include "tests/support/folder_test.h"

namespace godobject::live::state_message_test {
namespace {

using nlohmann::json;

class StateMessageTest : public test::FolderTest {
 protected:
  StateMessageTest() { sample_.H_WD = sample_.H_WS = {Quaternion::Identity(), Vector3(0.0, 0.0, 0.05)}; }

  json message(const std::optional<LiveSettings>& settings = {}) {
    return json::parse(state_.text(settings, 0.5, 3) + "}");
  }

  const firmware::ControllerConfig config_ = ball_in_hand(folder_);
  const test::SceneImage image_ = test::ball_over_plate();
  const SceneView scene_ = test::open_scene(image_);
  const firmware::Placement placement_ = firmware::place(config_.workspace, config_.device, scene_.H_MB.translation);
  StateMessage state_{scene_, &placement_};
  LiveSample sample_;
};

TEST_F(StateMessageTest, IsEmptyBeforeTheFirstCycle) { EXPECT_EQ(state_.text({}, 1.0, 0), ""); }

TEST_F(StateMessageTest, HasTheLastCycleAndTheExtremesSinceTheMessageBefore) {
  for (const double force : {2.0, 9.0, 1.0, 4.0}) {
    sample_.t += 1e-3;
    sample_.wrench_R.force = Vector3(0.0, force, 0.0);
    state_.add(sample_);
  }
  json state = message();
  EXPECT_EQ(state["plots"]["force"], json({4.0, 1.0, 9.0}));
  EXPECT_EQ(state["t"], 0.004);
  EXPECT_EQ(state["cycles"], 4);
  EXPECT_EQ(state["speed"], 0.5);
  EXPECT_EQ(state["lost"], 3);
  EXPECT_TRUE(state["settings"].is_null());
  sample_.wrench_R.force = Vector3(0.0, 3.0, 0.0);
  state_.add(sample_);
  state = message();
  EXPECT_EQ(state["plots"]["force"], json({3.0, 3.0, 3.0})) << "extremes of an earlier message";
  EXPECT_EQ(state["cycles"], 5);
  EXPECT_EQ(message()["plots"]["force"], json({3.0, 3.0, 3.0})) << "no cycle since the message before";
  sample_.wrench_R.force = Vector3(0.0, 8.0, 0.0);
  state_.add(sample_);
  state_.skip();
  sample_.wrench_R.force = Vector3(0.0, 5.0, 0.0);
  state_.add(sample_);
  EXPECT_EQ(message()["plots"]["force"], json({5.0, 5.0, 5.0})) << "extremes that nobody wanted";
}

TEST_F(StateMessageTest, HasNullForWhatIsNotFinite) {
  sample_.wrench_R.force.x() = std::numeric_limits<double>::quiet_NaN();
  sample_.H_WS.translation.x() = std::numeric_limits<double>::infinity();
  sample_.contacts = 1.0;
  sample_.fault = "a \xff byte";
  state_.add(sample_);
  const json state = message();
  EXPECT_TRUE(state["force"][0].is_null());
  EXPECT_TRUE(state["god"][0].is_null());
  EXPECT_TRUE(state["points"].empty());
}

/// The force along the axes of the room is turned into the scene.
TEST_F(StateMessageTest, TurnsTheWrenchIntoTheScene) {
  firmware::Placement turned = placement_;
  turned.mapping.H_WR.rotation = exp_rotation(Vector3(0.0, 0.0, 1.5707963267948966));
  StateMessage state(scene_, &turned);
  sample_.wrench_R = {Vector3(3.0, 0.0, 1.0), Vector3(0.0, 2.0, 0.0)};
  state.add(sample_);
  const json text = json::parse(state.text({}, 1.0, 0) + "}");
  EXPECT_EQ(text["force"], json({-0.0, 3.0, 1.0}));
  EXPECT_EQ(text["torque"], json({-2.0, 0.0, 0.0}));
}

TEST_F(StateMessageTest, HasContactPointsOnlyInContact) {
  sample_.H_WS.translation.z() = 0.03;
  sample_.wrench_R.force.z() = 4.0;
  state_.add(sample_);
  EXPECT_TRUE(message()["points"].empty());
  sample_.contacts = 1.0;
  state_.add(sample_);
  const json points = message()["points"];
  ASSERT_FALSE(points.empty());
  EXPECT_EQ(points[0].size(), 7u);
}

TEST_F(StateMessageTest, HasTheSettings) {
  state_.add(sample_);
  const LiveSettings settings{.solver = Solver::kPaper,
                              .friction = true,
                              .stiffness = 500.0,
                              .damping = 2.0,
                              .boundary = 900.0,
                              .beyond = false,
                              .solvers = {Solver::kContact, Solver::kPaper},
                              .has_friction = true};
  const json entry = message(settings)["settings"];
  EXPECT_EQ(entry["solver"], "paper");
  EXPECT_EQ(entry["solvers"], json({"contact", "paper"}));
  EXPECT_EQ(entry["boundary"], 900.0);
}

/// The arm ends at the mesh in its hand, also where the clutch has moved the room, and has its size in the scene.
TEST_F(StateMessageTest, DrawsTheArmToTheMesh) {
  sample_.q = config_.workspace.posture;
  sample_.H_WD.translation = Vector3(0.3, 0.2, 0.1);
  const std::vector<Vector3> points = arm_points(sample_, placement_, scene_.H_MB.translation);
  ASSERT_EQ(points.size(), 8u);
  EXPECT_LT((points.back() - sample_.H_WD * scene_.H_MB.translation).norm(), 1e-12);
  const ArmKinematics arm = forward_kinematics(placement_.device.model, sample_.q);
  for (std::size_t i = 1; i < points.size() - 1; ++i) {
    EXPECT_NEAR((points[i] - points[i - 1]).norm(), (arm.H_RL[i].translation - arm.H_RL[i - 1].translation).norm(),
                1e-9);
  }
  firmware::Placement twice = placement_;
  twice.mapping.scale = 2.0;
  const std::vector<Vector3> larger = arm_points(sample_, twice, scene_.H_MB.translation);
  EXPECT_NEAR((larger[2] - larger[0]).norm(), 2.0 * (points[2] - points[0]).norm(), 1e-9);
  // the clutch turns the mesh about the grip: the arm stays where it is
  sample_.H_WD.rotation = exp_rotation(Vector3(0.4, -0.3, 0.2));
  sample_.H_WD.translation += Vector3(points.back() - sample_.H_WD * scene_.H_MB.translation);
  const std::vector<Vector3> after = arm_points(sample_, placement_, scene_.H_MB.translation);
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_LT((after[i] - points[i]).norm(), 1e-12) << i;
}

}  // namespace
}  // namespace godobject::live::state_message_test
