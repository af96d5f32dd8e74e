#pragma once

#include <cstddef>
#include <functional>
#include <random>
#include <vector>

#include "godobject/pose.h"

namespace godobject::report {

/// The first touch of a still body by a moving body, and the directions of the motion from there, in the still body's
/// own frame O. Frame C is at the moving body's centre of mass, with the axes of its mesh.
struct Placement {
  Pose H_OC;                         ///< touching pose
  Vector3 into = -Vector3::UnitZ();  ///< unit; direction of the press
  Vector3 along = Vector3::UnitX();  ///< unit; direction of the slide
  double clear = 2e-3;               ///< distance from the surface at the begin and end of paths [m]
  Vector3 axis = Vector3::UnitX();   ///< unit; axis of the turns
};

/// Device poses, one per millisecond.
struct DevicePath {
  std::vector<Pose> H_OC;
  std::size_t begin = 0;  ///< first measured cycle; `end` is after the last one
  std::size_t end = 0;
  std::vector<std::size_t> checkpoints;  ///< cycles to compare with the optimum
};

/// Moves `placement` along `into` until a sample point touches, to 1e-12 m. `points_C`: sample points in C; `distance`:
/// distance of the still body in O. Throws std::runtime_error if no point touches within 0.3 m.
Placement touch(Placement placement, const std::vector<Vector3>& points_C,
                const std::function<double(const Vector3& p_O)>& distance);

/// Returns 0 at u <= 0, 1 at u >= 1, and the polynomial of least jerk in between.
double smooth_step(double u);

/// Returns a press from outside to `depth` within 0.4 s, held for 0.2 s.
DevicePath press(const Placement& placement, double depth);

/// Returns a press to `depth`, then a slide along the surface at `speed`. Measured from 0.15 s after its begin, for
/// `duration`.
DevicePath slide(const Placement& placement, double depth, double speed, double duration);

/// Returns a press to `depth` at -60 mm along the slide, a slide at `speed` to +40 mm, and a hold there. Measured from
/// -10 mm on.
DevicePath slip_off(const Placement& placement, double depth, double speed);

/// Returns a press to `depth`, then a retreat at up to 0.2 m/s. Measured from the begin of the retreat.
DevicePath retreat(const Placement& placement, double depth);

/// Returns a press to `depth`, then rotations back and forth by `angle` [rad] at 1.5 Hz.
DevicePath turn(const Placement& placement, double depth, double angle);

/// Returns a press to `depth`, held for `duration` by a hand that trembles at 8, 9, .. 12 Hz with amplitudes of 0.1 mm
/// and 0.1 mrad each. Encoders read it in steps of 5 um (rotations: 5 um at 0.1 m). At 7 mm and a friction of 0.2 the
/// tremor stays below the friction of a ball of 20 mm and of a box of 60 x 40 mm: up to 1 N of 2.8 N, 0.025 Nm of 0.05
/// Nm. The tremor's period is 1 s. Measured from 1 s after the press on.
DevicePath tremor(const Placement& placement, double depth, double duration);

/// Returns a random motion in all six degrees of freedom through the plane z = 0, from `height` above it to the same
/// below, a hold there, and the motion back: up to 7 m/s and 90 rad/s, both constant in each direction.
DevicePath dash(double height, std::mt19937& random);

}  // namespace godobject::report
