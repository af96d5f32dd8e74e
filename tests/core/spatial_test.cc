#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "core/spatial/bounding_sphere.h"
#include "godobject/pose.h"

namespace godobject {
namespace {

constexpr double kPi = std::numbers::pi;

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double uniform() { return std::uniform_real_distribution<double>(-1.0, 1.0)(engine_); }
  Vector3 vector() { return {uniform(), uniform(), uniform()}; }
  Vector3 direction() { return vector().normalized(); }
  Pose pose() {
    Pose pose;
    pose.rotation = exp_rotation(kPi * uniform() * direction());
    pose.translation = vector();
    return pose;
  }

 private:
  std::mt19937 engine_;
};

Eigen::Matrix4d matrix(const Pose& H) {
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m.topLeftCorner<3, 3>() = H.rotation.toRotationMatrix();
  m.topRightCorner<3, 1>() = H.translation;
  return m;
}

TEST(Rotation, OfNothingIsTheIdentity) {
  EXPECT_EQ(exp_rotation(Vector3::Zero()).coeffs(), Quaternion::Identity().coeffs());
  EXPECT_EQ(log_rotation(Quaternion::Identity()), Vector3::Zero());
}

TEST(Rotation, OfAQuarterTurnIsKnownByHand) {
  const Quaternion q = exp_rotation(Vector3(0.0, 0.0, 0.5 * kPi));
  EXPECT_NEAR((q * Vector3(1.0, 0.0, 0.0) - Vector3(0.0, 1.0, 0.0)).norm(), 0.0, 1e-15);
  EXPECT_NEAR(q.w(), std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(q.z(), std::sqrt(0.5), 1e-15);
}

/// The angles reach from vanishing squares to just below half a turn, across the switch to the series (1e-4 rad).
TEST(Rotation, LogUndoesExpForEveryAngle) {
  Random random(1);
  for (const double angle : {1e-300, 1e-160, 1e-30, 1e-12, 1e-8, 9.9e-6, 1.9e-5, 2.1e-5, 9.999e-5, 1.0001e-4, 1e-3,
                             3e-3, 0.1, 1.0, 2.0, 3.0, kPi - 1e-3, kPi - 1e-8}) {
    for (int i = 0; i < 100; ++i) {
      const Vector3 r = angle * random.direction();
      const Vector3 back = log_rotation(exp_rotation(r));
      ASSERT_LE((back - r).norm(), 1e-15 * angle + 4e-16 * angle) << angle;
      ASSERT_NEAR(exp_rotation(r).norm(), 1.0, 5e-16) << angle;
    }
  }
}

TEST(Rotation, ExpAgreesWithAxisAndAngle) {
  Random random(2);
  for (int i = 0; i < 10000; ++i) {
    const Vector3 axis = random.direction();
    const double angle = 3.0 * kPi * random.uniform();  // also more than a turn
    const Matrix3 expected = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
    ASSERT_LT((exp_rotation(angle * axis).toRotationMatrix() - expected).norm(), 1e-14) << angle;
  }
}

TEST(Rotation, LogTakesTheShortWayWhateverTheSign) {
  Random random(3);
  for (int i = 0; i < 10000; ++i) {
    const Vector3 r = kPi * random.uniform() * random.direction();
    const Quaternion q = exp_rotation(r);
    const Vector3 other = log_rotation(Quaternion(-q.w(), -q.x(), -q.y(), -q.z()));
    ASSERT_LE(other.norm(), kPi + 1e-15);
    ASSERT_LT((other - r).norm(), 1e-14);
  }
}

TEST(Rotation, LogOfHalfATurnHasLengthPi) {
  for (const double w : {0.0, 1e-17, -1e-17, 1e-300}) {
    const Vector3 r = log_rotation(Quaternion(w, 0.6, 0.0, 0.8));
    EXPECT_NEAR(r.norm(), kPi, 1e-15) << w;
    EXPECT_NEAR(std::fabs(r.normalized().dot(Vector3(0.6, 0.0, 0.8))), 1.0, 1e-15) << w;
  }
}

TEST(Rotation, LogOfAnExactHalfTurnKeepsItsAxis) {
  EXPECT_LT((log_rotation(Quaternion(0.0, 0.6, 0.0, 0.8)) - kPi * Vector3(0.6, 0.0, 0.8)).norm(), 1e-15);
}

TEST(Rotation, LogStandsALengthSlightlyOff) {
  const Quaternion q = exp_rotation(Vector3(0.3, -0.2, 0.5));
  for (const double length : {1.0 - 1e-12, 1.0 + 1e-12}) {
    const Quaternion off(length * q.w(), length * q.x(), length * q.y(), length * q.z());
    EXPECT_LT((log_rotation(off) - Vector3(0.3, -0.2, 0.5)).norm(), 1e-14);
  }
}

TEST(Pose, ComposesLikeMatrices) {
  Random random(4);
  for (int i = 0; i < 10000; ++i) {
    const Pose H_AB = random.pose();
    const Pose H_BC = random.pose();
    ASSERT_LT((matrix(H_AB * H_BC) - matrix(H_AB) * matrix(H_BC)).norm(), 1e-14);
    ASSERT_LT((matrix(H_AB.inverse()) - matrix(H_AB).inverse()).norm(), 1e-14);
    const Vector3 p_B = random.vector();
    const Vector3 expected = (matrix(H_AB) * p_B.homogeneous()).head<3>();
    ASSERT_LT((H_AB * p_B - expected).norm(), 1e-14);
  }
}

/// The letters of the frames promise this: H_WS H_SP = H_WP, and so on.
TEST(Pose, NeighbouringLettersCancel) {
  Random random(5);
  for (int i = 0; i < 10000; ++i) {
    const Pose H_WS = random.pose();
    const Pose H_SP = random.pose();
    const Pose H_WP = H_WS * H_SP;
    const Vector3 p_P = random.vector();
    ASSERT_LT((H_WP * p_P - H_WS * (H_SP * p_P)).norm(), 2e-15);
    ASSERT_LT((H_WP.inverse() * (H_WP * p_P) - p_P).norm(), 4e-15);
    const Pose H_SS = H_WS.inverse() * H_WS;
    ASSERT_LT(H_SS.translation.norm() + log_rotation(H_SS.rotation).norm(), 2e-15);
    const Pose H_PW = H_SP.inverse() * H_WS.inverse();
    ASSERT_LT((matrix(H_PW) - matrix(H_WP.inverse())).norm(), 1e-14);
  }
}

TEST(Pose, StaysUnitOverAMillionProducts) {
  Random random(6);
  const Pose step = set_matrix({1e-3 * random.vector(), 1e-2 * random.vector()});
  Pose H;
  for (int i = 0; i < 1000000; ++i) H = H * step;
  EXPECT_NEAR(H.rotation.norm(), 1.0, 4e-16);
  // the same turn in one step; rounding adds up like a random walk, or linearly at worst
  const double angle = std::remainder(1e6 * log_rotation(step.rotation).norm(), 2.0 * kPi);
  const Quaternion expected = exp_rotation(angle * log_rotation(step.rotation).normalized());
  EXPECT_LT(log_rotation(expected.conjugate() * H.rotation).norm(), 1e6 * 4e-16);
}

TEST(Pose, SetMatrixMovesInTheFrameThatMoves) {
  // S is a metre along x of W and looks along y, so a step of 0.1 along its own x is along y of W
  Pose H_WS;
  H_WS.rotation = exp_rotation(Vector3(0.0, 0.0, 0.5 * kPi));
  H_WS.translation = Vector3(1.0, 0.0, 0.0);
  const Pose moved = H_WS * set_matrix({Vector3(0.1, 0.0, 0.0), Vector3(0.0, 0.0, 0.5 * kPi)});
  EXPECT_LT((moved.translation - Vector3(1.0, 0.1, 0.0)).norm(), 1e-15);
  EXPECT_LT((moved * Vector3(1.0, 0.0, 0.0) - Vector3(0.0, 0.1, 0.0)).norm(), 1e-15);
}

TEST(Pose, GetMotionUndoesSetMatrix) {
  Random random(7);
  for (int i = 0; i < 10000; ++i) {
    const Motion xi{random.vector(), 3.1 * random.uniform() * random.direction()};
    const Motion back = get_motion(set_matrix(xi));
    ASSERT_EQ(back.translation, xi.translation);  // not the SE(3) logarithm: the translation stays as it is
    ASSERT_LT((back.rotation - xi.rotation).norm(), 4e-15);
  }
}

TEST(Pose, EqualsOnlyAPoseWithTheSameSevenNumbers) {
  Random random(8);
  const Pose pose = random.pose();
  EXPECT_EQ(pose, Pose(pose));
  for (int i = 0; i < 7; ++i) {
    Pose other = pose;
    (i < 3 ? other.translation[i] : other.rotation.coeffs()[i - 3]) += 1e-9;
    EXPECT_FALSE(pose == other) << i;
  }
}

TEST(Pose, KnowsWhatIsNotFinite) {
  EXPECT_TRUE(Pose().is_finite());
  for (const double value : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    for (int i = 0; i < 3; ++i) {
      Pose pose;
      pose.translation[i] = value;
      EXPECT_FALSE(pose.is_finite());
    }
    for (int i = 0; i < 4; ++i) {
      Pose pose;
      pose.rotation.coeffs()[i] = value;
      EXPECT_FALSE(pose.is_finite());
    }
  }
}

/// No point of the sphere travels farther than the bound, and one travels more than half of it.
TEST(BoundingSphere, BoundsTheWayFromPoseToPose) {
  Random random(11);
  for (int k = 0; k < 300; ++k) {
    const BoundingSphere sphere{random.vector(), 0.3 + 0.2 * random.uniform()};
    const Pose H0 = random.pose();
    const double size = std::pow(10.0, -4.0 + 4.0 * std::abs(random.uniform()));
    Pose H1 = H0;
    H1.translation += size * random.vector();
    H1.rotation = (exp_rotation(size * random.vector()) * H0.rotation).normalized();
    const double bound = farthest_way(sphere, H0, H1);
    double farthest = 0.0;
    for (int i = 0; i < 4000; ++i) {
      const Vector3 p = sphere.center + sphere.radius * random.direction();
      farthest = std::max(farthest, (H1 * p - H0 * p).norm());
    }
    ASSERT_LE(farthest, bound);
    ASSERT_GE(farthest, 0.6 * bound);
  }
}

TEST(BoundingSphere, GoesAsFarAsItsCentreWhereNothingTurns) {
  const BoundingSphere sphere{{0.1, 0.2, 0.3}, 0.5};
  Pose H0;
  Pose H1;
  H1.translation = Vector3(3e-3, 0.0, 4e-3);
  EXPECT_NEAR(farthest_way(sphere, H0, H1), 5e-3 + 1e-9 * (5e-3 + 0.5), 1e-15);  // a billionth against rounding
  EXPECT_NEAR(travel(sphere, {H1.translation, Vector3::Zero()}), 5e-3, 1e-15);
  // a rotation about the centre
  const double turn = 0.5;
  H1.rotation = exp_rotation({0.0, 0.0, turn});
  H1.translation = sphere.center - H1.rotation * sphere.center;
  EXPECT_NEAR(farthest_way(sphere, H0, H1), 2.0 * std::sin(0.5 * turn) * 0.5, 2e-9);
}

TEST(BoundingSphere, TurnsAboutItsCentreByItsRadiusAlone) {
  const BoundingSphere sphere{{0.1, -0.2, 0.3}, 0.5};
  const Vector3 turn(2e-3, 1e-3, -2e-3);  // 3 mrad
  EXPECT_NEAR(travel(sphere, {-turn.cross(sphere.center), turn}), 3e-3 * 0.5 + 0.5 * 9e-6 * 0.6, 1e-12);
  // for a large rotation, the distance to the axis counts as well
  const Vector3 far(0.0, 3.0, 0.0);
  EXPECT_NEAR(travel(sphere, {Vector3(0.0, 0.1, 0.0), far}), 0.1 + 3.0 * (0.6 + 0.5), 1e-12);
}

TEST(BoundingSphere, BoundsEveryShareOfAMotion) {
  Random random(12);
  for (int k = 0; k < 300; ++k) {
    const BoundingSphere sphere{random.vector(), 0.3 + 0.2 * random.uniform()};
    const Pose H0 = random.pose();
    const double size = std::pow(10.0, -4.0 + 4.0 * std::abs(random.uniform()));
    const Motion motion{size * random.vector(), size * random.vector()};
    const double bound = travel(sphere, motion);
    for (int i = 0; i < 300; ++i) {
      const double share = std::abs(random.uniform());
      const Pose H1 = H0 * set_matrix({share * motion.translation, share * motion.rotation});
      const Vector3 p = sphere.center + sphere.radius * random.direction();
      ASSERT_LE((H1 * p - H0 * p).norm(), share * bound * (1.0 + 1e-12));
    }
  }
}

}  // namespace
}  // namespace godobject
