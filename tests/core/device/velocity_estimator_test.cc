#include "core/device/velocity_estimator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/random.h"

namespace godobject {
namespace {

constexpr double kSamplePeriod = 1e-3;

class Window : public testing::TestWithParam<int> {
 protected:
  double update(double q) {
    JointVector qd;
    EXPECT_EQ(estimator_.update(JointVector::Constant(q), qd), Status::kOk);
    EXPECT_TRUE((qd.array() == qd[0]).all());
    return qd[0];
  }

  double n_ = GetParam();
  VelocityEstimator estimator_{GetParam(), kSamplePeriod};
};

TEST_P(Window, ConstantVelocityIsExactFromTheSecondPositionOn) {
  for (const double velocity : {0.0, 1.0, -7.5}) {
    estimator_.reset();
    EXPECT_EQ(update(1.0), 0.0);
    for (int k = 1; k < 100; ++k) EXPECT_NEAR(update(1.0 + velocity * k * kSamplePeriod), velocity, 1e-11);
  }
}

TEST_P(Window, BeginsWithoutPositions) {
  EXPECT_EQ(update(0.731), 0.0);
  EXPECT_NEAR(update(0.731 + 2.0 * kSamplePeriod), 2.0, 1e-11);
}

TEST_P(Window, ConstantAccelerationIsLateByTheStatedDelay) {
  const double delay = 0.5 * (n_ - 1.0) * kSamplePeriod;
  EXPECT_DOUBLE_EQ(estimator_.delay(), delay);
  const double acceleration = 20.0;
  for (int k = 0; k < 100; ++k) {
    const double t = k * kSamplePeriod;
    const double velocity = update(0.5 * acceleration * t * t);
    if (k >= GetParam() - 1) {
      EXPECT_NEAR(velocity, acceleration * (t - delay), 1e-10);
    }
  }
}

TEST_P(Window, NoiseIsAsStated) {
  test::Random random(1);
  const double half_width = std::sqrt(3.0) * 1e-5;  // the standard deviation is 1e-5
  double sum = 0.0;
  const int count = 200000;
  for (int k = 0; k < count; ++k) {
    const double v = update(random.between(-half_width, half_width));
    if (k >= GetParam()) sum += v * v;
  }
  const double expected = 1e-5 * std::sqrt(12.0 / (n_ * (n_ * n_ - 1.0))) / kSamplePeriod;
  // neighbouring estimates share positions: about ten thousand are independent, so the error is 1 %
  EXPECT_NEAR(std::sqrt(sum / count), expected, 0.03 * expected);
}

TEST_P(Window, QuantisationStaysWithinTheStatedBound) {
  const double h = 1e-4;
  const bool odd = GetParam() % 2 == 1;
  const double bound = odd ? 1.5 * h / (kSamplePeriod * n_) : 1.5 * h * n_ / (kSamplePeriod * (n_ * n_ - 1.0));
  test::Random random(2);
  double worst = 0.0;
  for (int run = 0; run < 20000; ++run) {
    const double velocity = random.between(-1.0, 1.0);
    const double start = random.between(0.0, h);
    estimator_.reset();
    double estimate = 0.0;
    for (int k = 0; k < GetParam(); ++k) estimate = update(h * std::round((start + velocity * k * kSamplePeriod) / h));
    worst = std::max(worst, std::fabs(estimate - velocity));
  }
  EXPECT_LE(worst, bound * (1.0 + 1e-9));

  // the bound is attained: errors of half a quantum, with one sign in the older half and the other in the newer half
  estimator_.reset();
  double estimate = 0.0;
  for (int k = 0; k < GetParam(); ++k) {
    const double side = k - 0.5 * (n_ - 1.0);
    estimate = update(0.5 * h * (side > 0.0 ? 1.0 : side < 0.0 ? -1.0 : 0.0));
  }
  EXPECT_NEAR(estimate, bound, 1e-9 * bound);
}

TEST_P(Window, NothingStaysOfAnOldPosition) {
  update(1e6);
  for (int k = 0; k < 20; ++k) update(1.0);
  EXPECT_EQ(update(1.0), 0.0);
}

INSTANTIATE_TEST_SUITE_P(VelocityEstimator, Window, testing::Values(2, 3, 4, 7, 8, 16));

TEST(VelocityEstimator, LeavesOutWhatIsNotFinite) {
  VelocityEstimator estimator(4, kSamplePeriod);
  JointVector qd;
  for (int k = 0; k < 4; ++k) ASSERT_EQ(estimator.update(JointVector::Constant(k * kSamplePeriod), qd), Status::kOk);
  JointVector bad = JointVector::Zero();
  bad[6] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(estimator.update(bad, qd), Status::kNotFinite);
  ASSERT_EQ(estimator.update(JointVector::Constant(4 * kSamplePeriod), qd), Status::kOk);
  EXPECT_NEAR(qd[0], 1.0, 1e-12);
}

TEST(VelocityEstimator, WindowIsBroughtIntoRange) {
  EXPECT_DOUBLE_EQ(VelocityEstimator(-3, kSamplePeriod).delay(), 0.5 * kSamplePeriod);
  EXPECT_DOUBLE_EQ(VelocityEstimator(1000, kSamplePeriod).delay(),
                   0.5 * (VelocityEstimator::kMaxWindow - 1) * kSamplePeriod);
}

}  // namespace
}  // namespace godobject
