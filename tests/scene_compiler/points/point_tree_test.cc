#include "toolchain/scene_compiler/points/point_tree.h"

#include <algorithm>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace godobject::scene_compiler::point_tree_test {
namespace {

using Eigen::Vector3d;

std::vector<Vector3d> random_points(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform;
  std::vector<Vector3d> points;
  // some on a lattice, so that there are ties
  for (std::size_t i = 0; i < count; ++i) {
    Vector3d p(uniform(random), uniform(random), uniform(random));
    if (i % 3 == 0) p = (p * 4.0).array().round() / 4.0;
    points.push_back(p);
  }
  return points;
}

TEST(PointTree, FindsWhatAFullSearchFinds) {
  for (const std::size_t count : {1u, 8u, 9u, 17u, 1000u}) {
    const std::vector<Vector3d> points = random_points(count, 1);
    const PointTree tree(points);
    for (const Vector3d& p : random_points(200, 2)) {
      std::size_t nearest = 0;
      std::vector<std::uint32_t> near;
      for (std::uint32_t i = 0; i < count; ++i) {
        if ((points[i] - p).squaredNorm() < (points[nearest] - p).squaredNorm()) nearest = i;
        if ((points[i] - p).norm() <= 0.2) near.push_back(i);
      }
      EXPECT_EQ(tree.nearest(p).index, nearest);
      std::vector<std::uint32_t> found;
      tree.within(p, 0.2, [&](std::uint32_t i, double) { found.push_back(i); });
      std::sort(found.begin(), found.end());
      EXPECT_EQ(found, near);
      EXPECT_EQ(tree.any_within(p, 0.2), !near.empty());
    }
  }
}

/// With counts on both sides of those that are built in parallel, and halves of unequal sizes.
TEST(PointTree, DividesAllPointsIntoRunsAndLeaves) {
  for (const std::size_t count : {1u, 33u, 1000u, 8191u, 40003u}) {
    const std::vector<Vector3d> points = random_points(count, 3);
    const PointTree tree(points);
    std::vector<int> in_runs(count);
    for (const PointTree::Run& run : tree.runs(32)) {
      EXPECT_LE(run.end - run.begin, 32u);
      for (std::uint32_t entry = run.begin; entry < run.end; ++entry) {
        EXPECT_EQ(tree.point(entry), points[tree.index(entry)]);
        ++in_runs[tree.index(entry)];
      }
    }
    EXPECT_EQ(std::count(in_runs.begin(), in_runs.end(), 1), static_cast<std::ptrdiff_t>(count));
    std::vector<int> in_leaves(count);
    const auto below = [](const PointTree::Bounds& box) { return box.high.x() < 0.5; };
    tree.leaves(below, [&](const PointTree::Run& run) {
      for (std::uint32_t entry = run.begin; entry < run.end; ++entry) ++in_leaves[tree.index(entry)];
    });
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_LE(in_leaves[i], 1) << i;
      EXPECT_GE(in_leaves[i], points[i].x() >= 0.5 ? 1 : 0) << i;
    }
  }
}

TEST(PointTree, NearestPassesOverWhatIsNotAccepted) {
  const std::vector<Vector3d> points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  const PointTree tree(points);
  EXPECT_EQ(tree.nearest({0.1, 0, 0}, [](std::uint32_t i) { return i != 0; }).index, 1u);
  EXPECT_EQ(tree.nearest({0.1, 0, 0}, [](std::uint32_t) { return false; }).index, PointTree::kNone);
}

TEST(PointTree, HoldsManyCopiesOfOnePoint) {
  const std::vector<Vector3d> points(100, Vector3d(1, 2, 3));
  const PointTree tree(points);
  EXPECT_EQ(tree.nearest({0, 0, 0}).index, 0u);
  int found = 0;
  tree.within({1, 2, 3}, 0.0, [&](std::uint32_t, double) { ++found; });
  EXPECT_EQ(found, 100);
}

}  // namespace
}  // namespace godobject::scene_compiler::point_tree_test
