// Example 4: closed loop on a simulated arm. The whole controller runs: position check, god object, limits at the hand,
// joint torques, supervisor. The hand of an operator, a spring of 300 N/m, leads the tool down until the mesh presses
// on the still body, and on by 40 mm. Time is virtual, so the run is the same each time. For a real arm, replace the
// drives.
//
// usage: 4_simulated_arm firmware/devices/lwr.toml X.scene; the numbers suit the scene of write_scene

#include <cstdint>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <vector>

#include "core/device/kinematics.h"
#include "firmware/configuration/controller_file.h"
#include "firmware/configuration/device_file.h"
#include "firmware/cycle/control_cycle.h"
#include "sim/direct_drives.h"
#include "toolchain/files/aligned_bytes.h"
#include "toolchain/files/scene_image.h"

namespace {

using namespace godobject;

constexpr std::int64_t kPeriod_ns = 1'000'000;

/// Poses H_RT of the tool 1 ms apart: from `start` straight down with 50 mm/s, 90 mm.
std::vector<Pose> lead_down(const Pose& start) {
  std::vector<Pose> path(1, start);
  while (path.back().translation.z() > start.translation.z() - 0.09) {
    path.push_back(path.back());
    path.back().translation.z() -= 50e-6;
  }
  return path;
}

void run(const char* device_file, const char* image_file) {
  const files::SceneImage image = files::SceneImage::read(image_file);

  // where the arm stands: its posture, and the mesh's place in the scene at that posture
  firmware::ControllerConfig::Workspace workspace;
  workspace.posture << 0.0, -0.5, 0.0, 1.4, 0.0, -1.2, 0.0;
  workspace.start.translation = Vector3(0.0, 0.0, 0.08);
  const firmware::Placement placement =
      firmware::place(workspace, firmware::read_device_file(device_file), image.scene.H_MB.translation);
  const ArmModel& arm = placement.device.model;

  // the start takes 3 s, the hand begins at 8 s; a real arm brings these along: joints, drives, and the hand of a
  // person
  const std::vector<Pose> path = lead_down(forward_kinematics(arm, workspace.posture).H_RM);
  sim::HandParameters hand;
  hand.grip = sim::Grip::kSpring;
  sim::Plant plant(arm, workspace.posture, JointVector::Zero(), sim::OperatorHand(hand, path, 8'000 * kPeriod_ns));
  const auto hardware = sim::usual_hardware(arm);
  sim::DirectDrives drives(plant, hardware, {});

  files::AlignedBytes memory(GodObject::memory_size(Scene::of(image.scene)));
  firmware::CycleSetup setup;
  setup.scene = &image.scene;
  setup.solver = image.scene.default_solver();
  setup.memory = memory.span();
  setup.arm = &arm;
  setup.joint_torque = &placement.device.torque;
  setup.mapping = placement.mapping;
  firmware::ControlCycle cycle(setup, drives);
  const Status status = cycle.start();
  if (status != Status::kOk) throw std::runtime_error(describe(status));

  for (int k = 0; k < 12'000; ++k) {
    drives.advance_to(k * kPeriod_ns);
    cycle.request();
    cycle.run_once({});
    const firmware::CycleRecord& record = cycle.record();
    if (k % 1000 == 999) {
      std::printf("%4.1f s  %-9s device %6.2f mm  god object %6.2f mm  force %5.2f N\n", 1e-3 * (k + 1),
                  firmware::name(record.mode), 1e3 * record.H_WM.translation.z(),
                  1e3 * record.god_object_W.translation.z(), record.F_G_R.force.z());
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return std::fprintf(stderr, "usage: 4_simulated_arm DEVICE.toml X.scene\n"), 64;
  try {
    run(argv[1], argv[2]);
  } catch (const std::exception& error) {
    return std::fprintf(stderr, "%s\n", error.what()), 65;
  }
  return 0;
}
