// The certificate and the rows of edge against edge, by hand. tests/watch/edge_pairs_test.cc has random motions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/pipeline/contact/edge_certificate.h"
#include "core/pipeline/contact/edge_rows.h"
#include "tests/support/edge_set.h"

namespace godobject::detail::edge_certificate_test {
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
    WorkMeter work;
    Budget budget{work};
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
  EXPECT_FALSE(obstacle.exhausted);
  EXPECT_NEAR(obstacle.gap.distance, 4e-6, 1e-12);
}

TEST(EdgeCertificate, SaysWhetherItsBudgetWasSpentWhateverItSaidBefore) {
  EdgeObstacle obstacle;
  Cross cross(1e-3);
  for (const bool before : {false, true}) {
    obstacle.exhausted = before;
    EXPECT_FALSE(cross.free(moved(0, 0, -4e-3), obstacle));
    EXPECT_FALSE(obstacle.exhausted) << "an edge is in the way";
    obstacle.exhausted = before;
    EXPECT_TRUE(cross.free(moved(0, 0, 1e-3), obstacle));
    EXPECT_FALSE(obstacle.exhausted);
    WorkMeter work;
    work.start(1);
    work.add(Work::kPair, 1000);
    Budget budget{work};
    obstacle.exhausted = before;
    EXPECT_FALSE(
        edges_are_free(cross.edges, Pose{}, moved(0, 0, -4e-3), 5e-6, lengths(), cross.near, budget, obstacle));
    EXPECT_TRUE(obstacle.exhausted);
  }
}

/// Behind the count of near pairs may stand those of an earlier sub-step. They do not hold the body.
TEST(EdgeCertificate, LooksAtTheCountedPairsOnly) {
  EdgeObstacle obstacle;
  Cross cross(1e-3);
  const Pose through = moved(0, 0, -4e-3);
  cross.near.push({0, 0}, cross.near.gap[0]);
  for (const std::uint32_t count : {2u, 1u, 0u}) {
    cross.near.count = count;
    EXPECT_EQ(cross.free(through, obstacle), count == 0) << count;
  }
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
  WorkMeter work;
  Budget budget{work};
  EXPECT_TRUE(edges_are_free(edges, Pose{}, moved(5e-3, 0, 0), 1.6e-5, lengths(), near, budget, obstacle));
  EXPECT_EQ(budget.balls, kMostBallsOfCycle) << "by the plane of the face";
  EXPECT_FALSE(edges_are_free(edges, Pose{}, moved(5e-3, 0, -1e-4), 1.6e-5, lengths(), near, budget, obstacle));
  const auto rows = std::make_unique<ContactRows>();
  EXPECT_EQ(push_edges(Pose{}, lengths(), near, *rows), 0u);
  EXPECT_EQ(rows->count, 0u) << "the face holds the body";
}

/// Parallel edges along y. The moving one is at x = 0 and at the height of a margin, the still one ahead of it.
struct Ahead {
  test::EdgeSet moving{{{Vector3(0, -0.01, 2e-5), Vector3(0, 0.01, 2e-5)}}};
  test::EdgeSet still{{{Vector3(1e-3, -0.01, 0), Vector3(1e-3, 0.01, 0)}}};
  EdgeObstacle obstacle;

  bool free(const Pose& H0, const Pose& H1, Budget& budget) {
    const EdgeContacts edges{moving.view(), still.view()};
    NearEdges near;
    near.push({0, 0}, gap_at(edges, {0, 0}, H0));
    return edges_are_free(edges, H0, H1, 1.6e-5, lengths(), near, budget, obstacle);
  }
};

/// An edge slides over a face, or a face over an edge. The face is either one of its edge's two.
TEST(EdgeCertificate, TakesThePlaneOfAnyFace) {
  for (const int face : {0, 1}) {
    for (const bool is_still : {true, false}) {
      Ahead pair;
      (is_still ? pair.still : pair.moving).edges()[0].normal[face][2] = is_still ? 1.0f : -1.0f;
      WorkMeter work;
      Budget budget{work};
      EXPECT_TRUE(pair.free(Pose{}, moved(5e-3, 0, 0), budget)) << is_still << ' ' << face;
      EXPECT_EQ(budget.balls, kMostBallsOfCycle) << "by the plane " << is_still << ' ' << face;
    }
  }
}

/// An edge over a face may come nearer to the edge of the face than the least gap: the face is nearer than its edge.
TEST(EdgeCertificate, LeavesAnEdgeOverAFaceToTheFace) {
  for (const bool has_faces : {true, false}) {
    Ahead pair;
    if (has_faces) {
      pair.still.edges()[0].normal[0][2] = pair.still.edges()[0].normal[1][0] = 1.0f;
      pair.moving.edges()[0].normal[0][2] = -1.0f;
      pair.moving.edges()[0].normal[1][0] = 1.0f;
    }
    WorkMeter work;
    Budget budget{work};
    EXPECT_EQ(pair.free(moved(9e-4, 0, -1e-5), moved(9.9e-4, 0, -1e-5), budget), has_faces);
    if (has_faces) continue;
    EXPECT_EQ(pair.obstacle.share, 1.0);
    EXPECT_NEAR(pair.obstacle.gap.distance, std::sqrt(2.0) * 1e-5, 1e-10);
  }
}

