#include "toolchain/report/contact_quality/device_path.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace godobject::report {
namespace {

constexpr double kPeriod_s = 1e-3;
constexpr double kPress_s = 0.4;

struct Offset {
  double into = 0.0;
  double along = 0.0;
  double angle = 0.0;
};

Pose at(const Placement& placement, const Offset& offset) {
  Pose pose = placement.H_OC;
  pose.translation += offset.into * placement.into + offset.along * placement.along;
  pose.rotation = exp_rotation(offset.angle * placement.axis) * pose.rotation;
  return pose;
}

std::size_t cycles(double duration) { return static_cast<std::size_t>(std::lround(duration / kPeriod_s)); }

DevicePath sampled(const Placement& placement, double duration, const std::function<Offset(double t)>& offset) {
  DevicePath path;
  const std::size_t count = cycles(duration);
  for (std::size_t k = 0; k < count; ++k) {
    path.H_OC.push_back(at(placement, offset(kPeriod_s * static_cast<double>(k))));
  }
  path.end = count;
  return path;
}

double pressed(const Placement& placement, double t, double depth) {
  return -placement.clear + (depth + placement.clear) * smooth_step(t / kPress_s);
}

/// Returns the distance travelled at t after a smooth start from rest to `speed` within `rise`.
double run_up(double t, double speed, double rise) {
  const double u = std::clamp(t / rise, 0.0, 1.0);
  const double integral = u * u * u * u * (2.5 + u * (-3.0 + u));  // of smooth_step
  return speed * (rise * integral + std::max(0.0, t - rise));
}

}  // namespace

double smooth_step(double u) {
  u = std::clamp(u, 0.0, 1.0);
  return u * u * u * (10.0 + u * (-15.0 + 6.0 * u));
}

Placement touch(Placement placement, const std::vector<Vector3>& points_C,
                const std::function<double(const Vector3&)>& distance) {
  constexpr double kStep_m = 2e-4;
  constexpr double kFarthest_m = 0.3;
  constexpr int kHalvings = 32;
  const auto is_free = [&](double way) {
    const Pose pose = at(placement, {.into = way});
    return std::all_of(points_C.begin(), points_C.end(), [&](const Vector3& p) { return distance(pose * p) >= 0.0; });
  };
  if (!is_free(0.0)) throw std::runtime_error("a scene's start pose is not free");
  double met = 0.0;
  while (is_free(met)) {
    met += kStep_m;
    if (met > kFarthest_m) throw std::runtime_error("a scene's body does not meet the still body");
  }
  double low = met - kStep_m;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + met);
    (is_free(middle) ? low : met) = middle;
  }
  placement.H_OC = at(placement, {.into = low});
  return placement;
}

DevicePath press(const Placement& placement, double depth) {
  constexpr double kHold_s = 0.2;
  DevicePath path =
      sampled(placement, kPress_s + kHold_s, [&](double t) { return Offset{.into = pressed(placement, t, depth)}; });
  path.begin = cycles(0.6 * kPress_s);
  path.checkpoints = {cycles(0.7 * kPress_s), cycles(kPress_s), path.end - 1};
  return path;
}

DevicePath slide(const Placement& placement, double depth, double speed, double duration) {
  constexpr double kRise_s = 0.05;
  constexpr double kSettle_s = 0.15;
  DevicePath path = sampled(placement, kPress_s + kSettle_s + duration, [&](double t) {
    return Offset{.into = pressed(placement, t, depth), .along = run_up(t - kPress_s, speed, kRise_s)};
  });
  path.begin = cycles(kPress_s + kSettle_s);
  path.checkpoints = {path.begin, (path.begin + path.end) / 2, path.end - 1};
  return path;
}

DevicePath slip_off(const Placement& placement, double depth, double speed) {
  constexpr double kRise_s = 0.02;
  constexpr double kFrom_m = -0.06;
  constexpr double kMeasured_m = -0.01;
  constexpr double kTo_m = 0.04;
  constexpr double kHold_s = 0.06;
  const double way_s = (kTo_m - kFrom_m) / speed + 0.5 * kRise_s;
  DevicePath path = sampled(placement, kPress_s + way_s + kHold_s, [&](double t) {
    return Offset{.into = pressed(placement, t, depth),
                  .along = std::min(kTo_m, kFrom_m + run_up(t - kPress_s, speed, kRise_s))};
  });
  path.begin = cycles(kPress_s + (kMeasured_m - kFrom_m) / speed + 0.5 * kRise_s);
  for (std::size_t k = path.begin; k < path.end; ++k) path.checkpoints.push_back(k);
  return path;
}

