#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/device/arm_model.h"
#include "core/scene/scene_view.h"
#include "firmware/configuration/controller_file.h"
#include "toolchain/live/live_sample.h"

namespace godobject::live {

/// The rendering of a simulated run, as a page may change it.
struct LiveSettings {
  Solver solver = Solver::kContact;
  bool friction = false;
  double stiffness = 0.0;       ///< k_D [N/m]
  double damping = 0.0;         ///< b_D [Ns/m]
  double boundary = 0.0;        ///< largest stiffness that the gain check allows with this damping [N/m]
  bool beyond = false;          ///< the stiffness is above it
  std::vector<Solver> solvers;  ///< that the image holds
  bool has_friction = false;    ///< the image holds friction
};

/// Turns the cycles of a controller into messages for a page, each with the last cycle and the extremes of all cycles
/// since the message before.
class StateMessage {
 public:
  /// `scene` and `placement` outlive this object. `placement`: as LiveSource::placement.
  StateMessage(const SceneView& scene, const firmware::Placement* placement);

  void add(const LiveSample& sample);
  /// Begins the extremes of the next message again.
  void skip() { fresh_ = true; }

  /// The message as JSON without its closing brace, to which each viewer's own keys are added (README.md). Empty before
  /// the first sample. Finds the contact points; what is not finite becomes null.
  std::string text(const std::optional<LiveSettings>& settings, double speed, std::uint64_t lost);

 private:
  static constexpr std::size_t kPlots = 8;
  struct Range {
    double last = 0.0, low = 0.0, high = 0.0;
  };

  const SceneView& scene_;
  const firmware::Placement* placement_;
  std::optional<LiveSample> last_;
  std::array<Range, kPlots> plots_;
  std::uint64_t cycles_ = 0;
  bool fresh_ = true;  ///< no cycle since the last message
};

/// Returns the wrench on the hand about the moving body's centre of mass, along the axes of W [N, Nm].
Wrench wrench_in_scene(const LiveSample& sample, const firmware::Placement* placement);

/// Returns the places of the arm's joints and of the grip, the body's centre of mass `p_MB` in the mesh [m], in the
/// scene, from the base on [m].
std::vector<Vector3> arm_points(const LiveSample& sample, const firmware::Placement& placement, const Vector3& p_MB);

}  // namespace godobject::live
