// Pairs of edges of convex bodies that may overlap, against an independent test of whether the bodies do.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "core/pipeline/contact/edges/edge_search.h"
#include "tests/support/edge_set.h"
#include "tests/support/prism.h"
#include "tests/support/random.h"

namespace godobject::test {
namespace {

constexpr double kDeepest = 1e-3;

/// A search at one pose.
struct Found {
  EdgeSurroundings around;
  NearEdges near;
  bool overlap = false;

  Found(const Prism& moving, const Prism& still, const Pose& H) {
    const auto search = std::make_unique<EdgeSearch>();
    search->start({moving.edges.view(), still.edges.view()});
    WorkMeter work;
    around = search->find(H, 0.0, kDeepest, 1e-3, kDeepest, work, near);
    for (std::uint32_t n = 0; n < near.count; ++n) overlap = overlap || near.gap[n].distance < 0.0;
  }
};

Prism box() { return Prism::over({{-4e-3, -3e-3}, {4e-3, -3e-3}, {4e-3, 3e-3}, {-4e-3, 3e-3}}, 0.005); }

Pose pose_at_z(double z) {
  Pose H;
  H.translation.z() = z;
  return H;
}

/// Two convex bodies at random poses, near each other or a little inside each other: a box against wheels, whose rims
/// have corners of 15 and of 4 degrees; the edges of the second are shorter than the deepest overlap. Apart no pair of
/// edges overlaps. Where the bodies overlap and no corner of one lies inside the other, a pair tells it, wherever the
/// edges cross. Without points of the still body the pairs tell its corners inside as well, if they lie beside an edge.
TEST(EdgeOverlaps, AreThoseOfConvexBodies) {
  for (const int corners : {24, 96}) {
    const Prism wheel = wheel_with(corners);
    const Prism block = box();
    Random random(3);
    int apart = 0, overlapping = 0, with_corner = 0;
    for (int k = 0; k < (corners == 24 ? 10000 : 3000); ++k) {
      const Prism& moving = k % 2 == 0 ? wheel : block;
      const Prism& still = k % 2 == 0 ? block : wheel;
      const Pose H = random_meeting(random, moving, still);
      const double gap = separation(moving, still, H);
      if (gap < -3e-4 || std::fabs(gap) < 1e-6) continue;
      const Found found(moving, still, H);
      if (gap > 0.0) {
        ++apart;
        EXPECT_FALSE(found.overlap) << k << ' ' << gap;
        continue;
      }
      if (CornersInside(moving, H, still, kDeepest).any) continue;
      const CornersInside of_still(still, H.inverse(), moving, kDeepest);
      if (of_still.any && !of_still.near_an_edge) continue;  // through a face
      ++(of_still.any ? with_corner : overlapping);
      EXPECT_TRUE(found.overlap) << k << ' ' << gap << (of_still.any ? " a corner of the still body" : " edges only");
      EXPECT_TRUE(found.around.may_overlap);
    }
    EXPECT_GT(apart, corners == 24 ? 600 : 150);
    EXPECT_GT(overlapping, corners == 24 ? 300 : 50);
    EXPECT_GT(with_corner, corners == 24 ? 300 : 50);
  }
}

/// An edge below the ridge of a roof, across it. A body that hangs from above overlaps at the edges. A body that
/// reaches down from the edge lies inside the roof, which a face tells: a row of the edges would hold it inside.
TEST(EdgeOverlaps, LeaveOutWhatOverlapsAtAFace) {
  for (const bool is_below : {false, true}) {
    for (const bool swapped : {false, true}) {
      EdgeSet ridge({{Vector3(-0.01, 0, 0), Vector3(0.01, 0, 0)}});
      EdgeSet across({{Vector3(0, -0.01, -1e-4), Vector3(0, 0.01, -1e-4)}});
      for (int face = 0; face < 2; ++face) {
        ridge.edges()[0].normal[face][1] = across.edges()[0].normal[face][0] = face == 0 ? 0.8f : -0.8f;
        ridge.edges()[0].normal[face][2] = 0.6f;
        across.edges()[0].normal[face][2] = is_below ? 0.6f : -0.6f;
      }
      const auto search = std::make_unique<EdgeSearch>();
      if (swapped) {
        search->start({ridge.view(), across.view()});
      } else {
        search->start({across.view(), ridge.view()});
      }
      for (const double deepest : {kDeepest, 0.5e-4, 0.0}) {
        NearEdges near;
        WorkMeter work;
        const EdgeSurroundings around = search->find(Pose{}, 0.0, kDeepest, 1e-3, deepest, work, near);
        const bool is_near_enough = deepest > 1e-4;
        EXPECT_EQ(around.may_overlap, is_near_enough) << is_below << deepest;
        ASSERT_EQ(near.count, is_near_enough && is_below ? 0u : 1u) << is_below << deepest;
        if (near.count == 1) {
          EXPECT_NEAR(near.gap[0].distance, is_near_enough ? -1e-4 : 1e-4, 1e-12);
        }
      }
    }
  }
}

/// The end of an edge below a ridge, which leaves the roof through a face. While it overlaps no motion is known to be
/// free.
TEST(EdgeOverlaps, OfEndsAreNoFreeSpace) {
  EdgeSet ridge({{Vector3(-0.01, 0, 0), Vector3(0.01, 0, 0)}});
  EdgeSet side({{Vector3(0, 0, -4e-4), Vector3(0, 0.01, -2e-3)}});
  for (int face = 0; face < 2; ++face) {
    ridge.edges()[0].normal[face][1] = face == 0 ? 0.8f : -0.8f;
    ridge.edges()[0].normal[face][2] = 0.6f;
    side.edges()[0].normal[face][0] = face == 0 ? 1.0f : -1.0f;
  }
  const auto search = std::make_unique<EdgeSearch>();
  search->start({side.view(), ridge.view()});
  NearEdges near;
  WorkMeter work;
  EXPECT_TRUE(search->find(Pose{}, 0.0, kDeepest, 1e-3, kDeepest, work, near).may_overlap);
  ASSERT_EQ(near.count, 1u);
  EXPECT_NEAR(near.gap[0].distance, -4e-4, 1e-5);
  EXPECT_FALSE(search->is_free(0.0, 1e-4));
  near.count = 0;
  EXPECT_FALSE(search->find(pose_at_z(1e-3), 1e-3, kDeepest, 1e-3, kDeepest, work, near).may_overlap);
  EXPECT_TRUE(search->is_free(1e-3, 1e-4)) << "above the ridge";
}

/// The end of an edge below a ridge, beside another edge of the roof that is nearer to it: that one tells the sides.
TEST(EdgeOverlaps, OfEndsAreToldByTheNearestEdge) {
  for (const bool swapped : {false, true}) {
    for (const bool has_nearer : {false, true}) {
      std::vector<std::pair<Vector3, Vector3>> edges{{Vector3(-0.01, 0, 0), Vector3(0.01, 0, 0)}};
      if (has_nearer) edges.emplace_back(Vector3(-0.01, -3e-4, -4e-4), Vector3(0.01, -3e-4, -4e-4));
      EdgeSet roof(edges);
      EdgeSet side({{Vector3(0, 0, -4e-4), Vector3(0, 0.01, -2e-3)}});
      for (int face = 0; face < 2; ++face) {
        roof.edges()[0].normal[face][1] = face == 0 ? 0.8f : -0.8f;
        roof.edges()[0].normal[face][2] = 0.6f;
        if (has_nearer) roof.edges()[1].normal[face][1] = 1.0f;  // the end is outside
        side.edges()[0].normal[face][0] = face == 0 ? 1.0f : -1.0f;
      }
      const auto search = std::make_unique<EdgeSearch>();
      if (swapped) {
        search->start({roof.view(), side.view()});
      } else {
        search->start({side.view(), roof.view()});
      }
      NearEdges near;
      WorkMeter work;
      EXPECT_TRUE(search->find(Pose{}, 0.0, kDeepest, 1e-3, kDeepest, work, near).may_overlap);
      ASSERT_EQ(near.count, has_nearer ? 2u : 1u);
      for (std::uint32_t n = 0; n < near.count; ++n) {
        const bool is_ridge = (swapped ? near.pair[n].moving : near.pair[n].still) == 0;
        const double distance = is_ridge ? (has_nearer ? 4e-4 : -4e-4) : 3e-4;
        EXPECT_NEAR(near.gap[n].distance, distance, 2e-5) << swapped << has_nearer;
      }
      // at the same pose the pairs are known: each is looked at, and for the end both once more
      const std::uint64_t before = work.spent();
      near.count = 0;
      static_cast<void>(search->find(Pose{}, 0.0, kDeepest, 1e-3, kDeepest, work, near));
      const std::uint64_t pairs = near.count;
      EXPECT_EQ(work.spent() - before, 2 * pairs * cost_of(Work::kScan) + (2 * pairs - 1) * cost_of(Work::kPair));
    }
  }
}

}  // namespace
}  // namespace godobject::test
