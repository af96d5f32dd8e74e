#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/pipeline/contact/edges/near_edges.h"
#include "core/pipeline/cycle/work.h"
#include "core/spatial/bounding_sphere.h"
#include "godobject/pose.h"

namespace godobject {

/// The result of EdgeSearch::find, beside the near pairs.
struct EdgeSurroundings {
  std::uint32_t unlisted = 0;  ///< near pairs, and pairs of branches, that found no place in a list
  /// Up to this displacement all pairs outside of the list of near pairs stay apart [m].
  double free_displacement = std::numeric_limits<double>::infinity();
  /// Two near edges may overlap: they do, or a nearest point of theirs lies inside the other's wedge, or that of a pair
  /// which is not known may.
  bool may_overlap = false;
};

/// Finds the near pairs of edges, by the sphere trees of both bodies. It remembers the pairs within a larger distance,
/// and looks at the trees again only when the body has travelled so far that another pair could be near (the neighbour
/// list of molecular dynamics: Verlet, Physical Review 159, 1967). The results do not depend on this memory, except
/// where pairs find no place in it.
class EdgeSearch {
 public:
  /// Most pairs that are remembered. Chosen: 32 KiB.
  static constexpr std::uint32_t kCapacity = 2048;
  /// Most pairs of branches that one visit of the trees looks at. Chosen: some 0.2 ms.
  static constexpr std::uint32_t kMostVisits = 1 << 14;

  /// Forgets all and starts. `edges` may be empty: then no pair is ever near.
  void start(const EdgeContacts& edges) noexcept {
    edges_ = edges;
    count_ = 0;
    visit_ = Visit{};
    complete_until_ = -std::numeric_limits<double>::infinity();
    certain_ = edges.empty() ? std::numeric_limits<double>::infinity() : complete_until_;
  }

  /// Tells whether the last `find` proves that no gap falls below `gap` [m] up to the odometer's reading `travelled`
  /// [m].
  bool is_free(double travelled, double gap) const noexcept { return travelled + gap < certain_; }

  /// Finds all pairs whose gap is below `radius` [m]. H_WS: pose of the moving body, where the odometer reads
  /// `travelled` [m]. `slack`: pairs up to this much farther away are remembered [m]. `deepest`: as in edge_gap, not
  /// above `radius` [m]. `near` must be empty. If the budget of `work` is spent before the end, pairs are missing, and
  /// a call at the same pose goes on with the visit of the trees. Cost: some 60 ns for each remembered pair that may be
  /// near, and seldom a visit of the trees. Real-time safe.
  ///
  /// With `deepest` the end of an edge overlaps, too: if it lies inside the wedge of the other edge, and no other near
  /// edge of that body is nearer to it. Other pairs of which a nearest point lies inside the wedge of the other edge
  /// are left out, without a limit of the motion: the bodies overlap there by the distance to a face. A row would hold
  /// them together.
  EdgeSurroundings find(const Pose& H_WS, double travelled, double radius, double slack, double deepest,
                        WorkMeter& work, NearEdges& near) noexcept;

 private:
  struct Candidate {
    EdgePair pair;
    double free_until;  ///< reading of the odometer up to which the edges stay apart [m]
  };

  /// Two branches of the trees whose edges may be near.
  struct Branches {
    std::uint32_t moving;
    std::uint32_t still;
  };
  /// A visit of the trees, which may take several cycles while the body stays.
  struct Visit {
    double travelled{};  ///< reading of the odometer [m]
    double reach{};      ///< pairs up to this gap are remembered [m]
    double complete{};   ///< all pairs outside of the list are at least this far apart [m]
    std::uint32_t visits{};
    std::uint32_t left_out{};  ///< pairs, and pairs of branches, that found no place
    std::size_t round = 0;
    bool goes_on = false;
    std::size_t size{};
    std::array<Branches, 256> stack;  ///< branches that are still to be looked at
  };

  /// Remembers all pairs within a distance. False: the budget of work was spent.
  bool remember(const Pose& H_WS, double travelled, double radius, double slack, WorkMeter& work) noexcept;
  void begin_visit(double travelled, double reach) noexcept;
  bool visit_trees(const Pose& H_WS, WorkMeter& work) noexcept;
  void look_at(const Branches& branches, double distance) noexcept;
  void leave_out(double apart) noexcept;
  /// Turns the gaps of ends that overlap round, if the list has all near pairs, and leaves out what overlaps at a face.
  void settle_overlaps(const Pose& H_WS, bool has_all, WorkMeter& work, NearEdges& near) const noexcept;

  EdgeContacts edges_;
  std::uint32_t count_{};
  std::array<Candidate, kCapacity> candidates_;
  Visit visit_;
  double complete_until_{};  ///< reading up to which all other pairs stay apart [m]
  double certain_{};         ///< reading up to which all pairs stay apart [m]
};

}  // namespace godobject
