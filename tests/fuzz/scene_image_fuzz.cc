// Opens any bytes as a scene image. If the image is valid, makes a thousand look-ups and cycles of every solver in it.

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <random>
#include <span>
#include <vector>

#include "core/scene/scene_view.h"
#include "toolchain/session/owned_god_object.h"

namespace godobject {
namespace {

void require(bool holds) {
  if (!holds) std::abort();  // libFuzzer reports this as a crash
}

bool finite(const FieldSample& sample) {
  return std::isfinite(sample.distance) && sample.gradient.allFinite() && std::isfinite(sample.clearance);
}

/// Looks up points in the grid and around it. All results must be finite.
void look_up(const Voxelmap& map, const format::Grid& grid, std::mt19937& random) {
  constexpr int kLookUps = 1000;
  std::uniform_real_distribution<double> anywhere(-0.2, 1.2);
  for (int i = 0; i < kLookUps; ++i) {
    Vector3 p;
    for (int axis = 0; axis < 3; ++axis) {
      p[axis] = grid.origin[axis] + grid.voxel_size * format::kBrickCells * grid.bricks[axis] * anywhere(random);
    }
    require(finite(map.sample(p)));
    require(map.layer(p).to_center.allFinite());
    require(!std::isnan(map.lower_bound(p, grid.voxel_size)));
  }
}

void run(const SceneView& scene, Solver solver, bool friction, std::mt19937& random) {
  constexpr int kCycles = 100;
  static OwnedGodObject god_object;
  if (god_object.start(scene, solver, friction) != Status::kOk) return;
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const Vector3 low(scene.grid.surface_min[0], scene.grid.surface_min[1], scene.grid.surface_min[2]);
  const Vector3 high(scene.grid.surface_max[0], scene.grid.surface_max[1], scene.grid.surface_max[2]);
  GodObject::Input input;
  CycleReport report;
  for (int cycle = 0; cycle < kCycles; ++cycle) {
    const Vector3 at(share(random), share(random), share(random));
    input.H_WM.translation = low + at.cwiseProduct(high - low);
    // a cycle may fail: numbers within their bounds can still lead to an overflow
    if (god_object->update(input, report) != Status::kOk) return;
    require(report.H_WS.is_finite() && report.force.total_W.force.allFinite() &&
            report.force.total_W.torque.allFinite());
  }
}

}  // namespace
}  // namespace godobject

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace godobject;
  struct alignas(format::kAlignment) Line {
    std::byte byte[format::kAlignment];
  };
  std::vector<Line> memory(size / sizeof(Line) + 1);
  if (size > 0) std::memcpy(memory.data(), data, size);
  SceneView scene;
  if (SceneView::open(std::as_bytes(std::span(memory)).first(size), scene) != Status::kOk) return 0;
  std::mt19937 random(1);
  look_up(scene.voxelmap, scene.grid, random);
  for (const Solver solver : {Solver::kPaper, Solver::kCorrected, Solver::kContact}) {
    for (const bool friction : {false, true}) run(scene, solver, friction, random);
  }
  return 0;
}
