// The way out of an overlap in which the rows contradict each other.
#include "core/pipeline/contact/overlap.h"

#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/decompositions.h"
#include "tests/support/random.h"

namespace godobject::overlap_test {
namespace {

using detail::FeatureDirection;
using detail::Overlap;
using detail::SampleDirection;

class OverlapTest : public ::testing::Test {
 protected:
  /// Adds a point of the shell with a distance that lacks `lost` of the margin.
  void add(const Vector3& p, const Vector3& gradient, double lost) {
    SampleBatch batch;
    batch.x[0] = static_cast<float>(p.x());
    batch.y[0] = static_cast<float>(p.y());
    batch.z[0] = static_cast<float>(p.z());
    batch.gradient_x[0] = gradient.x();
    batch.gradient_y[0] = gradient.y();
    batch.gradient_z[0] = gradient.z();
    batch.distance[0] = lengths_.margin - lost;
    batch.clearance[0] = 0.0;
    batch.known = 1;
    const std::uint32_t number = near_->count;
    near_->push(&number, batch, 1);
  }

  template <class Direction>
  Motion way_out(const Pose& H = {}, const Motion& wanted = {}) const {
    Overlap overlap(lengths_);
    overlap.add<Direction>(*near_, H);
    return overlap.way_out(wanted);
  }

  ContactLengths lengths_ = ContactLengths::make({});
  std::unique_ptr<NearPoints> near_ = std::make_unique<NearPoints>();
};

/// Pushed to +x, to -x and to +z by the same: x cancels, z remains. The sum of all squares is 3, so a thousandth of it
/// is added to the 1 of z.
TEST_F(OverlapTest, CancelsWhatContradictsAndKeepsTheRest) {
  const double lost = 1e-5;
  add(Vector3::Zero(), Vector3::UnitX(), lost);
  add(Vector3::Zero(), -Vector3::UnitX(), lost);
  add(Vector3::Zero(), Vector3::UnitZ(), lost);
  const Motion out = way_out<SampleDirection>();
  EXPECT_NEAR(out.translation.x(), 0.0, 1e-20);
  EXPECT_NEAR(out.translation.z(), kRecovery * lost / 1.003, 1e-15);
  EXPECT_EQ(out.rotation, Vector3::Zero());
}

/// A point at which the field is flat says nothing of a way out, behind one that does, too.
TEST_F(OverlapTest, IgnoresPointsWithoutGradient) {
  add(Vector3::Zero(), Vector3::UnitX(), 1e-5);
  add(Vector3(0.01, 0.0, 0.0), Vector3::UnitZ(), 2e-5);
  const Motion out = way_out<SampleDirection>();
  add(Vector3(0.0, 0.02, 0.0), Vector3::Zero(), 3e-5);
  const Motion again = way_out<SampleDirection>();
  EXPECT_EQ(again.translation, out.translation);
  EXPECT_EQ(again.rotation, out.rotation);
}

/// Pushed along x only, it goes to the device along y and z, and hardly along x: with the weight 0.002 of 2.002.
TEST_F(OverlapTest, GoesToTheDeviceWhereNothingPushes) {
  add(Vector3::Zero(), Vector3::UnitX(), 1e-9);
  add(Vector3::Zero(), -Vector3::UnitX(), 1e-9);
  const Motion out = way_out<SampleDirection>({}, {{1e-3, 2e-3, -3e-3}, {0.01, 0.0, 0.02}});
  EXPECT_NEAR(out.translation.x(), 1e-3 * 0.002 / 2.002, 1e-12);
  EXPECT_NEAR(out.translation.y(), 2e-3, 1e-15);
  EXPECT_NEAR(out.translation.z(), -3e-3, 1e-15);
  EXPECT_LT((out.rotation - Vector3(0.01, 0.0, 0.02)).norm(), 1e-14);
}

TEST_F(OverlapTest, LooksOnlyAtPointsThatLostAPartOfTheirMargin) {
  add(Vector3::Zero(), Vector3::UnitX(), 0.0);
  add(Vector3::Zero(), Vector3::UnitY(), -1e-4);
  add(Vector3::Zero(), Vector3::Zero(), 1e-4);  // no gradient
  EXPECT_EQ(way_out<SampleDirection>().translation, Vector3::Zero());
  EXPECT_EQ(way_out<SampleDirection>().rotation, Vector3::Zero());
  near_->count = 0;
  EXPECT_EQ(way_out<FeatureDirection>().translation, Vector3::Zero());
}

/// Against least squares by a singular value decomposition of all rows. A feature point rests: in S it moves by
/// -(x + r x q).
TEST_F(OverlapTest, IsTheLeastSquaresSolutionInBothDirections) {
  test::Random random(4);
  for (int round = 0; round < 40; ++round) {
    near_->count = 0;
    Pose H;
    H.rotation = exp_rotation(random.in_cube(2.0));
    H.translation = random.in_cube(0.1);
    const int count = random.integer(1, 40);
    for (int i = 0; i < count; ++i) {
      add(random.in_cube(0.05), random.between(0.4, 1.7) * random.direction(), random.between(1e-7, 1e-4));
    }
    for (const bool is_feature : {false, true}) {
      const double gyration = lengths_.metric.gyration;
      Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(count + 6, 6);
      Eigen::VectorXd gains = Eigen::VectorXd::Zero(count + 6);
      double squares = 0.0;
      for (int i = 0; i < count; ++i) {
        const auto k = static_cast<std::uint32_t>(i);
        const Vector3 g = near_->gradient(k);
        const Vector3 P = is_feature ? H * near_->point(k) : near_->point(k);
        const Vector3 n = (is_feature ? Vector3(-g) : H.rotation.conjugate() * g).normalized();
        rows.row(i) << n.transpose(), P.cross(n).transpose() / gyration;
        gains[i] = lengths_.gap_law().required_gain((lengths_.margin - near_->distance[k]) / g.norm());
        squares += rows.row(i).squaredNorm();
      }
      const Motion wanted{random.in_cube(1e-4), random.in_cube(1e-3)};
      const double weight = std::sqrt(1e-3 * squares);
      rows.bottomRows(6).diagonal().setConstant(weight);
      gains.tail(6) << weight * wanted.translation, weight * gyration * wanted.rotation;
      const Eigen::VectorXd expected = test::least_squares(rows, gains);
      const Motion out = is_feature ? way_out<FeatureDirection>(H, wanted) : way_out<SampleDirection>(H, wanted);
      EXPECT_LT((out.translation - expected.head<3>()).norm(), 1e-9 * (1e-6 + expected.norm())) << round;
      EXPECT_LT((gyration * out.rotation - expected.tail<3>()).norm(), 1e-9 * (1e-6 + expected.norm())) << round;
    }
  }
}

}  // namespace
}  // namespace godobject::overlap_test
