// forces X.scene POSES.csv CYCLES: replays a path with `contact` and friction. Prints the vectors that the look-ups
// use, then force, torque and number of contacts of every tenth cycle. It needs nothing but the core.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>

#include "core/scene/clearance_kernel.h"
#include "godobject/god_object.h"

namespace {

using namespace godobject;

constexpr std::size_t kAligned = 64;

GodObject god_object;

/// Returns the file's bytes, aligned as an image must be. They are freed when the process ends.
std::span<const std::byte> read_aligned(const char* path) {
  std::FILE* const file = std::fopen(path, "rb");
  if (file == nullptr) return {};
  std::fseek(file, 0, SEEK_END);
  const auto size = static_cast<std::size_t>(std::ftell(file));
  std::rewind(file);
  auto* const bytes = static_cast<std::byte*>(std::aligned_alloc(kAligned, (size / kAligned + 1) * kAligned));
  const std::size_t read = std::fread(bytes, 1, size, file);
  std::fclose(file);
  return {bytes, read};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return 64;
  Scene scene;
  if (Scene::open(read_aligned(argv[1]), scene) != Status::kOk) return 65;
  const std::size_t bytes = (GodObject::memory_size(scene) / kAligned + 1) * kAligned;
  const std::span memory(static_cast<std::byte*>(std::aligned_alloc(kAligned, bytes)), bytes);
  if (god_object.start(scene, Solver::kContact, true, memory) != Status::kOk) return 65;
  std::FILE* const path = std::fopen(argv[2], "r");
  if (path == nullptr) return 66;
  char line[512];
  if (std::fgets(line, sizeof line, path) == nullptr) return 65;  // the names of the columns
  std::printf("%s\n", detail::clearance_kernels().front().name);
  const int cycles = std::atoi(argv[3]);
  for (int i = 0; i < cycles; ++i) {
    Pose H_WM;
    Vector3& p = H_WM.translation;
    double w = 1.0, x = 0.0, y = 0.0, z = 0.0;
    if (std::fgets(line, sizeof line, path) == nullptr) return 65;
    if (std::sscanf(line, "%*f,%lf,%lf,%lf,%lf,%lf,%lf,%lf", &p.x(), &p.y(), &p.z(), &w, &x, &y, &z) != 7) return 65;
    H_WM.rotation = Quaternion(w, x, y, z).normalized();
    CycleReport report;
    if (god_object.update({H_WM, Motion{}}, report) != Status::kOk) return 65;
    if (i % 10 != 0) continue;
    const Wrench& force = report.force.total_W;
    std::printf("%d %.9f %.9f %.9f %.9f %.9f %.9f %u\n", i, force.force.x(), force.force.y(), force.force.z(),
                force.torque.x(), force.torque.y(), force.torque.z(), report.contacts);
  }
  std::fclose(path);
  return 0;
}
