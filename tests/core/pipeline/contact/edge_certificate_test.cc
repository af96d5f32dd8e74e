// The certificate and the rows of edge against edge, by hand. tests/watch/edge_pairs_test.cc has random motions.
#include <gtest/gtest.h>

#include <memory>

#include "core/pipeline/contact/edge_certificate.h"
#include "core/pipeline/contact/edge_rows.h"
#include "tests/support/edge_set.h"

namespace godobject::detail {
namespace {

ContactLengths lengths() {
  ContactLengths l{};
  l.margin = 2e-5;
  l.wanted_margin = 1.6e-5;
  l.least_margin = 5e-6;
  l.rounding = 1e-9;
  l.largest_gain = 1e-3;
  l.metric.tolerance = 2e-8;
  return l;
}

/// One edge of each body; the moving one along y at the height h above the still one along x.
struct Cross {
  test::EdgeSet moving, still;
  EdgeContacts edges;
  NearEdges near;

  explicit Cross(double height)
      : moving({{Vector3(0, -0.01, height), Vector3(0, 0.01, height)}}),
        still({{Vector3(-0.01, 0, 0), Vector3(0.01, 0, 0)}}),
        edges{moving.view(), still.view()} {
    near.push({0, 0}, gap_at(edges, {0, 0}, Pose{}));
  }
  bool free(const Pose& H1, EdgeObstacle& obstacle, double least = 5e-6) {
    Budget budget;
    return edges_are_free(edges, Pose{}, H1, least, lengths(), near, budget, obstacle);
  }
};

Pose moved(double x, double y, double z) {
  Pose H;
  H.translation = Vector3(x, y, z);
  return H;
}

TEST(EdgeCertificate, AcceptsMotionsAlongTheEdgesAndAway) {
  EdgeObstacle obstacle;
  EXPECT_TRUE(Cross(2e-5).free(moved(5e-3, 0, 0), obstacle));
  EXPECT_TRUE(Cross(2e-5).free(moved(5e-3, 5e-3, 0), obstacle));
  EXPECT_TRUE(Cross(2e-5).free(moved(0, 0, 5e-3), obstacle));
  EXPECT_TRUE(Cross(2e-5).free(moved(0, 0, -1.4e-5), obstacle)) << "a gap of 6 um remains";
}

TEST(EdgeCertificate, RefusesToCrossAndSaysWhere) {
  EdgeObstacle obstacle;
  EXPECT_FALSE(Cross(1e-3).free(moved(0, 0, -4e-3), obstacle)) << "through to the other side";
  EXPECT_EQ(obstacle.near, 0u);
  EXPECT_FALSE(obstacle.exhausted);
  EXPECT_NEAR(obstacle.share, 0.25, 1e-3);
  EXPECT_NEAR(obstacle.gap.normal.z(), 1.0, 1e-9);
  EXPECT_NEAR(obstacle.gap.place, 0.5, 1e-9);
  EXPECT_FALSE(Cross(2e-5).free(moved(0, 0, -1.6e-5), obstacle)) << "a gap of 4 um is below the least";
  EXPECT_EQ(obstacle.share, 1.0);
  EXPECT_NEAR(obstacle.gap.distance, 4e-6, 1e-12);
}

/// Parallel edges of two boxes: the lower one slides off the face of the other at the height of a margin, and far.
TEST(EdgeCertificate, LetsABoxSlideOverTheEdgeOfAFace) {
  const Vector3 low(0, -0.01, 2e-5);
  test::EdgeSet moving({{low, low + Vector3(0, 0.02, 0)}});
  test::EdgeSet still({{Vector3(1e-3, -0.01, 0), Vector3(1e-3, 0.01, 0)}});
  still.edges()[0].normal[0][2] = still.edges()[0].normal[1][0] = 1.0f;
  moving.edges()[0].normal[0][2] = -1.0f;
  moving.edges()[0].normal[1][0] = 1.0f;
  const EdgeContacts edges{moving.view(), still.view()};
  NearEdges near;
  near.push({0, 0}, gap_at(edges, {0, 0}, Pose{}));
  EXPECT_FALSE(near.gap[0].is_nearest);
  EdgeObstacle obstacle;
  Budget budget;
  EXPECT_TRUE(edges_are_free(edges, Pose{}, moved(5e-3, 0, 0), 1.6e-5, lengths(), near, budget, obstacle));
  EXPECT_EQ(budget.balls, Budget{}.balls) << "by the plane of the face";
  EXPECT_FALSE(edges_are_free(edges, Pose{}, moved(5e-3, 0, -1e-4), 1.6e-5, lengths(), near, budget, obstacle));
  const auto rows = std::make_unique<ContactRows>();
  EXPECT_EQ(push_edges(Pose{}, lengths(), near, *rows), 0u);
  EXPECT_EQ(rows->count, 0u) << "the face holds the body";
}

TEST(EdgeCertificate, LetsAnOverlapAtTheStartOut) {
  Cross cross(1e-3);
  cross.near.gap[0].distance = -1e-3;
  EdgeObstacle obstacle;
  EXPECT_TRUE(cross.free(moved(0, 0, -1e-3), obstacle));
}

TEST(EdgeCertificate, LetsASmallGapGrowSlowly) {
  EdgeObstacle obstacle;
  EXPECT_TRUE(Cross(2e-6).free(moved(0, 0, 1e-6), obstacle)) << "below the least gap, but it grows";
  EXPECT_FALSE(Cross(2e-6).free(moved(0, 0, -1e-6), obstacle));
}

/// A row of the start and the row of an obstacle ask for the same along the same normal.
TEST(EdgeRows, AskForTheLostGap) {
  Cross cross(1.2e-5);
  const auto rows = std::make_unique<ContactRows>();
  Pose H;
  H.rotation = Quaternion(Eigen::AngleAxisd(0.5 * M_PI, Vector3::UnitX()));
  EXPECT_EQ(push_edges(H, lengths(), cross.near, *rows), 0u);
  ASSERT_EQ(rows->count, 1u);
  EXPECT_EQ(rows->id[0], id_of({0, 0}));
  EXPECT_NEAR(static_cast<double>(rows->required_gain[0]), kRecovery * 8e-6, 1e-12);
  EXPECT_TRUE(rows->normal(0).isApprox(Vector3::UnitY(), 1e-6)) << "in S";
  EXPECT_NEAR((H * rows->point(0) - Vector3(0, 0, 1.2e-5)).norm(), 0.0, 1e-9);
  rows->count = ContactRows::kCapacity;
  EXPECT_EQ(push_edges(H, lengths(), cross.near, *rows), 1u) << "no room";
  cross.near.push({0, 0}, cross.near.gap[0]);
  cross.near.gap[1].is_nearest = false;
  EXPECT_EQ(push_edges(H, lengths(), cross.near, *rows), 1u) << "only one of two pairs needs a row";
}

TEST(EdgeRows, OfAnObstacleKeepTheBodyAMarginAway) {
  Cross cross(1e-3);
  const Pose H1 = moved(0, 0, -4e-3);
  EdgeObstacle obstacle;
  ASSERT_FALSE(cross.free(H1, obstacle));
  const auto rows = std::make_unique<ContactRows>();
  const Motion step{Vector3(0, 0, -4e-3), Vector3::Zero()};
  ASSERT_TRUE(push_edge_obstacle({Pose{}, H1, step, 1.0, false}, lengths(), cross.edges, cross.near, obstacle, *rows));
  ASSERT_EQ(rows->count, 1u);
  EXPECT_TRUE(rows->normal(0).isApprox(Vector3::UnitZ(), 1e-6));
  EXPECT_NEAR(static_cast<double>(rows->required_gain[0]), -(1e-3 - 2e-5), 1e-9);
  rows->count = ContactRows::kCapacity;
  EXPECT_FALSE(push_edge_obstacle({Pose{}, H1, step, 1.0, false}, lengths(), cross.edges, cross.near, obstacle, *rows));
}

}  // namespace
}  // namespace godobject::detail
