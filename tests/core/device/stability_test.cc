#include "core/device/stability.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/LU>

#include "core/device/dynamics.h"
#include "tests/support/arms.h"

namespace godobject {
namespace {

using test::Arm;
using test::Random;

AxisLoop axis(double virtual_damping, double delay) {
  AxisLoop loop;
  loop.mass = 1.0;
  loop.damping = 2.0;
  loop.virtual_damping = virtual_damping;
  loop.timing.delay = delay;
  return loop;
}

/// K_crit [N/m] for m = 1 kg, b = 2 Ns/m, T = 1 ms, computed independently. 0: no stiffness is stable.
TEST(StabilityBoundary, IsTheTabulatedOne) {
  constexpr double kDamping[] = {0, 5, 10, 20, 50, 100, 200, 300, 400, 600};
  constexpr double kDelay[] = {0.5e-3, 1e-3, 2e-3};
  constexpr double kBoundary[3][10] = {{2001, 6968, 11885, 21571, 49440, 91977, 162703, 214874, 249153, 266530},
                                       {1334, 4643, 7916, 14349, 32755, 60431, 104359, 132703, 144989, 119132},
                                       {801, 2783, 4737, 8560, 19336, 34903, 56312, 63019, 52150, 0}};
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 10; ++k) {
      const double boundary = stability_boundary(axis(kDamping[k], kDelay[i]));
      EXPECT_NEAR(boundary, kBoundary[i][k], 1e-3 * kBoundary[i][k]) << kDamping[k] << " Ns/m, " << kDelay[i] << " s";
    }
  }
}

/// Largest B T/m without stiffness and without device damping.
TEST(DampingBoundary, IsTheTabulatedOne) {
  constexpr double kPeriods[] = {0.0, 0.5, 1.0, 1.5, 2.0, 3.0};
  constexpr double kBoundary[] = {2.00, 1.14, 0.83, 0.65, 0.54, 0.40};
  for (int i = 0; i < 6; ++i) {
    AxisLoop loop;
    loop.mass = 0.7;
    loop.timing = {2e-3, kPeriods[i] * 2e-3, 2};
    const double ratio = damping_boundary(loop) * loop.timing.period / loop.mass;
    EXPECT_NEAR(ratio, kBoundary[i], 0.02 * kBoundary[i]) << kPeriods[i];
  }
}

TEST(StabilityBoundary, FollowsTheLinearRuleWithoutVirtualDamping) {
  for (const double delay : {0.0, 0.3e-3, 0.5e-3, 1e-3, 1.7e-3, 2e-3, 3e-3}) {
    const double rule = 2.0 / (0.5e-3 + delay);
    // the rule is of first order in frequency times delay, which is at most 0.1 here
    EXPECT_NEAR(stability_boundary(axis(0.0, delay)), rule, 3e-3 * rule) << delay;
  }
}

TEST(StabilityBoundary, ChangesContinuouslyWithTheDelay) {
  for (const double whole : {1e-3, 2e-3, 3e-3}) {
    const double before = stability_boundary(axis(20.0, whole * (1.0 - 1e-9)));
    EXPECT_NEAR(stability_boundary(axis(20.0, whole)), before, 1e-5 * before);
    EXPECT_NEAR(stability_boundary(axis(20.0, whole * (1.0 + 1e-9))), before, 1e-5 * before);
  }
}

TEST(StabilityBoundary, DoesNotDependOnTheUnits) {
  // lengths cancel; the second loop has twice the mass and half the period
  AxisLoop loop = axis(20.0, 1e-3);
  const double boundary = stability_boundary(loop);
  loop.mass = 2.0;
  loop.timing = {0.5e-3, 0.5e-3, 2};
  loop.damping *= 4.0;
  loop.virtual_damping *= 4.0;
  EXPECT_NEAR(stability_boundary(loop), 8.0 * boundary, 1e-5 * 8.0 * boundary);
}

/// Simulates the loop in time: exact motion between changes of the force, in pieces of a period. Returns the growth of
/// the energy between the two halves of the run.
double growth(const AxisLoop& loop, double stiffness, int window) {
  constexpr int kPieces = 20;  // delays are multiples of a twentieth of the period
  const double step = loop.timing.period / kPieces;
  const double decay = std::exp(-loop.damping / loop.mass * step);
  const double travel = (1.0 - decay) * loop.mass / loop.damping;
  const int late = static_cast<int>(std::lround(loop.timing.delay / step));
  double x = 1e-3;
  double v = 0.0;
  double history[16];  // of the positions
  std::fill_n(history, 16, x);
  double forces[200] = {};  // the force that acts in each coming piece
  double halves[2] = {0.0, 0.0};
  constexpr int kCycles = 20000;
  for (int k = 0; k < kCycles; ++k) {
    std::copy_backward(history, history + 15, history + 16);
    history[0] = x;
    double velocity = 0.0;
    for (int age = 0; age < window; ++age) velocity += (0.5 * (window - 1) - age) * history[age];
    velocity *= 12.0 / (loop.timing.period * window * (window * window - 1.0));
    const double force = -stiffness * x - loop.virtual_damping * velocity;
    for (int i = 0; i < kPieces; ++i) forces[(k * kPieces + i + late) % 200] = force;
    for (int i = 0; i < kPieces; ++i) {
      const double f = forces[(k * kPieces + i) % 200] / loop.damping;  // terminal velocity
      x += f * step + (v - f) * travel;
      v = f + (v - f) * decay;
    }
    double& half = halves[k < kCycles / 2 ? 0 : 1];
    half = std::max(half, std::fabs(x));
  }
  return halves[1] / halves[0];
}

