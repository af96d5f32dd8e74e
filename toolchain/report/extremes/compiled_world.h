#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "core/scene/scene_view.h"
#include "toolchain/files/scene_image.h"
#include "toolchain/report/contact_quality/meshes.h"
#include "toolchain/report/extremes/setup.h"
#include "toolchain/watch/mesh_surface.h"
#include "toolchain/watch/watched_scene.h"

namespace godobject::report {

/// A world from the scene compiler, and its exact surfaces. Sessions that differ only by what a session may choose
/// (any_session_in) may run in it.
class CompiledWorld {
 public:
  /// Compiles the world of a setup in `work`, which takes seconds.
  CompiledWorld(const Setup& setup, const std::filesystem::path& work);

  const SceneView& scene() const { return image_->scene; }

  /// Returns what the watch needs to know of a session. It refers to this object.
  watch::WatchedSession watched(const watch::SessionChoice& choice, double rounding) const;

 private:
  std::unique_ptr<files::SceneImage> compile(const Setup& setup, const std::filesystem::path& work);

  TriangleMesh still_mesh_;
  TriangleMesh body_mesh_;
  double slack_ = 0.0;     ///< by which the body is smaller in its own field [m]
  double accuracy_ = 0.0;  ///< largest depth of a stored surface inside its mesh [m]
  std::unique_ptr<files::SceneImage> image_;
  std::optional<watch::WatchedScene> watched_;
  std::optional<watch::GrownSurface> still_surface_;
  std::optional<watch::MeshSurface> body_surface_;
};

}  // namespace godobject::report
