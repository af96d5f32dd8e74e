// Example 2: a device that sinks 30 mm in 100 cycles, and the force that it feels.
// usage: 2_press X.scene; the numbers suit the ball above a plate that write_scene makes

#include <cstdio>

#include <godobject/god_object.h>

#include "aligned_file.h"

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "usage: 2_press X.scene\n"), 64;
  AlignedBytes image = read_file(argv[1]);
  godobject::Scene scene;
  auto status = godobject::Scene::open(image.span(), scene);
  if (status != godobject::Status::kOk)
    return std::fprintf(stderr, "%s: %s\n", argv[1], godobject::describe(status)), 65;

  godobject::GodObject god_object;
  AlignedBytes memory(godobject::GodObject::memory_size(scene));
  status = god_object.start(scene, scene.default_solver(), scene.has_friction(), memory.span());

  godobject::CycleReport report;
  for (int cycle = 0; cycle <= 100 && status == godobject::Status::kOk; ++cycle) {
    godobject::GodObject::Input device;
    device.H_WM.translation.z() = 0.05 - 0.0003 * cycle;
    status = god_object.update(device, report);
    if (cycle % 10 != 0) continue;
    std::printf("device %6.2f mm  god object %6.2f mm  force %5.2f N\n", 1e3 * device.H_WM.translation.z(),
                1e3 * god_object.mesh_pose().translation.z(), report.force.total_W.force.z());
  }
  if (status != godobject::Status::kOk)
    return std::fprintf(stderr, "%s: %s\n", argv[1], godobject::describe(status)), 65;
  return 0;
}
