// The watch's own look-ups against other ones: the core's, brute force, dense samples, hand-computed cases.
#include "toolchain/watch/oracle.h"

#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "tests/support/folder_test.h"
#include "tests/support/random.h"
#include "toolchain/report/contact_quality/compiled_scene.h"
#include "toolchain/report/contact_quality/meshes.h"
#include "toolchain/watch/mesh_surface.h"
#include "toolchain/watch/stored_field.h"
#include "toolchain/watch/watch.h"

namespace godobject::watch {
namespace {

/// A plate across z = 0 whose distance is known.
class PlateOracle final : public Oracle {
 public:
  explicit PlateOracle(double half) : half_(half) {}
  double distance(const Vector3& p) const override { return std::fabs(p.z()) - half_; }
  Vector3 gradient(const Vector3& p) const override { return {0.0, 0.0, p.z() < 0.0 ? -1.0 : 1.0}; }
  double lipschitz() const override { return 1.0; }

 private:
  double half_;
};

Chord chord_through(const Oracle& oracle, const Vector3& p0, const Vector3& p1) {
  return {p0, p1, oracle.distance(p0), oracle.distance(p1)};
}

TEST(FallsBelow, SeesAPlateBetweenTwoPointsThatAreOutside) {
  const PlateOracle plate(1e-3);
  EXPECT_TRUE(falls_below(plate, chord_through(plate, {0.0, 0.0, 0.1}, {0.02, 0.0, -0.1}), 0.0, 1e-4));
  EXPECT_FALSE(falls_below(plate, chord_through(plate, {0.0, 0.0, 0.1}, {5.0, 0.0, 0.002}), 0.0, 1e-4));
  EXPECT_TRUE(falls_below(plate, chord_through(plate, {0.0, 0.0, 0.1}, {5.0, 0.0, 0.002}), 0.0011, 1e-4));
}

TEST(FallsBelow, AgreesWithDenseSamples) {
  const MeshSurface ell = [] {
    const auto mesh = report::cell_solid({{{-0.4, 0.1, 0.8}, {-0.4, 0.1, 0.8}, {-0.25, 0.25}}},
                                         [](int i, int j, int) { return i == 0 || j == 0; });
    return MeshSurface(mesh.vertices, mesh.triangles);
  }();
  test::Random random(4);
  int below = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector3 p0 = random.in_cube(1.0), p1 = random.in_cube(1.0);
    double least = HUGE_VAL;
    for (int k = 0; k <= 400; ++k) least = std::min(least, ell.distance(p0 + k / 400.0 * (p1 - p0)));
    if (std::fabs(least) < 0.01) continue;  // the resolutions differ
    below += least < 0.0;
    ASSERT_EQ(falls_below(ell, chord_through(ell, p0, p1), 0.0, 1e-3), least < 0.0);
  }
  EXPECT_GT(below, 200);
}

TEST(MeshSurface, IsTheBoxByHandAndTheEllByItsBoxes) {
  const auto box = report::box_mesh({-1.0, -2.0, -3.0}, {1.0, 2.0, 3.0});
  const MeshSurface surface(box.vertices, box.triangles);
  EXPECT_NEAR(surface.distance({0.0, 0.0, 0.0}), -1.0, 1e-15);
  EXPECT_NEAR(surface.distance({4.0, 6.0, 3.0}), 5.0, 1e-14);
  EXPECT_NEAR((surface.gradient({4.0, 6.0, 3.0}) - Vector3(0.6, 0.8, 0.0)).norm(), 0.0, 1e-14);
  EXPECT_TRUE(surface.meets({0.0, 0.0, 5.0}, {0.0, 0.0, 0.0}));
  EXPECT_FALSE(surface.meets({0.0, 0.0, 5.0}, {3.0, 0.0, 0.0}));
  test::Random random(5);
  for (int i = 0; i < 5000; ++i) {
    const Vector3 p = random.in_cube(5.0);
    const Vector3 q = p.cwiseAbs() - Vector3(1.0, 2.0, 3.0);
    const double truth = q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0);
    ASSERT_NEAR(surface.distance(p), truth, 1e-13);
    for (const double most : {1.0, 1.5, 0.5}) {  // as it is, too wide, and wrong
      ASSERT_EQ(surface.distance_within(p, most * std::fabs(truth)), surface.distance(p));
    }
  }
}

/// Two independent readers of one image: the core's and the watch's, in both directions, near edges and far away.
class StoredFieldTest : public test::FolderTest {};

