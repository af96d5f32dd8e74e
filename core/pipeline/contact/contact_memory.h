#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/pipeline/contact/contact_scene.h"
#include "core/pipeline/contact/qp/contact_rows.h"
#include "core/pipeline/contact/qp/least_constraint.h"
#include "core/pipeline/contact/search/near_points.h"
#include "core/pipeline/contact/search/near_search.h"

namespace godobject {

/// Memory of one cycle of `contact`; nothing in it survives the cycle. A cycle touches only what its contacts need.
struct ContactWorkspace {
  ContactRows rows;
  ConstrainedStep step;
  NearPoints samples;
  NearPoints features;
  std::array<float, 2 * NearPoints::kCapacity> distances;  ///< to select rows by
};
static_assert(sizeof(ContactWorkspace) < 768 * 1024);

/// Step #1 of `contact` in both directions, with its memory of where no point can be near yet. Results do not depend on
/// that memory.
struct ContactSearch {
  Odometer odometer;
  NearSearch samples;
  NearSearch features;

  /// Words of memory for these shells.
  static std::size_t memory(const Pointshell& shell, const Pointshell& features) noexcept {
    return NearSearch::memory(shell) + NearSearch::memory(features);
  }

  /// Starts anew. `words`: memory(...) words that outlive the search, or none: then each cycle looks at all nodes.
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
  }

  /// The last search knows that in a motion from here that displaces points by `displacement` at most, no clearance falls
  /// below `clearance`, which is at most the longest search radius [m].
  bool is_free(double displacement, double clearance) const noexcept {
    const double travelled = odometer.travelled() + displacement;
    return samples.is_free(travelled, clearance) && features.is_free(travelled, clearance);
  }
};

/// All that `contact` needs beside ProxyState: what it carries from cycle to cycle, and its workspace.
struct ContactMemory {
  ContactSearch search;
  ConstrainedStep last_step;  ///< the last cycle's motion, and the forces that held it
  Pose H_WD_last;             ///< the last cycle's device pose
  ContactWorkspace workspace;

  /// Forgets the last cycle; the search keeps its memory.
  void reset() noexcept {
    last_step = ConstrainedStep{};
    H_WD_last = Pose{};
  }
};

}  // namespace godobject
