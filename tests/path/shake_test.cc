// The swing of an unsteady hand: its size, its ends, and that a seed decides it.
#include "toolchain/path/shake.h"

#include <cmath>

#include <gtest/gtest.h>

#include "toolchain/path/trajectory.h"

namespace godobject::path {
namespace {

Keyframes still_for_four_seconds() {
  Keyframes motion;
  motion.keyframes.push_back({.t = 1.0, .position = Vector3(0.1, 0.2, 0.3)});
  motion.keyframes.push_back({.t = 5.0, .position = Vector3(0.1, 0.2, 0.3)});
  return motion;
}

TEST(Shake, MovesEveryCoordinateByAtMostThreeAmplitudesAndNotTheEnds) {
  for (const std::uint64_t seed : {0u, 1u, 77u}) {
    Keyframes motion = still_for_four_seconds();
    shake(seed, motion);
    Vector3 farthest = Vector3::Zero(), turned = Vector3::Zero();
    for (const Sample& sample : sample(motion)) {
      const Vector3 away = sample.pose.translation - motion.keyframes[0].position;
      farthest = farthest.cwiseMax(away.cwiseAbs());
      turned = turned.cwiseMax(log_rotation(sample.pose.rotation).cwiseAbs());
    }
    EXPECT_GT(farthest.minCoeff(), 1e-4) << seed;
    EXPECT_LE(farthest.maxCoeff(), 3e-3) << seed;
    EXPECT_GT(turned.minCoeff(), 2e-3) << seed;
    EXPECT_LE(turned.maxCoeff(), 0.07) << "turns about three axes do not only add up, " << seed;
    EXPECT_TRUE(pose_at(motion, 1.0).translation.isApprox(motion.keyframes[0].position, 1e-15));
    EXPECT_TRUE(pose_at(motion, 5.0).translation.isApprox(motion.keyframes[0].position, 1e-15));
  }
}

TEST(Shake, IsTheSameForTheSameSeedOnly) {
  Keyframes first = still_for_four_seconds(), same = first, other = first;
  shake(3, first);
  shake(3, same);
  shake(4, other);
  EXPECT_EQ(pose_at(first, 2.5).translation, pose_at(same, 2.5).translation);
  EXPECT_GT((pose_at(first, 2.5).translation - pose_at(other, 2.5).translation).norm(), 1e-5);
  // the first numbers of this generator are fixed by the standard
  Keyframes known = still_for_four_seconds();
  shake(5489, known);
  EXPECT_NEAR(known.oscillations[0].frequency, 0.1 + 1.4 * (14514284786278117030.0 / 18446744073709551616.0), 1e-12);
}

}  // namespace
}  // namespace godobject::path
