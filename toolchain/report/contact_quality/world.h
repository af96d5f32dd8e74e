#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "toolchain/report/analytic/solid.h"
#include "toolchain/report/contact_quality/body.h"
#include "toolchain/report/contact_quality/compiled_scene.h"
#include "toolchain/report/contact_quality/reference.h"
#include "toolchain/session/owned_god_object.h"

namespace godobject::report {

/// A function that runs one cycle of a god object with its state, for the device pose of body frame B. The first call
/// starts the god object at the device pose.
using Cycle = std::function<Status(const Pose& H_WD, CycleReport& report, StepTimes& times)>;

/// A still body, a moving body, and the solvers that can run with them.
class World {
 public:
  virtual ~World() = default;

  /// Returns a solver at its start; empty if it cannot run here.
  virtual Cycle start(Solver solver, bool friction) const = 0;

  /// Returns the distance for solvers: exact, or stored and interpolated.
  virtual double distance(const Vector3& p_W) const = 0;
  virtual void pieces(const Vector3& p_W, std::vector<analytic::Piece>& out) const = 0;

  /// Returns the depth of the deepest sample point at a pose, by the distance for solvers [m], positive inside.
  virtual double depth(const Pose& H_WS) const = 0;

  /// Returns the depth of the deepest sample point in the compiled mesh [m]; without a mesh the same as `depth`. Only
  /// points within half a voxel of the stored surface count.
  virtual double true_depth(const Pose& H_WS) const = 0;

  virtual const Pose& H_MB() const = 0;
  virtual const std::vector<Vector3>& points_B() const = 0;
  /// Returns the sharp edges of the moving body, and of the still one in W; none if the solvers do not know any.
  virtual std::vector<watch::WatchedEdge> edges_B() const { return {}; }
  virtual std::vector<watch::WatchedEdge> edges_W() const { return {}; }
};

std::unique_ptr<World> make_analytic_world(const analytic::Solid& solid, const Body& body,
                                           const WorldSettings& settings);

/// Returns a world from the scene compiler. Writes scene file and meshes to `folder`, and compiles the image there.
std::unique_ptr<World> make_compiled_world(const std::string& name, const CompiledStill& still, const Body& body,
                                           const WorldSettings& settings, const std::filesystem::path& folder);

}  // namespace godobject::report
