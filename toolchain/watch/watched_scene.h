#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/pipeline/cycle/parameters.h"
#include "core/scene/scene_view.h"
#include "toolchain/watch/stored_field.h"
#include "toolchain/watch/watch.h"

namespace godobject::watch {

/// The depth of a stored surface inside its mesh, over the tolerance that the compiler holds at the points that it
/// compares: between them it is a little larger.
inline constexpr double kDepthBetween = 1.2;

/// The exact surface of a body.
struct ExactSurface {
  const Oracle* mesh = nullptr;  ///< in the frame of its body; null: it is not known
  double accuracy = 0.0;         ///< largest depth of the stored surface inside the mesh [m]
};

/// The choices of a session, beside its scene.
struct SessionChoice {
  Solver solver = Solver::kContact;
  bool friction = false;
  Parameters parameters = {};  ///< as the session has them
};

/// Returns the points of a body in its frame; `origin` is added to each [m].
std::vector<Vector3> points_of(const Pointshell& shell, const Vector3& origin = Vector3::Zero());

/// A compiled scene as the watch sees it: fields, points and edges of the image.
class WatchedScene {
 public:
  /// `scene` is the view of `image`; both outlive this object. Throws std::runtime_error if the image lacks a field.
  WatchedScene(std::span<const std::byte> image, const SceneView& scene);

  WatchedScene(const WatchedScene&) = delete;
  WatchedScene& operator=(const WatchedScene&) = delete;

  /// Returns what the watch needs to know of a session. It refers to this object and to the surfaces' oracles.
  /// `still` is in W, `moving` in the moving body's frame B. `rounding`: of coordinates [m].
  WatchedSession session(const SessionChoice& choice, const ExactSurface& still, const ExactSurface& moving,
                         double rounding) const;

 private:
  const SceneView& scene_;
  StoredField still_;
  std::optional<StoredField> moving_;  ///< of the second direction
};

}  // namespace godobject::watch
