#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "core/device/kinematics.h"
#include "firmware/cycle/control_cycle.h"
#include "tests/firmware/cycle/fake_drives.h"
#include "tests/support/arms.h"
#include "tests/support/small_scenes.h"
#include "toolchain/files/aligned_bytes.h"

namespace godobject::firmware {

/// The light-weight robot, bent; its tool at the start is 50 mm over the plate's middle, scene and room alike directed.
class ControlCycleTest : public testing::Test {
 protected:
  ControlCycleTest() : image_(test::ball_over_plate()), scene_(test::open_scene(image_)), drives_(7) {
    q0_ << 0.0, -0.5, 0.0, 1.4, 0.0, -1.2, 0.0;
    setup_.scene = &scene_;
    setup_.arm = &arm_.model;
    setup_.joint_torque = &arm_.parameters;
    setup_.supervisor.sign_test = false;
    setup_.supervisor.engage_cycles = 20;
    const Pose H_RM = forward_kinematics(arm_.model, q0_).H_RM;
    setup_.mapping.H_WR.translation = Vector3(0.0, 0.0, 0.06) - H_RM.translation;
    drives_.reading.position = q0_;
  }

  void make() {
    setup_.memory = memory_.span();
    cycle_ = std::make_unique<ControlCycle>(setup_, drives_);
    ASSERT_EQ(cycle_->start(), Status::kOk);
  }

  /// One cycle, and what must hold in every one.
  void step(const LoopEvents& events = {}) {
    const JointVector before = drives_.sent.torque;
    cycle_->run_once(events);
    const JointVector& torque = drives_.sent.torque;
    ASSERT_TRUE(torque.allFinite());
    const Mode mode = cycle_->record().mode;
    const bool free_rate = mode == Mode::kFade || mode >= Mode::kStopping;
    for (int i = 0; i < 7; ++i) {
      const double limit = arm_.model.joints[static_cast<std::size_t>(i)].torque;
      ASSERT_LE(std::fabs(torque[i]), limit);
      if (!free_rate) {
        ASSERT_LE(std::fabs(torque[i] - before[i]), 0.05 * limit * (1.0 + 1e-12));
      }
    }
  }

  void run_to(Mode mode) {
    for (int i = 0; i < 1000 && cycle_->record().mode != mode; ++i) step();
    ASSERT_EQ(cycle_->record().mode, mode);
  }

  /// Joint positions with the tool moved by `offset` in the room, found with the transposed Jacobian's inverse.
  JointVector moved(const Vector3& offset) const {
    JointVector q = q0_;
    const Pose start = forward_kinematics(arm_.model, q0_).H_RM;
    for (int i = 0; i < 20; ++i) {
      const ArmKinematics kinematics = forward_kinematics(arm_.model, q);
      Eigen::Matrix<double, 6, 1> error;
      error << start.translation + offset - kinematics.H_RM.translation,
          log_rotation(start.rotation * kinematics.H_RM.rotation.conjugate());
      const Jacobian J = geometric_jacobian(kinematics, kinematics.H_RM.translation);
      q += J.transpose() * (J * J.transpose()).inverse() * error;
    }
    return q;
  }

  /// The tool goes down by `depth` in 200 cycles and stays there.
  void press(double depth) {
    for (int i = 1; i <= 200; ++i) {
      drives_.reading.position = moved(Vector3(0.0, 0.0, -depth * i / 200.0));
      step();
    }
    for (int i = 0; i < 30; ++i) step();
  }

  test::Arm arm_ = test::lwr();
  test::SceneImage image_;
  SceneView scene_;
  FakeDrives drives_;
  CycleSetup setup_;
  files::AlignedBytes memory_{GodObject::least_memory_size()};
  JointVector q0_ = JointVector::Zero();
  std::unique_ptr<ControlCycle> cycle_;
};

}  // namespace godobject::firmware
