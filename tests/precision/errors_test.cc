// Errors calculated by hand, and the exact scene against a box and a plane.
#include <string>

#include <unistd.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>

#include "toolchain/precision/errors.h"
#include "toolchain/precision/press_path.h"

namespace godobject::precision {
namespace {

TEST(WrenchError, IsThatOfHand) {
  const double squared_gyration = 0.25;  // a torque of 1 Nm counts as 2 N
  const std::vector<Wrench> reference = {{{0.0, 0.0, 4.0}, Vector3::Zero()}, {{0.0, 3.0, 0.0}, Vector3::Zero()}};
  const std::vector<Wrench> same = reference;
  EXPECT_EQ(wrench_error(same, reference, squared_gyration).relative, 0.0);
  const std::vector<Wrench> turned = {{{0.0, 4.0, 0.0}, Vector3::Zero()}, {{0.0, 3.0, 0.0}, {1.5, 0.0, 0.0}}};
  const WrenchError error = wrench_error(turned, reference, squared_gyration);
  EXPECT_NEAR(error.rms, std::sqrt((16.0 + 16.0 + 9.0) / 2.0), 1e-12);
  EXPECT_NEAR(error.relative, std::sqrt(41.0 / 25.0), 1e-12);
  EXPECT_NEAR(error.magnitude, 0.0, 1e-12);
  EXPECT_NEAR(error.direction, 0.5 * std::numbers::pi / std::sqrt(2.0), 1e-12);
}

/// A box of 40 mm about the origin on a block whose top is the plane z = 0.
class ExactSceneTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) / ("godobject_exact_scene_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
    write_box("block.ply", Vector3(-0.1, -0.1, -0.05), Vector3(0.1, 0.1, 0.0));
    write_box("box.ply", Vector3::Constant(-0.02), Vector3::Constant(0.02));
    config_.still = {.file = folder_ / "block.ply", .name = "block.ply"};
    config_.moving = {.file = folder_ / "box.ply", .name = "box.ply"};
    config_.voxel_size = 0.002;
    config_.thickness = 0.004;
    config_.settings.stiffness = 2000.0;
    config_.settings.coupling_translation = 1.0;
    config_.settings.coupling_rotation = 0.025;
    config_.settings.safety_distance = 0.003;
    config_.settings.margin = 2e-5;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write_box(const char* name, const Vector3& low, const Vector3& high) {
    std::ofstream out(folder_ / name);
    out << "ply\nformat ascii 1.0\nelement vertex 8\nproperty double x\nproperty double y\nproperty double z\n"
           "element face 6\nproperty list uchar int vertex_indices\nend_header\n";
    for (int i = 0; i < 8; ++i) {
      out << ((i & 1) != 0 ? high : low).x() << ' ' << ((i & 2) != 0 ? high : low).y() << ' '
          << ((i & 4) != 0 ? high : low).z() << '\n';
    }
    out << "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n";
  }

  static Pose at(double z, const Vector3& turned = Vector3::Zero()) {
    Pose pose;
    pose.translation.z() = z;
    pose.rotation = exp_rotation(turned);
    return pose;
  }

  std::filesystem::path folder_;
  scene_compiler::SceneConfig config_;
};

TEST_F(ExactSceneTest, KnowsHowDeepABoxIs) {
  const ExactScene exact(config_, 500);
  EXPECT_NEAR(exact.clearance(at(0.025)), 0.005, 1e-8);
  EXPECT_EQ(exact.penetration(at(0.025)), 0.0);
  EXPECT_NEAR(exact.penetration(at(0.0187)), 0.0013, 1e-8);
  const double corner = 0.02 * std::numbers::sqrt2;
  EXPECT_NEAR(exact.penetration(at(corner - 0.001, {0.25 * std::numbers::pi, 0.0, 0.0})), 0.001, 1e-8);
}

TEST_F(ExactSceneTest, HasTheExactDistanceAndItsGradient) {
  const ExactScene exact(config_, 500);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> across(-0.08, 0.08);
  std::uniform_real_distribution<double> height(-0.015, 0.05);
  for (int i = 0; i < 500; ++i) {
    const Vector3 p(across(random), across(random), height(random));
    const FieldSample sample = exact.still().sample(p);
    const double deep = std::min({0.1 - std::fabs(p.x()), 0.1 - std::fabs(p.y()), -p.z()});
    EXPECT_NEAR(sample.distance, p.z() > 0.0 ? p.z() : -deep, 1e-12);
    if (p.z() > 1e-6 || (p.z() < -1e-6 && deep == -p.z())) {
      EXPECT_LT((sample.gradient - Vector3::UnitZ()).norm(), 1e-9) << p.transpose();
    }
  }
}

TEST_F(ExactSceneTest, ReferencePushesByTheDepthAlongTheNormal) {
  const ExactScene exact(config_, 500);
  std::vector<Pose> path;
  for (int k = 0; k <= 100; ++k) path.push_back(at(0.021 - 5e-5 * k));
  const std::vector<TracedCycle> cycles = exact.reference({path}, false);
  const Wrench& last = cycles.back().spring_W;  // 4 mm deep, and the margin of a thousandth of a voxel
  EXPECT_NEAR(last.force.z(), 2000.0 * 0.004, 2000.0 * 5e-6);
  EXPECT_LT(last.force.head<2>().norm(), 1e-3);
  EXPECT_LT(last.torque.norm(), 1e-4);
  EXPECT_EQ(cycles.front().spring_W.force.norm(), 0.0);
  EXPECT_EQ(penetration_error(exact, cycles, 1).deepest, 0.0);
}

TEST_F(ExactSceneTest, MakesMotionsThatBeginFreeAndPress) {
  const ExactScene exact(config_, 500);
  const Paths paths = press_paths(exact);
  ASSERT_EQ(paths.size(), 4u);
  for (const auto& path : paths) {
    EXPECT_GT(exact.clearance(path.front()), 0.0);
    double deepest = 0.0;
    for (std::size_t k = 0; k < path.size(); k += 10) deepest = std::max(deepest, exact.penetration(path[k]));
    EXPECT_GT(deepest, 0.0005);
  }
}

}  // namespace
}  // namespace godobject::precision
