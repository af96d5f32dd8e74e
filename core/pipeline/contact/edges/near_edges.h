#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/pipeline/contact/edges/edge_gap.h"
#include "core/scene/sharp_edges.h"
#include "godobject/pose.h"

namespace godobject {

/// Edge against edge: the sharp edges of both bodies. Empty where one of them has none.
struct EdgeContacts {
  SharpEdges moving;  ///< in S
  SharpEdges still;   ///< in W

  bool empty() const noexcept { return moving.empty() || still.empty(); }
};

/// A sharp edge of the moving body and one of the still body, by their numbers.
struct EdgePair {
  std::uint32_t moving;
  std::uint32_t still;

  bool operator==(const EdgePair&) const = default;
};

namespace detail {

/// The bit of a contact's id that marks a pair of edges. It is no sample point: format::kMaxPoints is less.
inline constexpr std::uint32_t kEdgePair = 1u << 30;
inline constexpr std::uint32_t kStillEdgeBits = 15;
static_assert(format::kMaxPoints <= kEdgePair && format::kMaxSharpEdges < 1u << kStillEdgeBits);

/// Returns the contact's id of a pair, the same from cycle to cycle.
constexpr std::uint32_t id_of(const EdgePair& pair) noexcept {
  return kEdgePair | pair.moving << kStillEdgeBits | pair.still;
}
/// Tells whether the id of a sample point, feature point or pair is that of a pair.
constexpr bool is_edge_pair(std::uint32_t id) noexcept { return id >> 30 == 1; }
/// Returns the pair of an id for which is_edge_pair holds.
constexpr EdgePair pair_of(std::uint32_t id) noexcept {
  return {(id & ~kEdgePair) >> kStillEdgeBits, id & ((1u << kStillEdgeBits) - 1)};
}

/// Returns the gap of a pair with the moving body at H_WS. `deepest` as in edge_gap [m].
inline EdgeGap gap_at(const EdgeContacts& edges, const EdgePair& pair, const Pose& H_WS,
                      double deepest = 0.0) noexcept {
  return edge_gap(EdgeInW::at(edges.moving.edges[pair.moving], H_WS), EdgeInW::of_still(edges.still.edges[pair.still]),
                  deepest);
}
}  // namespace detail

/// The near pairs of a sub-step: those whose gap is below the search radius at the start of the motion.
struct NearEdges {
  /// Most near pairs. Chosen: 26 KiB. Two threads have more; the pairs that find no room limit the motion.
  static constexpr std::uint32_t kCapacity = 256;

  std::uint32_t count = 0;
  std::array<EdgePair, kCapacity> pair;
  std::array<EdgeGap, kCapacity> gap;  ///< at the start of the motion

  /// Appends a pair. False: there is no room.
  bool push(const EdgePair& near, const EdgeGap& at_start) noexcept {
    if (count == kCapacity) return false;
    pair[count] = near;
    gap[count++] = at_start;
    return true;
  }

  /// Puts a pair that may overlap in the place of one that is apart, if there is one. Returns the gap of the pair that
  /// found no place [m].
  double push_overlap(const EdgePair& near, const EdgeGap& at_start) noexcept {
    for (std::uint32_t k = 0; k < count; ++k) {
      if (gap[k].may_be_turned()) continue;
      const double left_out = gap[k].distance;
      pair[k] = near;
      gap[k] = at_start;
      return left_out;
    }
    return at_start.distance;
  }

  /// Leaves pairs out for which `leaves_out(gap)` holds; the others keep their order.
  template <typename Predicate>
  void leave_out(Predicate leaves_out) noexcept {
    std::uint32_t kept = 0;
    for (std::uint32_t k = 0; k < count; ++k) {
      if (leaves_out(gap[k])) continue;
      pair[kept] = pair[k];
      gap[kept++] = gap[k];
    }
    count = kept;
  }

  /// Returns the number of a pair in the list; `count` if it is not near.
  std::uint32_t find(const EdgePair& wanted) const noexcept {
    std::uint32_t k = 0;
    while (k < count && !(pair[k] == wanted)) ++k;
    return k;
  }
};

}  // namespace godobject