TEST(StabilityBoundary, DividesDecayFromGrowthInTime) {
  for (const double virtual_damping : {0.0, 20.0, 200.0}) {
    for (const double delay : {0.0, 0.25e-3, 1e-3, 1.85e-3}) {
      for (const int window : {2, 5}) {
        AxisLoop loop = axis(virtual_damping, delay);
        loop.timing.velocity_window = window;
        const double boundary = stability_boundary(loop);
        ASSERT_GT(boundary, 0.0);
        EXPECT_LT(growth(loop, 0.98 * boundary, window), 1.0) << virtual_damping << ", " << delay << ", " << window;
        EXPECT_GT(growth(loop, 1.02 * boundary, window), 1.0) << virtual_damping << ", " << delay << ", " << window;
      }
    }
  }
}

/// Returns an arm that is held at its tool. The damping is small: a stylus has an inertia of only 3e-5 kg m^2.
ArmLoop arm_loop(const Arm& arm, const JointVector& q) {
  const ArmKinematics kinematics = forward_kinematics(arm.model, q);
  ArmLoop loop;
  loop.joint_count = arm.model.joint_count;
  loop.mass = mass_matrix(arm.model, kinematics);
  for (int i = 0; i < arm.model.joint_count; ++i) {
    loop.damping[i] = arm.model.joints.at(static_cast<std::size_t>(i)).damping;
  }
  loop.jacobian = geometric_jacobian(kinematics, kinematics.H_RM.translation);
  loop.stiffness = 1000.0;
  loop.rotation_stiffness = 10.0;
  loop.tool_damping = 2.0;
  loop.rotation_tool_damping = 0.005;
  return loop;
}

TEST(ArmLoop, OneJointIsOneAxis) {
  for (const double delay : {0.0, 0.5e-3, 1e-3, 2.3e-3}) {
    AxisLoop single = axis(20.0, delay);
    ArmLoop arm;
    arm.joint_count = 1;
    const double lever = 0.25;
    arm.mass(0, 0) = lever * lever;
    arm.damping[0] = 2.0 * lever * lever;
    arm.jacobian(1, 0) = lever;
    arm.stiffness = 1.0;
    arm.tool_damping = 20.0;
    arm.timing = single.timing;
    const double boundary = stability_boundary(single);
    EXPECT_NEAR(stiffness_margin(arm), boundary, 1e-5 * boundary);
  }
}

TEST(ArmLoop, IndependentAxesAreAsStableAsTheWorst) {
  // three masses that move along x, y and z, and one that rotates
  ArmLoop arm;
  arm.joint_count = 4;
  arm.mass.diagonal().head<4>() << 1.0, 3.0, 0.5, 0.01;
  arm.damping.head<4>() << 2.0, 2.0, 2.0, 0.01;
  for (int i = 0; i < 4; ++i) arm.jacobian(i, i) = 1.0;
  arm.stiffness = 100.0;
  arm.rotation_stiffness = 1.0;
  arm.tool_damping = 10.0;
  arm.rotation_tool_damping = 0.1;
  double worst = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 4; ++i) {
    AxisLoop single;
    single.mass = arm.mass(i, i);
    single.damping = arm.damping[i];
    single.virtual_damping = i < 3 ? 10.0 : 0.1;
    worst = std::min(worst, stability_boundary(single) / (i < 3 ? 100.0 : 1.0));
  }
  EXPECT_NEAR(stiffness_margin(arm), worst, 1e-5 * worst);
}

TEST(ArmLoop, MarginDividesStableFromUnstable) {
  Random random(1);
  for (const Arm& arm : {test::lwr(), test::desktop6()}) {
    for (int i = 0; i < 10; ++i) {
      ArmLoop loop = arm_loop(arm, 0.7 * test::random_positions(random, arm.model));
      loop.timing.delay = random.between(0.0, 3e-3);
      const double margin = stiffness_margin(loop);
      ASSERT_GT(margin, 0.0);
      loop.stiffness *= 0.98 * margin;
      loop.rotation_stiffness *= 0.98 * margin;
      ASSERT_LT(spectral_radius(loop), 1.0);
      loop.stiffness *= 1.02 / 0.98;
      loop.rotation_stiffness *= 1.02 / 0.98;
      ASSERT_GT(spectral_radius(loop), 1.0);
    }
  }
}

