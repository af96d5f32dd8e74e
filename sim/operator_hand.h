#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "godobject/pose.h"

namespace godobject::sim {

enum class Grip : std::uint8_t {
  kNone,    ///< no hand is on the tool
  kSpring,  ///< a spring and damper connect hand and tool
  kRigid,   ///< hand and tool are one body
};

/// Parameters of an operator's arm and hand. Defaults, chosen: a loose grip on a handle, with a natural frequency of
/// sqrt(300 / 0.5) / 2 pi = 3.9 Hz and a damping ratio of 15 / (2 sqrt(300 * 0.5)) = 0.61.
struct HandParameters {
  Grip grip = Grip::kNone;
  double mass = 0.5;                ///< [kg]
  double inertia = 1e-3;            ///< about each axis [kg m^2]
  double stiffness = 300.0;         ///< between target and hand [N/m]
  double damping = 15.0;            ///< [Ns/m]
  double rotation_stiffness = 3.0;  ///< [Nm/rad]
  double rotation_damping = 0.05;   ///< [Nms/rad]
  double grip_stiffness = 2e4;      ///< between hand and tool, as `stiffness`; `kSpring` only
  double grip_damping = 50.0;
  double grip_rotation_stiffness = 50.0;
  double grip_rotation_damping = 0.2;
};

/// A moving rigid body: pose and velocity of its frame in the room R.
struct BodyState {
  Pose pose;
  Motion velocity;  ///< velocity of the origin [m/s] and angular velocity [rad/s], on the axes of R
};

/// Wrenches of the operator. M: frame of the tool, H: frame of the hand.
struct HandWrenches {
  Wrench F_M_R;  ///< on the tool, by the hand; with a rigid grip by the target
  Wrench F_H_R;  ///< on the hand, by the target
};

/// An operator's hand H: a mass with springs and dampers between a scripted pose and the tool M. H coincides with M
/// when the grip is at rest. The springs are conservative: torque = stiffness times rotation vector.
class OperatorHand {
 public:
  static constexpr double kRow = 1e-3;  ///< time between two poses of a script [s]

  OperatorHand() = default;

  /// `script`: target poses H_RM of the tool, `kRow` apart, the first at time `start_ns`; outlives the hand. The first
  /// pose holds before the script, the last one after it. Without a script the hand is passive until `steer`: a mass,
  /// damped against the room.
  explicit OperatorHand(const HandParameters& parameters, std::span<const Pose> script = {},
                        std::int64_t start_ns = 0) noexcept;

  const HandParameters& parameters() const noexcept { return parameters_; }

  /// Sets the target of the tool H_RM from now on, in place of the script's.
  void steer(const BodyState& target) noexcept { steered_ = target; }

  /// The target at `time` [s]: the one of `steer`; else that of the script, interpolated by cubic Hermite splines with
  /// continuous velocity. At rest at the origin without both.
  BodyState target(double time) const noexcept;

  /// Wrenches of springs and dampers. With a rigid grip the tool's state replaces the hand's.
  HandWrenches wrenches(const BodyState& target, const BodyState& hand, const BodyState& tool) const noexcept;

  /// Energy of springs and mass [J]; with a rigid grip without the mass, which is the arm's.
  double energy(const BodyState& target, const BodyState& hand, const BodyState& tool) const noexcept;

 private:
  bool is_passive() const noexcept { return script_.empty() && !steered_; }

  HandParameters parameters_;
  std::span<const Pose> script_;
  std::optional<BodyState> steered_;
  double start_ = 0.0;  // [s]
};

}  // namespace godobject::sim
