// The watch's view of pairs of edges: against the core's, which shares no code with it, and with edges that cross.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/pipeline/contact/edge_certificate.h"
#include "core/pipeline/contact/edges/edge_gap.h"
#include "core/pipeline/contact/edges/edge_search.h"
#include "core/pipeline/contact/edges/near_edges.h"
#include "tests/support/edge_set.h"
#include "tests/support/prism.h"
#include "tests/support/random.h"
#include "toolchain/watch/edge_pairs.h"
#include "toolchain/watch/watch.h"

namespace godobject::watch {
namespace {

WatchedEdge bare(const Vector3& from, const Vector3& to) {
  WatchedEdge edge;
  edge.end[0] = from;
  edge.end[1] = to;
  return edge;
}

EdgeInW of_core(const WatchedEdge& edge) {
  return {{edge.end[0], edge.end[1]}, {edge.normal[0], edge.normal[1]}, edge.radius};
}

TEST(EdgePairs, AgreeWithTheCore) {
  test::Random random(2);
  for (int k = 0; k < 5000; ++k) {
    const Vector3 a = random.in_cube(1.0);
    const Vector3 b = random.in_cube(1.0);
    const WatchedEdge first = bare(a, a + random.between(1e-3, 1.0) * random.direction());
    const Vector3 along = k % 4 == 0 ? Vector3(first.end[1] - first.end[0]) : random.direction();
    WatchedEdge second = bare(b, b + random.between(1e-3, 1.0) * along);
    second.radius = 0.01;
    const EdgeGap core = edge_gap(of_core(first), of_core(second));
    const EdgeDistance watch = distance_of(first, second);
    EXPECT_NEAR(watch.gap, core.distance, 1e-12);
    EXPECT_NEAR((watch.on_first - watch.on_second).norm() - 0.01, watch.gap, 1e-12);
    if (k % 4 != 0 && watch.gap > 0.0) {
      EXPECT_NEAR((watch.normal - core.normal).norm(), 0.0, 1e-6);
    }
  }
}

/// No motion that the core's certificate accepts brings two edges together, whatever its turn.
TEST(EdgePairs, StayApartInEveryMotionThatTheCoreAccepts) {
  ContactLengths lengths{};
  lengths.least_margin = 5e-6;
  lengths.rounding = 1e-9;
  test::Random random(8);
  int accepted = 0;
  int refused = 0;
  int wrongly_refused = 0;
  for (int k = 0; k < 30000; ++k) {
    const Vector3 a = random.in_cube(0.005);
    const Vector3 b = random.in_cube(0.005);
    const test::EdgeSet moving({{a, a + random.between(1e-3, 1e-2) * random.direction()}});
    const test::EdgeSet still({{b, b + random.between(1e-3, 1e-2) * random.direction()}});
    const EdgeContacts edges{moving.view(), still.view()};
    const Pose H1 = Pose{} * set_matrix(random.motion(0.01, 0.6));
    NearEdges near;
    near.push({0, 0}, detail::gap_at(edges, {0, 0}, Pose{}));
    if (near.gap[0].distance < 1e-5) continue;
    detail::EdgeObstacle obstacle;
    WorkMeter work;
    detail::Budget budget{work};
    const bool is_free = detail::edges_are_free(edges, Pose{}, H1, 5e-6, lengths, near, budget, obstacle);
    const WatchedEdge from = watched_edges(moving.view())[0];
    const WatchedEdge other = watched_edges(still.view())[0];
    const bool meets = falls_below(from, from.at(H1), other, 0.0, 1e-10);
    EXPECT_FALSE(is_free && meets) << k;
    ++(is_free ? accepted : refused);
    if (is_free) continue;
    EXPECT_EQ(obstacle.near, 0u);
    EXPECT_GT(obstacle.share, 0.0);
    EXPECT_LE(obstacle.share, 1.0);
    wrongly_refused += falls_below(from, from.at(H1), other, 1e-4, 1e-6) ? 0 : 1;
  }
  EXPECT_GT(accepted, 5000);
  EXPECT_GT(refused, 300);
  EXPECT_EQ(wrongly_refused, 0) << "motions with a gap of 0.1 mm are accepted";
}

/// The sides of all near edges of two convex bodies that meet are those of the core.
TEST(EdgePairs, HaveTheSidesOfTheCore) {
  constexpr double kDeepest = 1e-3;
  const test::Prism wheel = test::wheel_with(96);
  const test::Prism box = test::Prism::over({{-4e-3, -3e-3}, {4e-3, -3e-3}, {4e-3, 3e-3}, {-4e-3, 3e-3}}, 0.005);
  const auto search = std::make_unique<EdgeSearch>();
  test::Random random(4);
  int of_sides[3] = {};
  for (int k = 0; k < 400; ++k) {
    const test::Prism& moving = k % 2 == 0 ? wheel : box;
    const test::Prism& still = k % 2 == 0 ? box : wheel;
    const Pose H = random_meeting(random, moving, still);
    search->start({moving.edges.view(), still.edges.view()});
    NearEdges near;
    WorkMeter work;
    search->find(H, 0.0, kDeepest, 1e-3, kDeepest, work, near);
    const std::vector<WatchedEdge> first = watched_edges(moving.edges.view());
    const std::vector<WatchedEdge> second = watched_edges(still.edges.view());
    for (std::size_t i = 0; i < first.size(); ++i) {
      for (std::size_t j = 0; j < second.size(); ++j) {
        const EdgeDistance pair = distance_of(first[i].at(H), second[j]);
        if (!(pair.gap < kDeepest) || pair.gap < 1e-9) continue;
        const Sides sides = sides_of(first, H, second, i, j, pair);
        const std::uint32_t n = near.find({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)});
        const double distance = n < near.count ? near.gap[n].distance : 0.0;
        const Sides of_core = n == near.count ? Sides::kAtAFace : distance < 0.0 ? Sides::kOverlap : Sides::kApart;
        EXPECT_EQ(static_cast<int>(sides), static_cast<int>(of_core)) << k << ' ' << i << ' ' << j << ' ' << pair.gap;
        ++of_sides[static_cast<int>(sides)];
      }
    }
  }
  for (const int count : of_sides) EXPECT_GT(count, 100);
}

TEST(EdgePairs, FallBelowABoundOnTheWay) {
  const WatchedEdge still = bare({-1, 0, 0}, {1, 0, 0});
  const auto at = [](double z) { return bare({0, -1, z}, {0, 1, z}); };
  EXPECT_TRUE(falls_below(at(1.0), at(-1.0), still, 0.0, 1e-9)) << "from one side to the other";
  EXPECT_TRUE(falls_below(at(1.0), at(-3.0), still, 0.0, 1e-9));
  EXPECT_FALSE(falls_below(at(1.0), at(0.1), still, 0.0, 1e-9));
  EXPECT_TRUE(falls_below(at(1.0), at(0.1), still, 0.2, 1e-9));
  EXPECT_FALSE(falls_below(at(0.3), bare({3, -1, 0.3}, {3, 1, 0.3}), still, 0.2, 1e-9)) << "along it and beyond";
}

/// A god object whose edges pass through one another is found, also if it is outside before and after.
TEST(EdgePairs, ThatCrossAreFound) {
  WatchedSession session;
  session.moving_edges.push_back(bare({0, -1, 0}, {0, 1, 0}));
  session.still_edges.push_back(bare({-1, 0, 0}, {1, 0, 0}));
  session.parameters.voxel_size = 0.1;
  Watch watch(session);
  WatchedCycle cycle;
  const auto go = [&](double x, double z) {
    cycle.H_WD.translation = Vector3(x, 0.0, z);
    cycle.report.H_WS = cycle.H_WD;
    const std::vector<Pose> path(1, cycle.H_WD);
    cycle.path = path;
    watch.cycle(cycle);
  };
  go(0.0, 0.5);
  go(0.3, 0.01);
  go(0.0, 0.01);
  EXPECT_EQ(watch.findings()[Property::kNoCrossing].violated, 0) << watch.findings()[Property::kNoCrossing].first;
  go(0.0, -0.5);
  EXPECT_EQ(watch.findings()[Property::kNoCrossing].violated, 1);
  go(5.0, -0.5);
  go(5.0, 0.5);
  EXPECT_EQ(watch.findings()[Property::kNoCrossing].violated, 1) << "round the end of the other edge";
}

}  // namespace
}  // namespace godobject::watch
