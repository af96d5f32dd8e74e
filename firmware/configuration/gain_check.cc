#include "firmware/configuration/gain_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <Eigen/LU>

#include "core/device/dynamics.h"
#include "core/device/kinematics.h"
#include "core/pipeline/cycle/parameters.h"
#include "toolchain/command_line/failure.h"

namespace godobject::firmware {
namespace {

/// Element `index` of Halton's sequence in base `base`, in (0, 1).
double halton(int index, int base) noexcept {
  double share = 1.0;
  double value = 0.0;
  for (int i = index; i > 0; i /= base) {
    share /= base;
    value += share * (i % base);
  }
  return value;
}

JointVector posture_near(const ArmModel& arm, const JointVector& posture, int index) noexcept {
  constexpr std::array<int, kMaxJoints> kBases = {2, 3, 5, 7, 11, 13, 17};
  JointVector q = posture;
  for (int i = 0; i < arm.joint_count && index > 0; ++i) {
    const ArmJoint& joint = arm.joints[static_cast<std::size_t>(i)];
    const double low = std::max(joint.lower, posture[i] - kSpread);
    const double high = std::min(joint.upper, posture[i] + kSpread);
    q[i] = low + (high - low) * halton(index, kBases[static_cast<std::size_t>(i)]);
  }
  return q;
}

ArmLoop loop_at(const ArmModel& arm, const JointVector& q, const Vector3& p_MB, const FeltCoupling& felt,
                const LoopTiming& timing) {
  const ArmKinematics kinematics = forward_kinematics(arm, q);
  ArmLoop loop;
  loop.joint_count = arm.joint_count;
  loop.mass = mass_matrix(arm, kinematics);
  for (int i = 0; i < arm.joint_count; ++i) loop.damping[i] = arm.joints[static_cast<std::size_t>(i)].damping;
  loop.jacobian = geometric_jacobian(kinematics, kinematics.H_RM * p_MB);
  loop.stiffness = felt.stiffness;
  loop.rotation_stiffness = felt.rotation_stiffness;
  loop.tool_damping = felt.damping;
  loop.rotation_tool_damping = felt.rotation_damping;
  loop.timing = timing;
  return loop;
}

/// The posture with the largest spectral radius at kProbe times the stiffness. The exact boundary of each posture would
/// take twenty times as long.
JointVector worst_posture(const ArmModel& arm, const JointVector& posture, const Vector3& p_MB,
                          const FeltCoupling& felt, const LoopTiming& timing) {
  double largest = -1.0;
  JointVector worst = posture;
  for (int i = 0; i <= kPostures; ++i) {
    const JointVector q = posture_near(arm, posture, i);
    ArmLoop stiffer = loop_at(arm, q, p_MB, felt, timing);
    stiffer.stiffness *= kProbe;
    stiffer.rotation_stiffness *= kProbe;
    const double radius = spectral_radius(stiffer);
    if (radius > largest) {
      largest = radius;
      worst = q;
    }
  }
  return worst;
}

FeltCoupling with(FeltCoupling felt, double damping, double rotation_length) noexcept {
  felt.damping += damping;
  felt.rotation_damping += damping * rotation_length * rotation_length;
  return felt;
}

}  // namespace

FeltCoupling FeltCoupling::of(const SceneView& scene, double scale) noexcept {
  const Parameters parameters = Parameters::make(scene);
  const double translation = scale * scale * parameters.coupling_translation;
  return {parameters.stiffness * translation, parameters.stiffness * parameters.coupling_rotation,
          parameters.damping * translation, parameters.damping * parameters.coupling_rotation};
}

GainReport check_gains(const SceneView& scene, const ArmModel& arm, const JointVector& posture, double scale,
                       const LoopTiming& timing) {
  const Parameters parameters = Parameters::make(scene);
  const FeltCoupling felt = FeltCoupling::of(scene, scale);
  const Vector3 p_MB = scene.H_MB.translation / scale;  // in the room's scale
  GainReport report;
  report.joint_count = arm.joint_count;
  report.passivity_excess = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kPostures; ++i) {
    const ArmLoop loop = loop_at(arm, posture_near(arm, posture, i), p_MB, felt, timing);
    report.passivity_excess = std::min(report.passivity_excess, passivity_excess(loop));
  }
  report.posture = worst_posture(arm, posture, p_MB, felt, timing);
  report.margin = stiffness_margin(loop_at(arm, report.posture, p_MB, felt, timing));
  report.gyration = std::sqrt(parameters.mass.inertia.sum() / 3.0);
  report.coupling_gyration = std::sqrt(parameters.coupling_rotation / parameters.coupling_translation);
  return report;
}

