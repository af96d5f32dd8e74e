#include "firmware/configuration/gain_check.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "core/device/dynamics.h"
#include "core/device/kinematics.h"
#include "tests/support/arms.h"
#include "tests/support/small_scenes.h"
#include "toolchain/command_line/failure.h"

namespace godobject::firmware::gain_check_test {
namespace {

class GainCheckTest : public testing::Test {
 protected:
  GainCheckTest() : image_(test::ball_over_plate()), scene_(test::open_scene(image_)) {
    posture_ << 0.0, -0.5, 0.0, 1.4, 0.0, -1.2, 0.0;
    scene_.settings.damping = 5.0;
    scene_.settings.coupling_rotation = 0.003;
  }

  GainReport check(double scale = 1.0) const { return check_gains(scene_, arm_.model, posture_, scale, timing_); }

  std::string refusal(const GainReport& report, double least) const {
    try {
      judge_gains(report, FeltCoupling::of(scene_, 1.0), least);
    } catch (const command::Failure& failure) {
      EXPECT_EQ(failure.exit_code(), command::ExitCode::kBadConfig);
      return failure.what();
    }
    return {};
  }

  test::Arm arm_ = test::lwr();
  test::SceneImage image_;
  SceneView scene_;
  JointVector posture_ = JointVector::Zero();
  LoopTiming timing_{1e-3, 1e-3, 2};
};

TEST(GainReport, SaysNothingBeforeTheCheck) {
  const GainReport report;
  EXPECT_EQ(report.margin, 0.0) << "so that a check that was left out does not pass";
  EXPECT_EQ(report.joint_count, 0);
  EXPECT_EQ(report.passivity_excess, 0.0);
  EXPECT_EQ(report.gyration, 0.0);
  EXPECT_EQ(report.coupling_gyration, 0.0);
  const FeltCoupling felt;
  EXPECT_EQ(felt.stiffness, 0.0);
  EXPECT_EQ(felt.rotation_stiffness, 0.0);
  EXPECT_EQ(felt.damping, 0.0);
  EXPECT_EQ(felt.rotation_damping, 0.0);
  const InjectedDamping injected;
  EXPECT_EQ(injected.most, 0.0);
  EXPECT_EQ(injected.rotation_length, 0.1);
}

TEST_F(GainCheckTest, RefusesJointsWhoseOwnFeedbackIsBeyondTheBoundary) {
  require_stable_joints(arm_.model, arm_.parameters, posture_, timing_);
  const test::Arm desktop = test::desktop6();
  JointVector bent = JointVector::Zero();
  bent.head<6>() << 0.0, 0.6, -0.2, 0.0, 0.0, 0.0;
  require_stable_joints(desktop.model, desktop.parameters, bent, timing_);
  const auto refused = [&](const JointTorqueParameters& control) {
    try {
      require_stable_joints(arm_.model, control, posture_, timing_);
    } catch (const command::Failure& failure) {
      return std::string(failure.what());
    }
    return std::string();
  };
  JointTorqueParameters control = arm_.parameters;
  control.null_damping = JointVector::Constant(60.0);  // runs away while it engages, in free space
  EXPECT_NE(refused(control).find("null_damping"), std::string::npos) << refused(control);
  control = arm_.parameters;
  control.limit_stiffness[6] = 1e5;
  EXPECT_NE(refused(control).find("joint 7 has limit_stiffness"), std::string::npos) << refused(control);
}

/// The refusal tells the boundary of a joint's damping. Just above it is refused, just below it is not, on light
/// joints, too, whose boundary is below 1 Nms/rad.
TEST_F(GainCheckTest, RefusesADampingJustBeyondTheBoundaryThatItTells) {
  const test::Arm arm = test::desktop6();
  JointVector bent = JointVector::Zero();
  bent.head<6>() << 0.0, 0.6, -0.2, 0.0, 0.0, 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (int joint = 0; joint < arm.model.joint_count; ++joint) {
    const auto refused = [&](double damping) -> std::string {
      JointTorqueParameters control = arm.parameters;
      control.limit_damping[joint] = control.limit_stiffness[joint] = 0.0;
      control.null_damping[joint] = damping;
      try {
        require_stable_joints(arm.model, control, bent, timing_);
      } catch (const command::Failure& failure) {
        return failure.what();
      }
      return {};
    };
    const std::string words = "stable only below ";
    const std::string told = refused(1e6);
    ASSERT_NE(told.find(words), std::string::npos) << joint;
    const double boundary = std::stod(told.substr(told.find(words) + words.size()));
    EXPECT_NE(refused(1.001 * boundary), "") << joint << ' ' << boundary;
    EXPECT_EQ(refused(0.999 * boundary), "") << joint << ' ' << boundary;
    least = std::min(least, boundary);
  }
  EXPECT_LT(least, 1.0);
}

/// A joint without any feedback of its own cannot lose its stability by it.
TEST_F(GainCheckTest, AcceptsAJointWithoutFeedbackOfItsOwn) {
  for (const int joint : {0, 6}) {
    test::Arm arm = arm_;
    arm.model.joints[static_cast<std::size_t>(joint)].damping = 0.0;
    arm.parameters.null_damping[joint] = 0.0;
    arm.parameters.limit_damping[joint] = 0.0;
    arm.parameters.limit_stiffness[joint] = 0.0;
    EXPECT_NO_THROW(require_stable_joints(arm.model, arm.parameters, posture_, timing_)) << joint;
    arm.parameters.limit_stiffness[joint] = 1.0;
    EXPECT_THROW(require_stable_joints(arm.model, arm.parameters, posture_, timing_), command::Failure)
        << "a spring without damping, sampled: " << joint;
  }
}

/// Without a passivity controller there is nothing to refuse, whatever margin the gains leave.
TEST_F(GainCheckTest, JudgesNoInjectionThatIsOff) {
  const auto check_with = [&](double most) {
    require_stable_injection(scene_, arm_.model, posture_, 1.0, timing_, {most, 0.16}, 1e6);
  };
  EXPECT_NO_THROW(check_with(0.0));
  EXPECT_THROW(check_with(1e-3), command::Failure);
}

/// The start refuses a passivity controller whose damping, injected all the time, would violate the margin. The message
/// names the largest damping that keeps the margin.
TEST_F(GainCheckTest, RefusesAnInjectionBeyondTheBoundary) {
  constexpr double kLength = 0.16;
  constexpr double kLeast = 1.25;
  const auto refused = [&](double most) {
    try {
      require_stable_injection(scene_, arm_.model, posture_, 1.0, timing_, {most, kLength}, kLeast);
    } catch (const command::Failure& failure) {
      EXPECT_EQ(failure.exit_code(), command::ExitCode::kBadConfig);
      return std::string(failure.what());
    }
    return std::string();
  };
  EXPECT_EQ(refused(0.0), "");
  const std::string message = refused(1e4);
  const std::string begin = "at most ";
  ASSERT_NE(message.find("passivity.damping = 10000 Ns/m"), std::string::npos) << message;
  ASSERT_NE(message.find(begin), std::string::npos) << message;
  const double most = std::stod(message.substr(message.find(begin) + begin.size()));
  EXPECT_GT(most, 1.0);
  EXPECT_EQ(refused(0.9 * most), "");
  EXPECT_NE(refused(1.1 * most), "");
}

TEST_F(GainCheckTest, FindsTheExactBoundaryAtItsWorstPosture) {
  const GainReport report = check();
  ASSERT_GT(report.margin, 1.5);
  // the same loop with the stiffness a hair below and above
  const ArmKinematics kinematics = forward_kinematics(arm_.model, report.posture);
  ArmLoop loop;
  loop.joint_count = 7;
  loop.mass = mass_matrix(arm_.model, kinematics);
  for (int i = 0; i < 7; ++i) loop.damping[i] = arm_.model.joints[static_cast<std::size_t>(i)].damping;
  loop.jacobian = geometric_jacobian(kinematics, kinematics.H_RM.translation);
  loop.tool_damping = 5.0;
  loop.rotation_tool_damping = 5.0 * 0.003;
  loop.timing = timing_;
  for (const double factor : {0.999, 1.001}) {
    loop.stiffness = factor * report.margin * 2000.0;
    loop.rotation_stiffness = loop.stiffness * 0.003;
    EXPECT_EQ(spectral_radius(loop) < 1.0, factor < 1.0);
  }
}

TEST_F(GainCheckTest, RefusesWithTheBoundaryOnItsWrongSide) {
  const GainReport report = check();
  EXPECT_EQ(refusal(report, 0.99 * report.margin), "");
  const std::string message = refusal(report, 1.01 * report.margin);
  EXPECT_NE(message.find("the hand would feel 2000 N/m and 6 Nm/rad"), std::string::npos) << message;
  EXPECT_NE(message.find("stability boundary is"), std::string::npos) << message;
  scene_.settings.stiffness = 2000.0 * report.margin * 1.01;
  EXPECT_LT(check().margin, 1.0);
  EXPECT_NE(refusal(check(), 1.0), "");
}

TEST_F(GainCheckTest, AcceptsAStiffnessThatTheRefusalAdvised) {
  constexpr double kMargin = 1.25;
  scene_.settings.stiffness = 50000.0;
  const std::string message = refusal(check(), kMargin);
  const std::string before = "lower gains.stiffness to ";
  const std::size_t at = message.find(before);
  ASSERT_NE(at, std::string::npos) << message;
  scene_.settings.stiffness *= std::stod(message.substr(at + before.size()));
  EXPECT_EQ(refusal(check(), kMargin), "");
}

TEST_F(GainCheckTest, NamesOnlyThePositionsOfJointsThatAreThere) {
  EXPECT_EQ(check().joint_count, 7);
  GainReport report;
  report.margin = 0.5;
  report.joint_count = 2;
  report.posture << 0.1, -0.2, 3.0, 3.0, 3.0, 3.0, 3.0;
  EXPECT_NE(refusal(report, 1.0).find(" at joint positions 0.10 -0.20 [rad],"), std::string::npos);
}

TEST_F(GainCheckTest, SaysThatTheDampingIsTooMuchWhereNoStiffnessIsStable) {
  scene_.settings.damping = 20.0;
  scene_.settings.coupling_rotation = 0.025;
  EXPECT_EQ(check().margin, 0.0);
  EXPECT_NE(refusal(check(), 1.0).find("no stiffness is stable"), std::string::npos);
}

TEST_F(GainCheckTest, LosesMarginWithDelayAndGainsItWithASmallerScale) {
  const double margin = check().margin;
  timing_.delay = 2e-3;
  EXPECT_LT(check().margin, margin);
  timing_.delay = 1e-3;
  const auto felt = FeltCoupling::of(scene_, 0.5);
  EXPECT_EQ(felt.stiffness, 500.0);
  EXPECT_EQ(felt.rotation_stiffness, 6.0);
  EXPECT_EQ(felt.damping, 1.25);
}

TEST_F(GainCheckTest, FeelsTheLeverOfACentreOfMassThatIsNotHeldInTheHand) {
  const double margin = check().margin;
  scene_.H_MB.translation = Vector3(0.15, 0.0, 0.0);
  EXPECT_LT(check().margin, 0.8 * margin) << "the flange turns lightly";
}

TEST_F(GainCheckTest, WarnsWhereItIsNotPassiveAndWhereARadianCountsTooMuch) {
  const GainReport report = check();
  EXPECT_LT(report.passivity_excess, 0.0);
  const auto warnings = judge_gains(report, FeltCoupling::of(scene_, 1.0), 1.0);
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_NE(warnings[0].find("not passive"), std::string::npos);
  EXPECT_NE(warnings[1].find("gyration"), std::string::npos);
  // the ball's radius of gyration is 12.6 mm
  EXPECT_NEAR(report.gyration, 0.02 * std::sqrt(0.4), 1e-4);
  scene_.settings.coupling_rotation = report.gyration * report.gyration;
  scene_.settings.stiffness = 100.0;
  EXPECT_GT(check().passivity_excess, 0.0);
  EXPECT_TRUE(judge_gains(check(), FeltCoupling::of(scene_, 1.0), 1.0).empty());
}

}  // namespace
}  // namespace godobject::firmware::gain_check_test
