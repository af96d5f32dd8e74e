// The reference method: hand-computed cases, contradictions, and the optimality of random problems.
#include "toolchain/watch/least_distance.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "tests/support/random.h"

namespace godobject::watch {
namespace {

TEST(LeastDistance, IsTheNearestPointOfAHalfPlane) {
  HalfPlane row;
  row.normal << 3.0, 0.0, 0.0, 4.0, 0.0, 0.0;
  row.bound = 10.0;
  const LeastDistance found = least_distance({row});
  ASSERT_TRUE(found.feasible);
  EXPECT_LT((found.x - row.normal * 0.4).norm(), 1e-12);  // bound / |normal|^2
  EXPECT_NEAR(found.multiplier_sum, 0.4, 1e-12);
}

TEST(LeastDistance, SeesContradictions) {
  HalfPlane up, down;
  up.normal = Vector6::Unit(2);
  up.bound = 1.0;
  down.normal = -Vector6::Unit(2);
  down.bound = 0.5;
  EXPECT_FALSE(least_distance({up, down}).feasible);
}

/// The conditions of Karush, Kuhn and Tucker in the form that needs no multipliers: no feasible point has a smaller
/// component along the solution than the solution itself.
TEST(LeastDistance, IsNearerThanEveryFeasiblePoint) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 300; ++i) {
    const Vector6 inside = Vector6::NullaryExpr([&] { return normal(random); });  // feasible by construction
    std::vector<HalfPlane> rows(40);
    for (HalfPlane& row : rows) {
      row.normal = Vector6::NullaryExpr([&] { return normal(random); });
      row.bound = row.normal.dot(inside) - std::fabs(normal(random));
    }
    const LeastDistance found = least_distance(rows);
    ASSERT_TRUE(found.feasible);
    for (const HalfPlane& row : rows) ASSERT_GE(row.normal.dot(found.x), row.bound - 1e-9);
    ASSERT_GE(inside.dot(found.x), found.x.squaredNorm() - 1e-9);
  }
}

/// The projection lies in the cone, what is left points away from all rays and is perpendicular to the projection; all
/// of a vector within the cone is its projection.
TEST(ConeProjection, IsNearest) {
  test::Random random(5);
  const auto vector = [&] {
    Vector6 v;
    for (int i = 0; i < 6; ++i) v[i] = random.between(-1.0, 1.0);
    return v;
  };
  for (int trial = 0; trial < 2000; ++trial) {
    std::vector<Vector6> rays;
    Vector6 within = Vector6::Zero();
    for (int i = 0; i < 1 + trial % 40; ++i) {
      rays.push_back(std::pow(10.0, random.between(-2.0, 2.0)) * vector());
      within += random.between(0.0, 1.0) * rays.back();
    }
    const ConeProjection same = projection_on_cone(within, rays);
    ASSERT_TRUE(same.converged);
    EXPECT_LT((same.x - within).norm(), 1e-9 * within.norm());
    const Vector6 w = 10.0 * vector();
    const ConeProjection found = projection_on_cone(w, rays);
    ASSERT_TRUE(found.converged);
    EXPECT_LT(std::fabs((w - found.x).dot(found.x)), 1e-9 * w.squaredNorm());
    for (const Vector6& ray : rays) EXPECT_LT((w - found.x).dot(ray), 1e-9 * w.norm() * ray.norm());
  }
  EXPECT_TRUE(projection_on_cone(Vector6::Ones(), {}).x.isZero(0.0));
  EXPECT_TRUE(projection_on_cone(Vector6::Zero(), {Vector6::Ones()}).x.isZero(0.0));
}

}  // namespace
}  // namespace godobject::watch
