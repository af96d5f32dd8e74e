#include "toolchain/scene_compiler/points/point_tree.h"

#include <algorithm>

#include "toolchain/parallel/parallel.h"

namespace godobject::scene_compiler {

PointTree::PointTree(std::span<const Eigen::Vector3d> points) {
  entries_.reserve(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) entries_.push_back({points[i], i});
  if (entries_.empty()) return;
  std::size_t nodes = 1;  // halves of one level differ in size by one at most
  for (std::size_t largest = entries_.size(); largest > kLeafSize; largest = (largest + 1) / 2) nodes = 2 * nodes + 1;
  boxes_.resize(nodes);
  cuts_.resize(nodes);
  std::vector<Range> later;
  build({0, 0, size()}, &later);
  parallel::for_each_index(later.size(), [&](std::size_t i) { build(later[i], nullptr); });
}

/// `later`, if any: takes the ranges that are small enough for one thread.
void PointTree::build(const Range& range, std::vector<Range>* later) {
  constexpr std::uint32_t kParts = 8;
  constexpr std::uint32_t kFew = 4096;
  if (later != nullptr && range.end - range.begin <= std::max(size() / kParts, kFew)) {
    later->push_back(range);
    return;
  }
  Eigen::Vector3d low = entries_[range.begin].point;
  Eigen::Vector3d high = low;
  for (std::uint32_t i = range.begin; i < range.end; ++i) {
    low = low.cwiseMin(entries_[i].point);
    high = high.cwiseMax(entries_[i].point);
  }
  boxes_[range.node] = {{low, high}, (0.5 * (high - low)).norm()};
  if (range.leaf()) return;
  int axis = 0;
  (high - low).maxCoeff(&axis);
  const auto at = [this](std::uint32_t i) { return entries_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(range.begin), at(range.middle()), at(range.end), [axis](const Entry& a, const Entry& b) {
    return a.point[axis] != b.point[axis] ? a.point[axis] < b.point[axis] : a.index < b.index;
  });
  cuts_[range.node] = {entries_[range.middle()].point[axis], axis};
  build(range.lower(), later);
  build(range.upper(), later);
}

bool PointTree::any_in_boxes(const Eigen::Vector3d& p, const Range& range, double bound) const {
  const Bounds& box = boxes_[range.node];
  if (box.squared_distance(p) > bound) return false;
  if (range.leaf()) {
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      if ((entries_[i].point - p).squaredNorm() <= bound) return true;
    }
    return false;
  }
  const Cut& cut = cuts_[range.node];
  const bool below = p[cut.axis] < cut.value;
  return any_in_boxes(p, below ? range.lower() : range.upper(), bound) ||
         any_in_boxes(p, below ? range.upper() : range.lower(), bound);
}

std::vector<PointTree::Run> PointTree::runs(std::uint32_t most) const {
  std::vector<Run> runs;
  if (size() > 0) add_runs({0, 0, size()}, std::max(most, kLeafSize), runs);
  return runs;
}

void PointTree::add_runs(const Range& range, std::uint32_t most, std::vector<Run>& runs) const {
  if (range.end - range.begin <= most) {
    runs.push_back({range.begin, range.end});
    return;
  }
  add_runs(range.lower(), most, runs);
  add_runs(range.upper(), most, runs);
}

}  // namespace godobject::scene_compiler
