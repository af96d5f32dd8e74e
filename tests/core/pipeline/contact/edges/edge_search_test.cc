// The near pairs of edges: all of them, against a comparison of every pair, along random walks.
#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "core/pipeline/contact/edges/edge_search.h"
#include "core/pipeline/contact/search/odometer.h"
#include "tests/support/edge_set.h"
#include "tests/support/random.h"

namespace godobject::edge_search_test {
namespace {

using Segments = std::vector<std::pair<Vector3, Vector3>>;

Segments scattered(test::Random& random, int count, double half, double length) {
  Segments segments;
  for (int k = 0; k < count; ++k) {
    const Vector3 from = random.in_cube(half);
    segments.emplace_back(from, from + length * random.direction());
  }
  return segments;
}

std::set<std::pair<std::uint32_t, std::uint32_t>> all_below(const EdgeContacts& edges, const Pose& H, double radius) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> found;
  for (std::uint32_t i = 0; i < edges.moving.edges.size(); ++i) {
    for (std::uint32_t j = 0; j < edges.still.edges.size(); ++j) {
      if (detail::gap_at(edges, {i, j}, H).distance < radius) found.emplace(i, j);
    }
  }
  return found;
}

double least_gap(const EdgeContacts& edges, const Pose& H) {
  double least = 1e9;
  for (std::uint32_t i = 0; i < edges.moving.edges.size(); ++i) {
    for (std::uint32_t j = 0; j < edges.still.edges.size(); ++j) {
      least = std::min(least, detail::gap_at(edges, {i, j}, H).distance);
    }
  }
  return least;
}

TEST(EdgePairId, IsThatOfItsPairAndOfNoPoint) {
  for (const EdgePair pair : {EdgePair{0, 0}, EdgePair{1, 2}, EdgePair{format::kMaxSharpEdges - 1, 0},
                              EdgePair{format::kMaxSharpEdges - 1, format::kMaxSharpEdges - 1}}) {
    EXPECT_TRUE(detail::is_edge_pair(detail::id_of(pair)));
    EXPECT_TRUE(detail::pair_of(detail::id_of(pair)) == pair);
    EXPECT_NE(detail::id_of(pair), (1u << 31) - 1) << "the faces of the workspace";
  }
  EXPECT_FALSE(detail::is_edge_pair(format::kMaxPoints));
  EXPECT_FALSE(detail::is_edge_pair((1u << 31) | 5u)) << "a feature point";
}

/// A search that the budget of work ends goes on while the body stays, and then knows the same pairs.
TEST(EdgeSearch, GoesOnWhereTheBudgetEndedIt) {
  test::Random random(15);
  int stops = 0;
  for (int run = 0; run < 20; ++run) {
    const test::EdgeSet moving(scattered(random, 60, 0.02, 0.01));
    const test::EdgeSet still(scattered(random, 90, 0.03, 0.015));
    const EdgeContacts edges{moving.view(), still.view()};
    const auto search = std::make_unique<EdgeSearch>();
    search->start(edges);
    Pose H;
    Odometer odometer;
    for (int k = 0; k < 10; ++k) {
      H = H * set_matrix(random.motion(2e-3, 2e-2));
      odometer.move_to(H, {Vector3::Zero(), 0.06});
      const double radius = random.between(1e-4, 2e-3);
      for (int call = 0;; ++call) {
        ASSERT_LT(call, 1000);
        odometer.move_to(H, {Vector3::Zero(), 0.06});
        WorkMeter work;
        work.start(static_cast<std::uint64_t>(random.between(2e4, 1e5)));
        NearEdges near;
        const EdgeSurroundings around = search->find(H, odometer.travelled(), radius, 1e-3, 0.0, work, near);
        if (around.free_displacement == 0.0) {
          EXPECT_TRUE(work.is_spent());
          EXPECT_FALSE(search->is_free(odometer.travelled(), 0.0)) << "nothing is known yet";
          ++stops;
          if (random.integer(0, 3) == 0) H = H * set_matrix(random.motion(2e-3, 2e-2));  // it does not stay
          continue;
        }
        std::set<std::pair<std::uint32_t, std::uint32_t>> found;
        for (std::uint32_t i = 0; i < near.count; ++i) found.emplace(near.pair[i].moving, near.pair[i].still);
        EXPECT_EQ(found, all_below(edges, H, radius));
        break;
      }
    }
  }
  EXPECT_GT(stops, 100);
}

/// The budget of work ends a search with a small radius. Then the radius grows beyond the pairs that this search would
/// remember: all pairs within the new radius are found all the same.
TEST(EdgeSearch, FindsThePairsOfARadiusThatGrowsWhereTheBudgetEndedTheSearch) {
  constexpr double kSmall = 1e-4, kSlack = 1e-4, kLarge = 2e-3;
  test::Random random(16);
  int stops = 0;
  std::size_t farther = 0;  // pairs that the first search would not remember
  for (int run = 0; run < 20; ++run) {
    const test::EdgeSet moving(scattered(random, 60, 0.02, 0.01));
    const test::EdgeSet still(scattered(random, 90, 0.03, 0.015));
    const EdgeContacts edges{moving.view(), still.view()};
    const auto search = std::make_unique<EdgeSearch>();
    search->start(edges);
    const Pose H;
    WorkMeter little;
    little.start(3e4);
    NearEdges none;
    stops += search->find(H, 0.0, kSmall, kSlack, 0.0, little, none).free_displacement == 0.0 ? 1 : 0;
    WorkMeter enough;
    NearEdges near;
    const EdgeSurroundings around = search->find(H, 0.0, kLarge, kSlack, 0.0, enough, near);
    std::set<std::pair<std::uint32_t, std::uint32_t>> found;
    for (std::uint32_t i = 0; i < near.count; ++i) found.emplace(near.pair[i].moving, near.pair[i].still);
    EXPECT_EQ(found, all_below(edges, H, kLarge)) << run;
    EXPECT_GE(around.free_displacement, kLarge) << run;
    farther += found.size() - all_below(edges, H, kSmall + kSlack).size();
  }
  EXPECT_EQ(stops, 20);
  EXPECT_GT(farther, 20u);
}

/// A body that walks among edges: near pairs, the bound of the free displacement, and what is known to be free.
TEST(EdgeSearch, FindsAllNearPairsWhereverTheBodyWalks) {
  test::Random random(5);
  std::size_t near_pairs = 0;
  for (int run = 0; run < 4; ++run) {
    const test::EdgeSet moving(scattered(random, 40, 0.02, 0.01));
    const test::EdgeSet still(scattered(random, 60, 0.04, 0.015));
    const EdgeContacts edges{moving.view(), still.view()};
    const auto search = std::make_unique<EdgeSearch>();
    search->start(edges);
    const BoundingSphere sphere{Vector3::Zero(), 0.06};
    Odometer odometer;
    Pose H;
    const double step = run % 2 == 0 ? 2e-4 : 5e-3;
    for (int k = 0; k < 200; ++k) {
      const Motion motion = random.motion(step, 10.0 * step);
      H = H * set_matrix(motion);
      if (H.translation.norm() > 0.03) H.translation *= 0.5;
      odometer.move_to(H, sphere);
      const double radius = random.between(1e-4, 2e-3);
      if (search->is_free(odometer.travelled(), radius)) {
        EXPECT_TRUE(all_below(edges, H, radius).empty());
      }
      NearEdges near;
      WorkMeter work;
      const EdgeSurroundings around = search->find(H, odometer.travelled(), radius, 1e-3, 0.0, work, near);
      std::set<std::pair<std::uint32_t, std::uint32_t>> found;
      for (std::uint32_t i = 0; i < near.count; ++i) {
        found.emplace(near.pair[i].moving, near.pair[i].still);
        EXPECT_EQ(near.gap[i].distance, detail::gap_at(edges, near.pair[i], H).distance);
        EXPECT_EQ(near.find(near.pair[i]), i);
      }
      EXPECT_EQ(found.size(), near.count) << "no pair twice";
      EXPECT_EQ(found, all_below(edges, H, radius));
      EXPECT_EQ(around.unlisted, 0u);
      EXPECT_TRUE(around.free_displacement >= radius) << around.free_displacement;
      near_pairs += found.size();
    }
  }
  EXPECT_GT(near_pairs, 100u) << "the walks meet edges";
}

/// With more near pairs than places the others limit the motion.
TEST(EdgeSearch, LimitsTheMotionByPairsWithoutAPlace) {
  test::Random random(6);
  const test::EdgeSet moving(scattered(random, 80, 0.002, 0.002));
  const test::EdgeSet still(scattered(random, 80, 0.002, 0.002));
  const EdgeContacts edges{moving.view(), still.view()};
  const auto search = std::make_unique<EdgeSearch>();
  search->start(edges);
  NearEdges near;
  WorkMeter work;
  const EdgeSurroundings around = search->find(Pose{}, 0.0, 0.01, 0.001, 0.0, work, near);
  EXPECT_EQ(near.count, NearEdges::kCapacity);
  EXPECT_GT(around.unlisted, 0u);
  std::set<std::pair<std::uint32_t, std::uint32_t>> listed;
  for (std::uint32_t i = 0; i < near.count; ++i) listed.emplace(near.pair[i].moving, near.pair[i].still);
  for (const auto& pair : all_below(edges, Pose{}, 1.0)) {
    if (listed.count(pair) != 0) continue;
    EXPECT_GE(detail::gap_at(edges, {pair.first, pair.second}, Pose{}).distance, around.free_displacement);
  }
  // a pair without a place may overlap, if any may
  NearEdges again;
  EXPECT_FALSE(around.may_overlap);
  EXPECT_TRUE(search->find(Pose{}, 0.0, 0.01, 0.001, 1e-3, work, again).may_overlap);
}

/// With more near pairs than places a pair that overlaps has one, wherever it stands in the list.
TEST(EdgeSearch, KeepsAnOverlapWhereThereIsNoPlaceForAll) {
  constexpr std::uint32_t kEdges = 40;  // 1600 pairs that are 0.5 mm apart, and one that overlaps by 0.2 mm
  for (const std::uint32_t number : {0u, kEdges / 2, kEdges}) {
    Segments upper, lower;
    for (std::uint32_t i = 0; i <= kEdges; ++i) {
      const bool is_deep = i == number;
      const double place = is_deep ? 0.2 : 1e-3 * i;
      const double height = is_deep ? -0.2e-3 : 0.5e-3;
      upper.emplace_back(Vector3(place, is_deep ? 0.1 : 0.0, height), Vector3(place, is_deep ? 0.3 : 0.05, height));
      lower.emplace_back(Vector3(is_deep ? 0.1 : 0.0, place, 0.0), Vector3(is_deep ? 0.3 : 0.05, place, 0.0));
    }
    test::EdgeSet moving(upper), still(lower);
    for (int face = 0; face < 2; ++face) {
      moving.edges()[number].normal[face][0] = still.edges()[number].normal[face][1] = face == 0 ? 0.8f : -0.8f;
      moving.edges()[number].normal[face][2] = -0.6f;
      still.edges()[number].normal[face][2] = 0.6f;
    }
    const EdgeContacts edges{moving.view(), still.view()};
    const auto search = std::make_unique<EdgeSearch>();
    search->start(edges);
    NearEdges near;
    WorkMeter work;
    const EdgeSurroundings around = search->find(Pose{}, 0.0, 1e-3, 1e-3, 1e-3, work, near);
    EXPECT_EQ(near.count, NearEdges::kCapacity);
    EXPECT_EQ(around.unlisted, kEdges * kEdges + 1 - NearEdges::kCapacity);
    EXPECT_NEAR(around.free_displacement, 0.5e-3, 1e-9);
    ASSERT_TRUE(around.may_overlap) << number;
    const std::uint32_t k = near.find({number, number});
    ASSERT_LT(k, near.count) << number;
    EXPECT_NEAR(near.gap[k].distance, -0.2e-3, 1e-9);
  }
}

/// Returns 3000 short edges across the x axis, more than are remembered, at random heights. One of fifteen may be near,
/// below 0.9 mm; the others are above 1.5 mm.
Segments many_across(test::Random& random, bool some_are_near) {
  Segments segments;
  for (int k = 0; k < 3000; ++k) {
    const double height = some_are_near && k % 15 == 0 ? random.between(2e-4, 9e-4) : random.between(1.5e-3, 2e-3);
    segments.emplace_back(Vector3(0.005, -0.001, height), Vector3(0.005, 0.001, height));
  }
  return segments;
}

/// Without a place for all pairs the search remembers fewer, but all near ones; where those have a place anyway, it
/// remembers as many as it can.
TEST(EdgeSearch, RemembersThePairsThatMatterWhereNotAllHaveAPlace) {
  test::Random random(7);
  const test::EdgeSet moving({{Vector3(0, 0, 0), Vector3(0.01, 0, 0)}});
  constexpr double kRadius = 1e-3, kSlack = 1e-3;
  for (const bool some_are_near : {true, false}) {
    const test::EdgeSet still(many_across(random, some_are_near));
    const auto search = std::make_unique<EdgeSearch>();
    search->start({moving.view(), still.view()});
    NearEdges near;
    WorkMeter work;
    const EdgeSurroundings around = search->find(Pose{}, 0.0, kRadius, kSlack, 0.0, work, near);
    EXPECT_EQ(around.unlisted, 0u) << some_are_near;
    EXPECT_EQ(near.count, some_are_near ? 200u : 0u);
    for (std::uint32_t i = 0; i < near.count; ++i) EXPECT_LT(near.gap[i].distance, kRadius);
    EXPECT_GE(around.free_displacement, some_are_near ? kRadius : 1.5e-3);
    EXPECT_LT(around.free_displacement, kRadius + kSlack) << "not all that is within reach";

    // where few pairs are, all within reach have a place again
    Pose far;
    far.translation.x() = 1.0;
    NearEdges none;
    const EdgeSurroundings alone = search->find(far, 1.0, kRadius, kSlack, 0.0, work, none);
    EXPECT_NEAR(alone.free_displacement, kRadius + kSlack, 1e-12);
    EXPECT_EQ(none.count, 0u);
  }
}

/// The spheres of the still tree reach over the moving edge, so that the search looks at all branches below its root.
/// It has visits for all of the smaller tree. The edges themselves are far apart.
TEST(EdgeSearch, LooksAtAsManyBranchesAsItHasVisits) {
  constexpr std::uint32_t kMost = EdgeSearch::kMostVisits;
  const test::EdgeSet moving({{Vector3(0, 0, 0), Vector3(0.01, 0, 0)}});
  for (const bool fits : {true, false}) {
    const test::EdgeSet still(
        Segments(fits ? kMost + 1 : kMost + 2, std::make_pair(Vector3(0, 0, 1), Vector3(0, 0.01, 1))));
    std::vector<format::Node> nodes(still.view().nodes.begin(), still.view().nodes.end());
    ASSERT_EQ(nodes.size(), 1 + (fits ? kMost : kMost + 2)) << "with the root, which is no branch to visit";
    for (format::Node& node : nodes) node.radius = 2.0f;
    const auto search = std::make_unique<EdgeSearch>();
    search->start({moving.view(), {still.view().edges, nodes}});
    NearEdges near;
    WorkMeter work;
    const EdgeSurroundings around = search->find(Pose{}, 0.0, 1e-3, 2e-3, 0.0, work, near);
    EXPECT_EQ(near.count, 0u);
    EXPECT_EQ(around.unlisted == 0, fits);
    EXPECT_NEAR(around.free_displacement, fits ? 3e-3 : 0.0, 1e-15) << "branches without a visit may be anywhere";
  }
}

TEST(EdgeSearch, NeedsEdgesOfBothBodies) {
  const test::EdgeSet set({{Vector3(0, 0, 0), Vector3(0.01, 0, 0)}});
  EXPECT_FALSE((EdgeContacts{set.view(), set.view()}.empty()));
  for (const EdgeContacts& edges : {EdgeContacts{set.view(), {}}, EdgeContacts{{}, set.view()}, EdgeContacts{}}) {
    ASSERT_TRUE(edges.empty());
    const auto search = std::make_unique<EdgeSearch>();
    search->start(edges);
    EXPECT_TRUE(search->is_free(1e9, 1e9));
    NearEdges near;
    WorkMeter work;
    const EdgeSurroundings around = search->find(Pose{}, 0.0, 1.0, 1.0, 0.0, work, near);
    EXPECT_EQ(near.count, 0u);
    EXPECT_EQ(around.unlisted, 0u);
    EXPECT_GT(around.free_displacement, 1e9);
  }
}

TEST(EdgeSearch, KnowsThatNothingIsNear) {
  const test::EdgeSet moving({{Vector3(0, 0, 0), Vector3(0.01, 0, 0)}});
  const test::EdgeSet still({{Vector3(0, 0, 0.05), Vector3(0, 0.01, 0.05)}});
  const EdgeContacts edges{moving.view(), still.view()};
  EdgeSearch search;
  search.start(edges);
  EXPECT_FALSE(search.is_free(0.0, 1e-3)) << "nothing is known before the first search";
  NearEdges near;
  WorkMeter work;
  const EdgeSurroundings around = search.find(Pose{}, 0.0, 1e-3, 2e-3, 0.0, work, near);
  EXPECT_EQ(near.count, 0u);
  EXPECT_GE(around.free_displacement, 1e-3);
  EXPECT_TRUE(search.is_free(1e-3, 1e-3));
  EXPECT_FALSE(search.is_free(least_gap(edges, Pose{}), 1e-3));
  search.start({});
  EXPECT_TRUE(search.is_free(1e9, 1e9)) << "no edges";
  EXPECT_EQ(search.find(Pose{}, 0.0, 1.0, 1.0, 0.0, work, near).unlisted, 0u);
}

}  // namespace
}  // namespace godobject::edge_search_test
