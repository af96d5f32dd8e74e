// The stability functions against the loop itself: one period is simulated in small steps for each state.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
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

/// Advances positions and velocities of M qdd + D qd = tau by `time`, in small Runge-Kutta steps. Columns are cases.
void advance(const Matrix& inverse_mass, const Matrix& damping, const Matrix& tau, double time, Matrix& q, Matrix& qd) {
  constexpr int kSteps = 200;  // D T/M is at most 3 here: the error is about (3/200)^5 a step
  const double h = time / kSteps;
  const auto acceleration = [&](const Matrix& v) -> Matrix { return inverse_mass * (tau - damping * v); };
  for (int step = 0; step < kSteps; ++step) {
    const Matrix a1 = acceleration(qd);
    const Matrix a2 = acceleration(qd + 0.5 * h * a1);
    const Matrix a3 = acceleration(qd + 0.5 * h * a2);
    const Matrix a4 = acceleration(qd + h * a3);
    q += h * qd + h * h / 6.0 * (a1 + a2 + a3);
    qd += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
  }
}

/// Returns the map of a period in joint coordinates. States: positions, velocities, the last torques (newest first, as
/// many as may still act), the last N - 1 positions.
Matrix simulated_map(const ArmLoop& loop) {
  const int n = loop.joint_count;
  const int window = loop.timing.velocity_window;
  const double T = loop.timing.period;
  const int whole = static_cast<int>(std::floor(loop.timing.delay / T));
  const double late = loop.timing.delay - whole * T;
  const int torques = whole + 1;
  const int size = n * (2 + torques + window - 1);
  const Matrix states = Matrix::Identity(size, size);
  const auto part = [&](int index) -> Matrix { return states.middleRows(n * index, n); };

  // the control law at the sample: positions from the newest to the oldest
  std::vector<Matrix> positions = {part(0)};
  for (int age = 1; age < window; ++age) positions.push_back(part(2 + torques + age - 1));
  Matrix velocity = Matrix::Zero(n, size);  // slope of the least-squares line
  double sum = 0.0;
  for (int age = 0; age < window; ++age) {
    const double time = (0.5 * (window - 1) - age) * T;
    velocity += time * positions[static_cast<std::size_t>(age)];
    sum += time * time;
  }
  velocity /= sum;
  const Matrix J = loop.jacobian.leftCols(n);
  Eigen::Matrix<double, 6, 1> k, b;
  k << loop.stiffness, loop.stiffness, loop.stiffness, loop.rotation_stiffness, loop.rotation_stiffness,
      loop.rotation_stiffness;
  b << loop.tool_damping, loop.tool_damping, loop.tool_damping, loop.rotation_tool_damping, loop.rotation_tool_damping,
      loop.rotation_tool_damping;
  const Matrix now = -J.transpose() * (k.asDiagonal() * J * positions[0] + b.asDiagonal() * J * velocity);

  std::vector<Matrix> sent = {now};  // by age
  for (int i = 0; i < torques; ++i) sent.push_back(part(2 + i));
  Matrix q = part(0);
  Matrix qd = part(1);
  const Matrix inverse_mass = Matrix(loop.mass.topLeftCorner(n, n)).inverse();
  const Matrix damping = loop.damping.head(n).asDiagonal();
  advance(inverse_mass, damping, sent[static_cast<std::size_t>(whole + 1)], late, q, qd);
  advance(inverse_mass, damping, sent[static_cast<std::size_t>(whole)], T - late, q, qd);

  Matrix map = Matrix::Zero(size, size);
  map.middleRows(0, n) = q;
  map.middleRows(n, n) = qd;
  for (int i = 0; i < torques; ++i) map.middleRows(n * (2 + i), n) = sent[static_cast<std::size_t>(i)];
  for (int i = 0; i + 1 < window; ++i) {
    map.middleRows(n * (2 + torques + i), n) = positions[static_cast<std::size_t>(i)];
  }
  // without units: the eigenvalue solver does not balance the matrix
  Eigen::VectorXd weight(size);
  const Eigen::VectorXd root = loop.mass.diagonal().head(n).cwiseSqrt();
  for (int i = 0; i < size / n; ++i) {
    const bool is_torque = i >= 2 && i < 2 + torques;
    if (is_torque) {
      weight.segment(n * i, n) = T * T * root.cwiseInverse();
    } else {
      weight.segment(n * i, n) = (i == 1 ? T : 1.0) * root;
    }
  }
  return weight.asDiagonal() * map * weight.cwiseInverse().asDiagonal();
}

