#pragma once

#include <cstddef>
#include <span>

#include "godobject/pose.h"
#include "godobject/report.h"
#include "godobject/scene.h"
#include "godobject/status.h"

namespace godobject {

class CompiledSession;

/// The god object of a scene: one `update` a millisecond, from the device's pose to the force on the device.
///
/// Poses are those of the moving mesh's own frame M (scaled to metres) in W, the still mesh's frame.
/// No allocation, no exceptions, no locks: it works in memory that the caller gives, most of a mebibyte.
///
/// ```cpp
/// GodObject god_object;
/// std::span<std::byte> memory = ...;  // memory_size(scene) bytes at a multiple of memory_alignment()
/// if (god_object.start(scene, scene.default_solver(), scene.has_friction(), memory) != Status::kOk) ...
/// while (running) {
///   if (god_object.update({H_WM, velocity_W}, report) == Status::kOk) use(report.force.total_W);
/// }
/// ```
class GodObject {
 public:
  /// The device's pose, as the moving mesh's, and its velocity at the body's centre of mass, for the damping.
  struct Input {
    Pose H_WM;          ///< a rotation within 1e-3 of unit length is normalised
    Motion velocity_W;  ///< of the body's centre of mass [m/s], and angular [rad/s]
  };

  /// Bytes of memory with which `contact` remembers from cycle to cycle where nothing can be near.
  static std::size_t memory_size(const CompiledScene& scene) noexcept;
  /// Bytes without which `start` refuses. With fewer than memory_size(scene) results are the same, but `contact` looks at
  /// all nodes of the sphere trees in every cycle.
  static std::size_t least_memory_size() noexcept;
  /// The memory must begin at a multiple of this [bytes].
  static std::size_t memory_alignment() noexcept;

  GodObject() noexcept = default;
  GodObject(const GodObject&) = delete;
  GodObject& operator=(const GodObject&) = delete;

  /// Starts a session in `memory`, which is this god object's alone and outlives it, as the scene's image does. The scene
  /// itself may go. Cost: some 10 ns per byte of memory. May be called again.
  /// kNotInImage: the image was compiled without that solver, or without friction. kNotInBuild: this build of the library
  /// is without it. kMemory: too few bytes, or not aligned. Then nothing changed.
  Status start(const CompiledScene& scene, Solver solver, bool friction, std::span<std::byte> memory) noexcept;

  /// Forgets the god object: the next update starts with it at the device pose.
  void reset() noexcept;

  /// Renders nothing: puts the god object at the device pose, without a look at the scene. The report is that of a free
  /// cycle. Statuses as those of `update`, for the pose alone. Cost: 0.1 us. Real-time safe.
  Status follow(const Pose& H_WM, CycleReport& report) noexcept;

  /// One cycle, steps #1-#7 of the paper. The first one after `start` or `reset` puts the god object at the device pose.
  /// If that penetrates, the outcome is kStartInside until the god object has come out: by a share of its depth a cycle
  /// where the field has a gradient, with the device where it has none.
  /// kNotStarted: `start` did not succeed. kNotFinite, kNotUnit, kOutOfRange: the input is no pose, or would have led to a
  /// NaN. Then the god object is held, the force is zero, and the report's outcome is kBadInput.
  /// Cost: step #1's look-ups, up to 60 ns each, and 0.3 us for the rest (`paper` and `corrected` 0.5 us), with friction
  /// 1-2 us; more where many contacts begin to hold at once. Real-time safe.
  ///
  /// In a scene with a workspace box the god object follows the device only within it. The device feels the box's faces,
  /// as stiff as the coupling. Until the device has been in the box for the first time nothing is rendered, as by
  /// `follow`. `report.outside` tells both.
  Status update(const Input& input, CycleReport& report, StepTimes* times = nullptr) noexcept;

  /// The god object as a pose of the moving mesh's frame in W. Only after `start`.
  Pose mesh_pose() const noexcept;

  /// For this project's own tools and tests; its type is no part of the library's interface. Null before `start`.
  const CompiledSession* session() const noexcept { return session_; }

 private:
  CompiledSession* session_ = nullptr;
};

}  // namespace godobject
