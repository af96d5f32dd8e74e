#include "toolchain/scene_compiler/trimming/pruned_tree.h"

#include <algorithm>
#include <span>

#include <Eigen/Core>

#include "toolchain/parallel/parallel.h"
#include "toolchain/scene_compiler/points/sphere_tree.h"

namespace godobject::scene_compiler {
namespace {

using format::Node;

void remove_values(const std::vector<bool>& stays, std::vector<float>& axes) {
  if (axes.empty()) return;
  const std::size_t n = stays.size();
  std::vector<float> remaining;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (stays[i % n]) remaining.push_back(axes[i]);
  }
  axes = std::move(remaining);
}

class Pruning {
 public:
  Pruning(const std::vector<bool>& stays, const std::vector<Node>& nodes) : from_(nodes), before_(stays.size() + 1) {
    for (std::size_t i = 0; i < stays.size(); ++i) before_[i + 1] = before_[i] + (stays[i] ? 1 : 0);
  }

  std::vector<Node> make() {
    add(0, 0);
    return std::move(nodes_);
  }
  /// Returns, for each node from `make`, whether it contains fewer points than before.
  const std::vector<bool>& smaller() const { return smaller_; }

 private:
  std::uint32_t left(const Node& node) const {
    return before_[node.first_point + node.point_count] - before_[node.first_point];
  }

  void add(std::uint32_t n, std::uint16_t level) {
    const Node& from = from_[n];
    std::vector<std::uint32_t> children;
    for (std::uint32_t child = n + 1; child < from.skip; child = from_[child].skip) {
      if (left(from_[child]) > 0) children.push_back(child);
    }
    if (children.size() == 1) return add(children.front(), level);
    const auto number = nodes_.size();
    nodes_.push_back(from);
    smaller_.push_back(left(from) < from.point_count);
    nodes_[number].first_point = before_[from.first_point];
    nodes_[number].point_count = left(from);
    nodes_[number].level = level;
    for (const std::uint32_t child : children) add(child, static_cast<std::uint16_t>(level + 1));
    nodes_[number].skip = static_cast<std::uint32_t>(nodes_.size());
  }

  const std::vector<Node>& from_;
  std::vector<std::uint32_t> before_;  // remaining points before this one
  std::vector<Node> nodes_;
  std::vector<bool> smaller_;
};

}  // namespace

std::uint32_t prune(const std::vector<bool>& stays, const TreeOfPoints& tree) {
  Pruning pruning(stays, tree.nodes);
  tree.nodes = pruning.make();
  remove_values(stays, tree.points);
  remove_values(stays, tree.normals);
  const std::size_t n = tree.points.size() / 3;
  std::vector<Eigen::Vector3d> points(n);
  for (std::size_t i = 0; i < n; ++i)
    points[i] = Eigen::Vector3f(tree.points[i], tree.points[n + i], tree.points[2 * n + i]).cast<double>();
  std::uint16_t deepest = 0;
  for (const Node& node : tree.nodes) deepest = std::max(deepest, node.level);
  parallel::for_each_index(tree.nodes.size(), [&](std::size_t i) {
    Node& node = tree.nodes[i];
    if (pruning.smaller()[i]) set_sphere(std::span(points).subspan(node.first_point, node.point_count), node);
  });
  return deepest + 1u;
}

}  // namespace godobject::scene_compiler
