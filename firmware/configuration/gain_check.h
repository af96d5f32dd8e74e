#pragma once

#include <string>
#include <vector>

#include "core/device/joint_torque.h"
#include "core/device/stability.h"
#include "core/device/workspace_mapping.h"
#include "core/scene/scene_view.h"

namespace godobject::firmware {

/// The virtual coupling as the hand feels it: springs and dampers at the tool.
struct FeltCoupling {
  double stiffness = 0.0;           ///< [N/m]
  double rotation_stiffness = 0.0;  ///< [Nm/rad]
  double damping = 0.0;             ///< [Ns/m]
  double rotation_damping = 0.0;    ///< [Nms/rad]

  /// Translations are felt with the square of the workspace's scale, rotations unchanged.
  static FeltCoupling of(const SceneView& scene, double scale) noexcept;
};

struct GainReport {
  double margin = 0.0;             ///< smallest factor from the stiffness to the stability boundary [1]
  JointVector posture;             ///< posture with that margin [rad]
  int joint_count = 0;             ///< of the posture
  double passivity_excess = 0.0;   ///< smallest eigenvalue, over the postures [Nms/rad]
  double gyration = 0.0;           ///< radius of gyration of the moving body [m]
  double coupling_gyration = 0.0;  ///< rho = sqrt(k_VC,r / k_VC,x) [m]
};

/// Checks the virtual coupling, a spring between centres of mass, for exact stability and for passivity by the linear
/// rule (A4, A13 of toolchain/report). It looks at `posture` and at kPostures of a low-discrepancy sequence about it,
/// within kSpread and the limits. The margin is exact at the worst of them. Cost: about 0.3 s at the start.
GainReport check_gains(const SceneView& scene, const ArmModel& arm, const JointVector& posture, double scale,
                       const LoopTiming& timing);

inline constexpr int kPostures = 60;
inline constexpr double kProbe =
    1.5;  ///< stiffness at which the worst posture is looked for, times that of the coupling
inline constexpr double kSpread = 0.5;  ///< [rad]

/// Checks the feedback at the joints, which runs in the same loop: null-space damping and the springs before position
/// limits. Each joint is checked alone, all others free, at its smallest apparent inertia 1 / (M^-1)_ii over the same
/// postures. Throws command::Failure (kBadConfig) naming joint, key and boundary if damping or stiffness is beyond the
/// exact stability boundary (A4, A5). Cost: about 0.1 s at the start.
void require_stable_joints(const ArmModel& arm, const JointTorqueParameters& control, const JointVector& posture,
                           const LoopTiming& timing);

/// The damper along the wrench at the hand that the passivity controller may add.
struct InjectedDamping {
  double most = 0.0;             ///< [Ns/m]
  double rotation_length = 0.1;  ///< length that a radian counts [m]
};

/// Checks the stiffness with the damping that the passivity controller may inject: with `injected.most` on all six axes
/// all the time, in addition to b_D, it must stay below the stability boundary by the factor `least`, too. Throws
/// command::Failure (kBadConfig) with the largest possible damping if it does not. Cost: about 0.3 s at the start.
void require_stable_injection(const SceneView& scene, const ArmModel& arm, const JointVector& posture, double scale,
                              const LoopTiming& timing, const InjectedDamping& injected, double least);

/// Throws command::Failure (kBadConfig) with the boundary if the margin is below `least`. Returns warnings, one line
/// each.
std::vector<std::string> judge_gains(const GainReport& report, const FeltCoupling& felt, double least);

}  // namespace godobject::firmware
