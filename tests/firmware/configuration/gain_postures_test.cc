// Compares the gain checks with the stability of each posture that they say they look at.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/device/dynamics.h"
#include "core/device/kinematics.h"
#include "firmware/configuration/gain_check.h"
#include "tests/support/arms.h"
#include "tests/support/decompositions.h"
#include "tests/support/small_scenes.h"
#include "toolchain/command_line/failure.h"

namespace godobject::firmware::gain_postures_test {
namespace {

/// The digits of `index` in this base, mirrored at the point: 6 = 110 in base 2 becomes 0.011 = 3/8.
double mirrored(int index, int base) {
  int digits = 0;
  int places = 1;
  for (; index > 0; index /= base, places *= base) digits = digits * base + index % base;
  return static_cast<double>(digits) / places;
}

TEST(GainPostures, MirrorDigitsAtThePoint) {
  EXPECT_EQ(mirrored(6, 2), 3.0 / 8.0);
  EXPECT_EQ(mirrored(5, 3), 7.0 / 9.0);  // 12 becomes 0.21
}

/// The gain checks' postures: the given one, then 60 of Halton's sequence within 0.5 rad and the limits.
std::vector<JointVector> postures_about(const ArmModel& arm, const JointVector& posture) {
  const std::array<int, kMaxJoints> primes = {2, 3, 5, 7, 11, 13, 17};
  std::vector<JointVector> postures{posture};
  for (int index = 1; index <= 60; ++index) {
    JointVector q = posture;
    for (int i = 0; i < arm.joint_count; ++i) {
      const ArmJoint& joint = arm.joints.at(static_cast<std::size_t>(i));
      const double low = posture[i] - 0.5 < joint.lower ? joint.lower : posture[i] - 0.5;
      const double high = posture[i] + 0.5 > joint.upper ? joint.upper : posture[i] + 0.5;
      q[i] = low + mirrored(index, primes.at(static_cast<std::size_t>(i))) * (high - low);
    }
    postures.push_back(q);
  }
  return postures;
}

/// An arm of few joints, which is quick, some of them near their limits, and a ball that is held beside its centre.
class GainPosturesTest : public testing::Test {
 protected:
  GainPosturesTest() : image_(test::ball_over_plate()), scene_(test::open_scene(image_)) {
    test::Random random(4);
    arm_ = test::random_arm(random, 4);
    for (std::size_t i = 0; i < 4; ++i) arm_.model.joints[i].damping = 0.5 + 0.1 * static_cast<double>(i);
    posture_.head<4>() << 0.3, -0.2, 0.4, -0.1;
    arm_.model.joints[0].upper = 0.5;
    arm_.model.joints[1].lower = -0.3;
    scene_.settings.stiffness = 500.0;
    scene_.settings.damping = 2.0;
    scene_.settings.coupling_rotation = 0.003;
    scene_.H_MB.translation = Vector3(0.03, -0.05, 0.02);
  }

  ArmLoop loop_at(const JointVector& q, double stiffness, double damping, double rotation_damping) const {
    const double square = kScale * kScale;
    const ArmKinematics kinematics = forward_kinematics(arm_.model, q);
    ArmLoop loop;
    loop.joint_count = 4;
    loop.mass = mass_matrix(arm_.model, kinematics);
    for (int i = 0; i < 4; ++i) loop.damping[i] = arm_.model.joints.at(static_cast<std::size_t>(i)).damping;
    loop.jacobian = geometric_jacobian(kinematics, kinematics.H_RM * Vector3(scene_.H_MB.translation / kScale));
    loop.stiffness = square * stiffness;
    loop.rotation_stiffness = 0.003 * stiffness;
    loop.tool_damping = square * 2.0 + damping;
    loop.rotation_tool_damping = 0.003 * 2.0 + rotation_damping;
    loop.timing = timing_;
    return loop;
  }

