#include "toolchain/scene_compiler/field/surface_check.h"

#include <cstring>
#include <map>
#include <numeric>
#include <optional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "tests/scene_compiler/simple_meshes.h"
#include "toolchain/scene_compiler/field/cell_edges.h"
#include "toolchain/scene_compiler/field/octant_nodes.h"
#include "toolchain/scene_compiler/field/surface_facets.h"

namespace godobject::scene_compiler::surface_check_test {
namespace {

using Eigen::Vector3d;

constexpr double kVoxelOfCheck = 0.002;

/// Bodies with holes, parts that cross or are reversed, a cavity, a sheet, and a dilated one.
std::vector<test::BodyOfMesh> compared_bodies() {
  const Eigen::Isometry3d aside(Eigen::Translation3d(0.011, 0.003, 0.002));
  const TriangleMesh box = test::moved(test::box_mesh({0.03, 0.02, 0.015}), test::odd_motion());
  TriangleMesh open = box;
  open.triangles.pop_back();
  const TriangleMesh ball = test::ball_mesh(0.012, 8);
  return {{box},
          {open, SurfaceKind::kSolid},
          {test::joined(ball, test::inside_out(test::moved(test::box_mesh({0.01, 0.02, 0.02}), aside)))},
          {test::joined(ball, test::inside_out(test::ball_mesh(0.006, 6)))},
          {test::moved(test::sheet_mesh(0.03), test::odd_motion()), SurfaceKind::kShell},
          {box, SurfaceKind::kSolid, 0.003}};
}

void expect_same(const Misses& found, const Misses& wanted, int round) {
  EXPECT_EQ(found.wanted, wanted.wanted) << round;
  EXPECT_EQ(found.exact, wanted.exact) << round;
  EXPECT_EQ(found.worst.error, wanted.worst.error) << round;
  EXPECT_EQ(found.worst.at, wanted.worst.at) << round;
}

/// Refines a field by what is missed and by chance, and bars bricks by chance.
class Rounds {
 public:
  Rounds(const test::BodyOfMesh& body, unsigned seed)
      : slack_(seed % 2 == 0 ? 0.25 * kVoxelOfCheck : 0.0),
        surface_(body.mesh, body.kind, 2.0 * kVoxelOfCheck, body.dilation),
        field_(make_distance_grid(surface_, kVoxelOfCheck, default_band(kVoxelOfCheck, 1.5 * kVoxelOfCheck), {})),
        facets_(surface_, 0.002 * kVoxelOfCheck),
        tree_(field_, facets_),
        barred_(field_.bricks.size()),
        random_(seed) {
    triangles_.resize(surface_.mesh().triangles.size());
    std::iota(triangles_.begin(), triangles_.end(), 0u);
  }

  /// Compares all, or some of the triangles, with and without the earlier comparisons.
  void compare(int round) {
    std::vector<std::uint32_t> some;
    for (const std::uint32_t t : triangles_) {
      if (round % 3 != 1 || random_() % 2 == 0) some.push_back(t);
    }
    // a wide tolerance inside, so that errors stay on one side only
    const SurfaceTolerance tolerance{0.02 * kVoxelOfCheck, 0.1 * kVoxelOfCheck};
    const Misses all = find_misses(surface_, tree_, barred_, tolerance, slack_, some, {});
    expect_same(find_misses(surface_, tree_, barred_, tolerance, slack_, some, {}, &compared_), all, round);
    wanted_ = all.wanted;
    exact_ = all.exact;
  }

  void halve() {
    for (const auto& [brick, cells] : exact_) {
      tree_.touch(brick);
      if (random_() % 3 != 0) tree_.make_exact(brick, cells);  // the rest in another round
    }
    if (random_() % 2 == 0) tree_.refuse(static_cast<std::uint32_t>(random_() % tree_.brick_count()));
    for (int k = 0; k < 3; ++k) want(wanted_, static_cast<std::uint32_t>(random_() % tree_.brick_count()), kAllOctants);
    for (const auto& [brick, octants] : wanted_) {
      const bool can = !barred_[brick] && tree_.level(brick) < format::kMaxRefinement;
      if (!can || random_() % 3 == 0) {  // the rest in another round, in which it must be compared again
        tree_.touch(brick);
        continue;
      }
      if (random_() % 16 == 0) {
        barred_[brick] = true;
        tree_.touch(brick);
      } else {
        tree_.halve(brick, octants, measure_octants(surface_, tree_, brick).bricks);
      }
    }
    barred_.resize(tree_.brick_count());
    tree_.join();
  }

  /// All bricks must be joined as if every position had changed.
  void expect_joined(int round) {
    std::vector<Brick> stored;
    std::vector<std::optional<format::ExactBrick>> exact;
    for (std::uint32_t b = 0; b < tree_.brick_count(); ++b) {
      stored.push_back(tree_.stored(b));
      exact.push_back(tree_.exact_brick(b));
      if (exact.back()) ++exact_bricks_;
    }
    for (std::uint32_t b = 0; b < tree_.brick_count(); ++b) tree_.touch(b);
    tree_.join();
    for (std::uint32_t b = 0; b < tree_.brick_count(); ++b) {
      ASSERT_EQ(std::memcmp(stored[b].value, tree_.stored(b).value, sizeof(stored[b].value)), 0) << round << " " << b;
      ASSERT_EQ(exact[b].has_value(), tree_.exact_brick(b).has_value()) << round << " " << b;
      if (!exact[b]) continue;
      for (int i = 0; i < format::kBrickValues; ++i) {
        ASSERT_EQ(exact[b]->weight[i], tree_.exact_brick(b)->weight[i]) << round << " " << b << " " << i;
      }
    }
    // the touching made a new comparison of everything necessary
    compare(round);
  }

  std::uint32_t bricks() const { return tree_.brick_count(); }
  std::size_t exact_bricks() const { return exact_bricks_; }

 private:
  double slack_;
  SolidSurface surface_;
  DistanceGrid field_;
  SurfaceFacets facets_;
  BrickTree tree_;
  std::vector<bool> barred_;
  std::vector<std::uint32_t> triangles_;
  std::mt19937 random_;
  std::size_t exact_bricks_ = 0;
  Compared compared_;
  Wanted wanted_;
  std::map<std::uint32_t, std::uint64_t> exact_;
};

TEST(SurfaceCheck, FindsTheSameMissesFromWhatHasChanged) {
  unsigned seed = 1;
  std::size_t exact_bricks = 0;
  for (const test::BodyOfMesh& body : compared_bodies()) {
    SCOPED_TRACE(seed);
    Rounds rounds(body, seed++);
    const std::uint32_t before = rounds.bricks();
    for (int round = 0; round < 8; ++round) {
      rounds.compare(round);
      rounds.halve();
    }
    rounds.expect_joined(8);
    EXPECT_GT(rounds.bricks(), before + 50);
    exact_bricks += rounds.exact_bricks();
  }
  EXPECT_GT(exact_bricks, 100u);
}

}  // namespace
}  // namespace godobject::scene_compiler::surface_check_test
