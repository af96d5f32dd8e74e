// The stability functions against mechanics of one axis: the roots of its characteristic polynomial, and closed forms.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "core/device/stability.h"
#include "tests/support/decompositions.h"
#include "tests/support/random.h"

namespace godobject {
namespace {

using test::Random;
using Matrix = Eigen::MatrixXd;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// An axis in units of its mass and period: b T/m, B T/m, K T^2/m, t_d/T.
struct UnitAxis {
  double damping = 0.0;
  double virtual_damping = 0.0;
  double stiffness = 0.0;
  double delay = 0.0;
  int window = 2;
};

/// Returns the largest root of the axis' characteristic polynomial. The plant's answer to a pulse of one period, late
/// by a fraction f, follows from the answer to a step, x'' + d x' = 1. Times the plant's denominator (z - 1)(z - e^-d)
/// it is a polynomial of three terms.
double largest_root(const UnitAxis& axis) {
  const double d = axis.damping;
  const auto step = [&](double t) {
    if (t <= 0.0) return 0.0;
    return d == 0.0 ? 0.5 * t * t : (d * t + std::expm1(-d * t)) / (d * d);
  };
  const int whole = static_cast<int>(std::floor(axis.delay));
  const double f = axis.delay - whole;
  const double decay = std::exp(-d);
  double pulse[4] = {};
  for (int i = 1; i < 4; ++i) pulse[i] = step(i - f) - step(i - 1 - f);
  const double plant[3] = {1.0, -1.0 - decay, decay};
  double answer[3];
  for (int i = 0; i < 3; ++i) {
    answer[i] = plant[0] * pulse[i + 1] + plant[1] * pulse[i] + (i > 0 ? plant[2] * pulse[i - 1] : 0.0);
  }

  // coefficients of z^degree .. z^0
  const int N = axis.window;
  const int degree = whole + N + 2;
  std::vector<double> polynomial(static_cast<std::size_t>(degree) + 1, 0.0);
  for (std::size_t i = 0; i < 3; ++i) polynomial[i] += plant[i];
  for (int age = 0; age < N; ++age) {
    const double slope = 12.0 / (N * (N * N - 1.0)) * (0.5 * (N - 1.0) - age);
    const double law = axis.virtual_damping * slope + (age == 0 ? axis.stiffness : 0.0);
    for (int i = 0; i < 3; ++i) polynomial[static_cast<std::size_t>(whole + 1 + age + i)] += answer[i] * law;
  }
  Matrix companion = Matrix::Zero(degree, degree);
  for (int i = 0; i < degree; ++i) companion(0, i) = -polynomial[static_cast<std::size_t>(i) + 1];
  companion.block(1, 0, degree - 1, degree - 1).setIdentity();
  return test::eigenvalues_of(companion).cwiseAbs().maxCoeff();
}

/// The friction may end a motion within a small part of the period: d up to 300.
UnitAxis random_axis(Random& random) {
  UnitAxis axis;
  axis.damping = std::pow(10.0, random.between(-1.0, 2.5));
  axis.virtual_damping = random.integer(0, 3) == 0 ? 0.0 : std::pow(10.0, random.between(-1.0, 0.5));
  axis.stiffness = std::pow(10.0, random.between(-1.0, 0.5));
  axis.delay = random.integer(0, 2) == 0 ? random.integer(0, 3) : random.between(0.0, 3.0);
  axis.window = random.integer(2, 6);
  return axis;
}

/// An axis of mass m [kg] and period T [s], along the row `row` of the Jacobian.
ArmLoop arm_of(const UnitAxis& axis, double m, double T, int row) {
  ArmLoop loop;
  loop.joint_count = 1;
  loop.mass(0, 0) = m;
  loop.damping[0] = axis.damping * m / T;
  loop.jacobian(row, 0) = 1.0;
  (row < 3 ? loop.stiffness : loop.rotation_stiffness) = axis.stiffness * m / (T * T);
  (row < 3 ? loop.tool_damping : loop.rotation_tool_damping) = axis.virtual_damping * m / T;
  loop.timing = {T, axis.delay * T, axis.window};
  return loop;
}

TEST(SpectralRadius, IsTheLargestRootOfOneAxis) {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const UnitAxis axis = random_axis(random);
    const double expected = largest_root(axis);
    // the period is a power of two: no rounding moves the delay into another period
    const double T = std::ldexp(1.0, random.integer(-13, -6));
    const ArmLoop arm = arm_of(axis, std::pow(10.0, random.between(-3.0, 2.0)), T, random.integer(0, 5));
    ASSERT_NEAR(spectral_radius(arm), expected, 1e-9 * expected)
        << i << ": b " << axis.damping << ", B " << axis.virtual_damping << ", K " << axis.stiffness << ", t_d "
        << axis.delay << ", N " << axis.window;
  }
}

/// Without delay and virtual damping the map is 2 x 2: x' = x + c v - s k x, v' = e v - c k x with c = (1 - e)/d and
/// s = (d - 1 + e)/d^2. Its eigenvalues are a conjugate pair. At the boundary its determinant, e + k (c^2 - e s), is 1.
TEST(StabilityBoundary, HasAClosedFormWithoutDelay) {
  for (const double d : {0.01, 0.1, 0.3, 0.7, 1.0, 1.7, 2.5}) {
    const double e = std::exp(-d);
    const double c = (1.0 - e) / d;
    const double s = (d - 1.0 + e) / (d * d);
    const double expected = (1.0 - e) / (c * c - e * s);
    const double trace = 1.0 + e - expected * s;
    ASSERT_LT(std::fabs(trace), 2.0) << "the eigenvalues are no pair";
    AxisLoop axis;
    axis.mass = 0.3;
    axis.timing = {2e-3, 0.0, 2};
    axis.damping = d * axis.mass / axis.timing.period;
    const double boundary = stability_boundary(axis) * axis.timing.period * axis.timing.period / axis.mass;
    EXPECT_LE(boundary, expected * (1.0 + 1e-11)) << d;
    EXPECT_GE(boundary, expected * (1.0 - 1e-6)) << d;
  }
}

/// The search begins with a spring of 1e-8 m/T^2. The linear rule is exact for such slow loops: K = b / (T/2).
TEST(StabilityBoundary, IsZeroBelowTheSoftestSpring) {
  AxisLoop axis;
  axis.mass = 2.0;
  axis.timing = {1e-3, 0.0, 2};
  const double softest = 1e-8 * axis.mass / (axis.timing.period * axis.timing.period);
  axis.damping = 0.5 * axis.timing.period * 1.2 * softest;
  EXPECT_NEAR(stability_boundary(axis), 1.2 * softest, 1e-3 * softest);
  axis.damping = 0.5 * axis.timing.period * 0.8 * softest;
  EXPECT_EQ(stability_boundary(axis), 0.0);
}

/// Six axes in mass-normalised coordinates, turned by an orthogonal matrix: the arm is as bad as the worst. Rows of the
/// Jacobian that no axis uses are zero, so the rank and the number of joints vary.
TEST(ArmLoop, IsAsBadAsItsWorstAxisInAnyCoordinates) {
  Random random(2);
  for (int i = 0; i < 60; ++i) {
    const bool has_friction = i % 2 == 0;
    const int rank = random.integer(1, 6);
    const int n = has_friction ? random.integer(rank, kMaxJoints) : rank;
    UnitAxis translation = random_axis(random);
    translation.damping = has_friction ? random.between(0.05, 1.0) : 0.0;
    UnitAxis rotation = translation;
    rotation.stiffness *= random.between(0.2, 1.0);
    rotation.virtual_damping *= random.between(0.2, 1.0);
    const double T = std::ldexp(1.0, -10);
    Matrix drawn(n, n);
    for (Eigen::Index k = 0; k < drawn.size(); ++k) drawn.data()[k] = random.between(-1.0, 1.0);
    const Matrix turned = Eigen::HouseholderQR<Matrix>(drawn).householderQ();
    // friction in proportion to the mass needs a diagonal mass matrix; without friction it may be any
    Matrix root = Matrix::Zero(n, n);
    for (int row = 0; row < n; ++row) {
      root(row, row) = std::pow(10.0, random.between(-1.0, 1.0));
      for (int column = 0; !has_friction && column < row; ++column) root(row, column) = random.between(-1.0, 1.0);
    }
    ArmLoop loop = arm_of(translation, 1.0, T, 0);
    loop.joint_count = n;
    loop.rotation_stiffness = rotation.stiffness / (T * T);
    loop.rotation_tool_damping = rotation.virtual_damping / T;
    loop.jacobian.setZero();
    const Matrix mass = root * root.transpose();
    loop.mass.topLeftCorner(n, n) = mass;
    for (int k = 0; k < n; ++k) loop.damping[k] = translation.damping / T * mass(k, k);
    double worst = n > rank ? std::exp(-translation.damping) : 0.0;
    const int first = random.integer(0, 6 - rank);
    for (int k = 0; k < rank; ++k) {
      const double lever = random.between(0.5, 1.0);
      loop.jacobian.row(first + k).head(n) = lever * turned.row(k) * root.transpose();
      UnitAxis axis = first + k < 3 ? translation : rotation;
      axis.stiffness *= lever * lever;
      axis.virtual_damping *= lever * lever;
      worst = std::max(worst, largest_root(axis));
    }
    ASSERT_NEAR(spectral_radius(loop), worst, 1e-8 * worst) << i << ": " << n << " joints, rank " << rank;
  }
}

/// Two joints move the tool along x and y, the second one hardly. Down to a share of 1e-9 the spring has to hold that
/// position, slowly: its radius is close to 1. A smaller share counts as none; then only the joint's friction acts.
TEST(ArmLoop, HasNoRowForAShareBelowABillionth) {
  ArmLoop loop;
  loop.joint_count = 2;
  loop.mass.diagonal().head<2>().setOnes();
  loop.damping.head<2>().setConstant(200.0);  // e^-0.2 a period
  loop.jacobian(0, 0) = 1.0;
  loop.stiffness = 1e4;  // well damped
  loop.timing = {1e-3, 0.0, 2};
  for (const double share : {1e-3, 1e-6, 1e-8, 1.5e-9}) {
    loop.jacobian(1, 1) = share;
    EXPECT_GT(spectral_radius(loop), 1.0 - 1e-6) << share;
  }
  for (const double share : {0.7e-9, 1e-10, 1e-12, 0.0}) {
    loop.jacobian(1, 1) = share;
    EXPECT_LT(spectral_radius(loop), 0.97) << share;
  }
}

TEST(ArmLoop, IsRefusedWithoutAWindowAndWithTooManyJoints) {
  UnitAxis axis;
  axis.damping = 0.1;
  axis.stiffness = 0.1;
  const ArmLoop good = arm_of(axis, 1.0, 1e-3, 0);
  ASSERT_LT(spectral_radius(good), 1.0);
  ArmLoop loop = good;
  for (const int window : {1, 0, -1, -100, 101}) {
    loop.timing.velocity_window = window;
    EXPECT_EQ(spectral_radius(loop), kInfinity) << window;
  }
  loop = good;
  loop.mass.setIdentity();
  loop.jacobian.setConstant(0.5);
  loop.damping.setZero();  // so that the numbers behind the mass matrix would pass for an eighth joint
  loop.joint_count = kMaxJoints;
  EXPECT_TRUE(std::isfinite(spectral_radius(loop)));
  for (const int joints : {kMaxJoints + 1, 0, -1}) {
    loop.joint_count = joints;
    EXPECT_EQ(spectral_radius(loop), kInfinity) << joints;
  }
}

/// Every number counts: the entries of joints that the arm does not have, and the springs of a tool that does not move.
TEST(ArmLoop, IsRefusedWithAnyNumberThatIsNotFiniteEvenIfItActsOnNothing) {
  UnitAxis axis;
  axis.damping = 0.1;
  ArmLoop loop = arm_of(axis, 1.0, 1e-3, 0);
  loop.jacobian.setZero();
  ASSERT_LT(spectral_radius(loop), 1.0);
  std::vector<double*> numbers = {&loop.stiffness, &loop.rotation_stiffness, &loop.tool_damping,
                                  &loop.rotation_tool_damping};
  numbers.insert(numbers.end(), {&loop.mass(0, 1), &loop.mass(6, 6), &loop.damping[1], &loop.damping[6],
                                 &loop.jacobian(0, 1), &loop.jacobian(5, 6), &loop.jacobian(4, 0)});
  for (double* number : numbers) {
    const double before = *number;
    for (const double bad : {std::nan(""), kInfinity, -kInfinity}) {
      *number = bad;
      EXPECT_EQ(spectral_radius(loop), kInfinity);
    }
    *number = before;
  }
  EXPECT_LT(spectral_radius(loop), 1.0);
}

TEST(ArmLoop, IsRefusedIfAMassOnTheDiagonalIsNotPositive) {
  ArmLoop loop;
  loop.joint_count = 3;
  loop.mass.diagonal().head<3>().setOnes();
  loop.damping.setConstant(10.0);
  ASSERT_LT(spectral_radius(loop), 1.0);
  for (int joint = 0; joint < 3; ++joint) {
    for (const double mass : {0.0, -1e-300, -1.0}) {
      loop.mass(joint, joint) = mass;
      EXPECT_EQ(spectral_radius(loop), kInfinity) << joint << ", " << mass;
    }
    loop.mass(joint, joint) = 1.0;
  }
}

}  // namespace
}  // namespace godobject
