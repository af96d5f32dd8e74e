// The overlap of meshes against the separating axes of boxes, an exact oracle, and against dense samples of the
// surface.
#include "toolchain/precision/mesh_overlap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/scene_compiler/simple_meshes.h"
#include "tests/support/random.h"

namespace godobject::precision {
namespace {

using scene_compiler::SolidSurface;
using scene_compiler::SurfaceKind;
using scene_compiler::TriangleMesh;

constexpr double kTolerance = 1e-6;

SolidSurface solid(TriangleMesh mesh) { return {std::move(mesh), SurfaceKind::kSolid, 0.0}; }

/// Returns the least translation that separates two boxes about their frames' origins; negative: their distance along
/// the best axis.
double separation(const Vector3& a, const Vector3& b, const Pose& H) {
  const Matrix3 R = H.rotation.toRotationMatrix();
  double least = std::numeric_limits<double>::infinity();
  const auto try_axis = [&](Vector3 n) {
    if (n.norm() < 1e-9) return;
    n.normalize();
    const double reach = 0.5 * (a.dot(n.cwiseAbs()) + b.dot((R.transpose() * n).cwiseAbs()));
    least = std::min(least, reach - std::abs(n.dot(H.translation)));
  };
  for (int i = 0; i < 3; ++i) {
    try_axis(Vector3::Unit(i));
    try_axis(R.col(i));
    for (int j = 0; j < 3; ++j) try_axis(Vector3::Unit(i).cross(R.col(j)));
  }
  return least;
}

/// Returns the depth of the deepest of many points of `of` in `in`.
double sampled_depth(const TriangleMesh& of, const SolidSurface& in, const Pose& X) {
  constexpr int kSteps = 40;
  double deepest = 0.0;
  for (const auto& t : of.triangles) {
    for (int i = 0; i <= kSteps; ++i) {
      for (int j = 0; i + j <= kSteps; ++j) {
        const double u = static_cast<double>(i) / kSteps;
        const double v = static_cast<double>(j) / kSteps;
        const Vector3 p = (1.0 - u - v) * of.vertices[t[0]] + u * of.vertices[t[1]] + v * of.vertices[t[2]];
        deepest = std::max(deepest, -in.signed_distance(X * p));
      }
    }
  }
  return deepest;
}

TEST(MeshOverlap, OfBoxesIsPositiveJustWhereNoAxisSeparatesThem) {
  test::Random random(31);
  int overlapping = 0;
  int edges_only = 0;
  for (int i = 0; i < 300; ++i) {
    const Vector3 a(random.between(0.02, 0.1), random.between(0.02, 0.1), random.between(0.02, 0.1));
    const Vector3 b(random.between(0.02, 0.1), random.between(0.02, 0.1), random.between(0.02, 0.1));
    Pose H;
    H.rotation = exp_rotation(random.between(0.0, 3.0) * random.direction());
    const Vector3 direction = random.direction();
    double near = 0.0;
    double far = 1.0;
    for (int k = 0; k < 50; ++k) {  // to the distance at which they touch
      const double middle = 0.5 * (near + far);
      H.translation = middle * direction;
      (separation(a, b, H) > 0.0 ? near : far) = middle;
    }
    H.translation =
        (far + std::pow(10.0, random.between(-5.0, -2.5)) * (random.integer(0, 1) == 0 ? 1.0 : -1.0)) * direction;
    const double least = separation(a, b, H);
    const MeshOverlap overlap(solid(test::box_mesh(a)), solid(test::box_mesh(b)), kTolerance);
    const double depth = overlap.depth(H);
    if (least <= 0.0) {
      EXPECT_EQ(depth, 0.0) << i << " apart by " << -least;
      continue;
    }
    ++overlapping;
    EXPECT_LE(depth, least * (1.0 + 1e-9)) << i;
    EXPECT_TRUE(depth > 0.0 || least < 1e-5) << i << " overlap by " << least;
    const auto vertices_outside = [](const Vector3& of, const Vector3& in, const Pose& X) {
      const TriangleMesh mesh = test::box_mesh(of);
      return std::all_of(mesh.vertices.begin(), mesh.vertices.end(),
                         [&](const Vector3& p) { return ((X * p).cwiseAbs() - 0.5 * in).maxCoeff() > 0.0; });
    };
    if (vertices_outside(a, b, H.inverse()) && vertices_outside(b, a, H)) ++edges_only;
  }
  EXPECT_GT(overlapping, 100);
  EXPECT_GT(edges_only, 20) << "no vertex of either box is in the other";
}

TEST(MeshOverlap, IsThatOfTheDeepestPlaceOnEitherSurface) {
  test::Random random(32);
  const TriangleMesh ball = test::ball_mesh(0.03, 12);
  const Vector3 edges(0.05, 0.06, 0.07);
  const TriangleMesh box = test::box_mesh(edges);
  const SolidSurface still = solid(box);
  const SolidSurface moving = solid(ball);
  const MeshOverlap overlap(solid(box), solid(ball), kTolerance);
  for (int i = 0; i < 6; ++i) {
    Pose H;
    H.rotation = exp_rotation(random.between(0.0, 3.0) * random.direction());
    H.translation = random.between(0.045, 0.07) * random.direction();
    const double sampled = std::max(sampled_depth(ball, still, H), sampled_depth(box, moving, H.inverse()));
    const double depth = overlap.depth(H);
    EXPECT_GE(depth, 0.99 * sampled - kTolerance) << i;
    EXPECT_LE(depth, sampled + 0.07 / 40) << "the samples' spacing, " << i;
  }
}

TEST(MeshOverlap, OfTwoEdgesThatCrossIsKnown) {
  // cubes on their edges, one above the other, crossing at right angles and 0.2 mm deep: the edge of one is 0.2 mm
  // below the other's, in the middle of a right angle
  const MeshOverlap overlap(solid(test::box_mesh({0.1, 0.1, 0.1})), solid(test::box_mesh({0.1, 0.1, 0.1})), 1e-7);
  const Quaternion on_edge = exp_rotation(0.25 * M_PI * Vector3::UnitX());
  Pose H_WS, H_WM;
  H_WS.rotation = on_edge;
  H_WM.rotation = exp_rotation(0.5 * M_PI * Vector3::UnitZ()) * on_edge;
  H_WM.translation = (0.1 * std::sqrt(2.0) - 2e-4) * Vector3::UnitZ();
  EXPECT_NEAR(overlap.depth(H_WS.inverse() * H_WM), 2e-4 * std::sqrt(0.5), 0.01 * 2e-4);
  H_WM.translation.z() += 2.01e-4;
  EXPECT_EQ(overlap.depth(H_WS.inverse() * H_WM), 0.0);
}

TEST(MeshOverlap, OfABodyWithinAnotherIsItsDepth) {
  const MeshOverlap overlap(solid(test::box_mesh({0.1, 0.1, 0.1})), solid(test::box_mesh({0.02, 0.02, 0.02})), 1e-7);
  Pose H;
  H.translation = Vector3(0.01, 0.0, 0.0);
  EXPECT_NEAR(overlap.depth(H), 0.05, 5e-4) << "the face of the small one that passes the middle";
}

}  // namespace
}  // namespace godobject::precision
