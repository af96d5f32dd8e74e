#include "toolchain/precision/press_path.h"

#include <optional>
#include <random>

#include <Eigen/Geometry>

#include "toolchain/path/trajectory.h"

namespace godobject::precision {
namespace {

constexpr int kWanted = 4;      // motions, chosen: from four sides
constexpr int kMostTries = 40;  // chosen

/// Returns the first pose of contact of a body that moves straight along `into`, at most `longest` [m] far; nothing if
/// it starts in contact or meets nothing.
std::optional<Pose> touch(const ExactScene& exact, Pose H_WM, const Vector3& into, double longest) {
  const double near = 1e-3 * exact.still().voxel_size();
  double travelled = 0.0;
  while (travelled < longest) {
    const double gap = exact.clearance(H_WM);
    if (gap < near) return travelled > 0.0 ? std::optional(H_WM) : std::nullopt;
    H_WM.translation += gap * into;
    travelled += gap;
  }
  return std::nullopt;
}

/// Returns the motion from free space to the touch pose, into contact and back. The pivot is the body's centre of mass.
std::vector<Pose> pressed(const ExactScene& exact, const Pose& H_WM, const Vector3& into, const Vector3& axis) {
  const double s = exact.still().voxel_size();
  const Vector3 along = into.cross(axis).normalized();
  const double turn = 10.0 * s / exact.points().nodes.front().radius;
  path::Keyframes motion;
  motion.pivot = exact.H_MB().translation;
  const auto frame = [&](double t, double deep, double slid, double turned) {
    const Quaternion rotation = exp_rotation(turned * axis) * H_WM.rotation;
    motion.keyframes.push_back({t, H_WM * motion.pivot + deep * into + slid * along, rotation});
  };
  frame(0.0, -2.0 * s, 0.0, 0.0);
  frame(0.2, 3.0 * s, 0.0, 0.0);
  frame(0.4, 3.0 * s, 10.0 * s, turn);
  frame(0.6, 3.0 * s, 0.0, -turn);
  frame(0.75, -5.0 * s, 0.0, -turn);
  std::vector<Pose> poses;
  for (const path::Sample& sample : path::sample(motion)) poses.push_back(sample.pose);
  return poses;
}

}  // namespace

Paths press_paths(const ExactScene& exact) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const auto direction = [&] { return Vector3(normal(random), normal(random), normal(random)).normalized(); };
  const auto& [low, high] = exact.still_box();
  const auto& [moving_low, moving_high] = exact.moving_box();
  const double longest = (high - low).norm() + 2.0 * (moving_high - moving_low).norm();
  std::uniform_real_distribution<double> share(0.2, 0.8);
  Paths paths;
  for (int i = 0; i < kMostTries && paths.size() < kWanted; ++i) {
    const Vector3 into = direction();
    const Vector3 axis = direction();
    Pose H_WM;
    H_WM.rotation = Quaternion(normal(random), normal(random), normal(random), normal(random)).normalized();
    const Vector3 target = low + Vector3(share(random), share(random), share(random)).cwiseProduct(high - low);
    const Vector3 middle = 0.5 * (moving_low + moving_high);
    H_WM.translation = target - H_WM.rotation._transformVector(middle) - 0.5 * longest * into;
    if (const auto touching = touch(exact, H_WM, into, longest)) paths.push_back(pressed(exact, *touching, into, axis));
  }
  return paths;
}

}  // namespace godobject::precision
