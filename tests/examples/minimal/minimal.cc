// The core in somebody else's program: a scene image, a device that sinks 30 mm in 100 cycles, and the force it feels.
// minimal X.scene

#include <cstdio>
#include <fstream>
#include <span>
#include <vector>

#include "core/pipeline/god_object.h"

int main(int argc, char** argv) {
  std::ifstream file(argc == 2 ? argv[1] : "", std::ios::binary | std::ios::ate);
  if (!file) return std::fprintf(stderr, "usage: minimal X.scene\n"), 66;

  struct alignas(godobject::format::kAlignment) Line {  // the image is read in place and must be aligned
    char byte[godobject::format::kAlignment];
  };
  const auto bytes = static_cast<std::size_t>(file.tellg());
  std::vector<Line> memory(bytes / sizeof(Line) + 1);
  file.seekg(0).read(memory.data()->byte, static_cast<std::streamsize>(bytes));

  godobject::Scene scene;
  godobject::GodObject god_object;
  godobject::Status status = godobject::Scene::open(std::as_bytes(std::span(memory)).first(bytes), scene);
  std::vector<std::uint32_t> search(godobject::GodObject::memory(scene));
  if (status == godobject::Status::kOk) status = god_object.start(scene, scene.default_solver(), false, search);

  godobject::CycleReport report;
  for (int cycle = 0; cycle <= 100 && status == godobject::Status::kOk; ++cycle) {
    godobject::GodObject::Input device;
    device.H_WM.translation.z() = 0.05 - 0.0003 * cycle;
    status = god_object.update(device, report);
    const double z_W = god_object.mesh_pose().translation.z();
    const double force_W = report.force.total_W.force.z();
    if (cycle % 10 == 0)
      std::printf("device %6.2f mm  god object %6.2f mm  force %5.2f N\n", 1e3 * device.H_WM.translation.z(), 1e3 * z_W,
                  force_W);
  }
  if (status != godobject::Status::kOk) return std::fprintf(stderr, "minimal: %s\n", godobject::describe(status)), 65;
}
