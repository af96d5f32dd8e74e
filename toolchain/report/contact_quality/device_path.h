#pragma once

#include <cstddef>
#include <functional>
#include <random>
#include <vector>

#include "godobject/pose.h"

namespace godobject::report {

/// Where a body touches a still body for the first time, and how it is moved from there, in the still body's own frame
/// O. Frame C stands at the moving body's centre of mass, on its mesh's axes.
struct Placement {
  Pose H_OC;                         ///< touching
  Vector3 into = -Vector3::UnitZ();  ///< unit: presses
  Vector3 along = Vector3::UnitX();  ///< unit: slides
  double clear = 2e-3;               ///< how far off the surface paths begin and end [m]
  Vector3 axis = Vector3::UnitX();   ///< unit: turns about it
};

/// One pose a millisecond.
struct DevicePath {
  std::vector<Pose> H_OC;
  std::size_t begin = 0;  ///< cycles that are measured
  std::size_t end = 0;
  std::vector<std::size_t> checkpoints;  ///< cycles that are compared with the optimum
};

/// Moves `placement` along `into` until a sample point touches, to 1e-12 m. `points_C` stand in C; `distance` is the
/// still body's in O. Throws std::runtime_error where nothing is met within 0.3 m.
Placement touch(Placement placement, const std::vector<Vector3>& points_C,
                const std::function<double(const Vector3& p_O)>& distance);

/// 0 at u <= 0, 1 at u >= 1, in between the polynomial of least jerk.
double smooth_step(double u);

/// From clear of the surface to `depth` within 0.4 s, and held for 0.2 s.
DevicePath press(const Placement& placement, double depth);

/// Pressed to `depth`, then along at `speed`: measured after 0.15 s of it, for `duration`.
DevicePath slide(const Placement& placement, double depth, double speed, double duration);

/// Pressed to `depth` at -60 mm along, then at `speed` to +40 mm, and held there. Measured from -10 mm on.
DevicePath slip_off(const Placement& placement, double depth, double speed);

/// Pressed to `depth`, then out at up to 0.2 m/s until clear. Measured from the way out on.
DevicePath retreat(const Placement& placement, double depth);

/// Pressed to `depth`, then turned to and fro by `angle` [rad] at 1.5 Hz.
DevicePath turn(const Placement& placement, double depth, double angle);

/// Pressed to `depth` and held for `duration` by a hand that trembles at 8, 9, .. 12 Hz, 0.1 mm and 0.1 mrad of
/// amplitude each, read by encoders with steps of 5 um (rotations: of 5 um at 0.1 m). At 7 mm and a friction of 0.2
/// neither a ball of 20 mm nor a box of 60 x 40 mm has a reason to slip: up to 1 N of 2.8 N, 0.025 Nm of 0.05 Nm. The
/// tremor's period is 1 s. Measured from 1 s after the press on.
DevicePath tremor(const Placement& placement, double depth, double duration);

/// Random motion in all six degrees of freedom through the plane z = 0 from `height` above it to the same below, held
/// there, and back: up to 7 m/s and 90 rad/s, both constant on each way.
DevicePath dash(double height, std::mt19937& random);

}  // namespace godobject::report
