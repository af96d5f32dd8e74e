#include <cmath>
#include <new>
#include <type_traits>

#include "core/scene/scene.h"
#include "godobject/scene.h"

namespace godobject {

CompiledScene::CompiledScene() noexcept {
  static_assert(sizeof(Scene) <= kBytes && alignof(Scene) <= 64);
  static_assert(std::is_trivially_destructible_v<Scene>);
  new (storage_) Scene();
}

CompiledScene::CompiledScene(const CompiledScene& other) noexcept { new (storage_) Scene(other.view()); }

CompiledScene& CompiledScene::operator=(const CompiledScene& other) noexcept {
  view() = other.view();
  return *this;
}

Status CompiledScene::open(std::span<const std::byte> image, CompiledScene& scene) noexcept {
  return Scene::open(image, scene.view());
}

CompiledScene CompiledScene::of(const Scene& view) noexcept {
  CompiledScene scene;
  scene.view() = view;
  return scene;
}

const Scene& CompiledScene::view() const noexcept { return *std::launder(reinterpret_cast<const Scene*>(storage_)); }
Scene& CompiledScene::view() noexcept { return *std::launder(reinterpret_cast<Scene*>(storage_)); }

Solver CompiledScene::default_solver() const noexcept { return view().default_solver(); }
bool CompiledScene::holds(Solver solver) const noexcept { return view().holds(solver); }
bool CompiledScene::has_friction() const noexcept { return view().settings.friction != 0; }
double CompiledScene::voxel_size() const noexcept { return view().grid.voxel_size; }
Vector3 CompiledScene::center_of_mass_M() const noexcept { return view().H_MB.translation; }

SurfaceDistance CompiledScene::distance(const Vector3& p_W) const noexcept {
  const FieldSample sample = view().voxelmap.sample(p_W);
  const double steepness = sample.gradient.norm();
  SurfaceDistance distance;
  distance.distance = sample.distance;
  distance.known = sample.known;
  if (steepness > 0.0) distance.normal_W = sample.gradient / steepness;
  return distance;
}

Gains CompiledScene::gains() const noexcept {
  const format::Settings& settings = view().settings;
  return {settings.stiffness, settings.damping, settings.coupling_rotation};
}

Status CompiledScene::set_gains(const Gains& gains) noexcept {
  const auto positive = [](double value) noexcept { return std::isfinite(value) && value > 0.0; };
  if (!positive(gains.stiffness) || !positive(gains.rotational)) return Status::kOutOfRange;
  if (!std::isfinite(gains.damping) || gains.damping < 0.0) return Status::kOutOfRange;
  format::Settings& settings = view().settings;
  settings.stiffness = gains.stiffness;
  settings.damping = gains.damping;
  settings.coupling_rotation = gains.rotational;
  return Status::kOk;
}

}  // namespace godobject
