// The limits of a sub-step, against cases that can be computed by hand.

#include "core/pipeline/contact/substep_limits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace godobject::test::substep_limits_test {
namespace {

constexpr double kBodyRadius = 0.1;

ContactLengths lengths() {
  Parameters q;
  q.voxel_size = 0.004;
  q.margin = 1e-4;
  q.mass = MassModel::make(Vector3::Constant(0.01), kBodyRadius, kBodyRadius);
  return ContactLengths::make(q);
}

Motion shift(double x) { return {{x, 0.0, 0.0}, Vector3::Zero()}; }
Motion turn(double angle) { return {Vector3::Zero(), {0.0, angle, 0.0}}; }
double share(const Motion& motion, double free_displacement, double search_radius, bool constrained) {
  return detail::allowed_share(motion, {.free_displacement = free_displacement}, search_radius, lengths(), constrained);
}

TEST(AllowedShare, IsOneForAMotionWithinTheFreeDisplacement) {
  EXPECT_EQ(share(shift(0.0), 0.01, 1.0, true), 1.0);
  EXPECT_EQ(share(shift(0.0098), 0.01, 1.0, true), 1.0);
  EXPECT_EQ(share(turn(0.05), 0.01, 1.0, true), 1.0);
}

TEST(AllowedShare, LeavesAMarginToPointsThatAreNotNear) {
  EXPECT_NEAR(share(shift(0.1), 0.01, 1.0, false), (0.01 - 1e-4) / 0.1, 1e-12);
  EXPECT_NEAR(share(turn(1.0), 0.01, 1.0, false), (0.01 - 1e-4) / kBodyRadius, 1e-7);
  EXPECT_NEAR(share(shift(0.1), 1.5e-4, 1.0, false), 0.75e-4 / 0.1, 1e-12) << "half of less than two margins";
  EXPECT_EQ(share(shift(0.1), 0.0, 1.0, false), 0.0);
}

TEST(AllowedShare, TurnsByATenthOfARadianAtMostWhereRowsHold) {
  EXPECT_NEAR(share(turn(1.0), 10.0, 1.0, true), 0.1, 1e-12);
  EXPECT_NEAR(share(turn(0.11), 10.0, 1.0, true), 0.1 / 0.11, 1e-12);
  EXPECT_EQ(share(turn(0.09), 10.0, 1.0, true), 1.0);
  EXPECT_EQ(share(turn(1.0), 10.0, 1.0, false), 1.0) << "without rows nothing is linear in the turn";
}

/// The part of a turn that the rows neglect, angle^2 R_max / 2, stays below half of the search radius.
TEST(AllowedShare, TurnsByLessInASmallSearchRadius) {
  for (const double search_radius : {1e-5, 1e-4, 5e-4}) {
    const double allowed = share(turn(1.0), 10.0, search_radius, true);
    EXPECT_NEAR(0.5 * allowed * allowed * kBodyRadius, 0.5 * search_radius, 1e-12);
  }
}

TEST(AllowedShare, ObeysBothLimits) {
  EXPECT_NEAR(share(turn(1.0), 0.002, 1.0, true), (0.002 - 1e-4) / kBodyRadius, 1e-7);
  EXPECT_NEAR(share(turn(1.0), 0.05, 1.0, true), 0.1, 1e-12);
}

class FirstSearchRadius : public ::testing::Test {
 protected:
  /// The radius after a last motion of `last` [m], when the device has moved by `device` [m] since then.
  double radius(double last, double device, double longest = 1.0) {
    memory_->last_step.motion = shift(last);
    memory_->H_WD_last.translation = Vector3(0.0, 3.0, 0.0);
    Pose H_WD = memory_->H_WD_last;
    H_WD.translation.z() += device;
    return detail::first_search_radius(*memory_, state_, H_WD, lengths(), longest);
  }

  ProxyState state_ = [] {
    ProxyState state;
    state.started = true;
    return state;
  }();
  std::unique_ptr<ContactMemory> memory_ = std::make_unique<ContactMemory>();
};

constexpr double kThreeMargins = 3e-4;

TEST_F(FirstSearchRadius, IsAQuarterMoreThanTheLongerDisplacementAndThreeMargins) {
  EXPECT_NEAR(radius(0.01, 0.0), 0.0125 + kThreeMargins, 1e-9);
  EXPECT_NEAR(radius(0.01, 0.008), 0.0125 + kThreeMargins, 1e-9);
  EXPECT_NEAR(radius(0.01, 0.012), 0.015 + kThreeMargins, 1e-9);
}

TEST_F(FirstSearchRadius, CountsAtMostTwiceTheLastMotion) {
  EXPECT_NEAR(radius(0.01, 0.5), 0.02 + kThreeMargins, 1e-9);
}

TEST_F(FirstSearchRadius, LiesBetweenAnEighthOfAVoxelAndTheLongest) {
  EXPECT_NEAR(radius(0.0, 0.0), 0.0005, 1e-12);
  EXPECT_NEAR(radius(0.0, 1.0), 0.0005, 1e-12);
  EXPECT_NEAR(radius(0.01, 0.0, 0.006), 0.006, 1e-12);
  EXPECT_NEAR(radius(0.0, 0.0, 1e-4), 1e-4, 1e-12);
}

TEST_F(FirstSearchRadius, DoesNotKnowTheDeviceBeforeTheFirstCycle) {
  state_.started = false;
  EXPECT_NEAR(radius(0.01, 0.5), 0.0125 + kThreeMargins, 1e-9);
}

TEST(CutOff, ShortensAMotionToTheFaceAndExpressesItInTheMovingFrame) {
  WorkspaceBox box;
  box.limited = true;
  box.low = Vector3(-1.0, -1.0, -1.0);
  box.high = Vector3(1.0, 1.0, 1.0);
  Pose H0;
  H0.translation = Vector3(0.9, 0.2, 0.0);
  H0.rotation = Quaternion(Eigen::AngleAxisd(0.5 * M_PI, Vector3::UnitZ()));  // x of S is y of W
  Pose H1 = H0;
  H1.translation = Vector3(1.3, 0.5, 0.0);
  Motion motion;
  detail::cut_off(box, H0, H1, motion);
  EXPECT_LT((H1.translation - Vector3(1.0, 0.5, 0.0)).norm(), 1e-15);
  EXPECT_LT((motion.translation - Vector3(0.3, -0.1, 0.0)).norm(), 1e-15);
  const Motion before = motion;
  const Pose on_face = H1;
  detail::cut_off(box, H0, H1, motion);
  EXPECT_EQ(H1.translation, on_face.translation) << "a pose on the face is inside";
  EXPECT_EQ(motion.translation, before.translation);
  box.limited = false;
  H1.translation = Vector3(5.0, 0.0, 0.0);
  detail::cut_off(box, H0, H1, motion);
  EXPECT_EQ(H1.translation.x(), 5.0);
}

}  // namespace
}  // namespace godobject::test::substep_limits_test
