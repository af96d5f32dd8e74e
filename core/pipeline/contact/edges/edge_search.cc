#include "core/pipeline/contact/edges/edge_search.h"

#include <algorithm>

#include "core/scene/pointshell.h"

namespace godobject {
namespace {

/// Returns the sphere about the surface of an edge, enlarged for rounding.
BoundingSphere sphere_of(const EdgeInW& edge) noexcept {
  constexpr double kRounding = 1.0 + 1e-12;
  return {0.5 * (edge.end[0] + edge.end[1]), kRounding * (0.5 * (edge.end[1] - edge.end[0]).norm() + edge.radius)};
}

/// Two branches of the trees whose edges may be near.
struct Branches {
  std::uint32_t moving;
  std::uint32_t still;
};

/// Branches that are still to be looked at.
class Stack {
 public:
  bool push(const Branches& branches) noexcept {
    if (size_ == items_.size()) return false;
    items_[size_++] = branches;
    return true;
  }
  bool empty() const noexcept { return size_ == 0; }
  Branches pop() noexcept { return items_[--size_]; }

 private:
  std::array<Branches, 256> items_;
  std::size_t size_ = 0;
};

}  // namespace

std::uint32_t EdgeSearch::remember(const Pose& H_WS, double travelled, double reach) noexcept {
  count_ = 0;
  const Matrix3 R = H_WS.rotation.toRotationMatrix();
  double complete = reach;  // all pairs outside of the list are at least this far apart
  std::uint32_t left_out = 0;
  const auto leave_out = [&](double apart) noexcept {
    complete = std::min(complete, apart);
    ++left_out;
  };
  const auto apart = [&](const Branches& b) noexcept {
    const BoundingSphere moving = sphere_of(edges_.moving.nodes[b.moving]);
    const BoundingSphere still = sphere_of(edges_.still.nodes[b.still]);
    return (R * moving.center + H_WS.translation - still.center).norm() - moving.radius - still.radius;
  };
  Stack stack;
  stack.push({0, 0});
  std::uint32_t visits = 0;
  const auto visit = [&](const Branches& b) noexcept {
    const double distance = apart(b);
    if (!(distance < reach)) return;
    if (visits == kMostVisits || !stack.push(b)) return leave_out(distance);
    ++visits;
  };
  while (!stack.empty()) {
    const Branches b = stack.pop();
    const format::Node& moving = edges_.moving.nodes[b.moving];
    const format::Node& still = edges_.still.nodes[b.still];
    if (moving.leaf != 0 && still.leaf != 0) {
      for (std::uint32_t i = moving.first_point; i < moving.first_point + moving.point_count; ++i) {
        const EdgeInW edge = EdgeInW::at(edges_.moving.edges[i], R, H_WS.translation);
        const BoundingSphere around = sphere_of(edge);
        for (std::uint32_t j = still.first_point; j < still.first_point + still.point_count; ++j) {
          const EdgeInW other = EdgeInW::of_still(edges_.still.edges[j]);
          const BoundingSphere around_other = sphere_of(other);
          const double most = reach + around.radius + around_other.radius;
          if ((around.center - around_other.center).squaredNorm() >= most * most) continue;
          const double gap = std::max(0.0, edge_distance(edge, other));
          if (!(gap < reach)) continue;
          if (count_ == kCapacity) {
            leave_out(gap);
          } else {
            candidates_[count_++] = {{i, j}, travelled + gap};
          }
        }
      }
    } else if (still.leaf != 0 || (moving.leaf == 0 && moving.radius > still.radius)) {
      for (std::uint32_t child = b.moving + 1; child < moving.skip; child = edges_.moving.nodes[child].skip) {
        visit({child, b.still});
      }
    } else {
      for (std::uint32_t child = b.still + 1; child < still.skip; child = edges_.still.nodes[child].skip) {
        visit({b.moving, child});
      }
    }
  }
  complete_until_ = travelled + std::max(0.0, complete);
  return left_out;
}

EdgeSurroundings EdgeSearch::find(const Pose& H_WS, double travelled, double radius, double slack, double deepest,
                                  NearEdges& near) noexcept {
  EdgeSurroundings around;
  if (edges_.empty() || is_free(travelled, radius)) return around;
  if (!(travelled + radius < complete_until_)) {
    std::uint32_t left_out = 0;
    for (const double share : {1.0, 0.3, 0.0}) {  // fewer pairs if there is no place for all
      left_out = remember(H_WS, travelled, radius + share * slack);
      if (left_out == 0 || travelled + radius < complete_until_) break;
    }
    if (!(travelled + radius < complete_until_)) around.unlisted += left_out;
  }
  around.free_displacement = std::max(0.0, complete_until_ - travelled);
  certain_ = complete_until_;
  for (std::uint32_t i = 0; i < count_; ++i) {
    Candidate& candidate = candidates_[i];
    if (!(travelled + radius < candidate.free_until)) {
      const EdgeGap gap = detail::gap_at(edges_, candidate.pair, H_WS, deepest);
      const double apart = std::max(0.0, gap.distance);  // sheets may overlap by less than their radii
      candidate.free_until = travelled + apart;
      if (apart < radius && !near.push(candidate.pair, gap)) {
        // a pair that overlaps would be held on its wrong side once it is taken for one that is apart
        const double left_out = gap.distance < 0.0 ? near.push_overlap(candidate.pair, gap) : gap.distance;
        ++around.unlisted;
        around.free_displacement = std::min(around.free_displacement, std::max(0.0, left_out));
      }
    }
    certain_ = std::min(certain_, candidate.free_until);
  }
  return around;
}

}  // namespace godobject
