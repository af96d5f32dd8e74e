#pragma once

#include <cstdint>
#include <span>

#include "godobject/pose.h"

namespace godobject::sim {

enum class Grip : std::uint8_t {
  kNone,    ///< nobody holds the tool
  kSpring,  ///< the hand holds it through a spring and damper
  kRigid,   ///< hand and tool are one body
};

/// The defaults are an arm and hand that work with a handle, loosely.
struct HandParameters {
  Grip grip = Grip::kNone;
  double mass = 0.5;                ///< [kg]
  double inertia = 1e-3;            ///< the same about all axes [kg m^2]
  double stiffness = 300.0;         ///< from the target to the hand [N/m]
  double damping = 15.0;            ///< [Ns/m]
  double rotation_stiffness = 3.0;  ///< [Nm/rad]
  double rotation_damping = 0.05;   ///< [Nms/rad]
  double grip_stiffness = 2e4;      ///< from the hand to the tool; `kSpring` only
  double grip_damping = 50.0;
  double grip_rotation_stiffness = 50.0;
  double grip_rotation_damping = 0.2;
};

/// A rigid body that moves: the pose of a frame and its velocity, in W.
struct BodyState {
  Pose pose;
  Motion velocity;  ///< of the frame's origin [m/s] and angular [rad/s]
};

/// Wrenches in W, each about the origin of the frame of the body that it acts on.
struct HandWrenches {
  Wrench on_tool;  ///< of the hand, or with a rigid grip of the target, on the tool
  Wrench on_hand;  ///< of the target on the hand
};

/// An operator's hand H: mass, spring and damper between a scripted pose and the tool M; H is where M is when the grip
/// is at rest. Its springs store the energy that they should: torque = stiffness times rotation vector.
class OperatorHand {
 public:
  OperatorHand() = default;

  /// `script`: where the hand would have the tool, H_WM, 1 ms apart, the first at time `start_ns`; it must outlive the
  /// hand. Before and after it the first and the last pose hold. Without one the hand is passive: mass, damped against
  /// the world.
  explicit OperatorHand(const HandParameters& parameters, std::span<const Pose> script = {},
                        std::int64_t start_ns = 0) noexcept;

  const HandParameters& parameters() const noexcept { return parameters_; }

  /// The script between its rows: cubic Hermite, continuous in velocity. At rest at the origin if there is none.
  BodyState target(double time) const noexcept;

  /// With a rigid grip the hand is where the tool is.
  HandWrenches wrenches(const BodyState& target, const BodyState& hand, const BodyState& tool) const noexcept;

  /// What its springs hold and its mass carries [J]; with a rigid grip the arm carries its mass.
  double energy(const BodyState& target, const BodyState& hand, const BodyState& tool) const noexcept;

 private:
  HandParameters parameters_;
  std::span<const Pose> script_;
  double start_ = 0.0;  // [s]
};

}  // namespace godobject::sim
