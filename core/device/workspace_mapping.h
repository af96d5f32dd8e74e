#pragma once

#include "godobject/pose.h"
#include "godobject/status.h"

namespace godobject {

/// How the room R in which the arm stands lies in the scene's frame W. An arm that is mapped has its ArmModel's W in
/// the room: there, what that calls H_WM is H_RM.
struct WorkspaceMappingParameters {
  Pose H_WR;               ///< at first: where the room's origin is in the scene, and the room's directions
  double scale = 1.0;      ///< motion in the scene to motion of the hand [1]
  double fade_time = 0.2;  ///< in which the force goes and comes at the clutch [s]
};

/// From the arm's tool to the moving body of the scene and back: registration, scale, clutch.
///
///   p_W = p_W0 + scale R_WR (p_R - p_R0),   R_WM = R_WR R_RM C
///
/// p_R0, p_W0 and the turn C are set anew whenever the clutch closes, so that the scene's pose goes on where it was.
/// C stands on the tool's side: a turn of the hand about an axis of the room stays a turn about the same axis of the
/// scene, as for translations.
/// M's origin is the point about which the clutch turns mesh and tool against each other, so it has to be where the
/// hand holds the mesh: about other points wrenches and velocities here and there no longer belong together.
///
/// Wrenches about M's origin come back by the transpose of the velocities' map, F_R = scale R_WR^T F_W,
/// t_R = R_WR^T t_W: the power at the hand is that in the scene, so what is passive in the scene is passive at the
/// hand. A stiffness k of the scene [N/m] is felt as scale^2 k, one in rotation [Nm/rad] as it is. (The force as it is,
/// felt as scale k, with torques as they are, would give power for a closed path: a wrench's force and torque would be
/// weighed differently.)
///
/// With the clutch open the scene's pose rests, and the wrench fades to zero in `fade_time`; when it closes it comes
/// back in as long. Neither pose nor force jumps, nor what damping has of it: velocities go on as the tool has them
/// while the wrench fades. A wrench that comes back while the body is pressed into something
/// gives the hand at most the energy of that press.
class WorkspaceMapping {
 public:
  /// `H_RM`: the tool at the start, which sets C and the points: the scene's pose is H_WR H_RM, its distance from the
  /// origin of W times the scale. The clutch is closed, the wrench at full.
  WorkspaceMapping(const WorkspaceMappingParameters& parameters, const Pose& H_RM) noexcept;

  /// One cycle of `period` [s]: the tool's pose and whether the clutch is closed.
  /// `kNotFinite`: the pose is not; nothing has changed. Cost: 100 ns. Real-time safe.
  Status update(const Pose& H_RM, bool closed, double period) noexcept;

  /// H_WM: the moving mesh in the scene.
  const Pose& scene_pose() const noexcept { return H_WM_; }

  /// Velocity of the tool's origin and angular velocity, in R -> the same of the moving mesh, in W, as if it were
  /// held; zero once the wrench has faded away with the clutch open.
  Motion velocity_in_scene(const Motion& velocity_R) const noexcept;

  /// Wrench on the moving body in W about M's origin -> wrench on the tool in R about its M's origin, faded.
  Wrench wrench_at_hand(const Wrench& F_W) const noexcept;

  /// Share of the wrench that is shown [0, 1].
  double engagement() const noexcept { return engagement_; }

 private:
  void index(const Pose& H_RM) noexcept;

  WorkspaceMappingParameters parameters_;
  Pose H_WM_;
  Vector3 tool_R_ = Vector3::Zero();          // p_R0
  Vector3 scene_W_ = Vector3::Zero();         // p_W0
  Quaternion turn_ = Quaternion::Identity();  // C
  bool closed_ = true;
  double engagement_ = 1.0;
};

}  // namespace godobject
