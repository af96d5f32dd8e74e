#pragma once

#include <cstdint>

#include "core/pipeline/contact/certificate.h"
#include "core/pipeline/contact/contact_lengths.h"
#include "core/pipeline/contact/edges/near_edges.h"
#include "godobject/pose.h"

namespace godobject::detail {

/// The first near pair of edges whose motion was not proved free.
struct EdgeObstacle {
  static constexpr std::uint32_t kNone = ~0u;
  std::uint32_t near = kNone;  ///< number of the near pair; kNone: no motion has failed yet
  double share = 1.0;          ///< share of the motion at which `gap` was measured [1]
  bool exhausted = false;      ///< the motion is free up to `share`, but the look-ups were used up
  EdgeGap gap;                 ///< at `share`
};

/// The certificate of edge against edge. Tells whether no edge of the moving body meets one of the still body while its
/// points move along their chords from pose H0 to H1, and no gap shrinks below `least_gap` [m], unless a face is
/// nearer. If not, `obstacle` receives the first pair that failed. Pairs that overlap at the start may move freely.
/// Other pairs stay apart (EdgeSurroundings::free_displacement), but for those that EdgeSearch::find leaves out.
///
/// A pair is free if its gap is larger than the displacement of the edge's ends. It is also free if a plane has the
/// still edge on one side and the moving edge on the other side in both poses: each point moves straight, so the plane
/// parts them in between, too. The function tries the planes between the nearest points at the start and at the end,
/// and those of the edges' faces. Otherwise free balls must cover the motion, as in chord_is_free. Cost: some 100 ns
/// for a near pair. Real-time safe.
bool edges_are_free(const EdgeContacts& edges, const Pose& H0, const Pose& H1, double least_gap,
                    const ContactLengths& lengths, const NearEdges& near, Budget& budget,
                    EdgeObstacle& obstacle) noexcept;

}  // namespace godobject::detail
