#include "toolchain/path/trajectory.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace godobject::path {
namespace {

/// Returns the pose from the keyframes alone: rotation R_WM and the pivot's place in W.
Pose blend(const std::vector<Keyframe>& keyframes, double t) {
  const auto next = std::upper_bound(keyframes.begin(), keyframes.end(), t,
                                     [](double time, const Keyframe& k) { return time < k.t; });
  if (next == keyframes.begin()) return {next->rotation, next->position};
  const auto last = next - 1;
  if (next == keyframes.end()) return {last->rotation, last->position};
  const double share = minimum_jerk((t - last->t) / (next->t - last->t));
  return {last->rotation.slerp(share, next->rotation), last->position + share * (next->position - last->position)};
}

double swing(const Oscillation& wave, double t) {
  const double envelope = minimum_jerk((t - wave.from) / wave.fade) * minimum_jerk((wave.to - t) / wave.fade);
  return envelope * std::sin(2.0 * std::numbers::pi * wave.frequency * (t - wave.from) + wave.phase);
}

}  // namespace

double minimum_jerk(double u) {
  const double v = std::clamp(u, 0.0, 1.0);
  return v * v * v * (10.0 + v * (-15.0 + 6.0 * v));
}

Pose pose_at(const Keyframes& motion, double t) {
  Pose pivot = blend(motion.keyframes, t);
  for (const Oscillation& wave : motion.oscillations) {
    const double value = swing(wave, t);
    pivot.translation += value * wave.translation;
    pivot.rotation = exp_rotation(value * wave.rotation) * pivot.rotation;
  }
  pivot.rotation.normalize();
  return {pivot.rotation, pivot.translation - pivot.rotation._transformVector(motion.pivot)};
}

std::vector<Sample> sample(const Keyframes& motion) {
  const double begin = motion.keyframes.front().t;
  const double span = motion.keyframes.back().t - begin;
  const auto steps = static_cast<std::size_t>(std::floor(span / motion.period + 1e-6));
  std::vector<Sample> samples;
  samples.reserve(steps + 1);
  for (std::size_t i = 0; i <= steps; ++i) {
    const double t = begin + motion.period * static_cast<double>(i);
    samples.push_back({t, pose_at(motion, t)});
  }
  return samples;
}

}  // namespace godobject::path