TEST(ArmLoop, TurningTheWorldChangesNothing) {
  Random random(2);
  const Arm arm = test::lwr();
  for (int i = 0; i < 10; ++i) {
    ArmLoop loop = arm_loop(arm, test::random_positions(random, arm.model));
    const double radius = spectral_radius(loop);
    const Matrix3 R = exp_rotation(random.motion(0.0, 3.0).rotation).toRotationMatrix();
    loop.jacobian.topRows<3>() = (R * loop.jacobian.topRows<3>()).eval();
    loop.jacobian.bottomRows<3>() = (R * loop.jacobian.bottomRows<3>()).eval();
    EXPECT_NEAR(spectral_radius(loop), radius, 1e-10);
  }
}

TEST(ArmLoop, PassiveMeansStable) {
  Random random(3);
  const Arm arm = test::lwr();
  int passive = 0;
  for (int i = 0; i < 40; ++i) {
    ArmLoop loop = arm_loop(arm, test::random_positions(random, arm.model));
    loop.tool_damping = 0.0;
    loop.rotation_tool_damping = 0.0;
    loop.stiffness = std::pow(10.0, random.between(0.0, 4.0));
    loop.rotation_stiffness = 0.01 * loop.stiffness;
    if (passivity_excess(loop) <= 0.0) continue;
    ++passive;
    EXPECT_LT(spectral_radius(loop), 1.0) << i;
  }
  EXPECT_GT(passive, 5);
  EXPECT_LT(passive, 35);
}

TEST(ArmLoop, PassivityIsTheLinearRuleOnOneAxis) {
  ArmLoop loop;
  loop.joint_count = 1;
  loop.mass(0, 0) = 1.0;
  loop.damping[0] = 2.0;
  loop.jacobian(0, 0) = 1.0;
  loop.stiffness = 1000.0;
  EXPECT_NEAR(passivity_excess(loop), 2.0 - 1.5e-3 * 1000.0, 1e-12);
}

TEST(ArmLoop, RefusesWhatIsNoLoop) {
  const Arm arm = test::desktop6();
  const ArmLoop good = arm_loop(arm, JointVector::Constant(0.2));
  const auto radius_after = [&](auto change) {
    ArmLoop loop = good;
    change(loop);
    return spectral_radius(loop);
  };
  EXPECT_TRUE(std::isfinite(spectral_radius(good)));
  EXPECT_TRUE(std::isinf(radius_after([](ArmLoop& l) { l.joint_count = 0; })));
  EXPECT_TRUE(std::isinf(radius_after([](ArmLoop& l) { l.mass(0, 0) = 0.0; })));
  EXPECT_TRUE(std::isinf(radius_after([](ArmLoop& l) { l.mass(0, 1) = l.mass(1, 0) = 1e3; })));
  EXPECT_TRUE(std::isinf(radius_after([](ArmLoop& l) { l.jacobian(2, 2) = std::nan(""); })));
  EXPECT_TRUE(std::isinf(radius_after([](ArmLoop& l) { l.timing.period = 0.0; })));
  EXPECT_TRUE(std::isinf(radius_after([](ArmLoop& l) { l.timing.delay = -1e-3; })));
  EXPECT_TRUE(std::isinf(radius_after([](ArmLoop& l) { l.timing.velocity_window = 1; })));
}

/// Checks the promise of the device files: the springs at the position limits are stable on each joint alone, while the
/// other joints are free. So is the damping. The delay is a period and a half.
TEST(DeviceFiles, SpringsAndDampingAreStable) {
  Random random(4);
  for (const Arm& arm : {test::lwr(), test::desktop6()}) {
    const int n = arm.model.joint_count;
    JointVector inertia = JointVector::Constant(std::numeric_limits<double>::infinity());
    for (int i = 0; i < 2000; ++i) {
      const ArmKinematics kinematics = forward_kinematics(arm.model, test::random_positions(random, arm.model));
      const Eigen::MatrixXd M = mass_matrix(arm.model, kinematics).topLeftCorner(n, n);
      inertia.head(n) = inertia.head(n).cwiseMin(M.inverse().diagonal().cwiseInverse());
    }
    for (int i = 0; i < n; ++i) {
      AxisLoop loop;
      loop.mass = inertia[i];
      loop.damping = arm.model.joints.at(static_cast<std::size_t>(i)).damping;
      loop.timing.delay = 1.5e-3;
      EXPECT_LT(2.0 * arm.parameters.null_damping[i], damping_boundary(loop))
          << "joint " << i + 1 << ": " << inertia[i];
      EXPECT_LT(2.0 * arm.parameters.limit_damping[i], damping_boundary(loop)) << "joint " << i + 1;
      loop.virtual_damping = arm.parameters.limit_damping[i];
      EXPECT_LT(2.0 * arm.parameters.limit_stiffness[i], stability_boundary(loop)) << "joint " << i + 1;
      // on the way back only the joint's own damping acts; the rest comes from the hand
    }
  }
}

}  // namespace
}  // namespace godobject
