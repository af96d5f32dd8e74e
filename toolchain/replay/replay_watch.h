#pragma once

#include <memory>
#include <string>

#include "toolchain/files/scene_image.h"
#include "toolchain/scene_compiler/scene_config.h"
#include "toolchain/watch/watch.h"
#include "toolchain/watch/watched_scene.h"

namespace godobject::replay {

/// The watch over a replay of a compiled scene, with the scene's meshes as exact surfaces.
class ReplayWatch {
 public:
  /// `config`: the scene file of the image, with its meshes. `image` outlives this object. Throws Failure (kNoInput,
  /// kBadData) if a mesh cannot be used.
  ReplayWatch(const files::SceneImage& image, const scene_compiler::SceneConfig& config);

  ReplayWatch(const ReplayWatch&) = delete;
  ReplayWatch& operator=(const ReplayWatch&) = delete;

  /// Begins to watch a session that has just started.
  void start(const watch::SessionChoice& choice);

  /// Judges the next cycle. Poses are of the body frame B.
  void cycle(const watch::WatchedCycle& cycle) { watch_->cycle(cycle); }

  const watch::Findings& findings() const { return watch_->findings(); }

 private:
  double voxel_size_;
  double farthest_;  ///< largest coordinate of the field's corner [m]
  watch::WatchedScene scene_;
  std::unique_ptr<watch::Oracle> still_, moving_;
  watch::ExactSurface still_surface_, moving_surface_;
  std::unique_ptr<watch::Watch> watch_;
};

/// Returns the findings as text: a line for each property that was judged or violated, and a last line that says how
/// many were violated.
std::string findings_text(const watch::Findings& findings);

}  // namespace godobject::replay