DevicePath retreat(const Placement& placement, double depth) {
  constexpr double kSpeed = 0.2;
  const double way_s = 1.875 * (depth + placement.clear) / kSpeed;  // the smooth step's largest slope
  DevicePath path = sampled(placement, kPress_s + way_s + 0.02, [&](double t) {
    return Offset{.into =
                      pressed(placement, t, depth) - (depth + placement.clear) * smooth_step((t - kPress_s) / way_s)};
  });
  path.begin = cycles(kPress_s);
  return path;
}

DevicePath turn(const Placement& placement, double depth, double angle) {
  constexpr double kFrequency = 1.5;
  constexpr double kRise_s = 0.1;
  constexpr std::size_t kChecks = 5;
  const double turn_s = 1.0 / kFrequency;
  DevicePath path = sampled(placement, kPress_s + turn_s, [&](double t) {
    const double since = std::max(0.0, t - kPress_s);
    return Offset{
        .into = pressed(placement, t, depth),
        .angle = angle * smooth_step(since / kRise_s) * std::sin(2.0 * std::numbers::pi * kFrequency * since)};
  });
  path.begin = cycles(kPress_s);
  for (std::size_t i = 1; i <= kChecks; ++i) {
    path.checkpoints.push_back(path.begin + i * (path.end - 1 - path.begin) / kChecks);
  }
  return path;
}

DevicePath tremor(const Placement& placement, double depth, double duration) {
  constexpr double kEncoder_m = 5e-6;
  constexpr double kEncoder_rad = kEncoder_m / 0.1;
  constexpr double kAmplitude_m = 1e-4;
  constexpr double kAmplitude_rad = 1e-4;
  constexpr double kSettle_s = 1.0;
  constexpr int kSlowest = 8;
  constexpr int kFastest = 12;
  DevicePath path = sampled(placement, kPress_s + kSettle_s + duration,
                            [&](double t) { return Offset{.into = pressed(placement, t, depth)}; });
  path.begin = cycles(kPress_s + kSettle_s);
  for (std::size_t k = cycles(kPress_s); k < path.end; ++k) {
    const double t = kPeriod_s * static_cast<double>(k) - kPress_s;
    const double rise = smooth_step(t / (0.5 * kSettle_s));
    Vector3 x = Vector3::Zero();
    Vector3 r = Vector3::Zero();
    for (int hertz = kSlowest; hertz <= kFastest; ++hertz) {
      for (int axis = 0; axis < 3; ++axis) {  // random phases, the same in every run
        x[axis] += kAmplitude_m * std::sin(2.0 * std::numbers::pi * hertz * t + 1.7 * hertz + 2.3 * axis);
        r[axis] += kAmplitude_rad * std::sin(2.0 * std::numbers::pi * hertz * t + 0.9 * hertz + 1.1 * axis);
      }
    }
    Pose& pose = path.H_OC[k];
    pose.translation += kEncoder_m * (rise * x / kEncoder_m).array().round().matrix();
    pose.rotation = exp_rotation(kEncoder_rad * (rise * r / kEncoder_rad).array().round().matrix()) * pose.rotation;
  }
  return path;
}

DevicePath dash(double height, std::mt19937& random) {
  constexpr double kSlowest = 0.5;
  constexpr double kFastest = 7.0;
  constexpr double kFastestTurn = 90.0;
  constexpr double kLateral = 0.6;
  constexpr double kHold_s = 0.02;
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::normal_distribution<double> normal;
  const auto direction = [&] { return Vector3(normal(random), normal(random), normal(random)).normalized(); };
  DevicePath path;
  Pose pose;
  pose.rotation = exp_rotation(std::numbers::pi * share(random) * direction());
  pose.translation = Vector3(0.0, 0.0, height);
  for (const double sense : {-1.0, 1.0}) {
    const double speed = kSlowest + (kFastest - kSlowest) * share(random);
    const Vector3 sideways = kLateral * share(random) * direction();
    const Vector3 velocity = speed * Vector3(sideways.x(), sideways.y(), sense).normalized();
    const Quaternion spin = exp_rotation(kPeriod_s * kFastestTurn * share(random) * direction());
    while (sense * pose.translation.z() < height) {
      path.H_OC.push_back(pose);
      pose.translation += kPeriod_s * velocity;
      pose.rotation = (spin * pose.rotation).normalized();
    }
    for (std::size_t k = 0; k < cycles(kHold_s); ++k) path.H_OC.push_back(pose);
  }
  path.end = path.H_OC.size();
  return path;
}

}  // namespace godobject::report
