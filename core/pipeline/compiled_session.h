#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "core/pipeline/session.h"
#include "core/scene/scene_view.h"
#include "godobject/god_object.h"

namespace godobject {

/// A session on a compiled scene, with poses of the moving mesh's frame M: the object that GodObject creates in its
/// caller's memory. Documented at GodObject.
class CompiledSession {
 public:
  CompiledSession() = default;
  CompiledSession(const CompiledSession&) = delete;  // `core_` refers to `scene_`
  CompiledSession& operator=(const CompiledSession&) = delete;

  using BodyField = std::conditional_t<kSceneTraits.features, Voxelmap, NoBodyField>;
  using Core = Session<Voxelmap, BodyField>;

  /// Returns the size of the search's memory, which lies behind the session [32-bit words].
  static std::size_t search_words(const SceneView& scene) noexcept {
    return Core::search_words(scene.pointshell, scene.features);
  }

  /// Starts the session. The image and this build must have the solver, and friction if requested (missing_part).
  /// `words`: search_words(scene) of them, or none.
  void start(const SceneView& scene, Solver solver, bool friction, std::span<std::uint32_t> words) noexcept;

  void reset() noexcept { core_.reset(); }
  Status follow(const Pose& H_WM, CycleReport& report) noexcept;
  Status update(const GodObject::Input& input, CycleReport& report, StepTimes* times) noexcept;
  Pose mesh_pose() const noexcept { return core_.state().H_WS * H_BM_; }  ///< S is a pose of B

  const Parameters& parameters() const noexcept { return core_.parameters(); }
  const ProxyState& state() const noexcept { return core_.state(); }
  const SubstepPath& path() const noexcept { return core_.path(); }
  const WorkMeter& work() const noexcept { return core_.work(); }
  void set_work_budget(std::uint64_t units) noexcept { core_.set_work_budget(units); }

 private:
  Status refuse(Status status, CycleReport& report) const noexcept;

  SceneView scene_;
  Pose H_MB_;
  Pose H_BM_;
  Core core_;
};

}  // namespace godobject