  /// The posture with the largest spectral radius at 1.5 times the stiffness.
  JointVector worst(double damping, double rotation_damping) const {
    JointVector found = posture_;
    double largest = -1.0;
    for (const JointVector& q : postures_about(arm_.model, posture_)) {
      const double radius = spectral_radius(loop_at(q, 1.5 * 500.0, damping, rotation_damping));
      if (radius > largest) found = q;
      largest = std::max(largest, radius);
    }
    return found;
  }

  static constexpr double kScale = 1.5;
  test::Arm arm_;
  test::SceneImage image_;
  SceneView scene_;
  JointVector posture_ = JointVector::Zero();
  LoopTiming timing_{1e-3, 1.2e-3, 3};
};

TEST_F(GainPosturesTest, AreWithinTheSpreadAndTheLimitsAndAllDifferent) {
  const std::vector<JointVector> postures = postures_about(arm_.model, posture_);
  for (const JointVector& q : postures) {
    EXPECT_LE((q - posture_).cwiseAbs().maxCoeff(), 0.5);
    EXPECT_LE(q[0], 0.5);
    EXPECT_GE(q[1], -0.3);
  }
}

TEST_F(GainPosturesTest, GiveTheMarginOfTheWorstOfThem) {
  const GainReport report = check_gains(scene_, arm_.model, posture_, kScale, timing_);
  double excess = HUGE_VAL;
  for (const JointVector& q : postures_about(arm_.model, posture_)) {
    excess = std::min(excess, passivity_excess(loop_at(q, 500.0, 0.0, 0.0)));
  }
  EXPECT_NEAR(report.passivity_excess, excess, 1e-9 * std::fabs(excess));
  const JointVector q = worst(0.0, 0.0);
  EXPECT_LT((report.posture - q).norm(), 1e-12) << report.posture.transpose() << " instead of " << q.transpose();
  EXPECT_NEAR(report.margin, stiffness_margin(loop_at(q, 500.0, 0.0, 0.0)), 1e-5 * report.margin);
  EXPECT_EQ(report.joint_count, 4);
  EXPECT_NEAR(report.coupling_gyration, std::sqrt(0.003), 1e-12);
}

TEST_F(GainPosturesTest, BoundTheDampingThatMayBeInjected) {
  constexpr double kLength = 0.2;
  const double margin = stiffness_margin(loop_at(worst(0.0, 0.0), 500.0, 0.0, 0.0));
  const double least = 0.5 * margin;
  const auto refused = [&](double most) {
    try {
      require_stable_injection(scene_, arm_.model, posture_, kScale, timing_, {most, kLength}, least);
    } catch (const command::Failure& failure) {
      EXPECT_EQ(failure.exit_code(), command::ExitCode::kBadConfig);
      return std::string(failure.what());
    }
    return std::string();
  };
  const auto is_stable = [&](const JointVector& q, double damping) {
    return stiffness_margin(loop_at(q, 500.0, damping, damping * kLength * kLength)) >= least;
  };
  double asked = 1.0;
  while (refused(asked).empty()) {
    EXPECT_TRUE(is_stable(worst(asked, asked * kLength * kLength), asked)) << asked;
    asked *= 2.0;
    ASSERT_LT(asked, 1e6);
  }
  const JointVector q = worst(asked, asked * kLength * kLength);
  EXPECT_FALSE(is_stable(q, asked));
  const std::string message = refused(asked);
  const std::string before = "set it to at most ";
  ASSERT_NE(message.find(before), std::string::npos) << message;
  const double most = std::stod(message.substr(message.find(before) + before.size()));
  // twelve halvings of `asked`, and three digits in the message
  EXPECT_TRUE(is_stable(q, most - asked / 4096.0 - 0.006 * most)) << message;
  EXPECT_FALSE(is_stable(q, most + asked / 4096.0 + 0.006 * most)) << message;
  EXPECT_EQ(message.rfind(fmt::format("passivity.damping = {:g} Ns/m and 4.5 Ns/m of gains.damping leave less than "
                                      "gains.margin = {:g} to the stability boundary: set it to at most ",
                                      asked, least),
                          0),
            0u)
      << message;
}

/// Each joint alone, at its smallest apparent inertia over the postures.
TEST_F(GainPosturesTest, BoundTheFeedbackOfEachJoint) {
  JointVector inertia = JointVector::Constant(HUGE_VAL);
  for (const JointVector& q : postures_about(arm_.model, posture_)) {
    const Eigen::MatrixXd mass = mass_matrix(arm_.model, forward_kinematics(arm_.model, q)).topLeftCorner(4, 4);
    for (int i = 0; i < 4; ++i) {
      // all others free: Schur complement of their block
      Eigen::MatrixXd rest(3, 3);
      Eigen::VectorXd coupling(3);
      for (int a = 0, r = 0; a < 4; ++a) {
        if (a == i) continue;
        coupling[r] = mass(a, i);
        for (int b = 0, c = 0; b < 4; ++b) {
          if (b != i) rest(r, c++) = mass(a, b);
        }
        ++r;
      }
      inertia[i] = std::min(inertia[i], mass(i, i) - coupling.dot(test::least_squares(rest, coupling)));
    }
  }
  const auto refused = [&](const JointTorqueParameters& control) {
    try {
      require_stable_joints(arm_.model, control, posture_, timing_);
    } catch (const command::Failure& failure) {
      EXPECT_EQ(failure.exit_code(), command::ExitCode::kBadConfig);
      return std::string(failure.what());
    }
    return std::string();
  };
  JointTorqueParameters none;
  none.null_damping.setZero();
  none.limit_damping.setZero();
  none.limit_stiffness.setZero();
  EXPECT_EQ(refused(none), "");
  for (int i = 0; i < 4; ++i) {
    AxisLoop axis{.mass = inertia[i],
                  .damping = arm_.model.joints.at(static_cast<std::size_t>(i)).damping,
                  .virtual_damping = 0.0,
                  .timing = timing_};
    const double damping = damping_boundary(axis);
    for (const double share : {0.0, 0.3, 1.0}) {  // of both dampings together
      JointTorqueParameters control = none;
      control.null_damping[i] = 0.999 * share * damping;
      control.limit_damping[i] = 0.999 * (1.0 - share) * damping;
      EXPECT_EQ(refused(control), "") << i;
      control.null_damping[i] = 1.001 * share * damping;
      control.limit_damping[i] = 1.001 * (1.0 - share) * damping;
      EXPECT_EQ(refused(control),
                fmt::format("device: joint {} has null_damping and limit_damping of {:.4g} Nms/rad; with {:.3g} kg m^2 "
                            "and this delay it is stable only below {:.4g}: lower it",
                            i + 1, 1.001 * damping, inertia[i], damping));
    }
    for (const double share : {0.0, 0.4}) {
      axis.virtual_damping = share * damping;
      const double stiffness = stability_boundary(axis);
      JointTorqueParameters control = none;
      control.null_damping[i] = axis.virtual_damping;
      control.limit_stiffness[i] = 0.999 * stiffness;
      EXPECT_EQ(refused(control), "") << i;
      control.limit_stiffness[i] = 1.001 * stiffness;
      EXPECT_EQ(refused(control),
                fmt::format("device: joint {} has limit_stiffness of {:.4g} Nm/rad; with {:.3g} kg m^2 and this delay "
                            "it is stable only below {:.4g}: lower it",
                            i + 1, 1.001 * stiffness, inertia[i], stiffness));
    }
  }
}

/// A report of a stable and passive coupling whose rotations count as those of the body.
GainReport good_report() {
  GainReport report;
  report.margin = 2.0;
  report.posture = JointVector::Zero();
  report.joint_count = 1;
  report.passivity_excess = 0.25;
  report.gyration = 0.1;
  report.coupling_gyration = 0.1;
  return report;
}

const FeltCoupling kFelt{2000.0, 6.0, 5.0, 0.015};

std::string refusal(const GainReport& report, double least) {
  try {
    judge_gains(report, kFelt, least);
  } catch (const command::Failure& failure) {
    EXPECT_EQ(failure.exit_code(), command::ExitCode::kBadConfig);
    return failure.what();
  }
  return {};
}

TEST(GainVerdict, RefusesBelowTheLeastMarginAndNotAtIt) {
  GainReport report = good_report();
  EXPECT_EQ(refusal(report, 2.0), "");
  EXPECT_EQ(refusal(report, 2.5),
            "gains: the hand would feel 2000 N/m and 6 Nm/rad; the stability boundary is 4000 N/m and 12 Nm/rad at "
            "joint positions 0.00 [rad], a factor of 2, and gains.margin is 2.5: lower gains.stiffness to 0.78 of its "
            "value, or lower gains.rotational or workspace.scale");  // 0.98 * 2 / 2.5 = 0.784
  EXPECT_NE(refusal(report, std::nextafter(2.0, 3.0)), "");
  const std::string none =
      "gains: with 5 Ns/m and 0.015 Nms/rad of virtual damping no stiffness is stable at joint positions 0.00 [rad]: "
      "lower gains.damping or gains.rotational";
  for (const double margin : {0.0, -1.0, std::nan("")}) {
    report.margin = margin;
    EXPECT_EQ(refusal(report, 1.0), none);
  }
  report.margin = 1e-3;
  EXPECT_NE(refusal(report, 1.0), none);
  EXPECT_NE(refusal(report, 1.0), "");
  report.margin = 2.0;
  EXPECT_NE(refusal(report, std::nan("")), "") << "not comparable is not enough";
}

TEST(GainVerdict, WarnsWhereItIsNotPassive) {
  GainReport report = good_report();
  EXPECT_TRUE(judge_gains(report, kFelt, 1.0).empty());
  report.passivity_excess = 1e-12;
  EXPECT_TRUE(judge_gains(report, kFelt, 1.0).empty());
  for (const double excess : {0.0, -0.125, std::nan("")}) {
    report.passivity_excess = excess;
    ASSERT_EQ(judge_gains(report, kFelt, 1.0).size(), 1u) << excess;
  }
  report.passivity_excess = -0.125;
  EXPECT_EQ(judge_gains(report, kFelt, 1.0)[0],
            "stable by a factor of 2, but not passive by the linear rule: a joint lacks 0.125 Nms/rad of damping");
}

TEST(GainVerdict, WarnsWhereARadianCountsLessThanHalfOrMoreThanTwice) {
  GainReport report = good_report();
  report.gyration = 0.25;
  for (const double good : {0.125, 0.25, 0.5}) {
    report.coupling_gyration = good;
    EXPECT_TRUE(judge_gains(report, kFelt, 1.0).empty()) << good;
  }
  report.coupling_gyration = 0.1249;
  ASSERT_EQ(judge_gains(report, kFelt, 1.0).size(), 1u);
  EXPECT_EQ(judge_gains(report, kFelt, 1.0)[0],
            "gains.rotational counts a radian as 0.125 m, the moving body's radius of gyration is 0.25 m: rotations "
            "yield too much compared with translations");
  report.coupling_gyration = 0.5001;
  ASSERT_EQ(judge_gains(report, kFelt, 1.0).size(), 1u);
  EXPECT_NE(judge_gains(report, kFelt, 1.0)[0].find("0.5 m, the moving body's radius of gyration is 0.25 m: rotations "
                                                    "yield too little"),
            std::string::npos);
}

TEST_F(GainPosturesTest, CouplingIsFeltWithTheSquareOfTheScale) {
  const FeltCoupling felt = FeltCoupling::of(scene_, 3.0);
  EXPECT_NEAR(felt.stiffness, 9.0 * 500.0, 1e-9);
  EXPECT_NEAR(felt.rotation_stiffness, 0.003 * 500.0, 1e-12);
  EXPECT_NEAR(felt.damping, 9.0 * 2.0, 1e-12);
  EXPECT_NEAR(felt.rotation_damping, 0.003 * 2.0, 1e-12);
}

}  // namespace
}  // namespace godobject::firmware::gain_postures_test
