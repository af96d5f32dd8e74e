// Which rows of points the rows of edge pairs imply, by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/pipeline/contact/implied_rows.h"
#include "tests/support/edge_set.h"
#include "tests/support/random.h"

namespace godobject::detail::implied_rows_test {
namespace {

constexpr double kMargin = 2e-5;
constexpr double kHeight = 2e-5;

/// Tells whether the rows of edge pairs imply that of the point.
bool implied(const HeldPoint& point, const EdgeContacts& edges, const NearEdges& near, const Pose& H) {
  return std::isfinite(implied_gap(point, edges, near, H, kMargin, 0.1 * kMargin));
}

void set_faces(format::SharpEdge& edge, const Vector3& first, const Vector3& second) {
  for (int axis = 0; axis < 3; ++axis) {
    edge.normal[0][axis] = static_cast<float>(first[axis]);
    edge.normal[1][axis] = static_cast<float>(second[axis]);
  }
}

/// The lower face of a box, 20 mm wide, lies over an edge of the still body along y. The edges of the face that cross
/// it, 0 and 1, are 10 mm apart. Points are given for the pose H.
struct FaceOverAnEdge {
  Pose H;
  test::EdgeSet moving{
      {{Vector3(-0.01, -0.005, 0), Vector3(0.01, -0.005, 0)}, {Vector3(-0.01, 0.005, 0), Vector3(0.01, 0.005, 0)}}};
  test::EdgeSet still{{{Vector3(0, -0.1, 0), Vector3(0, 0.1, 0)}}};
  EdgeContacts edges;
  NearEdges near;

  FaceOverAnEdge() {
    const Vector3 down = -Vector3::UnitZ();
    set_faces(moving.edges()[0], down, -Vector3::UnitY());
    set_faces(moving.edges()[1], Vector3::UnitY(), down);
    set_faces(still.edges()[0], Vector3::UnitZ(), Vector3::UnitX());
    edges = {moving.view(), still.view()};
    H.translation = Vector3(0.002, 0.001, kHeight);
    for (const std::uint32_t k : {0u, 1u}) {
      near.push({k, 0}, gap_at(edges, {k, 0}, H));
    }
  }

