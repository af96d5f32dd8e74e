#include "toolchain/report/analytic/solid.h"

#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace godobject::analytic {
namespace {

Pose odd_pose() {
  Pose pose;
  pose.rotation = exp_rotation(Vector3(0.4, -0.9, 0.3));
  pose.translation = Vector3(0.3, -0.2, 5.0);
  return pose;
}

std::vector<Primitive> all_primitives() {
  return {HalfSpace{.n = Vector3(0.6, 0.0, 0.8), .offset = -0.05},
          Ball{.center = Vector3(0.02, 0.0, 0.1), .radius = 0.03},
          Box{.center = Vector3(0.0, 0.1, 0.1), .half_edges = Vector3(0.02, 0.01, 0.03), .radius = 0.004},
          Bore{.radius = 0.2}};
}

TEST(Solid, KnowsDistancesThatCanBeWorkedOut) {
  const Solid edge({Box{.half_edges = Vector3(1.0, 2.0, 3.0)}});
  EXPECT_DOUBLE_EQ(edge.distance(Vector3(1.3, 2.4, 0.0)), 0.5);  // beside an edge
  EXPECT_DOUBLE_EQ(edge.distance(Vector3(0.9, 0.0, 0.0)), -0.1);
  const Solid sheet({Box{.half_edges = Vector3(1.0, 1.0, 0.0), .radius = 0.1}});
  EXPECT_DOUBLE_EQ(sheet.distance(Vector3(0.2, 0.3, -0.25)), 0.15);
  const Solid hole({Bore{.radius = 0.5}, HalfSpace{.offset = -1.0}});
  EXPECT_DOUBLE_EQ(hole.distance(Vector3(0.3, 0.0, -0.2)), 0.2);
  EXPECT_DOUBLE_EQ(hole.distance(Vector3(0.0, 0.0, -0.9)), 0.1);
}

TEST(Solid, HasTheGradientOfItsDistance) {
  const Solid solid = Solid(all_primitives()).moved(odd_pose());
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-0.15, 0.15);
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 2000; ++i) {
    const Vector3 p = odd_pose() * Vector3(uniform(random), uniform(random), uniform(random));
    std::vector<Piece> pieces;
    solid.pieces(p, pieces);
    std::sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.distance < b.distance; });
    EXPECT_EQ(pieces.front().distance, solid.distance(p));
    if (pieces[1].distance - pieces[0].distance < 1e-4 || pieces.front().distance < 1e-3) continue;  // a kink
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3 step = kStep * Vector3::Unit(axis);
      const double slope = (solid.distance(p + step) - solid.distance(p - step)) / (2.0 * kStep);
      EXPECT_NEAR(solid.gradient(p)[axis], slope, 1e-5) << p.transpose();
    }
  }
}

TEST(Solid, MovesWithItsFrame) {
  const Solid still(all_primitives());
  const Solid moved = still.moved(odd_pose());
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(-0.15, 0.15);
  for (int i = 0; i < 1000; ++i) {
    const Vector3 p(uniform(random), uniform(random), uniform(random));
    EXPECT_NEAR(moved.distance(odd_pose() * p), still.distance(p), 1e-14);
    EXPECT_LT((moved.gradient(odd_pose() * p) - odd_pose().rotation * still.gradient(p)).norm(), 1e-10);
  }
}

}  // namespace
}  // namespace godobject::analytic
