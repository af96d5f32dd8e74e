#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "toolchain/precision/setting.h"
#include "toolchain/session/owned_god_object.h"

namespace godobject::precision {

/// Motions, each from a free pose: of the moving mesh's frame in W, one pose for each cycle.
using Paths = std::vector<std::vector<Pose>>;

/// The result of one cycle of a god object.
struct TracedCycle {
  Pose H_WM;        ///< the god object, as a pose of the moving mesh's frame
  Wrench spring_W;  ///< on the device, about the moving body's centre of mass [N, Nm]
};

/// A god object of a compiled scene, with its memory and its own margin.
class Session {
 public:
  /// The image of `scene` must outlive it. Throws Failure (kBadData) if the image lacks the solver or friction.
  Session(const SceneView& scene, const Setting& setting);

  /// Makes the next update start again at the device pose.
  void reset() { (*god_object_)->reset(); }

  /// Runs one cycle. Throws Failure (kBadData) for an invalid pose.
  TracedCycle update(const Pose& H_WM);

 private:
  std::unique_ptr<OwnedGodObject> god_object_;
};

/// Returns all cycles of all paths, each path from a new start.
std::vector<TracedCycle> trace(Session& session, const Paths& paths);

/// The time of a cycle [ns]: for each cycle of the paths the median of several passes, then these quantiles over the
/// cycles by nearest rank.
struct CycleCost {
  double p50_ns = 0.0;
  double p99_ns = 0.0;
  double max_ns = 0.0;
  double instructions = 0.0;  ///< mean of a cycle; NaN if this machine does not let a process count its own
};

/// Times each session. Passes of the sessions take turns, so a disturbance affects all of them.
std::vector<CycleCost> time_cycles(std::span<Session> sessions, const Paths& paths, std::size_t passes);

}  // namespace godobject::precision