  /// A point of the face, given in the box's frame.
  bool implies(double x, double y, double z = 0.0) const {
    const Vector3 p = H * Vector3(x, y, z);
    return implies_at(p, std::hypot(p.x(), p.z()));
  }
  bool implies_at(const Vector3& p, double distance) const { return implied({p, distance, false}, edges, near, H); }
};

TEST(ImpliedRows, AreThoseOfPointsOnAnEdgeOfAPair) {
  const FaceOverAnEdge scene;
  EXPECT_TRUE(scene.implies(-0.002, 0.005));
  EXPECT_TRUE(scene.implies(-0.0021, -0.005)) << "0.1 mm before the still edge";
  EXPECT_FALSE(scene.implies(-0.002, 0.005, 1e-5)) << "a point 10 um beside the edge";
}

TEST(ImpliedRows, AreThoseOfPointsOnAFaceBetweenTwoPairs) {
  const FaceOverAnEdge scene;
  EXPECT_TRUE(scene.implies(-0.002, 0.0));
  EXPECT_TRUE(scene.implies(-0.00205, 0.0045));
  EXPECT_FALSE(scene.implies(-0.002, 0.006)) << "beyond the face";
  EXPECT_FALSE(scene.implies(-0.002, 0.0, -1e-5)) << "a point below the face";
}

TEST(ImpliedRows, AreNotThoseOfPointsNearAnotherPartOfTheSurface) {
  const FaceOverAnEdge scene;
  const Vector3 p = scene.H * Vector3(-0.002, 0.0, 0.0);
  EXPECT_TRUE(scene.implies_at(p, kHeight));
  EXPECT_FALSE(scene.implies_at(p, 0.5 * kHeight)) << "something is nearer than the edge";
}

TEST(ImpliedRows, NeedBothPairs) {
  FaceOverAnEdge one_pair;
  one_pair.near.count = 1;
  EXPECT_FALSE(one_pair.implies(-0.002, 0.0));
  EXPECT_TRUE(one_pair.implies(-0.002, -0.005)) << "on the edge of the pair";
  EXPECT_FALSE(one_pair.implies(-0.002, 0.005)) << "on the edge that has no pair";
  FaceOverAnEdge far_pair;
  far_pair.near.gap[0].distance = 3.0 * kMargin;
  EXPECT_FALSE(far_pair.implies(-0.002, 0.0)) << "that pair holds nothing";
  FaceOverAnEdge over_a_face;
  over_a_face.near.gap[0].is_nearest = false;
  EXPECT_FALSE(over_a_face.implies(-0.002, 0.0));
  FaceOverAnEdge other_faces;
  set_faces(other_faces.moving.edges()[1], Vector3::UnitY(), -Vector3(0.1, 0, 1).normalized());
  EXPECT_FALSE(other_faces.implies(-0.002, 0.0)) << "the two edges share no face";
  FaceOverAnEdge stepped;
  for (auto& end : stepped.moving.edges()[1].end) end[2] = 1e-4;
  EXPECT_FALSE(stepped.implies(-0.002, 0.0)) << "parallel faces at different heights";
}

/// Only the pairs at hand count, not those of the question before.
TEST(ImpliedRows, ForgetThePairsOfTheQuestionBefore) {
  FaceOverAnEdge scene;
  const Vector3 p = scene.H * Vector3(-0.002, 0.0, 0.0);
  const double distance = std::hypot(p.x(), p.z());
  const bool by_both = scene.implies_at(p, distance);
  scene.near.count = 1;
  const bool by_one = scene.implies_at(p, distance);  // at once, while the memory still has the other pair
  EXPECT_TRUE(by_both);
  EXPECT_FALSE(by_one);
}

/// The faces of bodies have normals that are not exactly unit vectors in single precision.
TEST(ImpliedRows, KnowAFaceInAnyDirection) {
  test::Random random(5);
  for (int k = 0; k < 200; ++k) {
    FaceOverAnEdge scene;
    const Pose turn{exp_rotation(3.0 * random.direction()), Vector3::Zero()};
    for (format::SharpEdge& edge : scene.moving.edges()) {
      const Vector3 ends[2] = {turn * edge_end(edge, 0), turn * edge_end(edge, 1)};
      set_faces(edge, turn * face_normal(edge, 0), turn * face_normal(edge, 1));
      for (int e = 0; e < 2; ++e) {
        for (int axis = 0; axis < 3; ++axis) edge.end[e][axis] = ends[e][axis];
      }
    }
    scene.H = scene.H * turn.inverse();
    const Vector3 p = scene.H * (turn * Vector3(-0.002, 0.0, 0.0));
    EXPECT_TRUE(scene.implies_at(p, std::hypot(p.x(), p.z()))) << k;
  }
}

/// Two triangles of one face have normals that differ by rounding.
TEST(ImpliedRows, KnowAFaceByNormalsThatDifferByRounding) {
  FaceOverAnEdge scene;
  scene.moving.edges()[1].normal[1][0] += 2e-7f;
  EXPECT_TRUE(scene.implies(-0.002, 0.0));
  scene.moving.edges()[1].normal[1][0] += 1e-5f;
  EXPECT_FALSE(scene.implies(-0.002, 0.0)) << "another face";
}

/// Edges of sheets have no faces, so two of them bound none.
TEST(ImpliedRows, KnowNoFaceOfASheet) {
  FaceOverAnEdge scene;
  for (format::SharpEdge& edge : scene.moving.edges()) set_faces(edge, Vector3::Zero(), Vector3::Zero());
  EXPECT_FALSE(scene.implies(-0.002, 0.0));
  EXPECT_TRUE(scene.implies(-0.002, 0.005)) << "on an edge of a pair";
}

/// Over a rib, a point is as near to one edge of the rib as to the other. A pair of each edge bounds nothing.
TEST(ImpliedRows, NeedTwoPairsOfOneEdge) {
  constexpr double kHalf = 1e-5;
  FaceOverAnEdge scene;
  const test::EdgeSet still(
      {{Vector3(-kHalf, -0.1, 0), Vector3(-kHalf, 0.1, 0)}, {Vector3(kHalf, -0.1, 0), Vector3(kHalf, 0.1, 0)}});
  scene.edges.still = still.view();
  const Vector3 p(0.0, 0.0, kHeight);
  const double distance = std::hypot(kHalf, kHeight);
  scene.near.gap[0] = gap_at(scene.edges, {0, 0}, scene.H);
  scene.near.gap[1] = gap_at(scene.edges, {1, 0}, scene.H);
  EXPECT_TRUE(scene.implies_at(p, distance)) << "both pairs of one edge";
  scene.near.pair[1].still = 1;
  scene.near.gap[1] = gap_at(scene.edges, {1, 1}, scene.H);
  EXPECT_FALSE(scene.implies_at(p, distance));
}

/// Pairs keep their own gap, which may be smaller than that of the point: the face is tilted over the still edge, its
/// lower edge pair is the nearest.
TEST(ImpliedRows, KeepTheGapOfThePairs) {
  FaceOverAnEdge scene;
  scene.H.rotation = exp_rotation(Vector3(1e-4, 0.0, 0.0));
  scene.near.count = 0;
  for (const std::uint32_t k : {0u, 1u}) {
    scene.near.push({k, 0}, gap_at(scene.edges, {k, 0}, scene.H));
  }
  const double lower = scene.near.gap[0].distance;
  ASSERT_LT(lower, scene.near.gap[1].distance - 0.4e-6);
  const auto gap = [&](double x, double y) {
    const Vector3 p = scene.H * Vector3(x, y, 0.0);
    const HeldPoint point{p, std::hypot(p.x(), p.z()), false};
    return implied_gap(point, scene.edges, scene.near, scene.H, kMargin, 0.1 * kMargin);
  };
  EXPECT_EQ(gap(-0.0021, -0.005), lower) << "on the edge of the nearer pair, whose own gap is larger";
  EXPECT_EQ(gap(-0.0021, 0.005), scene.near.gap[1].distance);
  EXPECT_EQ(gap(-0.0021, 0.0), lower) << "between the two";
  EXPECT_EQ(gap(-0.0021, 0.02), std::numeric_limits<double>::infinity()) << "beyond the face";
}

/// The one row of parallel edges holds their middle, so a point at the end needs its own.
TEST(ImpliedRows, AreNotThoseOfPointsFarAlongAParallelEdge) {
  const test::EdgeSet moving({{Vector3(0, -0.005, kHeight), Vector3(0, 0.005, kHeight)}});
  const test::EdgeSet still({{Vector3(0, -0.005, 0), Vector3(0, 0.005, 0)}});
  const EdgeContacts edges{moving.view(), still.view()};
  NearEdges near;
  near.push({0, 0}, gap_at(edges, {0, 0}, Pose{}));
  const auto implies = [&](double y) { return implied({Vector3(0, y, kHeight), kHeight, false}, edges, near, Pose{}); };
  EXPECT_TRUE(implies(near.gap[0].on_moving.y() + kMargin));
  EXPECT_TRUE(implies(near.gap[0].on_moving.y() - 3.5 * kMargin)) << "within four margins";
  EXPECT_FALSE(implies(near.gap[0].on_moving.y() - 4.5 * kMargin));
  EXPECT_FALSE(implies(near.gap[0].on_moving.y() + 1e-3));
}

/// The row of edges that cross holds the whole edge off the other one. By 0.05 rad and less they count as parallel.
TEST(ImpliedRows, AreThoseOfPointsFarAlongAnEdgeThatCrosses) {
  const test::EdgeSet still({{Vector3(0, -0.1, 0), Vector3(0, 0.1, 0)}});
  const auto implies = [&](double angle) {
    const Vector3 along(std::sin(angle), std::cos(angle), 0.0);
    const Vector3 above(0.0, 0.0, kHeight);
    const test::EdgeSet moving({{above - 0.005 * along, above + 0.005 * along}});
    const EdgeContacts edges{moving.view(), still.view()};
    NearEdges near;
    near.push({0, 0}, gap_at(edges, {0, 0}, Pose{}));
    const Vector3 p = above + 0.002 * along;
    return implied({p, std::hypot(p.x(), p.z()), false}, edges, near, Pose{});
  };
  for (const double side : {1.0, -1.0}) {
    EXPECT_FALSE(implies(0.03 * side));
    EXPECT_FALSE(implies(0.045 * side));
    EXPECT_TRUE(implies(0.055 * side));
    EXPECT_TRUE(implies(0.09 * side));
    EXPECT_TRUE(implies(1.5 * side));
  }
}

/// Points of sheets lie on the rounds of edges, a radius off their middle lines.
TEST(ImpliedRows, CountTheRadiiOfSheets) {
  constexpr double kRadius = 1e-3;
  test::EdgeSet moving({{Vector3(-0.01, 0, 0), Vector3(0.01, 0, 0)}});
  test::EdgeSet still({{Vector3(0, -0.01, 0), Vector3(0, 0.01, 0)}});
  moving.edges()[0].radius = static_cast<float>(kRadius);
  still.edges()[0].radius = static_cast<float>(2.0 * kRadius);
  const EdgeContacts edges{moving.view(), still.view()};
  Pose H;
  H.translation.z() = 3.0 * kRadius + kHeight;
  NearEdges near;
  near.push({0, 0}, gap_at(edges, {0, 0}, H));
  const auto implies = [&](double z, double distance) {
    return implied({Vector3(0, 0, z), distance, false}, edges, near, H);
  };
  EXPECT_TRUE(implies(2.0 * kRadius + kHeight, kHeight)) << "the lowest point of the round";
  EXPECT_FALSE(implies(3.0 * kRadius + kHeight, kRadius + kHeight)) << "a point of the middle line";
}

/// The same with the roles of the bodies exchanged: a feature point of the still body under an edge of the moving one.
TEST(ImpliedRows, AreThoseOfFeaturePointsToo) {
  const FaceOverAnEdge scene;
  EdgeContacts edges{scene.edges.still, scene.edges.moving};
  NearEdges near;
  Pose H;
  H.translation = Vector3(0.0, 0.0, -kHeight);
  for (const std::uint32_t k : {0u, 1u}) {
    near.push({0, k}, gap_at(edges, {0, k}, H));
  }
  const auto implies = [&](const Vector3& p_W, bool is_feature) {
    const double distance = std::hypot(p_W.x(), p_W.z() + kHeight);
    return implied({p_W, distance, is_feature}, edges, near, H);
  };
  EXPECT_TRUE(implies(Vector3(1e-5, 0.005, 0.0), true)) << "on an edge of the still face";
  EXPECT_TRUE(implies(Vector3(1e-5, 0.002, 0.0), true)) << "on the still face";
  EXPECT_FALSE(implies(Vector3(1e-5, 0.007, 0.0), true)) << "beyond the still face";
  EXPECT_FALSE(implies(Vector3(1e-5, 0.002, 0.0), false)) << "no point of the moving body";
}

}  // namespace
}  // namespace godobject::detail::implied_rows_test
