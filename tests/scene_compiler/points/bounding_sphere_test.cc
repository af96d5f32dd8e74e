#include "toolchain/scene_compiler/points/bounding_sphere.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace godobject::scene_compiler::bounding_sphere_test {
namespace {

using Eigen::Vector3d;

TEST(BoundingSphere, OfOnePointIsThatPoint) {
  const std::vector<Vector3d> points(3, Vector3d(1.0, 2.0, 3.0));
  const Sphere sphere = bounding_sphere(points);
  EXPECT_EQ(sphere.center, points[0]);
  EXPECT_EQ(sphere.radius, 0.0);
}

TEST(BoundingSphere, OfTwoPointsLiesHalfway) {
  const std::vector<Vector3d> points{{-1.0, 0.0, 0.0}, {3.0, 0.0, 0.0}};
  const Sphere sphere = bounding_sphere(points);
  EXPECT_NEAR((sphere.center - Vector3d(1.0, 0.0, 0.0)).norm(), 0.0, 1e-15);
  EXPECT_NEAR(sphere.radius, 2.0, 1e-15);
}

TEST(BoundingSphere, OfAnObtuseTriangleIgnoresTheMiddleCorner) {
  const std::vector<Vector3d> points{{-1.0, 0.0, 0.0}, {0.1, 0.2, 0.0}, {1.0, 0.0, 0.0}};
  EXPECT_NEAR(bounding_sphere(points).radius, 1.0, 1e-15);
}

TEST(BoundingSphere, OfAnEquilateralTriangleIsItsCircumcircle) {
  const std::vector<Vector3d> points{{0.0, 0.0, 5.0}, {1.0, 0.0, 5.0}, {0.5, std::sqrt(0.75), 5.0}};
  EXPECT_NEAR(bounding_sphere(points).radius, 1.0 / std::sqrt(3.0), 1e-14);
}

TEST(BoundingSphere, OfARegularTetrahedronIsItsCircumsphere) {
  const std::vector<Vector3d> points{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  const Sphere sphere = bounding_sphere(points);
  EXPECT_NEAR(sphere.radius, std::sqrt(3.0), 1e-14);
  EXPECT_NEAR(sphere.center.norm(), 0.0, 1e-14);
}

TEST(BoundingSphere, OfCosphericalAndOfCollinearPointsIsFound) {
  std::vector<Vector3d> cube;
  for (unsigned i = 0; i < 8; ++i) cube.emplace_back(i & 1u, (i >> 1) & 1u, (i >> 2) & 1u);
  EXPECT_NEAR(bounding_sphere(cube).radius, std::sqrt(0.75), 1e-14);
  std::vector<Vector3d> line;
  for (int i = 0; i <= 100; ++i) line.push_back(Vector3d(1.0, 2.0, 3.0) * (0.01 * i));
  EXPECT_NEAR(bounding_sphere(line).radius, 0.5 * std::sqrt(14.0), 1e-13);
}

/// An independent method, slow but sure: step towards the farthest point by less and less (Badoiu and Clarkson). After
/// n steps the centre is within radius / sqrt(n).
double radius_by_small_steps(const std::vector<Vector3d>& points) {
  Vector3d center = points[0];
  double radius = 0.0;
  for (int n = 1; n <= 200000; ++n) {
    const Vector3d* furthest = &points[0];
    for (const Vector3d& p : points) {
      if ((p - center).squaredNorm() > (*furthest - center).squaredNorm()) furthest = &p;
    }
    radius = (*furthest - center).norm();
    center += (*furthest - center) / (n + 1.0);
  }
  return radius;
}

TEST(BoundingSphere, IsNoLargerThanWhatSmallStepsFind) {
  std::mt19937 random(20160);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 12; ++trial) {
    std::vector<Vector3d> points;
    const int count = 2 + trial * 2;
    const Vector3d squeeze(1.0, trial % 2 ? 1e-3 : 1.0, trial % 3 ? 1.0 : 1e-6);
    for (int i = 0; i < count; ++i) {
      points.push_back(squeeze.cwiseProduct(Vector3d(normal(random), normal(random), normal(random))));
    }
    const Sphere sphere = bounding_sphere(points);
    for (const Vector3d& p : points) EXPECT_LE((p - sphere.center).norm(), sphere.radius);
    const double reference = radius_by_small_steps(points);
    EXPECT_LE(sphere.radius, reference * (1.0 + 1e-10)) << trial;
    EXPECT_GE(sphere.radius, reference * (1.0 - 1e-3)) << trial;  // the steps have not converged
  }
}

TEST(BoundingSphere, OfManyPointsOnASphereIsThatSphere) {
  std::mt19937 random(4711);
  std::normal_distribution<double> normal;
  std::vector<Vector3d> points;
  for (int i = 0; i < 20000; ++i) {
    points.push_back(Vector3d(7.0, -3.0, 2.0) +
                     0.25 * Vector3d(normal(random), normal(random), normal(random)).normalized());
  }
  const Sphere sphere = bounding_sphere(points);
  EXPECT_NEAR(sphere.radius, 0.25, 1e-8);
  EXPECT_NEAR((sphere.center - Vector3d(7.0, -3.0, 2.0)).norm(), 0.0, 1e-8);
}

}  // namespace
}  // namespace godobject::scene_compiler::bounding_sphere_test
