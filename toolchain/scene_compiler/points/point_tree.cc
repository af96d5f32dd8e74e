#include "toolchain/scene_compiler/points/point_tree.h"

#include <algorithm>

namespace godobject::scene_compiler {

PointTree::PointTree(std::span<const Eigen::Vector3d> points) {
  entries_.reserve(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) entries_.push_back({points[i], i});
  if (!entries_.empty()) build({0, 0, size()});
}

void PointTree::build(const Range& range) {
  Eigen::Vector3d low = entries_[range.begin].point;
  Eigen::Vector3d high = low;
  for (std::uint32_t i = range.begin; i < range.end; ++i) {
    low = low.cwiseMin(entries_[i].point);
    high = high.cwiseMax(entries_[i].point);
  }
  if (range.node >= boxes_.size()) boxes_.resize(range.node + 1);
  boxes_[range.node] = {low, high};
  if (range.leaf()) return;
  int axis = 0;
  (high - low).maxCoeff(&axis);
  const auto at = [this](std::uint32_t i) { return entries_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(range.begin), at(range.middle()), at(range.end), [axis](const Entry& a, const Entry& b) {
    return a.point[axis] != b.point[axis] ? a.point[axis] < b.point[axis] : a.index < b.index;
  });
  if (range.node >= cuts_.size()) cuts_.resize(range.node + 1);
  cuts_[range.node] = {entries_[range.middle()].point[axis], axis};
  build(range.lower());
  build(range.upper());
}

}  // namespace godobject::scene_compiler