TEST_F(StoredFieldTest, IsAsTheCoreLooksItUp) {
  report::write_ply(report::box_mesh(Vector3::Constant(-0.01), Vector3::Constant(0.01)), folder_ / "body.ply");
  const auto ell = report::cell_solid({{{-0.04, 0.01, 0.08}, {-0.04, 0.01, 0.08}, {-0.025, 0.0}}},
                                      [](int i, int j, int) { return i == 0 || j == 0; });
  const files::SceneImage image =
      report::compile("ell", {.still = {.mesh = ell}, .body = folder_ / "body.ply", .points = 100}, folder_);
  ASSERT_TRUE(image.scene.has_features());
  const StoredField still(image.bytes.span(), kStillField);
  const StoredField body(image.bytes.span(), kBodyField);
  test::Random random(6);
  int near = 0;
  for (int i = 0; i < 40000; ++i) {
    const bool of_body = i % 2 == 1;
    const Vector3 p = of_body ? random.in_cube(0.015) : Vector3(random.in_cube(0.09));
    const FieldSample core = (of_body ? image.scene.body_map : image.scene.voxelmap).sample(p);
    const double own = (of_body ? body : still).distance(p);
    near += core.known;
    ASSERT_NEAR(own, core.distance, 1e-9) << p.transpose();
    if (core.known) {
      ASSERT_LE(((of_body ? body : still).gradient(p) - core.gradient).norm(), 0.6) << p.transpose();
    }
  }
  EXPECT_GT(near, 5000);
  // the stated slope is one
  for (int i = 0; i < 20000; ++i) {
    const Vector3 p = random.in_cube(0.09);
    const Vector3 q = p + random.in_cube(0.002);
    ASSERT_LE(std::fabs(still.distance(p) - still.distance(q)), still.lipschitz() * (p - q).norm() + 1e-12);
  }
}

/// A box of 2 x 4 x 6, grown by half: faces, edges and corners stand half outside of the box.
TEST(GrownSurface, StandsAtItsDistanceFromTheMesh) {
  const auto box = report::box_mesh({-1.0, -2.0, -3.0}, {1.0, 2.0, 3.0});
  const GrownSurface grown({box.vertices, box.triangles}, 0.5, false);
  EXPECT_NEAR(grown.distance({1.7, 0.0, 0.0}), 0.2, 1e-12);
  EXPECT_NEAR(grown.distance({1.3, 2.4, 0.0}), 0.0, 1e-12) << "3, 4, 5 from the edge";
  EXPECT_NEAR(grown.distance({0.9, 0.0, 0.0}), -0.6, 1e-12);
  for (const Vector3& p : {Vector3(1.7, 0.0, 0.0), Vector3(1.3, 2.4, 0.0), Vector3(0.9, 0.0, 0.0)}) {
    EXPECT_EQ(grown.distance_within(p, std::fabs(grown.distance(p))), grown.distance(p));
  }
  EXPECT_TRUE(grown.gradient({0.9, 0.0, 0.0}).normalized().isApprox(Vector3::UnitX(), 1e-12));
}

TEST(GrownSurface, OfASheetHasTwoSidesAndARoundRim) {
  const auto sheet = report::sheet_mesh(1.0);
  const GrownSurface thick({sheet.vertices, sheet.triangles}, 0.1, true);
  for (const double side : {1.0, -1.0}) {
    EXPECT_NEAR(thick.distance({0.2, -0.3, 0.25 * side}), 0.15, 1e-12) << side;
    EXPECT_NEAR(thick.distance({0.2, -0.3, 0.06 * side}), -0.04, 1e-12) << side;
    EXPECT_NEAR(thick.distance({1.3, 0.0, 0.4 * side}), 0.4, 1e-12) << "3, 4, 5 from the rim";
    EXPECT_TRUE(thick.gradient({0.2, -0.3, 0.25 * side}).normalized().isApprox(side * Vector3::UnitZ(), 1e-12)) << side;
  }
}

/// A point that a wrong field lets into the mesh is found.
TEST(MeshProperty, IsViolatedByAPointInTheMesh) {
  const auto box = report::box_mesh({-1.0, -1.0, -1.0}, {1.0, 1.0, 0.0});
  const MeshSurface mesh(box.vertices, box.triangles);
  const PlateOracle nowhere(-10.0);  // a field without a surface
  WatchedSession session;
  session.directions.push_back({.field = &nowhere, .points = {Vector3::Zero()}, .mesh = &mesh, .mesh_accuracy = 1e-4});
  session.parameters.voxel_size = 0.1;  // by the field every point is far
  Watch watch(session);
  WatchedCycle cycle;
  const auto go = [&](double z) {
    cycle.H_WD.translation.z() = z;
    cycle.report.H_WS = cycle.H_WD;
    const std::vector<Pose> path(1, cycle.H_WD);
    cycle.path = path;
    watch.cycle(cycle);
  };
  go(0.5);
  go(0.1);
  go(-0.9e-4);
  EXPECT_EQ(watch.findings()[Property::kMesh].violated, 0) << watch.findings()[Property::kMesh].first;
  go(0.1);
  go(-2e-4);
  EXPECT_EQ(watch.findings()[Property::kMesh].violated, 1);
  go(0.1);
  go(-3.0);  // through it: from outside to outside
  EXPECT_EQ(watch.findings()[Property::kMesh].violated, 3);
}

}  // namespace
}  // namespace godobject::watch
