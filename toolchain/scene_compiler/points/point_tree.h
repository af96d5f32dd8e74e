#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "toolchain/scene_compiler/mesh/box.h"

namespace godobject::scene_compiler {

/// Balanced kd-tree over points: all points within a radius, or the nearest accepted one. Const calls may run on many
/// threads.
class PointTree {
 public:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  struct Nearest {
    std::uint32_t index = kNone;  ///< into the given points; kNone: none accepted
    double squared_distance = std::numeric_limits<double>::infinity();
  };

  explicit PointTree(std::span<const Eigen::Vector3d> points);

  /// Calls visit(index, squared distance) for every point at most `radius` from p.
  template <class Visit>
  void within(const Eigen::Vector3d& p, double radius, const Visit& visit) const {
    const double bound = radius * radius;
    descend(
        p, Range{0, 0, size()}, [&bound] { return bound; },
        [&](std::uint32_t index, double squared) {
          if (squared <= bound) visit(index, squared);
        });
  }

  /// A box around some of the points.
  struct Bounds : Box {
    double half_diagonal;  ///< [m]
  };

  /// Calls visit(index, squared distance) for every point at most `radius` from p, except points in boxes with
  /// skip(box).
  template <class Skip, class Visit>
  void within(const Eigen::Vector3d& p, double radius, const Skip& skip, const Visit& visit) const {
    if (size() > 0) descend_boxes(p, Range{0, 0, size()}, radius * radius, skip, visit);
  }

  /// True if a point is at most `radius` from p.
  bool any_within(const Eigen::Vector3d& p, double radius) const {
    return size() > 0 && any_in_boxes(p, Range{0, 0, size()}, radius * radius);
  }

  /// Some points that lie near each other: entries of the tree.
  struct Run {
    std::uint32_t begin, end;
  };

  /// Divides the points into runs of at most `most`, at least kLeafSize.
  std::vector<Run> runs(std::uint32_t most) const;

  const Eigen::Vector3d& point(std::uint32_t entry) const { return entries_[entry].point; }
  std::uint32_t index(std::uint32_t entry) const { return entries_[entry].index; }

  /// Calls visit(run) for the leaves of the tree, except those in boxes with skip(box).
  template <class Skip, class Visit>
  void leaves(const Skip& skip, const Visit& visit) const {
    if (size() > 0) descend_to_leaves(Range{0, 0, size()}, skip, visit);
  }

  /// Returns the nearest of the points with accept(index) that are nearer than `radius`; of equally near ones the
  /// first.
  template <class Accept>
  Nearest nearest(const Eigen::Vector3d& p, double radius, const Accept& accept) const {
    Nearest best;
    best.squared_distance = radius * radius;
    descend(
        p, Range{0, 0, size()}, [&best] { return best.squared_distance; },
        [&](std::uint32_t index, double squared) {
          const bool nearer =
              squared < best.squared_distance || (squared == best.squared_distance && index < best.index);
          if (nearer && accept(index)) best = {index, squared};
        });
    return best;
  }

  template <class Accept>
  Nearest nearest(const Eigen::Vector3d& p, const Accept& accept) const {
    return nearest(p, std::numeric_limits<double>::infinity(), accept);
  }

  Nearest nearest(const Eigen::Vector3d& p) const {
    return nearest(p, [](std::uint32_t) { return true; });
  }

 private:
  static constexpr std::uint32_t kLeafSize = 8;

  struct Entry {
    Eigen::Vector3d point;
    std::uint32_t index;
  };
  /// The place where a range of more than kLeafSize entries is cut in halves. The children of node k are 2k + 1 and 2k
  /// + 2.
  struct Cut {
    double value = 0.0;
    int axis = 0;
  };
  struct Range {
    std::uint32_t node, begin, end;
    Range lower() const { return {2 * node + 1, begin, middle()}; }
    Range upper() const { return {2 * node + 2, middle(), end}; }
    std::uint32_t middle() const { return begin + (end - begin) / 2; }
    bool leaf() const { return end - begin <= kLeafSize; }
  };

  std::uint32_t size() const { return static_cast<std::uint32_t>(entries_.size()); }
  void build(const Range& range, std::vector<Range>* later);

  template <class Bound, class Visit>
  void descend(const Eigen::Vector3d& p, const Range& range, const Bound& bound, const Visit& visit) const {
    if (range.leaf()) {
      for (std::uint32_t i = range.begin; i < range.end; ++i) {
        visit(entries_[i].index, (entries_[i].point - p).squaredNorm());
      }
      return;
    }
    const Cut& cut = cuts_[range.node];
    const double beyond = p[cut.axis] - cut.value;
    descend(p, beyond < 0.0 ? range.lower() : range.upper(), bound, visit);
    if (beyond * beyond <= bound()) descend(p, beyond < 0.0 ? range.upper() : range.lower(), bound, visit);
  }

  template <class Skip, class Visit>
  void descend_boxes(const Eigen::Vector3d& p, const Range& range, double bound, const Skip& skip,
                     const Visit& visit) const {
    const Bounds& box = boxes_[range.node];
    if (box.squared_distance(p) > bound || skip(box)) return;
    if (range.leaf()) {
      for (std::uint32_t i = range.begin; i < range.end; ++i) {
        const double squared = (entries_[i].point - p).squaredNorm();
        if (squared <= bound) visit(entries_[i].index, squared);
      }
      return;
    }
    const Cut& cut = cuts_[range.node];
    const bool below = p[cut.axis] < cut.value;
    descend_boxes(p, below ? range.lower() : range.upper(), bound, skip, visit);
    descend_boxes(p, below ? range.upper() : range.lower(), bound, skip, visit);
  }

  bool any_in_boxes(const Eigen::Vector3d& p, const Range& range, double bound) const;
  void add_runs(const Range& range, std::uint32_t most, std::vector<Run>& runs) const;

  template <class Skip, class Visit>
  void descend_to_leaves(const Range& range, const Skip& skip, const Visit& visit) const {
    const Bounds& box = boxes_[range.node];
    if (skip(box)) return;
    if (range.leaf()) {
      visit(Run{range.begin, range.end});
      return;
    }
    descend_to_leaves(range.lower(), skip, visit);
    descend_to_leaves(range.upper(), skip, visit);
  }

  std::vector<Entry> entries_;
  std::vector<Cut> cuts_;
  std::vector<Bounds> boxes_;  ///< of the points in each range
};

}  // namespace godobject::scene_compiler
