#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "toolchain/session/owned_god_object.h"
#include "toolchain/precision/setting.h"

namespace godobject::precision {

/// Motions, each from a free pose: of the moving mesh's frame in W, one pose a millisecond.
using Paths = std::vector<std::vector<Pose>>;

/// What one cycle of a god object has shown.
struct TracedCycle {
  Pose H_WM;        ///< the god object, as a pose of the moving mesh's frame
  Wrench spring_W;  ///< on the device, about the moving body's centre of mass [N, Nm]
};

/// A god object of a compiled scene, with the memory that it asks for and a margin of its own.
class Session {
 public:
  /// The image of `scene` must outlive it. Throws Failure (kBadData) if the image lacks the solver or friction.
  Session(const Scene& scene, const Setting& setting);

  /// The next update starts anew at the device pose.
  void reset() { (*god_object_)->reset(); }

  /// One cycle. Throws Failure (kBadData) for what is no pose.
  TracedCycle update(const Pose& H_WM);

 private:
  std::unique_ptr<OwnedGodObject> god_object_;
};

/// All cycles of all paths, each path from a new start.
std::vector<TracedCycle> trace(Session& session, const Paths& paths);

/// What a cycle takes [ns]: of each cycle of the paths the median of several passes, then these quantiles over the
/// cycles by nearest rank.
struct CycleCost {
  double p50_ns = 0.0;
  double p99_ns = 0.0;
  double max_ns = 0.0;
  double instructions = 0.0;  ///< mean of a cycle; NaN where this machine does not let a process count its own
};

/// One for each session. Passes of the sessions take turns, so that a disturbance meets all of them.
std::vector<CycleCost> time_cycles(std::span<Session> sessions, const Paths& paths, std::size_t passes);

}  // namespace godobject::precision