/// Returns the largest eigenvalue modulus without the `fixed` eigenvalues of 1 that belong to positions which the tool
/// does not feel.
double simulated_radius(const ArmLoop& loop, int fixed) {
  const Eigen::VectorXcd values = test::eigenvalues_of(simulated_map(loop));
  std::vector<std::complex<double>> left(values.data(), values.data() + values.size());
  std::sort(left.begin(), left.end(), [](auto a, auto b) { return std::abs(a - 1.0) < std::abs(b - 1.0); });
  left.erase(left.begin(), left.begin() + fixed);
  double radius = 0.0;
  for (const std::complex<double>& value : left) radius = std::max(radius, std::abs(value));
  return radius;
}

/// Returns a loop of `n` joints whose Jacobian has the rank `rank`. Units and sizes are spread over decades.
ArmLoop random_loop(Random& random, int n, int rank) {
  ArmLoop loop;
  loop.joint_count = n;
  const double T = std::pow(10.0, random.between(-4.0, -2.0));
  loop.timing.period = T;
  const int delays = random.integer(0, 3);
  loop.timing.delay = random.integer(0, 2) == 0 ? delays * T : random.between(0.0, 3.0) * T;
  loop.timing.velocity_window = random.integer(2, 5);
  const auto fill = [&](Eigen::Index rows, Eigen::Index columns) {
    Matrix m(rows, columns);
    for (Eigen::Index i = 0; i < m.size(); ++i) m.data()[i] = random.between(-1.0, 1.0);
    return m;
  };
  const Matrix root = fill(n, n);
  Eigen::VectorXd unit(n);
  for (int i = 0; i < n; ++i) unit[i] = std::pow(10.0, random.between(-1.0, 1.0));
  loop.mass.topLeftCorner(n, n) =
      unit.asDiagonal() * (root * root.transpose() + 0.5 * Matrix::Identity(n, n)) * unit.asDiagonal();
  for (int i = 0; i < n; ++i) loop.damping[i] = random.between(0.01, 1.0) * unit[i] * unit[i] / T;
  loop.jacobian.leftCols(n) = fill(6, rank) * fill(rank, n) * unit.asDiagonal();
  loop.stiffness = std::pow(10.0, random.between(-2.0, 0.0)) / (T * T);
  loop.rotation_stiffness = std::pow(10.0, random.between(-2.0, 0.0)) / (T * T);
  loop.tool_damping = std::pow(10.0, random.between(-2.0, 0.0)) / T;
  loop.rotation_tool_damping = std::pow(10.0, random.between(-2.0, 0.0)) / T;
  return loop;
}

TEST(ArmLoop, HasTheSpectralRadiusOfItsSimulation) {
  Random random(1);
  int stable = 0;
  constexpr int kLoops = 80;
  for (int i = 0; i < kLoops; ++i) {
    const int n = random.integer(1, kMaxJoints);
    const int rank = random.integer(1, std::min(n, 6));
    const ArmLoop loop = random_loop(random, n, rank);
    const double radius = spectral_radius(loop);
    stable += radius < 1.0 ? 1 : 0;
    ASSERT_NEAR(radius, simulated_radius(loop, n - rank), 1e-6 * radius) << i << ": " << n << " joints, rank " << rank;
  }
  EXPECT_GT(stable, kLoops / 10);
  EXPECT_LT(stable, kLoops * 9 / 10);
}

/// The unit of length is free: the same arm in other units has the same radius. The search for the rank must not take a
/// small unit for a missing direction.
TEST(ArmLoop, DoesNotDependOnTheUnitOfLength) {
  Random random(2);
  for (int i = 0; i < 20; ++i) {
    ArmLoop loop = random_loop(random, 3, 3);
    const double radius = spectral_radius(loop);
    for (const double unit : {1e-7, 1e-3, 1e3, 1e7}) {
      ArmLoop other = loop;
      other.jacobian.topRows<3>() *= unit;
      other.stiffness /= unit * unit;
      other.tool_damping /= unit * unit;
      ASSERT_NEAR(spectral_radius(other), radius, 1e-6 * radius) << unit;
    }
  }
}

TEST(ArmLoop, MarginIsTheLargestStableFactorToAMillionth) {
  Random random(3);
  int found = 0;
  for (int i = 0; i < 60; ++i) {
    ArmLoop loop = random_loop(random, random.integer(1, 3), 1);
    loop.tool_damping *= 0.1;
    loop.rotation_tool_damping *= 0.1;
    const auto radius = [&](double factor) {
      ArmLoop stiffer = loop;
      stiffer.stiffness *= factor;
      stiffer.rotation_stiffness *= factor;
      return spectral_radius(stiffer);
    };
    const double margin = stiffness_margin(loop);
    if (margin == 0.0) {
      EXPECT_GE(radius(1e-3), 1.0);
      continue;
    }
    ++found;
    ASSERT_LT(radius(margin), 1.0);
    ASSERT_GE(radius(margin * (1.0 + 2e-6)), 1.0);
  }
  EXPECT_GT(found, 20);
}

