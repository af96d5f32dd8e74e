// Bodies that turn on edges: the torque follows the lever, and exact meshes stay apart.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "tests/scene_compiler/simple_meshes.h"
#include "tests/support/folder_test.h"
#include "toolchain/files/scene_image.h"
#include "toolchain/precision/mesh_overlap.h"
#include "toolchain/scene_compiler/compile_scene.h"
#include "toolchain/session/owned_god_object.h"

namespace godobject::scene_compiler {
namespace {

using Eigen::Vector3d;

class EdgeContact : public test::FolderTest {
 protected:
  /// `friction`: mu; 0: none.
  void compile(const TriangleMesh& still, const TriangleMesh& moving, double voxel_size, int points,
               double friction = 0.0) {
    std::ofstream(folder_ / "still.obj") << test::obj_text(still);
    std::ofstream(folder_ / "moving.obj") << test::obj_text(moving);
    std::ofstream(folder_ / "scene.toml") << fmt::format(
        "[still]\nmesh = \"still.obj\"\nvoxel_size = {}\n[moving]\nmesh = \"moving.obj\"\npoints = {}\nlevels = 4\n"
        "[contact]\nedges = true\nboth_directions = false\n{}",
        voxel_size, points, friction == 0.0 ? "" : fmt::format("[friction]\nstatic = {0}\nkinetic = {0}\n", friction));
    CompileRequest request;
    request.scene_file = folder_ / "scene.toml";
    request.output = folder_ / "out.scene";
    compile_scene(request);
    image_ = std::make_unique<files::SceneImage>(files::SceneImage::read(request.output));
    ASSERT_EQ(god_object_.start(image_->scene, Solver::kContact, friction > 0.0), Status::kOk);
  }

  CycleReport move_to(const Vector3d& p, const Quaternion& rotation = Quaternion::Identity()) {
    CycleReport report;
    EXPECT_EQ(god_object_->update({{rotation, p}, {}}, report), Status::kOk);
    return report;
  }

