#pragma once

#include <string>
#include <vector>

#include "core/device/joint_torque.h"
#include "core/device/stability.h"
#include "core/device/workspace_mapping.h"
#include "core/scene/scene.h"

namespace godobject::firmware {

/// What the hand feels of the virtual coupling: its springs and dampers at the tool.
struct FeltCoupling {
  double stiffness = 0.0;           ///< [N/m]
  double rotation_stiffness = 0.0;  ///< [Nm/rad]
  double damping = 0.0;             ///< [Ns/m]
  double rotation_damping = 0.0;    ///< [Nms/rad]

  /// Translations are felt with the square of the workspace's scale, rotations as they are.
  static FeltCoupling of(const Scene& scene, double scale) noexcept;
};

struct GainReport {
  double margin = 0.0;             ///< smallest factor from the stiffness to the stability boundary [1]
  JointVector posture;             ///< where it is that small [rad]
  int joint_count = 0;             ///< of the posture
  double passivity_excess = 0.0;   ///< smallest eigenvalue, over the postures [Nms/rad]
  double gyration = 0.0;           ///< radius of gyration of the moving body [m]
  double coupling_gyration = 0.0;  ///< rho = sqrt(k_VC,r / k_VC,x) [m]
};

/// Exact stability and passivity by the linear rule (A4, A13 of toolchain/report) of the coupling, a spring between
/// centres of mass, over postures about `posture`: kPostures of a low-discrepancy sequence within kSpread of it and the
/// limits, and itself. The margin is exact at the worst of them. Cost: at start-up, about 0.3 s.
GainReport check_gains(const Scene& scene, const ArmModel& arm, const JointVector& posture, double scale,
                       const LoopTiming& timing);

inline constexpr int kPostures = 60;
inline constexpr double kProbe =
    1.5;  ///< stiffness at which the worst posture is looked for, times that of the coupling
inline constexpr double kSpread = 0.5;  ///< [rad]

/// The joints' own feedback runs in the same loop: damping of null-space motion and the springs before position limits.
/// Each joint alone, all others free, at its smallest apparent inertia 1 / (M^-1)_ii over the same postures: throws
/// command::Failure (kBadConfig) naming joint, key and boundary where damping or stiffness is beyond the exact one (A4,
/// A5). Cost: at start-up, about 0.1 s.
void require_stable_joints(const ArmModel& arm, const JointTorqueParameters& control, const JointVector& posture,
                           const LoopTiming& timing);

/// What the passivity controller may add: a damper along the wrench at the hand.
struct InjectedDamping {
  double most = 0.0;             ///< [Ns/m]
  double rotation_length = 0.1;  ///< metres that a radian counts [m]
};

/// The damping that the passivity controller injects varies between none and `injected.most`; with the latter on all
/// six axes all the time, beside b_D, the stiffness must stay below the stability boundary by the factor `least`, too.
/// Throws command::Failure (kBadConfig) with the most that does where it does not. Cost: at start-up, about 0.3 s.
void require_stable_injection(const Scene& scene, const ArmModel& arm, const JointVector& posture, double scale,
                              const LoopTiming& timing, const InjectedDamping& injected, double least);

/// Throws command::Failure (kBadConfig) with the boundary if the margin is below `least`. Returns what is only to be
/// warned of, one line each.
std::vector<std::string> judge_gains(const GainReport& report, const FeltCoupling& felt, double least);

}  // namespace godobject::firmware
