#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/pipeline/contact/contact_scene.h"
#include "core/pipeline/contact/edges/edge_search.h"
#include "core/pipeline/contact/edges/near_edges.h"
#include "core/pipeline/contact/qp/contact_rows.h"
#include "core/pipeline/contact/qp/least_constraint.h"
#include "core/pipeline/contact/search/kept_search.h"
#include "core/pipeline/contact/search/near_points.h"
#include "core/pipeline/contact/search/near_search.h"
#include "core/pipeline/contact/substep_path.h"
#include "core/pipeline/contact/work_share.h"
#include "core/pipeline/cycle/work.h"

namespace godobject {

/// The workspace of one cycle of `contact`; its contents end with the cycle, except for the near points and rows of a
/// search that goes on. A cycle touches only as much as it has contacts.
struct ContactWorkspace {
  ContactRows rows;
  ConstrainedStep step;
  ConstrainedStep last_step;  ///< of the sub-step before
  NearPoints samples;
  NearPoints features;
  NearEdges edges;
  std::array<float, 2 * NearPoints::kCapacity> distances;  ///< of all near points, for the selection of rows [m]
};
static_assert(sizeof(ContactWorkspace) < 1664 * 1024);

/// Step #1 of `contact` in both directions and for edge against edge, with the memory of how far each node, point and
/// pair is from being near. The memory does not change what is free.
struct ContactSearch {
  Odometer odometer;
  NearSearch samples;
  NearSearch features;
  EdgeSearch edges;

  /// Returns the size of the memory for these shells [32-bit words].
  static std::size_t memory(const Pointshell& shell, const Pointshell& features) noexcept {
    return NearSearch::memory(shell) + NearSearch::memory(features);
  }

  /// Forgets all and starts. `words`: memory(...) words that outlive the search. With none, each cycle visits the trees
  /// from their roots.
  template <DistanceField Field, DistanceField BodyField>
  void start(const ContactScene<Field, BodyField>& scene, std::span<std::uint32_t> words) noexcept {
    odometer.reset();
    const std::size_t of_samples = words.empty() ? 0 : NearSearch::memory(*scene.shell);
    samples.start(words.first(of_samples), *scene.shell, scene.field->lipschitz(), scene.longest_search_radius);
    if (scene.has_features()) {
      features.start(words.subspan(of_samples), scene.features.points, scene.features.map->lipschitz(),
                     scene.feature_direction.most_stretch() * scene.longest_search_radius);
    } else {
      features.start_without_shell();
    }
    edges.start(scene.has_edges() ? scene.edges : EdgeContacts{});
  }

  /// Begins a search at another pose: no point has been visited.
  void start_over() noexcept {
    samples.start_over();
    features.start_over();
  }

  /// Tells whether the last search proves that no clearance falls below `clearance` [m] in a motion from here that
  /// displaces points by at most `displacement` [m]. `clearance` is at most the longest search radius.
  bool is_free(double displacement, double clearance) const noexcept {
    const double travelled = odometer.travelled() + displacement;
    return samples.is_free(travelled, clearance) && features.is_free(travelled, clearance) &&
           edges.is_free(travelled, clearance);
  }
};

/// The memory of `contact` beside ProxyState: the state that it carries from cycle to cycle, and its workspace.
struct ContactMemory {
  ContactSearch search;
  ConstrainedStep last_step;        ///< the last cycle's motion and contact forces
  Pose H_WD_last;                   ///< the last cycle's device pose
  bool first_search_ended = false;  ///< since the start: it is known whether the first pose penetrates
  bool edges_may_overlap = true;    ///< no pose since the start is known to have all edges apart
  SubstepPath path;                 ///< of the last cycle, for tools and tests
  WorkMeter work;                   ///< of the last cycle
  WorkShare share;                  ///< of radius and motion that the budget of work allows
  KeptSearch kept;                  ///< the last search
  std::uint64_t attempt_work = 0;   ///< of the last first attempt at a motion [units]
  ContactWorkspace workspace;

  /// Forgets the last cycle; the search's memory stays valid.
  void reset() noexcept {
    last_step = ConstrainedStep{};
    H_WD_last = Pose{};
    first_search_ended = false;
    edges_may_overlap = true;
    path.clear();
    share = WorkShare{};
    kept.goes_on = false;
    attempt_work = 0;
  }
};

}  // namespace godobject
