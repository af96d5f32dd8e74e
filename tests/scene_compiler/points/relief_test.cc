#include "toolchain/scene_compiler/points/relief.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "tests/scene_compiler/simple_meshes.h"

namespace godobject::scene_compiler::relief_test {
namespace {

using Eigen::Vector3d;

constexpr double kSearchRadius = 0.01;
constexpr Relief::Resolution kResolution{.search_radius = kSearchRadius, .fall = 2e-4, .fine = 5e-4};

/// Returns the smallest distance from the normal at which the surface falls by more than `depth` and at most `deepest`,
/// over all places; `limit` if none is nearer.
double level_radius_of_all(const Relief& relief, std::size_t i, double depth, double deepest, double limit) {
  const SurfaceSample& place = relief.places()[i];
  double least = limit;
  for (const SurfaceSample& other : relief.places()) {
    const double fall = relief.depth_below(i, other.point);
    if (fall <= depth || fall > deepest || !same_side(place, other)) continue;
    least = std::min(least, std::sqrt(std::max(0.0, (other.point - place.point).squaredNorm() - fall * fall)));
  }
  return least;
}

/// Within half of the search radius all places count, so the trees must find what a loop over all finds. Surface deeper
/// than `seen` they may find or not.
void expect_as_over_all(const TriangleMesh& mesh) {
  const SolidSurface surface(mesh, SurfaceKind::kSolid, 0.0);
  const OuterSurface outer(surface);
  const Relief relief(outer, kResolution, 5, {});
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  int falling = 0;
  int level = 0;
  for (int k = 0; k < 1000; ++k) {
    const auto i = static_cast<std::size_t>(share(random) * static_cast<double>(relief.places().size()));
    const Relief::Fall fall{.depth = 1e-3 * share(random), .seen = 1e-3 + 3e-3 * share(random)};
    const double limit = 0.5 * kSearchRadius * share(random);
    const double most = level_radius_of_all(relief, i, fall.depth, fall.seen, limit);
    const double least = level_radius_of_all(relief, i, fall.depth, 1.0, limit);
    const double found = relief.level_radius(i, fall, limit);
    EXPECT_LE(found, most + 1e-12) << "place " << i;
    EXPECT_GE(found, least - 1e-12) << "place " << i;
    const bool falls = relief.falls(i, limit, fall);
    EXPECT_TRUE(falls || most >= limit) << "place " << i;
    EXPECT_TRUE(!falls || least < limit) << "place " << i;
    falling += most < limit ? 1 : 0;
    level += least >= limit ? 1 : 0;
  }
  EXPECT_GT(falling, 100);
  EXPECT_GT(level, 100);
}

TEST(Relief, FindsTheFallsOfABoxThatALoopFinds) { expect_as_over_all(test::box_mesh({0.03, 0.02, 0.01})); }

TEST(Relief, FindsTheFallsOfABallThatALoopFinds) { expect_as_over_all(test::ball_mesh(0.01, 16)); }

/// Points that are left out for some places at once must show no fall at any of them.
void expect_as_one_by_one(const TriangleMesh& mesh, SurfaceKind kind) {
  const SolidSurface surface(mesh, kind, 0.002);
  const OuterSurface outer(surface);
  const Relief relief(outer, kResolution, 7, {});
  std::vector<int> asked(relief.places().size());
  std::atomic<int> falling{0};
  std::atomic<int> wrong{0};
  relief.for_each_run([&](const Relief::Run& run) {
    std::mt19937 random(run.front());
    std::uniform_real_distribution<double> share(0.0, 1.0);
    const Relief::Fall fall{.depth = 1e-3 * share(random) * share(random), .seen = 4e-3 * share(random)};
    const double most = kSearchRadius * share(random);
    Relief::Vicinity vicinity(relief, run, most, fall);
    for (const std::uint32_t i : run) {
      ++asked[i];
      for (const double radius : {most, most * share(random), most * share(random)}) {
        const bool falls = relief.falls(i, radius, fall);
        if (vicinity.falls(i, radius) != falls) ++wrong;
        if (falls) ++falling;
      }
    }
  });
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(falling, 100);
  EXPECT_LT(falling, static_cast<int>(3 * asked.size()) - 100);
  EXPECT_EQ(std::count(asked.begin(), asked.end(), 1), static_cast<std::ptrdiff_t>(asked.size()));
}

TEST(Relief, FindsTheSameFallsForManyPlacesAtOnce) {
  expect_as_one_by_one(test::box_mesh({0.03, 0.02, 0.01}), SurfaceKind::kSolid);
  expect_as_one_by_one(test::ball_mesh(0.01, 16), SurfaceKind::kSolid);
  expect_as_one_by_one(test::box_mesh({0.03, 0.02, 0.0004}), SurfaceKind::kSolid);
  expect_as_one_by_one(test::sheet_mesh(0.03), SurfaceKind::kShell);
  const Eigen::Isometry3d aside(Eigen::Translation3d(0.012, 0.004, 0.003));
  const TriangleMesh crossing =
      test::joined(test::ball_mesh(0.01, 24), test::moved(test::box_mesh({0.01, 0.01, 0.02}), aside));
  expect_as_one_by_one(test::joined(crossing, test::inside_out(test::ball_mesh(0.004, 8))), SurfaceKind::kAuto);
}

}  // namespace
}  // namespace godobject::scene_compiler::relief_test
