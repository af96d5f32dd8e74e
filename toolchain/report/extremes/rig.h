#pragma once

#include <filesystem>
#include <memory>
#include <span>

#include "toolchain/report/extremes/setup.h"
#include "toolchain/watch/watch.h"

namespace godobject::report {

/// A solver at its start in a world: analytic, or compiled in `work`.
class Rig {
 public:
  virtual ~Rig() = default;

  /// Runs a cycle with the body frame at the device pose H_WD.
  virtual Status update(const Pose& H_WD, const Motion& velocity_W, CycleReport& report) = 0;
  /// Returns the sub-steps of the last cycle of `contact`.
  virtual std::span<const Pose> path() const = 0;
  /// Returns what the watch needs to know; the rig owns what it refers to.
  virtual watch::WatchedSession watched() const = 0;
};

class CompiledWorld;

/// Returns a solver at its start in the world of the setup.
std::unique_ptr<Rig> make_rig(const Setup& setup, const std::filesystem::path& work);

/// Returns one in a world that is compiled already.
std::unique_ptr<Rig> make_rig_in(std::shared_ptr<const CompiledWorld> world, const Setup& setup);

/// Returns half the edges of a moving body that is a box, or a degenerate box [m].
Vector3 half_edges(const Setup& setup);

/// Returns half the edges of the box about the origin that holds the moving body of a compiled world [m].
Vector3 half_size_of_body(const Setup& setup);

/// Tells if the scene compiler makes the world. Such worlds take seconds, and refuse bad input themselves.
bool is_compiled(const Setup& setup);

/// Returns the pose of the world's frame O in W.
Pose placement(const Setup& setup);

/// Returns a place inside of the still body, in O, or at its middle.
Vector3 inner_place(const Setup& setup);

}  // namespace godobject::report