  std::unique_ptr<files::SceneImage> image_;
  OwnedGodObject god_object_;
};

/// A box that a force of F presses on a table, its centre drawn over the table's edge at 1.25 mm/s. Beyond the edge the
/// torque is F times the distance of the centre from the edge: it grows by 12.5 uNm a cycle, without steps, whatever
/// the voxels and points.
TEST_F(EdgeContact, LetsABoxTipOverAnEdgeSmoothly) {
  const Vector3d table(0.2, 0.1, 0.04);
  const Vector3d box(0.04, 0.03, 0.02);
  constexpr double kPressed = 0.005;
  constexpr double kStep = 1.25e-6;
  for (const auto& [voxel_size, points] : {std::pair{0.002, 600}, {0.004, 120}}) {
    compile(test::box_mesh(table, {-0.1, -0.05, -0.04}), test::box_mesh(box), voxel_size, points);
    for (int k = 0; k <= 100; ++k) move_to({0.0995, 0.0, 0.0102 - (0.0002 + kPressed) * k / 100});
    double before = 0.0;
    for (int k = 0; k < 4000; ++k) {
      const double x = 0.0995 + kStep * k;
      const CycleReport report = move_to({x, 0.0, 0.01 - kPressed});
      const double force = report.force.spring_W.force.z();
      const double torque = report.force.spring_W.torque.y();
      ASSERT_NEAR(force, 2000.0 * kPressed, 0.02 * 2000.0 * kPressed) << k;
      const double lever = x - 0.1;
      if (lever > 5e-4) {
        ASSERT_NEAR(torque, force * lever, 0.01 * force * lever) << "at " << lever << " m beyond the edge";
        ASSERT_NEAR(torque - before, force * kStep, 0.1 * force * kStep) << "at " << lever << " m beyond the edge";
      }
      before = torque;
    }
  }
}

/// A box whose edges pass over the parallel edge of a table feels nothing along its way, slow and fast.
TEST_F(EdgeContact, LetsEdgesPassOverTheBorderOfAFace) {
  compile(test::box_mesh({0.2, 0.1, 0.04}, {-0.1, -0.05, -0.04}), test::box_mesh({0.04, 0.03, 0.02}), 0.002, 600);
  for (const double step : {2e-6, 2e-5, 5e-4}) {
    god_object_->reset();
    for (int k = 0; k <= 100; ++k) move_to({0.0798, 0.0, 0.0102 - 0.0052 * k / 100});
    for (double x = 0.0798; x < std::min(0.0995, 0.0798 + 2000 * step); x += step) {
      const CycleReport report = move_to({x, 0.0, 0.005});
      ASSERT_NEAR(report.force.spring_W.force.x(), 0.0, 0.02 * 10.0) << "at " << x << " with steps of " << step;
      ASSERT_NEAR(report.force.spring_W.force.z(), 10.0, 0.1) << "at " << x << " with steps of " << step;
    }
  }
}

/// A face that is pressed on a table and turns resists with the torque of even pressure: mu N times the least mean
/// distance of its places. The load's centre is below the device. Over the edge of the table only a part of it touches,
/// and the pressure grows towards the edge.
TEST_F(EdgeContact, TurnsAFaceWithTheTorqueOfEvenPressure) {
  constexpr double kRatio = 0.3;
  constexpr double kPressed = 0.004;
  for (const auto& [voxel_size, points] : {std::pair{0.002, 1500}, {0.002, 300}, {0.004, 300}}) {
    compile(test::box_mesh({0.2, 0.1, 0.04}, {-0.1, -0.05, -0.04}), test::box_mesh({0.04, 0.03, 0.02}), voxel_size,
            points, kRatio);
    for (const double x : {0.0, 0.086, 0.089}) {
      god_object_->reset();
      for (int k = 0; k <= 100; ++k) move_to({x, 0.0, 0.0102 - (0.0002 + kPressed) * k / 100});
      CycleReport report;
      for (int k = 0; k < 1000; ++k) {  // until the box has shifted to the place about which it turns
        report = move_to({x, 0.0, 0.01 - kPressed}, exp_rotation(Vector3d(0.0, 0.0, 4e-5 * k)));
        ASSERT_EQ(report.outcome, Outcome::kContact);
      }
      // linear over the part on the table, from the back of the box to the edge, with its centre at x
      const double back = -0.02;
      const double front = std::min(0.02, 0.1 - x);
      const double middle = 0.5 * (back + front);
      const double variance = (front - back) * (front - back) / 12.0;
      double least = 1.0;  // the box turns about the place where the mean distance is least
      for (int k = -40; k <= 40; ++k) {
        constexpr int kParts = 100;
        double pressure = 0.0;
        double moment = 0.0;
        for (int i = 0; i < kParts; ++i) {
          const double along = back + (front - back) * (i + 0.5) / kParts;
          const double here = std::max(0.0, 1.0 - middle * (along - middle) / variance);
          for (int j = 0; j < kParts; ++j) {
            pressure += here;
            moment += here * std::hypot(along - 2e-4 * k, 0.03 * ((j + 0.5) / kParts - 0.5));
          }
        }
        least = std::min(least, moment / pressure);
      }
      const double expected = kRatio * report.force.spring_W.force.z() * least;
      // with few points and little of the face on the table: measured 6.9 % too little
      const double tolerance = points == 300 && voxel_size < 0.003 && x > 0.088 ? 0.08 : 0.05;
      EXPECT_NEAR(-report.force.spring_W.torque.z(), expected, tolerance * expected)
          << x << " m, voxels of " << voxel_size << " m, " << points << " points";
    }
  }
}

/// An L that hangs over the edge of a cube and is drawn along and about it.
TEST_F(EdgeContact, KeepsABracketAndTheEdgeThatItHangsOverApart) {
  const TriangleMesh cube = test::box_mesh({0.03, 0.03, 0.03}, {-0.03, -0.015, -0.03});
  TriangleMesh bracket;  // an L of 20 x 20 x 12 mm with walls of 6 mm, open downwards, inner corner at the origin
  const std::vector<Vector3d> outline = {{-0.014, 0, 0},     {0, 0, 0},         {0, 0, -0.014},
                                         {0.006, 0, -0.014}, {0.006, 0, 0.006}, {-0.014, 0, 0.006}};
  const auto n = static_cast<std::uint32_t>(outline.size());
  for (const double y : {-0.006, 0.006}) {
    for (const Vector3d& p : outline) bracket.vertices.push_back(p + Vector3d(0, y, 0));
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    bracket.triangles.push_back({i, j, n + j});
    bracket.triangles.push_back({i, n + j, n + i});
  }
  for (const auto& t : {std::array<std::uint32_t, 3>{0, 1, 5}, {1, 4, 5}, {1, 2, 4}, {2, 3, 4}}) {
    bracket.triangles.push_back({t[0], t[2], t[1]});
    bracket.triangles.push_back({n + t[0], n + t[1], n + t[2]});
  }
  compile(cube, bracket, 0.002, 300);
  const precision::MeshOverlap exact({cube, SurfaceKind::kSolid, 0.0}, {bracket, SurfaceKind::kSolid, 0.0}, 1e-7);
  double deepest = 0.0;
  double strongest = 0.0;
  for (int k = 0; k < 1200; ++k) {
    const double t = std::min(1.0, k / 300.0);
    const Quaternion turned =
        exp_rotation(0.3 * t * Vector3d(std::sin(0.004 * k), std::cos(0.007 * k), std::sin(0.011 * k)));
    const Vector3d p(0.001 * std::sin(0.02 * k), 0.008 * std::sin(0.005 * k), 0.004 - 0.008 * t);
    const CycleReport report = move_to(p, turned);
    strongest = std::max(strongest, report.force.spring_W.force.norm());
    if (k % 4 == 0) deepest = std::max(deepest, exact.depth(god_object_->mesh_pose()));
  }
  EXPECT_LE(deepest, 5e-6);
  EXPECT_GT(strongest, 5.0) << "it presses";
}

}  // namespace
}  // namespace godobject::scene_compiler
