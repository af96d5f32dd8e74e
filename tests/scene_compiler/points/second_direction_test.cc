#include "toolchain/scene_compiler/points/second_direction.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "tests/scene_compiler/simple_meshes.h"
#include "tests/scene_compiler/test_meshes.h"
#include "toolchain/scene_compiler/mesh/triangle_tree.h"
#include "toolchain/scene_compiler/points/point_tree.h"
#include "toolchain/scene_compiler/points/still_features.h"

namespace godobject::scene_compiler::second_direction_test {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr std::uint32_t kDense = 40000;        // draws on each surface, apart from the compiler's own
constexpr std::uint32_t kDenseOnTool = 10000;  // tools are small and have few edges
constexpr std::uint32_t kDenseSeed = 4711;

/// A surface with dense draws, vertices and points along all its edges.
struct Dense {
  Dense(const OuterSurface& outer, std::uint32_t count) {
    std::vector<SurfaceSample> draws = outer.draw_all(count, kDenseSeed);
    const TriangleMesh& mesh = outer.body().mesh;
    double length = 0.0;
    for (const MeshEdges::Edge& edge : outer.body().edges.all())
      length += (mesh.vertices[edge.high] - mesh.vertices[edge.low]).norm();
    if (outer.surface().shell_triangles().empty()) {
      for (const MeshEdges::Edge& edge : outer.body().edges.all()) {
        const Vector3d along = mesh.vertices[edge.high] - mesh.vertices[edge.low];
        const int parts = 1 + static_cast<int>(along.norm() / length * count);
        for (int i = 0; i <= parts; ++i) points.push_back(mesh.vertices[edge.low] + along * i / parts);
      }
    }
    for (const SurfaceSample& draw : draws) points.push_back(draw.point);
  }
  std::vector<Vector3d> points;
};

std::vector<Vector3d> points_of(const std::vector<SurfaceSample>& samples) {
  std::vector<Vector3d> points;
  for (const SurfaceSample& sample : samples) points.push_back(sample.point);
  return points;
}

/// Points that move with a body against a surface at rest. Clearances are looked up as late as possible.
class Watched {
 public:
  Watched(std::vector<Vector3d> points, const SolidSurface& against)
      : points_(std::move(points)), against_(against), tree_(points_), at_least_(points_.size()) {}

  const PointTree& tree() const { return tree_; }
  double at_least(std::size_t i) const { return at_least_[i]; }

  void start(const Isometry3d& motion) {
    for (std::size_t i = 0; i < points_.size(); ++i) at_least_[i] = against_.signed_distance(motion * points_[i]);
  }

  /// Returns the smallest signed distance after `motion`, which moved every point by at most `travelled` since the last
  /// call.
  double clearance(const Isometry3d& motion, double travelled, double smallest) {
    for (std::size_t i = 0; i < points_.size(); ++i) {
      at_least_[i] -= travelled;
      if (at_least_[i] >= smallest) continue;
      at_least_[i] = against_.signed_distance(motion * points_[i]);
      smallest = std::min(smallest, at_least_[i]);
    }
    return smallest;
  }

 private:
  std::vector<Vector3d> points_;
  const SolidSurface& against_;
  PointTree tree_;
  std::vector<double> at_least_;
};

/// Returns the depth of the deepest of `dense` (moved) in `body`. `watched`: points that are known not to be inside.
double deepest(const std::vector<Vector3d>& dense, const Isometry3d& motion, const SolidSurface& body,
               const Watched* watched) {
  double least = 0.0;
  for (const Vector3d& point : dense) {
    if (watched != nullptr) {
      const PointTree::Nearest near = watched->tree().nearest(point);
      if (near.index != PointTree::kNone && watched->at_least(near.index) - std::sqrt(near.squared_distance) > least)
        continue;
    }
    least = std::min(least, body.signed_distance(motion * point));
  }
  return -least;
}

/// Returns the largest depth of the edges of `outer` (moved) where they pierce triangles of `body`.
double deepest_piercing(const OuterSurface& outer, const Isometry3d& motion, const SolidSurface& body) {
  constexpr int kLooks = 8;  // between two triangles
  const TriangleMesh& mesh = outer.body().mesh;
  double least = 0.0;
  if (!outer.surface().shell_triangles().empty() || body.solid_triangles().empty()) return 0.0;
  for (const MeshEdges::Edge& edge : outer.body().edges.all()) {
    const Vector3d low = motion * mesh.vertices[edge.low];
    const Vector3d along = motion * mesh.vertices[edge.high] - low;
    TriangleTree::RayHit hit{};
    double from = 0.0;
    for (bool pierced = true, any = false; pierced; from = hit.t) {
      pierced = body.solid_triangles().first_hit(low, along, from, 1.0, hit);
      any |= pierced;
      const double to = pierced ? hit.t : 1.0;
      for (int i = 0; any && i <= kLooks; ++i)
        least = std::min(least, body.signed_distance(low + (from + (to - from) * i / kLooks) * along));
    }
  }
  return -least;
}

struct Bodies {
  Bodies(TriangleMesh still_mesh, TriangleMesh moving_mesh, SurfaceKind kind, double thickness)
      : still(std::move(still_mesh), kind, thickness),
        moving(std::move(moving_mesh), SurfaceKind::kAuto, thickness),
        still_outer(still),
        moving_outer(moving) {}
  Bodies(TriangleMesh still_mesh, TriangleMesh moving_mesh)
      : Bodies(std::move(still_mesh), std::move(moving_mesh), SurfaceKind::kAuto, 0.002) {}

