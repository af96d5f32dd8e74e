#include "firmware/simulation/simulated_arm.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/device/kinematics.h"
#include "firmware/simulation/paced_clock.h"
#include "tests/support/folder_test.h"
#include "tests/support/random.h"
#include "toolchain/command_line/failure.h"

namespace godobject::firmware::simulated_arm_test {
namespace {

using command::ExitCode;

/// A world that only keeps the time.
class EmptyWorld final : public sim::World {
 public:
  std::int64_t now_ns() const noexcept override { return now; }
  void advance_to(std::int64_t ns) noexcept override { now = std::max(now, ns); }
  std::int64_t now = 5'000'000'000;
};

TEST(PacedClock, BeginsAtTheWorldsTimeAndWaitsForIt) {
  EmptyWorld world;
  PacedClock clock(world);
  const std::int64_t begin = clock.now_ns();
  EXPECT_GE(begin, 5'000'000'000);
  EXPECT_LT(begin, 3'600'000'000'000) << "an hour";
  clock.sleep_until(begin + 2'000'000);
  EXPECT_EQ(world.now, begin + 2'000'000);
  EXPECT_GE(clock.now_ns(), begin + 2'000'000);
}

/// The light-weight robot with a mesh that is turned, scaled and held beside the tool.
class SimulatedArmTest : public test::FolderTest {
 protected:
  SimulatedArmTest() {
    test::Random random(6);
    config_.device = read_device_file(GODOBJECT_FIRMWARE_DIR "/devices/lwr.toml");
    config_.workspace.posture << 0.0, -0.5, 0.0, 1.4, 0.0, -1.2, 0.0;
    config_.workspace.scale = 2.0;
    config_.workspace.turn = exp_rotation(random.motion(0.0, 2.0).rotation);
    config_.workspace.start = {exp_rotation(random.motion(0.0, 2.0).rotation), random.in_cube(0.5)};
  }

  /// Exit code and message with which a path of these poses in the scene is refused.
  std::pair<ExitCode, std::string> refusal(const std::vector<Pose>& poses, const Vector3& p_MB = {0, 0, 0}) {
    std::ofstream out(folder_ / "path.csv");
    out << "t,px,py,pz,qw,qx,qy,qz\n";
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const Vector3& p = poses[i].translation;
      const Quaternion& q = poses[i].rotation;
      out << fmt::format("{},{},{},{},{},{},{},{}\n", 1e-3 * static_cast<double>(i), p.x(), p.y(), p.z(), q.w(), q.x(),
                         q.y(), q.z());
    }
    out.close();
    config_.simulation.path = folder_ / "path.csv";
    try {
      const SimulatedArm arm(config_, place(config_.workspace, config_.device, p_MB));
      seconds_ = arm.path_seconds();
    } catch (const command::Failure& failure) {
      return {failure.exit_code(), failure.what()};
    }
    return {ExitCode::kOk, ""};
  }

  Pose moved(const Vector3& translation, const Vector3& rotation) const {
    const Pose& start = config_.workspace.start;
    return {start.rotation * exp_rotation(rotation), start.translation + translation};
  }

  ControllerConfig config_;
  double seconds_ = 0.0;  // of the path that was accepted last
};

TEST_F(SimulatedArmTest, RestsAtThePostureWithoutAPath) {
  const SimulatedArm arm(config_, place(config_.workspace, config_.device, Vector3(0, 0, 0)));
  EXPECT_EQ(arm.joint_count(), 7);
  EXPECT_EQ(arm.now_ns(), 0);
  EXPECT_EQ(arm.hand_work(), 0.0);
  EXPECT_EQ(arm.path_seconds(), 1e-3) << "one pose";
  EXPECT_EQ(arm.hardware().size(), static_cast<std::size_t>(kMaxJoints));
}

/// A path may begin a little beside the tool: 10 mm of the hand, which are 20 mm of the scene here, and 0.05 rad.
TEST_F(SimulatedArmTest, WantsAPathThatBeginsAtTheTool) {
  test::Random random(7);
  for (int i = 0; i < 20; ++i) {
    const Vector3 along = random.direction();
    const Vector3 about = random.direction();
    const Vector3 p_MB = random.in_cube(0.1);
    EXPECT_EQ(refusal({moved({0, 0, 0}, {0, 0, 0})}, p_MB).second, "");
    EXPECT_EQ(refusal({moved(0.0199 * along, {0, 0, 0})}, p_MB).second, "");
    EXPECT_EQ(refusal({moved({0, 0, 0}, 0.0499 * about)}).second, "");
    const auto [far, says] = refusal({moved(0.0202 * along, {0, 0, 0})}, p_MB);
    EXPECT_EQ(far, ExitCode::kBadConfig);
    EXPECT_NE(says.find("path.csv: begins 0.0101 m and "), std::string::npos) << says;
    EXPECT_NE(says.find("set workspace.start to its first pose"), std::string::npos) << says;
    const auto [turned, words] = refusal({moved({0, 0, 0}, 0.0501 * about)});
    EXPECT_EQ(turned, ExitCode::kBadConfig);
    EXPECT_NE(words.find(" m and 0.0501 rad from the tool"), std::string::npos) << words;
  }
  // only the first pose counts
  EXPECT_EQ(refusal({moved({0, 0, 0}, {0, 0, 0}), moved({0.1, 0, 0}, {0, 0, 0.3})}).second, "");
}

TEST_F(SimulatedArmTest, RefusesARowThatIsNoPose) {
  const Pose start = moved({0, 0, 0}, {0, 0, 0});
  for (const double length : {0.9989, 0.9991, 1.0009, 1.0011}) {
    Pose pose = start;
    pose.rotation.coeffs() *= length;
    const ExitCode code = refusal({start, pose}).first;
    EXPECT_EQ(code, length > 0.999 && length < 1.001 ? ExitCode::kOk : ExitCode::kBadData) << length;
    EXPECT_EQ(refusal({pose, start}).first, code) << length;
  }
  Pose far = start;
  far.translation.y() = HUGE_VAL;
  EXPECT_EQ(refusal({start, far}).first, ExitCode::kBadData);
  far.translation.y() = std::nan("");
  const auto [code, says] = refusal({start, far});
  EXPECT_EQ(code, ExitCode::kBadData);
  EXPECT_NE(says.find("path.csv: has a row with an invalid pose; check its quaternions"), std::string::npos) << says;
}

/// A pose a millisecond, also in a slower path: n poses are n - 1 ms long.
TEST_F(SimulatedArmTest, TakesASlowerPathForLonger) {
  const std::vector<Pose> poses(11, moved({0, 0, 0}, {0, 0, 0}));
  for (const auto& [slower, rows] : {std::pair{1.0, 11}, {2.0, 21}, {1.25, 13}, {10.0, 101}}) {
    config_.simulation.slower = slower;
    ASSERT_EQ(refusal(poses).second, "");
    EXPECT_NEAR(seconds_, 1e-3 * rows, 1e-12) << slower;
  }
}

/// A slower path moves the hand as one whose poses in between are written down: at `slower` times its duration, linear
/// in position and angle between two poses.
TEST_F(SimulatedArmTest, MovesTheHandAlongTheSlowerPathAsAlongOneWrittenDown) {
  const Vector3 axis = Vector3(1.0, -2.0, 0.5).normalized();
  const std::vector<double> way = {0.0, 1.0, 1.5, 4.0, 3.0, 3.5, 7.0, 8.0};
  const auto pose = [&](double at) { return moved(0.01 * at * Vector3(0.6, -0.8, 0.3), 0.02 * at * axis); };
  const auto run = [&](const std::vector<Pose>& poses, double slower) {
    config_.simulation.slower = slower;
    EXPECT_EQ(refusal(poses).second, "");
    SimulatedArm arm(config_, place(config_.workspace, config_.device, Vector3(0, 0, 0)));
    std::vector<Pose> seen;
    for (int ms = 0; ms < 30; ++ms) {
      for (int part = 0; part < 10; ++part) arm.plant().step(sim::Plant::kStep_ns, {});
      seen.push_back(arm.plant().hand().pose);
    }
    return seen;
  };
  config_.simulation.begin = 0.0;
  std::vector<Pose> poses;
  for (const double at : way) poses.push_back(pose(at));
  for (const double slower : {1.0, 2.0, 3.0, 2.5}) {
    std::vector<Pose> longer;
    for (int i = 0; i <= static_cast<int>(slower * 7.0); ++i) {
      const double at = static_cast<double>(i) / slower;
      const auto before = std::min<std::size_t>(static_cast<std::size_t>(at), 6);
      const double share = at - static_cast<double>(before);
      longer.push_back(pose((1.0 - share) * way[before] + share * way[before + 1]));
    }
    const std::vector<Pose> slow = run(poses, slower);
    const std::vector<Pose> written = run(longer, 1.0);
    for (std::size_t i = 0; i < slow.size(); ++i) {
      // the acceleration of the hand divides by small masses: 1e-9 is far above rounding, far below a wrong pose
      EXPECT_LT((slow[i].translation - written[i].translation).norm(), 1e-9) << slower << ' ' << i;
      EXPECT_LT(slow[i].rotation.angularDistance(written[i].rotation), 1e-7) << slower << ' ' << i;
    }
    EXPECT_GT((slow.back().translation - slow.front().translation).norm(), 1e-3) << "it moved";
  }
}

/// The hand that waits at the tool does not pull it before the path begins.
TEST_F(SimulatedArmTest, HoldsTheToolAtRestUntilThePathBegins) {
  config_.simulation.begin = 0.05;
  ASSERT_EQ(refusal({moved({0, 0, 0}, {0, 0, 0}), moved({0, 0, 0}, {0, 0, 0})}).second, "");
  const Pose rest = forward_kinematics(config_.device.model, config_.workspace.posture).H_RM;
  SimulatedArm arm(config_, place(config_.workspace, config_.device, Vector3(0, 0, 0)));
  EXPECT_LT((arm.plant().hand().pose.translation - rest.translation).norm(), 1e-9);
}

}  // namespace
}  // namespace godobject::firmware::simulated_arm_test
