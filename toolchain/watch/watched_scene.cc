#include "toolchain/watch/watched_scene.h"

#include "core/pipeline/cycle/scene_traits.h"

namespace godobject::watch {

std::vector<Vector3> points_of(const Pointshell& shell, const Vector3& origin) {
  std::vector<Vector3> points;
  for (std::size_t i = 0; i < shell.size; ++i) points.push_back(shell.point(i) + origin);
  return points;
}

WatchedScene::WatchedScene(std::span<const std::byte> image, const SceneView& scene)
    : scene_(scene), still_(image, kStillField) {
  if (scene.has_features()) moving_.emplace(image, kBodyField);
}

WatchedSession WatchedScene::session(const SessionChoice& choice, const ExactSurface& still, const ExactSurface& moving,
                                     double rounding) const {
  WatchedSession session;
  session.directions.push_back({.field = &still_,
                                .points = points_of(scene_.pointshell),
                                .points_move = true,
                                .mesh = still.mesh,
                                .mesh_accuracy = still.accuracy});
  if (moving_) {
    session.directions.push_back({.field = &*moving_,
                                  .points = points_of(scene_.features, scene_.features_origin),
                                  .points_move = false,
                                  .mesh = moving.mesh,
                                  .mesh_accuracy = moving.accuracy});
  }
  session.moving_edges = watched_edges(scene_.body_edges);
  session.still_edges = watched_edges(scene_.edges);
  session.parameters = choice.parameters;
  session.solver = choice.solver;
  session.friction = choice.friction;
  session.renders_ball = is_ball(scene_) && choice.solver == Solver::kContact && !choice.friction;
  session.rounding = rounding;
  return session;
}

}  // namespace godobject::watch