void require_stable_joints(const ArmModel& arm, const JointTorqueParameters& control, const JointVector& posture,
                           const LoopTiming& timing) {
  JointVector inertia = JointVector::Constant(std::numeric_limits<double>::infinity());
  for (int i = 0; i <= kPostures; ++i) {
    const ArmKinematics kinematics = forward_kinematics(arm, posture_near(arm, posture, i));
    const Eigen::MatrixXd mass = mass_matrix(arm, kinematics).topLeftCorner(arm.joint_count, arm.joint_count);
    const Eigen::MatrixXd inverse = mass.inverse();
    for (int k = 0; k < arm.joint_count; ++k) inertia[k] = std::min(inertia[k], 1.0 / inverse(k, k));
  }
  for (int k = 0; k < arm.joint_count; ++k) {
    AxisLoop axis{.mass = inertia[k],
                  .damping = arm.joints[static_cast<std::size_t>(k)].damping,
                  .virtual_damping = control.null_damping[k] + control.limit_damping[k],
                  .timing = timing};
    const auto refuse = [&](const char* key, double value, double boundary, const char* unit) {
      throw command::Failure(
          command::ExitCode::kBadConfig,
          fmt::format("device: joint {} has {} of {:.4g} {}; with {:.3g} kg m^2 and this delay it is "
                      "stable only below {:.4g}: lower it",
                      k + 1, key, value, unit, inertia[k], boundary));
    };
    if (const double most = damping_boundary(axis); axis.virtual_damping > 0.0 && !(axis.virtual_damping < most)) {
      refuse("null_damping and limit_damping", axis.virtual_damping, most, "Nms/rad");
    }
    const double stiffness = control.limit_stiffness[k];
    if (const double most = stability_boundary(axis); stiffness > 0.0 && !(stiffness < most)) {
      refuse("limit_stiffness", stiffness, most, "Nm/rad");
    }
  }
}

void require_stable_injection(const SceneView& scene, const ArmModel& arm, const JointVector& posture, double scale,
                              const LoopTiming& timing, const InjectedDamping& injected, double least) {
  if (!(injected.most > 0.0)) return;
  const FeltCoupling felt = FeltCoupling::of(scene, scale);
  const Vector3 p_MB = scene.H_MB.translation / scale;
  const JointVector worst =
      worst_posture(arm, posture, p_MB, with(felt, injected.most, injected.rotation_length), timing);
  const auto is_stable = [&](double damping) {
    return stiffness_margin(loop_at(arm, worst, p_MB, with(felt, damping, injected.rotation_length), timing)) >= least;
  };
  if (is_stable(injected.most)) return;
  double low = 0.0;
  double high = injected.most;
  for (int i = 0; i < 12; ++i) {
    const double middle = 0.5 * (low + high);
    (is_stable(middle) ? low : high) = middle;
  }
  throw command::Failure(
      command::ExitCode::kBadConfig,
      fmt::format("passivity.damping = {:g} Ns/m and {:.4g} Ns/m of gains.damping leave less than gains.margin = {:g} "
                  "to the stability boundary: set it to at most {:.3g} Ns/m, or lower gains.stiffness",
                  injected.most, felt.damping, least, low));
}

std::vector<std::string> judge_gains(const GainReport& report, const FeltCoupling& felt, double least) {
  const std::string where =
      fmt::format("at joint positions {:.2f} [rad]",
                  fmt::join(report.posture.data(), report.posture.data() + report.joint_count, " "));
  if (!(report.margin > 0.0)) {
    throw command::Failure(
        command::ExitCode::kBadConfig,
        fmt::format("gains: with {:.4g} Ns/m and {:.4g} Nms/rad of virtual damping no stiffness is stable {}: lower "
                    "gains.damping or gains.rotational",
                    felt.damping, felt.rotation_damping, where));
  }
  if (!(report.margin >= least)) {
    constexpr double kAdvised = 0.98;  // reserve, chosen: with another stiffness another posture is the worst
    throw command::Failure(
        command::ExitCode::kBadConfig,
        fmt::format(
            "gains: the hand would feel {:.4g} N/m and {:.4g} Nm/rad; the stability boundary is {:.4g} N/m and "
            "{:.4g} Nm/rad {}, a factor of {:.3g}, and gains.margin is {:g}: lower gains.stiffness to {:.2f} of its "
            "value, or lower gains.rotational or workspace.scale",
            felt.stiffness, felt.rotation_stiffness, report.margin * felt.stiffness,
            report.margin * felt.rotation_stiffness, where, report.margin, least,
            std::floor(100.0 * kAdvised * report.margin / least) / 100.0));
  }
  std::vector<std::string> warnings;
  if (!(report.passivity_excess > 0.0)) {
    warnings.push_back(fmt::format(
        "stable by a factor of {:.3g}, but not passive by the linear rule: a joint lacks {:.3g} Nms/rad of damping",
        report.margin, -report.passivity_excess));
  }
  const double ratio = report.coupling_gyration / report.gyration;
  if (ratio < 0.5 || ratio > 2.0) {
    warnings.push_back(
        fmt::format("gains.rotational counts a radian as {:.3g} m, the moving body's radius of "
                    "gyration is {:.3g} m: rotations yield too {} compared with translations",
                    report.coupling_gyration, report.gyration, ratio > 1.0 ? "little" : "much"));
  }
  return warnings;
}

}  // namespace godobject::firmware
