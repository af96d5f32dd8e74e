#pragma once

#include "godobject/pose.h"
#include "godobject/status.h"

namespace godobject {

/// The relation of the room R, in which the arm stands, to the scene's frame W.
struct WorkspaceMappingParameters {
  Pose H_WR;               ///< at the start: the room's origin and axes in the scene
  double scale = 1.0;      ///< motion in the scene per motion of the hand [1]
  double fade_time = 0.2;  ///< in which the force fades out and in at the clutch [s]
};

/// Maps the grip G, by which the hand holds the mesh, from the room to the scene and wrenches back: registration,
/// scale, clutch.
///
///   p_WG = p_WG0 + scale R_WR (p_RG - p_RG0),   R_WG = R_WR R_RG C
///
/// p_RG0, p_WG0 and the rotation C are set again whenever the clutch closes, so that the pose in the scene continues
/// where it was. C multiplies on the grip's side: a rotation of the hand about an axis of the room is a rotation about
/// the same axis in the scene, as for translations.
///
/// The clutch rotates mesh and tool against each other about G's origin, so that has to be the point at which the hand
/// holds the mesh. About other points wrenches and velocities in room and scene no longer belong together.
///
/// Wrenches about G's origin return by the transpose of the map of velocities: force_R = scale R_WR^T force_W,
/// torque_R = R_WR^T torque_W. The power at the hand is then the power in the scene, and a scene that is passive is
/// passive at the hand. A stiffness k of the scene [N/m] is felt as scale^2 k, a rotational one [Nm/rad] unchanged. (An
/// unscaled force with unscaled torques would be felt as scale k, but a closed path would yield energy: forces and
/// torques of one wrench would have different weights.)
///
/// While the clutch is open the pose in the scene rests, and the wrench fades to zero in `fade_time`. After it has
/// closed the wrench returns in the same time. Neither pose nor force jumps, nor the damping: velocities stay those of
/// the tool while the wrench fades. A wrench that returns while the body is pressed into something gives the hand at
/// most the energy of that press.
class WorkspaceMapping {
 public:
  /// `H_RG`: the grip at the start, which sets C and the two points. The pose in the scene is then H_WR H_RG with its
  /// translation from H_WR scaled. The clutch is closed, the wrench in full.
  WorkspaceMapping(const WorkspaceMappingParameters& parameters, const Pose& H_RG) noexcept;

  /// One cycle of `period` [s]: the grip's pose in the room, and whether the clutch is closed.
  /// `kNotFinite`: the pose is not finite; nothing changes. Cost: 100 ns. Real-time safe.
  Status update(const Pose& H_RG, bool closed, double period) noexcept;

  /// H_WG: the grip in the scene.
  const Pose& scene_pose() const noexcept { return H_WG_; }

  /// The velocity of G's origin and the angular velocity, from the axes of R to those of W, as if the clutch were
  /// closed. Zero once the wrench has faded out with the clutch open.
  Motion velocity_in_scene(const Motion& velocity_R) const noexcept;

  /// The wrench on the hand, faded, for a wrench on the moving body in the scene; both about G's origin.
  Wrench wrench_at_hand(const Wrench& F_G_W) const noexcept;

  /// Share of the wrench that is rendered [0, 1].
  double engagement() const noexcept { return engagement_; }

 private:
  void index(const Pose& H_RG) noexcept;

  WorkspaceMappingParameters parameters_;
  Pose H_WG_;
  Vector3 p_RG0_ = Vector3::Zero();
  Vector3 p_WG0_ = Vector3::Zero();
  Quaternion turn_ = Quaternion::Identity();  // C
  bool closed_ = true;
  double engagement_ = 1.0;
};

}  // namespace godobject