/// An edge passes over another one, from 20 heights before it to 20 heights behind it. The balls at both ends leave a
/// gap in the middle, which one more ball covers.
TEST(EdgeCertificate, SpendsNoMoreThanTheBudget) {
  for (const int balls : {0, 1, 2}) {
    Ahead pair;
    WorkMeter work;
    Budget budget{work, balls};
    EXPECT_EQ(pair.free(moved(-0.019, 0, 1e-3 - 2e-5), moved(0.021, 0, 1e-3 - 2e-5), budget), balls > 0) << balls;
    EXPECT_EQ(pair.obstacle.exhausted, balls == 0);
    EXPECT_EQ(budget.balls, std::max(0, balls - 1));
    if (balls == 0) {
      EXPECT_NEAR(pair.obstacle.share, 0.5, 0.01);
    }
  }
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
  cross.near.gap[1].distance = 1.1 * lengths().margin;
  EXPECT_EQ(push_edges(H, lengths(), cross.near, *rows), 1u) << "only one of two pairs needs a row";
}

/// A face that is nearer than its edge holds the body by its points. If they do not, the edges come nearer than a
/// margin, and the pair must lead away.
TEST(EdgeRows, HoldEdgesOverAFaceThatItsPointsDoNotHold) {
  const double limit = lengths().margin;
  for (const double share : {1.1, 0.9, 1e-3}) {
    Cross cross(share * limit);
    cross.near.gap[0].is_nearest = false;
    const auto rows = std::make_unique<ContactRows>();
    EXPECT_EQ(push_edges(Pose{}, lengths(), cross.near, *rows), 0u);
    EXPECT_EQ(rows->count, share < 1.0 ? 1u : 0u) << share;
    if (share < 1.0) {
      EXPECT_GT(rows->required_gain[0], 0.0f) << share;
    }
  }
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

/// An edge of the body turns about the body's origin by a share s of the angle a; its middle is L beside that origin.
/// Along the normal (cos b, sin b, 0) the tangent promises L s a sin b; the arc gives L (cos b (cos(s a) - 1) + sin b
/// sin(s a)). The obstacle lies at the share o of the chord. The loss is for the whole step: the difference times o /
/// s.
TEST(EdgeRows, OfAnObstacleMakeUpForTheLossOfTheArc) {
  constexpr double kLever = 0.125, kAngle = 0.2;
  const test::EdgeSet moving({{Vector3(0, 0, 0), Vector3(2.0 * kLever, 0, 0)}});
  const test::EdgeSet still({{Vector3(0, 0, -0.1), Vector3(0, 0, 0.1)}});
  const EdgeContacts edges{moving.view(), still.view()};
  NearEdges near;
  near.push({0, 0}, {.distance = 1e-3});
  const Pose H0{exp_rotation(Vector3(0.3, -0.8, 0.5)), Vector3(0.1, 0.2, 0.3)};
  const Motion step{Vector3::Zero(), Vector3(0, 0, kAngle)};
  for (const double share : {1.0, 0.5, 0.125}) {
    const Pose H1 = H0 * set_matrix({Vector3::Zero(), share * step.rotation});
    for (const double of_chord : {1.0, 0.75, 0.25}) {
      for (const double b : {0.0, 0.3, -0.4, 2.8}) {
        EdgeObstacle obstacle;
        obstacle.near = 0;
        obstacle.share = of_chord;
        obstacle.gap.place = 0.5;
        obstacle.gap.normal = H0.rotation._transformVector(Vector3(std::cos(b), std::sin(b), 0.0));
        const auto gain = [&](bool is_arc) {
          const auto rows = std::make_unique<ContactRows>();
          EXPECT_TRUE(push_edge_obstacle({H0, H1, step, share, is_arc}, lengths(), edges, near, obstacle, *rows));
          return static_cast<double>(rows->required_gain[0]);
        };
        const double turn = share * kAngle;
        const double promised = turn * std::sin(b);
        const double arc = std::cos(b) * (std::cos(turn) - 1.0) + std::sin(b) * std::sin(turn);
        const double loss = kLever * of_chord / share * (promised - arc);
        EXPECT_NEAR(gain(true) - gain(false), std::max(0.0, loss), 1e-8) << share << ' ' << of_chord << ' ' << b;
      }
    }
  }
}

}  // namespace
}  // namespace godobject::detail::edge_certificate_test
