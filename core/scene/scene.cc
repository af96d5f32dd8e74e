#include <new>
#include <type_traits>

#include "core/scene/scene_view.h"
#include "godobject/scene.h"

namespace godobject {

Scene::Scene() noexcept {
  static_assert(sizeof(SceneView) <= kBytes && alignof(SceneView) <= 64);
  static_assert(std::is_trivially_destructible_v<SceneView>);
  new (storage_) SceneView();
}

Scene::Scene(const Scene& other) noexcept { new (storage_) SceneView(other.view()); }

Scene& Scene::operator=(const Scene& other) noexcept {
  mutable_view() = other.view();
  return *this;
}

Status Scene::open(std::span<const std::byte> image, Scene& scene) noexcept {
  return SceneView::open(image, scene.mutable_view());
}

Scene Scene::of(const SceneView& view) noexcept {
  Scene scene;
  scene.mutable_view() = view;
  return scene;
}

const SceneView& Scene::view() const noexcept { return *std::launder(reinterpret_cast<const SceneView*>(storage_)); }
SceneView& Scene::mutable_view() noexcept { return *std::launder(reinterpret_cast<SceneView*>(storage_)); }

Solver Scene::default_solver() const noexcept { return view().default_solver(); }
bool Scene::holds(Solver solver) const noexcept { return view().holds(solver); }
bool Scene::has_friction() const noexcept { return view().settings.friction != 0; }
double Scene::voxel_size() const noexcept { return view().grid.voxel_size; }
Vector3 Scene::center_of_mass_M() const noexcept { return view().H_MB.translation; }

SurfaceDistance Scene::distance(const Vector3& p_W) const noexcept {
  const FieldSample sample = view().voxelmap.sample(p_W);
  const double steepness = sample.gradient.norm();
  SurfaceDistance distance;
  distance.distance = sample.distance;
  distance.known = sample.known;
  if (steepness > 0.0) distance.normal_W = sample.gradient / steepness;
  return distance;
}

Gains Scene::gains() const noexcept {
  const format::Settings& settings = view().settings;
  return {settings.stiffness, settings.damping, settings.coupling_rotation};
}

Status Scene::set_gains(const Gains& gains) noexcept {
  format::Settings settings = view().settings;
  settings.stiffness = gains.stiffness;
  settings.damping = gains.damping;
  settings.coupling_rotation = gains.rotational;
  if (!valid_gains(settings)) return Status::kOutOfRange;
  mutable_view().settings = settings;
  return Status::kOk;
}

double Scene::period() const noexcept { return view().settings.period; }

Status Scene::set_period(double period) noexcept {
  if (!valid_period(period)) return Status::kOutOfRange;
  mutable_view().settings.period = period;
  return Status::kOk;
}

}  // namespace godobject
