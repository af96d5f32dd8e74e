// The sharp edges of a body and their sphere tree.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/scene/sharp_edges.h"
#include "tests/scene_compiler/simple_meshes.h"
#include "toolchain/scene_compiler/points/sharp_edge_tree.h"

namespace godobject::scene_compiler::sharp_edge_tree_test {
namespace {

using Eigen::Vector3d;

SharpEdgeTree edges_of(const TriangleMesh& mesh, SurfaceKind kind = SurfaceKind::kSolid,
                       const Eigen::Isometry3d& X = Eigen::Isometry3d::Identity()) {
  return make_sharp_edges(BodyMesh(SolidSurface(mesh, kind, kind == SurfaceKind::kShell ? 0.002 : 0.0)), X);
}

TEST(SharpEdges, OfABoxAreItsTwelveEdgesWithTheNormalsOfTheirFaces) {
  const Vector3d size(0.01, 0.02, 0.03);
  const SharpEdgeTree tree = edges_of(test::box_mesh(size));
  ASSERT_EQ(tree.edges.size(), 12u);
  EXPECT_EQ(tree.left_out, 0u);
  for (const format::SharpEdge& edge : tree.edges) {
    const Vector3d along = edge_end(edge, 1) - edge_end(edge, 0);
    const Vector3d middle = 0.5 * (edge_end(edge, 0) + edge_end(edge, 1));
    EXPECT_EQ((along.array().abs() > 1e-12).count(), 1) << "along an axis";
    EXPECT_EQ((middle.array().abs() > 1e-12).count(), 2);
    for (int k = 0; k < 2; ++k) {
      EXPECT_NEAR(face_normal(edge, k).norm(), 1.0, 1e-6);
      EXPECT_NEAR(face_normal(edge, k).dot(along), 0.0, 1e-9);
      EXPECT_GT(face_normal(edge, k).dot(middle), 0.0) << "outwards";
    }
    EXPECT_NEAR(face_normal(edge, 0).dot(face_normal(edge, 1)), 0.0, 1e-6);
    EXPECT_EQ(edge.radius, 0.0f);
  }
}

TEST(SharpEdges, MoveWithTheBody) {
  Eigen::Isometry3d X(Eigen::AngleAxisd(0.5 * M_PI, Vector3d::UnitZ()));
  X.translation() = Vector3d(1.0, 2.0, 3.0);
  const SharpEdgeTree still = edges_of(test::box_mesh({0.01, 0.02, 0.03}));
  const SharpEdgeTree moved = edges_of(test::box_mesh({0.01, 0.02, 0.03}), SurfaceKind::kSolid, X);
  ASSERT_EQ(moved.edges.size(), still.edges.size());
  Eigen::AlignedBox3d box;
  for (const Vector3d& end : ends_of(moved)) box.extend(end);
  EXPECT_TRUE(box.center().isApprox(X.translation(), 1e-12));
  EXPECT_TRUE(box.sizes().isApprox(Vector3d(0.02, 0.01, 0.03), 1e-12));
}

/// Smooth bodies have none, and re-entrant edges do not count.
TEST(SharpEdges, AreConvexAndSharp) {
  EXPECT_TRUE(edges_of(test::ball_mesh(0.01, 24)).edges.empty());
  EXPECT_TRUE(edges_of(test::ball_mesh(0.01, 24)).nodes.empty());
  EXPECT_FALSE(edges_of(test::ball_mesh(0.01, 3)).edges.empty());
}

TEST(SharpEdges, OfASheetLieInsideItsThickness) {
  TriangleMesh sheet;
  sheet.vertices = {{0.0, 0.0, 0.0}, {0.02, 0.0, 0.0}, {0.02, 0.02, 0.0}, {0.0, 0.02, 0.0}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
  const SharpEdgeTree tree = edges_of(sheet, SurfaceKind::kShell);
  ASSERT_EQ(tree.edges.size(), 4u);
  for (const format::SharpEdge& edge : tree.edges) {
    EXPECT_EQ(edge.radius, 0.001f);
    EXPECT_TRUE(face_normal(edge, 0).isZero());
  }
}

/// Every node's sphere contains its edges, siblings share out the edges of their parent, and leaves are small.
TEST(SharpEdges, HaveATreeWhoseSpheresContainThem) {
  const SharpEdgeTree tree = edges_of(test::ball_mesh(0.01, 5));
  ASSERT_GT(tree.edges.size(), 40u);
  ASSERT_FALSE(tree.nodes.empty());
  EXPECT_EQ(tree.nodes[0].point_count, tree.edges.size());
  EXPECT_EQ(tree.nodes[0].skip, tree.nodes.size());
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    const format::Node& node = tree.nodes[n];
    const Vector3d center = Eigen::Map<const Eigen::Vector3f>(node.center).cast<double>();
    for (std::uint32_t i = node.first_point; i < node.first_point + node.point_count; ++i) {
      for (int k = 0; k < 2; ++k) {
        EXPECT_LE((edge_end(tree.edges[i], k) - center).norm(), static_cast<double>(node.radius));
      }
    }
    if (node.leaf != 0) {
      EXPECT_LE(node.point_count, 2u);
      continue;
    }
    const format::Node& first = tree.nodes[n + 1];
    const format::Node& second = tree.nodes[first.skip];
    EXPECT_EQ(second.skip, node.skip) << "two children";
    EXPECT_EQ(first.first_point, node.first_point);
    EXPECT_EQ(second.first_point, first.first_point + first.point_count);
    EXPECT_EQ(first.point_count + second.point_count, node.point_count);
    EXPECT_LE(std::max(first.point_count, second.point_count), (node.point_count + 1) / 2);
    EXPECT_EQ(first.level, node.level + 1);
  }
}

}  // namespace
}  // namespace godobject::scene_compiler::sharp_edge_tree_test
