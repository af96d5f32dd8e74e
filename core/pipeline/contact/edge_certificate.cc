#include "core/pipeline/contact/edge_certificate.h"

#include <algorithm>

#include "core/pipeline/contact/contact_limits.h"

namespace godobject::detail {
namespace {

/// Returns the edge at a share of the chords of its ends.
EdgeInW between(const EdgeInW& start, const EdgeInW& end, double share) noexcept {
  EdgeInW edge = start;
  for (int k = 0; k < 2; ++k) edge.end[k] += share * (end.end[k] - start.end[k]);
  return edge;
}

/// Tells whether a plane with this unit normal has the still edge on one side, and the moving edge on the other side in
/// both poses, with more than `gap` between their surfaces. Rounding is far below any gap that is asked for.
bool are_parted(const EdgeInW& start, const EdgeInW& end, const EdgeInW& still, const Vector3& normal,
                double gap) noexcept {
  const auto height = [&](const Vector3& p) noexcept { return normal.dot(p - still.end[0]); };
  const double high = std::max(0.0, height(still.end[1]));
  const double low = std::min({height(start.end[0]), height(start.end[1]), height(end.end[0]), height(end.end[1])});
  return low - high > start.radius + still.radius + gap;
}

/// The same with one of the planes that contacts have: those of the nearest points, and those of the faces.
bool have_a_plane(const EdgeInW& start, const EdgeInW& end, const EdgeInW& still, const EdgeGap& at_start,
                  const EdgeGap& at_end, double gap) noexcept {
  return are_parted(start, end, still, at_start.normal, gap) || are_parted(start, end, still, at_end.normal, gap) ||
         are_parted(start, end, still, still.normal[0], gap) || are_parted(start, end, still, still.normal[1], gap) ||
         are_parted(start, end, still, -start.normal[0], gap) || are_parted(start, end, still, -start.normal[1], gap);
}

/// Tells whether free balls cover the motion of an edge, from the gap `g0` [m] at its start to `g1` at its end. A point
/// moves by at most `length` [m]. If not, `obstacle` receives the place; there the edges are at most `near` apart [m].
bool balls_cover(const EdgeInW& start, const EdgeInW& end, const EdgeInW& still, double g0, double g1, double length,
                 double near, Budget& budget, EdgeObstacle& obstacle) noexcept {
  constexpr double kShare = 0.99;  // of a ball: the last one ends before the edges meet, where a gap has no side
  double covered = kShare * g0;
  for (int ball = 0; ball < kMostBallsOfChord; ++ball) {
    if (covered + g1 > length + near) return true;
    obstacle.share = covered / length;
    if (!budget.take_ball()) break;
    obstacle.gap = edge_gap(between(start, end, obstacle.share), still);
    if (!(obstacle.gap.distance > near)) return false;
    covered += kShare * obstacle.gap.distance;
  }
  obstacle.exhausted = true;
  return false;
}

}  // namespace

bool edges_are_free(const EdgeContacts& edges, const Pose& H0, const Pose& H1, double least_gap,
                    const ContactLengths& lengths, const NearEdges& near, Budget& budget,
                    EdgeObstacle& obstacle) noexcept {
  obstacle.exhausted = false;
  budget.work.add(Work::kScan, 16 * near.count);
  for (std::uint32_t k = 0; k < near.count; ++k) {
    const EdgeGap& gap = near.gap[k];
    if (!(gap.distance > 0.0)) continue;
    const format::SharpEdge& edge = edges.moving.edges[near.pair[k].moving];
    const EdgeInW start = EdgeInW::at(edge, H0);
    const EdgeInW end = EdgeInW::at(edge, H1);
    const double length = std::max((end.end[0] - start.end[0]).norm(), (end.end[1] - start.end[1]).norm());
    if (gap.distance - length >= least_gap) continue;
    if (budget.work.is_spent()) {
      obstacle.exhausted = true;
      obstacle.share = 0.0;
      return false;
    }
    budget.work.add(Work::kPair);
    const EdgeInW still = EdgeInW::of_still(edges.still.edges[near.pair[k].still]);
    const EdgeGap at_end = edge_gap(end, still);
    const bool keeps_gap =
        !at_end.is_nearest || at_end.distance >= std::min(gap.distance, least_gap) - lengths.rounding;
    const double apart = 0.5 * lengths.least_margin;
    const bool is_free = have_a_plane(start, end, still, gap, at_end, apart) ||
                         balls_cover(start, end, still, gap.distance, std::max(0.0, at_end.distance), length,
                                     std::min(apart, 0.5 * gap.distance), budget, obstacle);
    if (is_free && keeps_gap) continue;
    if (is_free) {
      obstacle.share = 1.0;
      obstacle.gap = at_end;
    }
    obstacle.near = k;
    return false;
  }
  return true;
}

}  // namespace godobject::detail
