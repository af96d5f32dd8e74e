#include "toolchain/scene_compiler/mesh/thin_places.h"

#include <gtest/gtest.h>

#include "tests/scene_compiler/test_meshes.h"
#include "toolchain/command_line/failure.h"

namespace godobject::scene_compiler::thin_places_test {
namespace {

using Eigen::Vector3d;

ThinReport look(const TriangleMesh& mesh, double voxel_size, SurfaceKind kind = SurfaceKind::kAuto) {
  return find_thin_places(SolidSurface(mesh, kind, 2.0 * voxel_size), voxel_size, {});
}

TriangleMesh plate(double thickness) { return box({0, 0, 0}, {0.1, 0.1, thickness}); }

TEST(ThinPlaces, FindsNothingInAPlateOfTwoVoxels) {
  const ThinReport report = look(plate(0.002), 0.001);
  EXPECT_EQ(report.walls.samples, 0u);
  EXPECT_EQ(report.gaps.samples, 0u);
  EXPECT_NO_THROW(require_walls_that_last(report, 0.001, "plate"));
}

TEST(ThinPlaces, ReportsAPlateOfOneAndAHalfVoxels) {
  const ThinReport report = look(plate(0.0015), 0.001);
  EXPECT_NEAR(report.walls.smallest, 0.0015, 1e-9);
  EXPECT_NEAR(report.walls.voxel_needed, 0.00075, 1e-9);
  EXPECT_NEAR(report.walls.area, 0.01, 1e-3);
  EXPECT_EQ(report.walls.lost_area, 0.0);
  EXPECT_NO_THROW(require_walls_that_last(report, 0.001, "plate"));
}

TEST(ThinPlaces, RefusesAPlateThatWouldBeLost) {
  const ThinReport report = look(plate(0.0005), 0.001);
  EXPECT_NEAR(report.walls.lost_area, 0.01, 1e-3);
  try {
    require_walls_that_last(report, 0.001, "plate.ply");
    FAIL() << "took it";
  } catch (const command::Failure& failure) {
    EXPECT_EQ(failure.exit_code(), command::ExitCode::kBadData);
    const std::string message = failure.what();
    EXPECT_NE(message.find("plate.ply"), std::string::npos) << message;
    EXPECT_NE(message.find("voxel_size = 0.00025"), std::string::npos) << message;
    EXPECT_NE(message.find("shell"), std::string::npos) << message;
  }
}

TEST(ThinPlaces, TakesAThinPlateAsAShell) {
  const ThinReport report = look(plate(0.0005), 0.001, SurfaceKind::kShell);
  EXPECT_NO_THROW(require_walls_that_last(report, 0.001, "plate"));
}

TEST(ThinPlaces, ReportsAGapButDoesNotRefuseIt) {
  const TriangleMesh two = joined(box({0, 0, 0}, {0.05, 0.05, 0.02}), box({0, 0, 0.0205}, {0.05, 0.05, 0.04}));
  const ThinReport report = look(two, 0.001);
  EXPECT_NEAR(report.gaps.smallest, 0.0005, 1e-9);
  EXPECT_NEAR(report.gaps.at.z(), 0.02025, 1e-6);
  EXPECT_EQ(report.walls.samples, 0u);
  EXPECT_NO_THROW(require_walls_that_last(report, 0.001, "blocks"));
}

TEST(ThinPlaces, ReportsAGapBetweenSheets) {
  const std::array<bool, 6> kTop = {false, false, false, false, false, true};
  const TriangleMesh two =
      joined(box({0, 0, -1}, {0.05, 0.05, 0.0}, kTop), box({0, 0, -1}, {0.05, 0.05, 0.0035}, kTop));
  const ThinReport report = look(two, 0.001);
  EXPECT_NEAR(report.gaps.smallest, 0.0015, 1e-9);  // between sheets thickened to 2 mm
}

TEST(ThinPlaces, DoesNotTakeAnEdgeForAWall) {
  // a wedge of 22 degrees: flagged along its edge, not refused
  TriangleMesh wedge;
  wedge.vertices = {{0, 0, 0},    {0.05, 0, 0.01},    {0.05, 0, -0.01},
                    {0, 0.05, 0}, {0.05, 0.05, 0.01}, {0.05, 0.05, -0.01}};
  wedge.triangles = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3}, {0, 3, 5}, {0, 5, 2}, {1, 2, 5}, {1, 5, 4}};
  const ThinReport report = look(wedge, 0.001);
  EXPECT_GT(report.walls.samples, 0u);
  // thinner than a voxel over the first 2.5 mm of its 50 mm: reported, but not refused
  EXPECT_NEAR(report.walls.lost_area, 0.0025 * 0.05, 0.1 * 0.0025 * 0.05);
  EXPECT_EQ(report.walls.lost_patch, 0.0);
  EXPECT_NO_THROW(require_walls_that_last(report, 0.001, "wedge"));
}

TEST(ThinPlaces, IgnoresFacesInsideOfTheSolid) {
  // two overlapping blocks: the faces within the union bound nothing
  const TriangleMesh two = joined(box({0, 0, 0}, {0.05, 0.05, 0.02}), box({0.01, 0.01, 0.0195}, {0.04, 0.04, 0.04}));
  const ThinReport report = look(two, 0.001);
  EXPECT_EQ(report.walls.samples, 0u);
  EXPECT_EQ(report.gaps.samples, 0u);
}

}  // namespace
}  // namespace godobject::scene_compiler::thin_places_test
