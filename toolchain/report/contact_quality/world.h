#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "toolchain/session/owned_god_object.h"
#include "toolchain/report/analytic/solid.h"
#include "toolchain/report/contact_quality/body.h"
#include "toolchain/report/contact_quality/compiled_scene.h"
#include "toolchain/report/contact_quality/reference.h"

namespace godobject::report {

/// One cycle of a god object that keeps its state: from the pose of body frame B on the device. The first call starts
/// it at the device pose.
using Cycle = std::function<Status(const Pose& H_WD, CycleReport& report, StepTimes& times)>;

/// A still body, the body that moves in it, and the solvers that can run there.
class World {
 public:
  virtual ~World() = default;

  /// A solver at its start; empty where it cannot run.
  virtual Cycle start(Solver solver, bool friction) const = 0;

  /// The distance that solvers see: exact, or stored and interpolated.
  virtual double distance(const Vector3& p_W) const = 0;
  virtual void pieces(const Vector3& p_W, std::vector<analytic::Piece>& out) const = 0;

  /// Deepest sample point at a pose, in the distance that solvers see [m], positive inside.
  virtual double depth(const Pose& H_WS) const = 0;

  /// Deepest sample point in the mesh that was compiled [m]; the same as `depth` where there is no mesh. Only points
  /// within half a voxel of the stored surface are looked at.
  virtual double true_depth(const Pose& H_WS) const = 0;

  virtual const Pose& H_MB() const = 0;
  virtual const std::vector<Vector3>& points_B() const = 0;
};

std::unique_ptr<World> make_analytic_world(const analytic::Solid& solid, const Body& body,
                                           const WorldSettings& settings);

/// Through the scene compiler: scene file and meshes are written to `folder`, the image is compiled there and read.
std::unique_ptr<World> make_compiled_world(const std::string& name, const CompiledStill& still, const Body& body,
                                           const WorldSettings& settings, const std::filesystem::path& folder);

}  // namespace godobject::report
