#include "toolchain/scene_compiler/points/sharp_edge_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/scene/sharp_edges.h"
#include "toolchain/scene_compiler/mesh/sharp_features.h"

namespace godobject::scene_compiler {
namespace {

using Eigen::Vector3d;
using format::Node;

constexpr std::uint32_t kMostInLeaf = 2;

format::SharpEdge stored_edge(const BodyMesh& body, const SharpEdge& edge, const Eigen::Isometry3d& X) {
  format::SharpEdge stored{};
  const std::array<std::uint32_t, 2> vertices{edge.low, edge.high};
  for (std::size_t k = 0; k < 2; ++k) {
    const Vector3d end = X * body.mesh.vertices[vertices[k]];
    std::copy_n(end.data(), 3, stored.end[k]);
    const Eigen::Vector3f normal = (X.linear() * edge.normals[k]).cast<float>();
    std::copy_n(normal.data(), 3, stored.normal[k]);
  }
  stored.radius = edge.in_shell ? static_cast<float>(body.half_thickness) : 0.0f;
  return stored;
}

Vector3d middle_of(const format::SharpEdge& edge) { return 0.5 * (edge_end(edge, 0) + edge_end(edge, 1)); }

/// Builds the tree over edges[first .. first + count) and sorts them.
class Builder {
 public:
  explicit Builder(SharpEdgeTree& tree) : tree_(tree) {}

  void build(std::uint32_t first, std::uint32_t count, std::uint16_t level) {
    const std::size_t at = tree_.nodes.size();
    tree_.nodes.push_back(node_around(first, count));
    tree_.nodes[at].level = level;
    if (count <= kMostInLeaf) {
      tree_.nodes[at].leaf = 1;
    } else {
      const std::uint32_t half = count / 2;
      sort_along_longest_axis(first, count);
      build(first, half, static_cast<std::uint16_t>(level + 1));
      build(first + half, count - half, static_cast<std::uint16_t>(level + 1));
    }
    tree_.nodes[at].skip = static_cast<std::uint32_t>(tree_.nodes.size());
  }

 private:
  std::span<format::SharpEdge> edges(std::uint32_t first, std::uint32_t count) {
    return std::span(tree_.edges).subspan(first, count);
  }

  void sort_along_longest_axis(std::uint32_t first, std::uint32_t count) {
    Eigen::AlignedBox3d middles;
    for (const format::SharpEdge& edge : edges(first, count)) middles.extend(middle_of(edge));
    Eigen::Index axis = 0;
    middles.sizes().maxCoeff(&axis);
    const auto begin = edges(first, count).begin();
    std::stable_sort(begin, begin + count, [axis](const format::SharpEdge& a, const format::SharpEdge& b) {
      return middle_of(a)[axis] < middle_of(b)[axis];
    });
  }

  Node node_around(std::uint32_t first, std::uint32_t count) {
    constexpr double kRoundedUp = 1.0 + 1e-6;  // more than the rounding to single precision
    Eigen::AlignedBox3d box;
    for (const format::SharpEdge& edge : edges(first, count)) {
      for (int k = 0; k < 2; ++k) box.extend(edge_end(edge, k));
    }
    const Eigen::Vector3f center = box.center().cast<float>();
    double radius = 0.0;
    for (const format::SharpEdge& edge : edges(first, count)) {
      for (int k = 0; k < 2; ++k) {
        radius =
            std::max(radius, (edge_end(edge, k) - center.cast<double>()).norm() + static_cast<double>(edge.radius));
      }
    }
    Node node{};
    std::copy_n(center.data(), 3, node.center);
    node.radius = static_cast<float>(radius * kRoundedUp);
    node.first_point = first;
    node.point_count = count;
    return node;
  }

  SharpEdgeTree& tree_;
};

}  // namespace

SharpEdgeTree make_sharp_edges(const BodyMesh& body, const Eigen::Isometry3d& X) {
  SharpEdgeTree tree;
  std::vector<SharpEdge> sharp = sharp_features(body).edges;
  std::erase_if(sharp,
                [&](const SharpEdge& edge) { return body.mesh.vertices[edge.low] == body.mesh.vertices[edge.high]; });
  if (sharp.size() > format::kMaxSharpEdges) {
    std::stable_sort(sharp.begin(), sharp.end(), [](const SharpEdge& a, const SharpEdge& b) {
      return a.normals[0].dot(a.normals[1]) < b.normals[0].dot(b.normals[1]);
    });
    tree.left_out = static_cast<std::uint32_t>(sharp.size()) - format::kMaxSharpEdges;
    sharp.resize(format::kMaxSharpEdges);
  }
  for (const SharpEdge& edge : sharp) tree.edges.push_back(stored_edge(body, edge, X));
  if (!tree.edges.empty()) Builder(tree).build(0, static_cast<std::uint32_t>(tree.edges.size()), 0);
  return tree;
}

std::vector<Vector3d> ends_of(const SharpEdgeTree& tree) {
  std::vector<Vector3d> ends;
  for (const format::SharpEdge& edge : tree.edges) {
    for (int k = 0; k < 2; ++k) ends.push_back(edge_end(edge, k));
  }
  return ends;
}

}  // namespace godobject::scene_compiler