/// A mass of 1 kg at 1 kHz without delay, with damping of 2 Ns/m: stable up to about 4000 N/m.
ArmLoop one_axis(double stiffness, double rotation_stiffness) {
  ArmLoop loop;
  loop.joint_count = 1;
  loop.mass(0, 0) = 1.0;
  loop.damping[0] = 2.0;
  loop.jacobian(0, 0) = rotation_stiffness > 0.0 ? 0.0 : 1.0;
  loop.jacobian(3, 0) = rotation_stiffness > 0.0 ? 1.0 : 0.0;
  loop.stiffness = stiffness;
  loop.rotation_stiffness = rotation_stiffness;
  loop.timing.delay = 0.0;
  return loop;
}

TEST(ArmLoop, MarginCoversWeakAndStrongSprings) {
  const double boundary = stiffness_margin(one_axis(1.0, 0.0));
  EXPECT_NEAR(boundary, 4000.0, 20.0);
  EXPECT_NEAR(stiffness_margin(one_axis(0.0, 1.0)), boundary, 1e-5 * boundary);
  EXPECT_EQ(stiffness_margin(one_axis(0.0, 0.0)), 0.0);
  EXPECT_EQ(stiffness_margin(one_axis(-1.0, 0.0)), 0.0);
  // stable at a thousandth, but not at all of it
  EXPECT_NEAR(stiffness_margin(one_axis(999.0 * boundary, 0.0)), 1.0 / 999.0, 1e-5 / 999.0);
  EXPECT_EQ(stiffness_margin(one_axis(1001.0 * boundary, 0.0)), 0.0);
  ArmLoop unmoved = one_axis(1.0, 0.0);
  unmoved.jacobian.setZero();
  EXPECT_EQ(stiffness_margin(unmoved), std::numeric_limits<double>::infinity());
}

TEST(ArmLoop, PassivityExcessIsTheSmallestEigenvalue) {
  Random random(4);
  for (int i = 0; i < 300; ++i) {
    const int n = random.integer(1, kMaxJoints);
    const ArmLoop loop = random_loop(random, n, random.integer(1, std::min(n, 6)));
    const double late = 0.5 * loop.timing.period + loop.timing.delay;
    Matrix excess = Matrix::Zero(n, n);
    for (int a = 0; a < n; ++a) {
      excess(a, a) = loop.damping[a];
      for (int c = 0; c < n; ++c) {
        for (int row = 0; row < 6; ++row) {
          const double k = row < 3 ? loop.stiffness : loop.rotation_stiffness;
          excess(a, c) -= late * k * loop.jacobian(row, a) * loop.jacobian(row, c);
        }
      }
    }
    const double expected = test::eigenvalues_of(excess).real().minCoeff();
    ASSERT_NEAR(passivity_excess(loop), expected, 1e-10 * excess.norm()) << i;
  }
}

TEST(ArmLoop, IsRefusedOneStepBeyondEachBound) {
  const ArmLoop good = one_axis(100.0, 0.0);
  const auto is_possible = [&](auto change) {
    ArmLoop loop = good;
    change(loop);
    return std::isfinite(spectral_radius(loop));
  };
  EXPECT_TRUE(is_possible([](ArmLoop&) {}));
  EXPECT_FALSE(is_possible([](ArmLoop& l) { l.joint_count = 0; }));
  EXPECT_FALSE(is_possible([](ArmLoop& l) { l.joint_count = kMaxJoints + 1; }));
  EXPECT_TRUE(is_possible([](ArmLoop& l) {
    l.joint_count = kMaxJoints;
    l.mass.setIdentity();
  }));
  EXPECT_FALSE(is_possible([](ArmLoop& l) { l.timing.period = 0.0; }));
  EXPECT_FALSE(is_possible([](ArmLoop& l) { l.timing.period = -1e-3; }));
  EXPECT_TRUE(is_possible([](ArmLoop& l) { l.timing.period = 1e-9; }));
  EXPECT_TRUE(is_possible([](ArmLoop& l) { l.timing.delay = 0.0; }));
  EXPECT_FALSE(is_possible([](ArmLoop& l) { l.timing.delay = -1e-300; }));
  EXPECT_TRUE(is_possible([](ArmLoop& l) { l.timing.delay = 99.9e-3; }));
  EXPECT_FALSE(is_possible([](ArmLoop& l) { l.timing.delay = 100.0 * l.timing.period; }));
  EXPECT_FALSE(is_possible([](ArmLoop& l) { l.timing.velocity_window = 1; }));
  EXPECT_TRUE(is_possible([](ArmLoop& l) { l.timing.velocity_window = 2; }));
  EXPECT_TRUE(is_possible([](ArmLoop& l) { l.timing.velocity_window = 100; }));
  EXPECT_FALSE(is_possible([](ArmLoop& l) { l.timing.velocity_window = 101; }));
  EXPECT_FALSE(is_possible([](ArmLoop& l) { l.mass(0, 0) = 0.0; }));
  EXPECT_FALSE(is_possible([](ArmLoop& l) { l.mass(0, 0) = -1.0; }));
  EXPECT_FALSE(is_possible([](ArmLoop& l) {  // the second joint has no mass of its own
    l.joint_count = 2;
    l.mass(1, 1) = 0.0;
  }));
  EXPECT_FALSE(is_possible([](ArmLoop& l) {  // positive on the diagonal, but not positive definite
    l.joint_count = 2;
    l.mass(1, 1) = 1.0;
    l.mass(0, 1) = l.mass(1, 0) = 1.1;
  }));
}

