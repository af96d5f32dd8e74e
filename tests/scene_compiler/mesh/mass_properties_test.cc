#include "toolchain/scene_compiler/mesh/mass_properties.h"

#include <gtest/gtest.h>

#include "tests/scene_compiler/simple_meshes.h"

namespace godobject::scene_compiler::mass_properties_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using test::box_mesh;

const Vector3d kEdges(0.06, 0.04, 0.03);
// (b^2 + c^2) / 12 and so on, ascending
const Vector3d kBoxMoments(0.0025 / 12.0, 0.0045 / 12.0, 0.0052 / 12.0);

void expect_near(const Vector3d& a, const Vector3d& b, double tolerance) {
  EXPECT_LE((a - b).cwiseAbs().maxCoeff(), tolerance) << a.transpose() << "  against  " << b.transpose();
}

TEST(MassProperties, OfABoxAreThoseOfTheTextbook) {
  const MassMoments moments = moments_of_volume(box_mesh(kEdges));
  EXPECT_NEAR(moments.volume, 72e-6, 1e-18);
  expect_near(moments.center, Vector3d::Zero(), 1e-16);
  EXPECT_LE((moments.inertia - Matrix3d(kBoxMoments.asDiagonal())).cwiseAbs().maxCoeff(), 1e-16);
}

TEST(MassProperties, OfAnOffsetBoxMoveWithIt) {
  const Vector3d low(1.0, -2.0, 3.0);
  const MassMoments moments = moments_of_volume(box_mesh(kEdges, low));
  EXPECT_NEAR(moments.volume, 72e-6, 1e-16);
  expect_near(moments.center, low + 0.5 * kEdges, 1e-14);
  // coordinates of 3 m carry errors of 4e-16 m, times a lever of 0.06 m
  EXPECT_LE((moments.inertia - Matrix3d(kBoxMoments.asDiagonal())).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(MassProperties, OfATetrahedronAreAThirdOfBaseTimesHeight) {
  const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  const MassMoments moments = moments_of_volume(mesh);
  EXPECT_NEAR(moments.volume, 1.0, 1e-15);
  expect_near(moments.center, Vector3d(0.25, 0.5, 0.75), 1e-15);
  // the covariance of a right tetrahedron is 3/80 of the squared edge along an axis, -1/80 of the product across
  EXPECT_NEAR(moments.inertia(0, 0), 3.0 / 80.0 * (4.0 + 9.0), 1e-15);
  EXPECT_NEAR(moments.inertia(0, 1), 1.0 / 80.0 * 2.0, 1e-15);
}

TEST(MassProperties, PrincipalMomentsDoNotDependOnTheFrame) {
  const Eigen::Isometry3d motion = test::odd_motion();
  const MassMoments moments = moments_of_volume(test::moved(box_mesh(kEdges), motion));
  const PrincipalAxes principal = principal_axes(moments.inertia);
  expect_near(moments.center, motion.translation(), 1e-14);
  expect_near(principal.moments, kBoxMoments, 1e-15);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(std::abs(principal.rotation_MB.col(axis).dot(motion.linear().col(axis))), 1.0, 1e-12);
  }
  EXPECT_NEAR(principal.rotation_MB.determinant(), 1.0, 1e-12);
}

TEST(MassProperties, AxesThatArePrincipalAlreadyAreKept) {
  const PrincipalAxes principal = principal_axes(kBoxMoments.asDiagonal());
  EXPECT_LE((principal.rotation_MB - Matrix3d::Identity()).norm(), 1e-12);
}

TEST(MassProperties, AxesAreSortedByMomentAndRightHanded) {
  const PrincipalAxes principal = principal_axes(Vector3d(3.0, 1.0, 2.0).asDiagonal());
  expect_near(principal.moments, Vector3d(1.0, 2.0, 3.0), 1e-15);
  expect_near(principal.rotation_MB.col(0), Vector3d::UnitY(), 1e-12);
  expect_near(principal.rotation_MB.col(1), Vector3d::UnitZ(), 1e-12);
  EXPECT_NEAR(principal.rotation_MB.determinant(), 1.0, 1e-12);
}

TEST(MassProperties, EqualMomentsTakeTheMeshesOwnAxes) {
  EXPECT_TRUE(principal_axes(2.0 * Matrix3d::Identity()).rotation_MB.isIdentity(0.0));
  // rounding must not decide; the perturbation is far below the threshold of 1e-5
  Matrix3d cube = 2.0 * Matrix3d::Identity();
  cube(0, 1) = cube(1, 0) = 1e-9;
  cube(2, 2) -= 2e-9;
  EXPECT_TRUE(principal_axes(cube).rotation_MB.isIdentity(0.0));
  Matrix3d disc = Vector3d(1.0, 1.0, 2.0).asDiagonal();
  disc(0, 1) = disc(1, 0) = 1e-9;
  EXPECT_TRUE(principal_axes(disc).rotation_MB.isIdentity(1e-8));
  Matrix3d rod = Vector3d(1.0, 2.0, 2.0).asDiagonal();
  rod(1, 2) = rod(2, 1) = 1e-9;
  EXPECT_TRUE(principal_axes(rod).rotation_MB.isIdentity(1e-8));
}

TEST(MassProperties, OfABallApproachTwoFifthsOfItsRadiusSquared) {
  const MassMoments moments = moments_of_volume(test::ball_mesh(0.1, 64));
  const PrincipalAxes principal = principal_axes(moments.inertia);
  expect_near(principal.moments, Vector3d::Constant(0.4 * 0.01),
              0.4 * 0.01 * 3e-3);  // 64 rings: facets lie 1.2e-3 deep
}

TEST(MassProperties, AMeshWithoutVolumeHasNone) {
  EXPECT_EQ(moments_of_volume(box_mesh(Vector3d(0.1, 0.1, 0.0))).volume, 0.0);
  EXPECT_EQ(moments_of_volume(test::inside_out(box_mesh(kEdges))).volume, 0.0);
  EXPECT_EQ(moments_of_volume({}).volume, 0.0);
}

TEST(MassProperties, OfPointsAreFiniteForOnePointAndForALine) {
  const std::vector<Vector3d> one{{1.0, 2.0, 3.0}};
  const MassMoments single = moments_of_points(one);
  expect_near(single.center, one[0], 0.0);
  EXPECT_TRUE(principal_axes(single.inertia).rotation_MB.isIdentity(0.0));
  EXPECT_EQ(principal_axes(single.inertia).moments, Vector3d::Zero());

  const std::vector<Vector3d> line{{0.0, -1.0, 5.0}, {0.0, 1.0, 5.0}};
  const PrincipalAxes rod = principal_axes(moments_of_points(line).inertia);
  expect_near(rod.moments, Vector3d(0.0, 1.0, 1.0), 1e-15);
  expect_near(rod.rotation_MB.col(0), Vector3d::UnitY(), 1e-15);
  EXPECT_NEAR(rod.rotation_MB.determinant(), 1.0, 1e-12);
}

}  // namespace
}  // namespace godobject::scene_compiler::mass_properties_test
