#include "core/pipeline/contact/edges/edge_search.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "core/scene/pointshell.h"

namespace godobject {
namespace {

/// Returns the sphere about the surface of an edge, enlarged for rounding.
BoundingSphere sphere_of(const EdgeInW& edge) noexcept {
  constexpr double kRounding = 1.0 + 1e-12;
  return {0.5 * (edge.end[0] + edge.end[1]), kRounding * (0.5 * (edge.end[1] - edge.end[0]).norm() + edge.radius)};
}

}  // namespace

void EdgeSearch::leave_out(double apart) noexcept {
  visit_.complete = std::min(visit_.complete, apart);
  ++visit_.left_out;
}

void EdgeSearch::look_at(const Branches& branches, double distance) noexcept {
  if (!(distance < visit_.reach)) return;
  if (visit_.visits == kMostVisits || visit_.size == visit_.stack.size()) return leave_out(distance);
  visit_.stack[visit_.size++] = branches;
  ++visit_.visits;
}

void EdgeSearch::begin_visit(double travelled, double reach) noexcept {
  count_ = 0;
  visit_.travelled = travelled;
  visit_.reach = visit_.complete = reach;
  visit_.visits = visit_.left_out = 0;
  visit_.stack[0] = {0, 0};
  visit_.size = 1;
}

bool EdgeSearch::visit_trees(const Pose& H_WS, WorkMeter& work) noexcept {
  const Matrix3 R = H_WS.rotation.toRotationMatrix();
  const double reach = visit_.reach;
  const auto visit = [&](const Branches& b) noexcept {
    const BoundingSphere moving = sphere_of(edges_.moving.nodes[b.moving]);
    const BoundingSphere still = sphere_of(edges_.still.nodes[b.still]);
    look_at(b, (R * moving.center + H_WS.translation - still.center).norm() - moving.radius - still.radius);
    work.add(Work::kBranches);
  };
  while (visit_.size > 0) {
    if (work.is_spent()) return false;
    const Branches b = visit_.stack[--visit_.size];
    const format::Node& moving = edges_.moving.nodes[b.moving];
    const format::Node& still = edges_.still.nodes[b.still];
    if (moving.leaf != 0 && still.leaf != 0) {
      work.add(Work::kBranches, moving.point_count * still.point_count);
      for (std::uint32_t i = moving.first_point; i < moving.first_point + moving.point_count; ++i) {
        const EdgeInW edge = EdgeInW::at(edges_.moving.edges[i], R, H_WS.translation);
        const BoundingSphere around = sphere_of(edge);
        for (std::uint32_t j = still.first_point; j < still.first_point + still.point_count; ++j) {
          const EdgeInW other = EdgeInW::of_still(edges_.still.edges[j]);
          const BoundingSphere around_other = sphere_of(other);
          const double most = reach + around.radius + around_other.radius;
          if ((around.center - around_other.center).squaredNorm() >= most * most) continue;
          work.add(Work::kPair);
          const double gap = std::max(0.0, edge_distance(edge, other));
          if (!(gap < reach)) continue;
          if (count_ == kCapacity) {
            leave_out(gap);
          } else {
            candidates_[count_++] = {{i, j}, visit_.travelled + gap};
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
  complete_until_ = visit_.travelled + std::max(0.0, visit_.complete);
  return true;
}

bool EdgeSearch::remember(const Pose& H_WS, double travelled, double radius, double slack, WorkMeter& work) noexcept {
  constexpr std::array kShares = {1.0, 0.3, 0.0};  // fewer pairs if there is no place for all
  bool goes_on = visit_.goes_on && visit_.travelled == travelled && radius <= visit_.reach;
  // most visits end in the round of the last one
  std::size_t round = visit_.round;
  if (!goes_on && round > 0 && count_ < kCapacity / 4) --round;
  for (; round < kShares.size(); ++round) {
    if (!goes_on) begin_visit(travelled, radius + kShares[round] * slack);
    visit_.round = round;
    visit_.goes_on = !visit_trees(H_WS, work);
    if (visit_.goes_on) return false;
    goes_on = false;
    if (visit_.left_out == 0 || travelled + radius < complete_until_) break;
  }
  return true;
}

void EdgeSearch::settle_overlaps(const Pose& H_WS, bool has_all, WorkMeter& work, NearEdges& near) const noexcept {
  const Matrix3 R = H_WS.rotation.toRotationMatrix();
  const auto is_nearer = [](const EdgeInW& edge, const Vector3& end, double distance) noexcept {
    const Vector3 along = edge.end[1] - edge.end[0];
    const double place = nearest_place(edge.end[0], along, along.squaredNorm(), end);
    return (edge.end[0] + place * along - end).norm() < distance;
  };
  for (std::uint32_t k = 0; k < near.count && has_all; ++k) {
    EdgeGap& gap = near.gap[k];
    const bool of_moving = gap.inside == EdgeInside::kEndOfMoving;
    if (!of_moving && gap.inside != EdgeInside::kEndOfStill) continue;
    if (work.is_spent()) return;
    work.add(Work::kScan, near.count);
    const double length = (gap.on_moving - gap.on_still).norm();
    bool is_nearest = true;
    for (std::uint32_t n = 0; n < near.count && is_nearest; ++n) {
      const EdgePair& other = near.pair[n];
      const bool is_of_end = of_moving ? other.moving == near.pair[k].moving : other.still == near.pair[k].still;
      if (n == k || !is_of_end) continue;
      work.add(Work::kPair);
      is_nearest = of_moving ? !is_nearer(EdgeInW::of_still(edges_.still.edges[other.still]), gap.on_moving, length)
                             : !is_nearer(EdgeInW::at(edges_.moving.edges[other.moving], R, H_WS.translation),
                                          gap.on_still, length);
    }
    if (is_nearest) gap.turn_round();
  }
  near.leave_out([](const EdgeGap& gap) noexcept { return gap.inside == EdgeInside::kPoint && gap.distance > 0.0; });
}

EdgeSurroundings EdgeSearch::find(const Pose& H_WS, double travelled, double radius, double slack, double deepest,
                                  WorkMeter& work, NearEdges& near) noexcept {
  EdgeSurroundings around;
  if (edges_.empty() || is_free(travelled, radius)) return around;
  if (!(travelled + radius < complete_until_)) {
    certain_ = complete_until_ = -std::numeric_limits<double>::infinity();
    if (!remember(H_WS, travelled, radius, slack, work)) {
      around.free_displacement = 0.0;
      return around;
    }
    if (!(travelled + radius < complete_until_)) around.unlisted += visit_.left_out;
  }
  around.free_displacement = std::max(0.0, complete_until_ - travelled);
  certain_ = complete_until_;
  work.add(Work::kScan, count_);
  for (std::uint32_t i = 0; i < count_; ++i) {
    Candidate& candidate = candidates_[i];
    if (!(travelled + radius < candidate.free_until)) {
      if (work.is_spent()) {
        certain_ = -std::numeric_limits<double>::infinity();
        around.free_displacement = 0.0;
        return around;
      }
      work.add(Work::kPair);
      const EdgeGap gap = detail::gap_at(edges_, candidate.pair, H_WS, deepest);
      const double apart = std::max(0.0, gap.distance);  // sheets may overlap by less than their radii
      candidate.free_until = travelled + apart;
      around.may_overlap = around.may_overlap || gap.inside != EdgeInside::kNone || gap.distance < 0.0;
      if (apart < radius && !near.push(candidate.pair, gap)) {
        // a pair that overlaps would be held on its wrong side once it is taken for one that is apart
        const double left_out = gap.may_be_turned() ? near.push_overlap(candidate.pair, gap) : gap.distance;
        ++around.unlisted;
        around.free_displacement = std::min(around.free_displacement, std::max(0.0, left_out));
      }
    }
    certain_ = std::min(certain_, candidate.free_until);
  }
  if (deepest > 0.0) {
    settle_overlaps(H_WS, around.unlisted == 0, work, near);
    around.may_overlap = around.may_overlap || complete_until_ - travelled < deepest;
    if (around.may_overlap) certain_ = -std::numeric_limits<double>::infinity();  // the turned gaps are not free
  }
  return around;
}

}  // namespace godobject