TEST(ArmLoop, IsRefusedWithAnyNumberThatIsNotFinite) {
  ArmLoop loop = one_axis(100.0, 0.0);
  std::vector<double*> numbers = {&loop.stiffness,     &loop.rotation_stiffness,
                                  &loop.tool_damping,  &loop.rotation_tool_damping,
                                  &loop.timing.period, &loop.timing.delay};
  numbers.insert(numbers.end(), {&loop.mass(0, 0), &loop.damping[0], &loop.jacobian(0, 0), &loop.jacobian(5, 0)});
  for (double* number : numbers) {
    const double good = *number;
    for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
      *number = bad;
      EXPECT_EQ(spectral_radius(loop), std::numeric_limits<double>::infinity());
    }
    *number = good;
  }
}

/// An axis is the arm of one joint with a lever of 1 m along x.
TEST(StabilityBoundary, IsTheMarginOfTheSameArm) {
  Random random(5);
  for (int i = 0; i < 30; ++i) {
    AxisLoop axis;
    axis.timing.period = std::pow(10.0, random.between(-4.0, -2.0));
    axis.timing.delay = random.between(0.0, 2.0) * axis.timing.period;
    axis.timing.velocity_window = random.integer(2, 6);
    axis.mass = std::pow(10.0, random.between(-3.0, 2.0));
    axis.damping = random.between(0.001, 0.1) * axis.mass / axis.timing.period;
    axis.virtual_damping = random.between(0.0, 0.2) * axis.mass / axis.timing.period;
    ArmLoop arm = one_axis(1e-3 * axis.mass / std::pow(axis.timing.period, 2), 0.0);
    arm.mass(0, 0) = axis.mass;
    arm.damping[0] = axis.damping;
    arm.tool_damping = axis.virtual_damping;
    arm.timing = axis.timing;
    const double boundary = stability_boundary(axis);
    ASSERT_NEAR(arm.stiffness * stiffness_margin(arm), boundary, 3e-6 * boundary) << i;
    // the damping boundary ignores `virtual_damping`
    const double damping = damping_boundary(axis);
    AxisLoop other = axis;
    other.virtual_damping = 17.0 * axis.virtual_damping;
    ASSERT_EQ(damping_boundary(other), damping);
    arm.stiffness = 1e-8 * axis.mass / std::pow(axis.timing.period, 2);
    arm.tool_damping = damping;
    ASSERT_LT(spectral_radius(arm), 1.0);
    arm.tool_damping = damping * (1.0 + 1e-5);
    ASSERT_GE(spectral_radius(arm), 1.0);
  }
}

TEST(LoopTiming, BeginsWithTheStatedNumbers) {
  const LoopTiming timing;
  EXPECT_EQ(timing.period, 1e-3);
  EXPECT_EQ(timing.delay, 1e-3);
  EXPECT_EQ(timing.velocity_window, 2);
  const AxisLoop axis;
  EXPECT_EQ(axis.mass, 1.0);
  EXPECT_EQ(axis.damping, 0.0);
  EXPECT_EQ(axis.virtual_damping, 0.0);
  const ArmLoop arm;
  EXPECT_EQ(arm.joint_count, 0);
  EXPECT_EQ(arm.stiffness + arm.rotation_stiffness, 0.0);
  EXPECT_EQ(arm.tool_damping + arm.rotation_tool_damping, 0.0);
}

}  // namespace
}  // namespace godobject
