#include "toolchain/scene_compiler/points/sphere_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "toolchain/parallel/parallel.h"
#include "toolchain/scene_compiler/points/bounding_sphere.h"
#include "toolchain/scene_compiler/points/point_tree.h"

namespace godobject::scene_compiler {
namespace {

using Eigen::Vector3d;

/// The children of a level's samples. Those of the sample at place i of its level are samples[first[i]] ..
/// samples[first[i + 1]], its own first.
struct Children {
  std::vector<std::size_t> first;
  std::vector<std::uint32_t> samples;
};

std::vector<Vector3d> points_of(std::span<const Eigen::Vector3f> points, std::span<const std::uint32_t> indices) {
  std::vector<Vector3d> chosen;
  chosen.reserve(indices.size());
  for (const std::uint32_t i : indices) chosen.push_back(points[i].cast<double>());
  return chosen;
}

std::size_t place_of(std::uint32_t sample, std::span<const std::uint32_t> level) {
  return static_cast<std::size_t>(std::lower_bound(level.begin(), level.end(), sample) - level.begin());
}

bool holds(std::span<const std::uint32_t> level, std::uint32_t sample) {
  return std::binary_search(level.begin(), level.end(), sample);
}

Children attach(std::span<const Eigen::Vector3f> points, std::span<const std::uint32_t> parents,
                std::span<const std::uint32_t> samples) {
  const PointTree tree(points_of(points, parents));
  std::vector<std::size_t> parent(samples.size());
  parallel::for_each_index(samples.size(), [&](std::size_t i) {
    parent[i] = holds(parents, samples[i]) ? place_of(samples[i], parents)
                                           : tree.nearest(points[samples[i]].cast<double>()).index;
  });
  Children children{std::vector<std::size_t>(parents.size() + 1, 0), std::vector<std::uint32_t>(samples.size())};
  for (const std::size_t p : parent) ++children.first[p + 1];
  std::partial_sum(children.first.begin(), children.first.end(), children.first.begin());
  std::vector<std::size_t> next(children.first.begin(), children.first.end() - 1);
  for (std::size_t p = 0; p < parents.size(); ++p) children.samples[next[p]++] = parents[p];
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (parents[parent[i]] != samples[i]) children.samples[next[parent[i]]++] = samples[i];
  }
  return children;
}

/// Lays out nodes and points in pre-order.
class Layout {
 public:
  Layout(std::span<const Eigen::Vector3f> points, const std::vector<std::vector<std::uint32_t>>& levels)
      : levels_(levels) {
    for (std::size_t k = 1; k < levels.size(); ++k) children_.push_back(attach(points, levels[k - 1], levels[k]));
  }

  SphereTree make() {
    const std::uint32_t root = open_node(0);
    if (levels_.size() == 1) {
      tree_.order = levels_.front();
    } else {
      for (const std::uint32_t sample : levels_.front()) add(sample, 1);
    }
    close_node(root);
    return std::move(tree_);
  }

 private:
  /// Adds the node of `sample` at `level` (1 .. levels - 1) with its subtree.
  void add(std::uint32_t sample, std::size_t level) {
    const std::uint32_t node = open_node(level);
    const Children& children = children_[level - 1];
    const std::size_t place = place_of(sample, levels_[level - 1]);
    for (std::size_t i = children.first[place]; i < children.first[place + 1]; ++i) {
      if (level + 1 == levels_.size()) {
        tree_.order.push_back(children.samples[i]);
      } else {
        add(children.samples[i], level + 1);
      }
    }
    close_node(node);
  }

  std::uint32_t open_node(std::size_t level) {
    format::Node node{};
    node.first_point = static_cast<std::uint32_t>(tree_.order.size());
    node.level = static_cast<std::uint16_t>(level);
    node.leaf = level + 1 == levels_.size() ? 1 : 0;
    tree_.nodes.push_back(node);
    return static_cast<std::uint32_t>(tree_.nodes.size() - 1);
  }

  void close_node(std::uint32_t index) {
    format::Node& node = tree_.nodes[index];
    node.skip = static_cast<std::uint32_t>(tree_.nodes.size());
    node.point_count = static_cast<std::uint32_t>(tree_.order.size()) - node.first_point;
  }

  const std::vector<std::vector<std::uint32_t>>& levels_;
  std::vector<Children> children_;  // of levels 1, 2, ..
  SphereTree tree_;
};

}  // namespace

/// Stores centre and radius as floats. The radius grows by the rounding of the centre and then to the next float, so
/// the last bit of a distance to the centre does not matter.
void set_sphere(std::span<const Vector3d> points, format::Node& node) {
  const Eigen::Vector3f center = bounding_sphere(points).center.cast<float>();
  double radius = 0.0;
  for (const Vector3d& point : points) radius = std::max(radius, (point - center.cast<double>()).norm());
  for (int axis = 0; axis < 3; ++axis) node.center[axis] = center[axis];
  const auto rounded = static_cast<float>(radius);
  node.radius = radius > 0.0 ? std::nextafter(rounded, std::numeric_limits<float>::infinity()) : 0.0f;
}

SphereTree build_sphere_tree(std::span<const Eigen::Vector3f> points,
                             const std::vector<std::vector<std::uint32_t>>& levels) {
  SphereTree tree = Layout(points, levels).make();
  const std::vector<Vector3d> ordered = points_of(points, tree.order);
  parallel::for_each_index(tree.nodes.size(), [&](std::size_t i) {
    format::Node& node = tree.nodes[i];
    set_sphere(std::span(ordered).subspan(node.first_point, node.point_count), node);
  });
  return tree;
}

std::vector<float> by_axis(std::span<const Eigen::Vector3f> values, std::span<const std::uint32_t> order) {
  std::vector<float> axes;
  axes.reserve(3 * order.size());
  for (int axis = 0; axis < 3; ++axis) {
    for (const std::uint32_t i : order) axes.push_back(values[i][axis]);
  }
  return axes;
}

}  // namespace godobject::scene_compiler