  void look(std::uint32_t points, double wanted) {
    sampling = sample_moving_body(moving_outer, points, 1, {});
    both = see_both_directions(still_outer, moving_outer, wanted, sampling, {});
    RecordProperty("bound_um", 1e6 * both.between.bound);
    RecordProperty("added", both.added_points);
    RecordProperty("features", static_cast<double>(both.features.size()));
  }

  static void RecordProperty(const char* key, double value) {
    testing::Test::RecordProperty(key, std::to_string(value));
  }

  SolidSurface still;
  SolidSurface moving;
  OuterSurface still_outer;
  OuterSurface moving_outer;
  MovingSampling sampling;
  BothDirections both;
};

/// Turns the moving body at random and moves it from afar along random lines, until a sample point touches the still
/// body or a feature point the moving one. `target`: the lines lead to this place in the still body's box.
double deepest_unseen(const Bodies& bodies, int poses, const Vector3d& target, double spread,
                      std::uint32_t dense = kDense) {
  const Dense moving_dense(bodies.moving_outer, dense);
  const Dense still_dense(bodies.still_outer, dense);
  Watched samples(points_of(bodies.sampling.samples), bodies.still);
  Watched features(points_of(bodies.both.features), bodies.moving);
  const double far = bodies.still_outer.body().diagonal + bodies.moving_outer.body().diagonal;
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::normal_distribution<double> normal;
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& point : moving_dense.points) middle += point / static_cast<double>(moving_dense.points.size());

  double worst = 0.0;
  for (int pose = 0; pose < poses; ++pose) {
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized();
    const Vector3d from = Vector3d(normal(random), normal(random), normal(random)).normalized();
    const Vector3d aim = target + spread * Vector3d(uniform(random), uniform(random), uniform(random));
    Isometry3d X_WM = Isometry3d(Eigen::Translation3d(aim + far * from) * turn * Eigen::Translation3d(-middle));
    samples.start(X_WM);
    features.start(X_WM.inverse());
    double travelled = 0.0;
    double step = 0.0;
    for (int i = 0; i < 200 && travelled < 2.0 * far; ++i) {
      double clear = samples.clearance(X_WM, step, std::numeric_limits<double>::infinity());
      clear = features.clearance(X_WM.inverse(), step, clear);
      if (clear < 1e-8) break;
      step = clear;
      travelled += step;
      X_WM.pretranslate(-step * from);
    }
    if (travelled >= 2.0 * far) continue;  // passed by
    worst = std::max(worst, deepest(moving_dense.points, X_WM, bodies.still, &samples));
    worst = std::max(worst, deepest(still_dense.points, X_WM.inverse(), bodies.moving, nullptr));
    worst = std::max(worst, deepest_piercing(bodies.moving_outer, X_WM, bodies.still));
    worst = std::max(worst, deepest_piercing(bodies.still_outer, X_WM.inverse(), bodies.moving));
  }
  Bodies::RecordProperty("deepest_um", 1e6 * worst);
  return worst;
}

TEST(SecondDirection, HoldsItsBoundBetweenBunnyAndTeapot) {
  Bodies bodies(load("teapot", 0.037), load("bunny_npm", 0.0161497));
  bodies.look(5587, 0.003);  // half a millimetre takes minutes
  EXPECT_LE(deepest_unseen(bodies, 3, {0.0, 0.03, 0.0}, 0.05), bodies.both.between.bound);
}

TEST(SecondDirection, HoldsItsBoundBetweenPegAndHole) {
  Bodies bodies(load("hole_round", 1.0), load("peg_round", 1.0));
  bodies.look(3000, 0.001);
  EXPECT_LE(bodies.both.between.bound, 0.001);
  EXPECT_LE(deepest_unseen(bodies, 1, {0.0, 0.0, 0.05}, 0.02), bodies.both.between.bound);
}

TEST(SecondDirection, HoldsItsBoundBetweenBunnyAndPlate) {
  Bodies bodies(load("plate_2mm", 1.0), load("bunny_npm", 0.0161497));
  bodies.look(3000, 0.002);
  EXPECT_LE(deepest_unseen(bodies, 1, Vector3d::Zero(), 0.05), bodies.both.between.bound);
}

TEST(SecondDirection, HoldsItsBoundBetweenBunnyAndSheet) {
  Bodies bodies(load("sheet_open", 1.0), load("bunny_npm", 0.0161497), SurfaceKind::kShell, 0.002);
  bodies.look(3000, 0.002);
  EXPECT_LE(deepest_unseen(bodies, 1, Vector3d::Zero(), 0.05), bodies.both.between.bound);
}

/// Flat walls can enter other bodies only with their edges.
TEST(SecondDirection, NeedsNoFeaturesOnFlatWalls) {
  Bodies bodies(test::box_mesh({0.06, 0.04, 0.05}), test::ball_mesh(0.015, 24));
  bodies.look(400, 0.001);
  EXPECT_LE(bodies.both.between.bound, 0.001);
  std::size_t on_faces = 0;
  for (const SurfaceSample& feature : bodies.both.features) on_faces += feature.place == SurfaceSample::Place::kFace;
  EXPECT_EQ(on_faces, 0u);
}

/// A wedge along y with its edge on top, at z = 0: `half_width` below it by `height`.
TriangleMesh knife_mesh(double length, double half_width, double height) {
  const double y = 0.5 * length;
  return {{{0.0, -y, 0.0},
           {0.0, y, 0.0},
           {-half_width, -y, -height},
           {half_width, -y, -height},
           {-half_width, y, -height},
           {half_width, y, -height}},
          {{0, 3, 5}, {0, 5, 1}, {0, 1, 4}, {0, 4, 2}, {2, 4, 5}, {2, 5, 3}, {0, 2, 3}, {1, 5, 4}}};
}

/// Needles side by side, their tips at x = 0.
TriangleMesh comb_mesh() {
  TriangleMesh comb;
  for (int i = 0; i < 4; ++i) {
    Isometry3d aside = Isometry3d::Identity();
    aside.translation() = Vector3d(0.0, 0.004 * i, 0.0);
    const TriangleMesh tooth = test::moved(test::needle_mesh(0.02, 0.001), aside);
    comb = i == 0 ? tooth : test::joined(comb, tooth);
  }
  return comb;
}

class Tools : public testing::TestWithParam<int> {
 protected:
  static TriangleMesh tool() {
    if (GetParam() == 0) return test::needle_mesh(0.02, 0.001);
    if (GetParam() == 1) return comb_mesh();
    return knife_mesh(0.02, 0.002, 0.01);
  }
};

/// Samples 3 mm apart, between which each of the tools would enter undetected.
TEST_P(Tools, EnterNoBoxDeeperThanTheBound) {
  Bodies bodies(tool(), test::box_mesh({0.03, 0.02, 0.025}));
  bodies.look(400, 0.0005);
  ASSERT_FALSE(bodies.both.features.empty());
  EXPECT_LE(deepest_unseen(bodies, 15, Vector3d::Zero(), 0.004, kDenseOnTool), bodies.both.between.bound);
}

TEST_P(Tools, EnterNoCoarseBallDeeperThanTheBound) {
  Bodies bodies(tool(), test::ball_mesh(0.015, 6));
  bodies.look(400, 0.0005);
  EXPECT_LE(deepest_unseen(bodies, 15, Vector3d::Zero(), 0.004, kDenseOnTool), bodies.both.between.bound);
}

INSTANTIATE_TEST_SUITE_P(SpikeCombKnife, Tools, testing::Range(0, 3));

}  // namespace
}  // namespace godobject::scene_compiler::second_direction_test
