#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "godobject/pose.h"
#include "godobject/report.h"
#include "godobject/scene.h"
#include "godobject/status.h"

namespace godobject {

class CompiledSession;

/// The god object of a scene: one `update` a period (Scene::period), from the device's pose to the force on the device.
///
/// Poses of this interface are H_WM: the moving mesh's own frame M (scaled to metres) in W, the still mesh's frame.
/// Forces are in W about the moving body's centre of mass. Lengths are in m, forces in N, torques in Nm.
///
/// The class allocates nothing, throws nothing and takes no lock. It works in memory that the caller provides: below
/// a mebibyte, and for full speed some 36 bytes more for each point and sphere of the scene. For a real-time loop lock
/// that memory, and touch it once, before `start`. One god object belongs to one thread at a time.
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
  /// The device's pose and velocity in one cycle.
  struct Input {
    Pose H_WM;          ///< the moving mesh as the device holds it; a rotation within 1e-3 of unit length is normalised
    Motion velocity_W;  ///< of the body's centre of mass [m/s], and angular [rad/s]; only the damping uses it
  };

  /// The budget of work without a limit.
  static constexpr std::uint64_t kNoBudget = std::numeric_limits<std::uint64_t>::max();

  /// Returns the memory that `start` needs to run at full speed in `scene` [bytes]. With it `contact` remembers from
  /// cycle to cycle which parts of the bodies are too far apart to touch.
  static std::size_t memory_size(const Scene& scene) noexcept;
  /// Returns the least memory that `start` accepts [bytes]. With less than memory_size(scene) `contact` visits the
  /// sphere trees from their roots in every cycle and looks all near points up: a god object at rest has the same pose,
  /// but one in motion may be some micrometres elsewhere.
  static std::size_t least_memory_size() noexcept;
  /// Returns the alignment of the memory [bytes]: it must begin at a multiple of this.
  static std::size_t memory_alignment() noexcept;

  GodObject() noexcept = default;
  GodObject(const GodObject&) = delete;
  GodObject& operator=(const GodObject&) = delete;

  /// Starts a session of `scene` with `solver`, with or without friction. May be called again, for any scene.
  ///
  /// `memory` belongs to this god object alone and must outlive it. So must the bytes of the scene's image; the object
  /// `scene` itself need not.
  ///
  /// kNotInImage: the image was compiled without that solver or without friction, or `scene` was never opened.
  /// kNotInBuild: this build of the library leaves out the solver, friction, or a part that the scene needs.
  /// kMemory: `memory` is smaller than least_memory_size() or not aligned. After a refusal the god object is unchanged.
  ///
  /// Cost: linear in points, spheres and bricks of the scene, some milliseconds. Not for the real-time loop.
  Status start(const Scene& scene, Solver solver, bool friction, std::span<std::byte> memory) noexcept;

  /// Forgets the god object: the next `update` starts with it at the device pose. Cost: 0.1 us. Real-time safe.
  void reset() noexcept;

  /// Moves the god object to the device pose H_WM and renders no force; the scene is not looked at. The next `update`
  /// starts again, as after `reset`. `report` is that of a free cycle.
  ///
  /// kNotStarted: `start` has not succeeded; `report` is unchanged. kNotFinite, kNotUnit, kOutOfRange: H_WM is not a
  /// valid pose; the god object stays, and the report's outcome is kBadInput. Cost: 0.1 us. Real-time safe.
  Status follow(const Pose& H_WM, CycleReport& report) noexcept;

  /// Runs one cycle, steps #1-#7 of the paper: from `input` to pose, force and outcome in `report`.
  ///
  /// The first cycle after `start`, `reset` or `follow` begins with the god object at the device pose. If that pose
  /// penetrates, the outcome is kStartInside until the god object has come out. It moves out by a share of its depth in
  /// each cycle where the field has a gradient; that may push on the hand, and where points push against each other by
  /// no more than the stiffness times a quarter of the voxel edge. It follows the device, without force, where the
  /// field has no gradient. With no point inside, sharp edges that overlap by less than a voxel edge are contacts. They
  /// lead the god object out, by about a margin a cycle, and the outcome is kContact. Edges that overlap by more are
  /// not seen: their contact holds the god object on the wrong side.
  ///
  /// In a scene with a workspace box the god object follows the device only within the box, and the device feels the
  /// box's faces as stiff as the coupling. With `contact` the faces hold the god object as contacts without friction
  /// do, so that the force of faces and contacts together is that of one spring; the other solvers follow the pose in
  /// the box that is nearest to the device. Until the device has been inside for the first time, nothing is rendered,
  /// as by `follow`. `report.outside` tells both cases.
  ///
  /// `times`, if not null, receives how long the steps took.
  ///
  /// kNotStarted: `start` has not succeeded; `report` is unchanged. kNotFinite, kNotUnit, kOutOfRange: the input is not
  /// a valid pose and velocity, or would have led to a NaN or Inf. Then the god object stays where it is, the force is
  /// zero and the report's outcome is kBadInput.
  ///
  /// Cost: the look-ups of step #1, up to 60 ns each, and 0.3 us for the other steps (`paper` and `corrected` 0.5 us),
  /// with friction 1-2 us; more in a cycle in which many contacts begin at once. Real-time safe.
  Status update(const Input& input, CycleReport& report, StepTimes* times = nullptr) noexcept;

  /// Sets the budget of work of a cycle of `contact` from the next `update` on [units]; `start` removes it. A unit is
  /// about a quarter of a nanosecond on an x86-64 processor of 3 GHz with AVX2; CycleReport::work tells what a cycle
  /// took. When the budget is spent, the cycle ends with the motion that is certified so far: the god object may lag,
  /// but crosses nothing. A cycle takes somewhat more than its budget: some ten thousand units, or two passes over the
  /// lists of near points.
  ///
  /// If the search for near points does not fit into the budget, the next cycles go on with it while the god object
  /// stays. After `start`, `reset` and `follow` the outcome is kStartInside, without force, until the first search has
  /// ended. If the first motion after it does not fit, shorter ones follow in the next cycles, at last without friction
  /// (`unconverged`). Where the bodies touch at thousands of points, a budget far below what cycles take without one
  /// may hold the god object for good, also when the device moves away; so it may without the memory of memory_size().
  /// `units`: 1 or more; kNoBudget: no budget. No effect before `start`. Real-time safe.
  void set_work_budget(std::uint64_t units) noexcept;

  /// Returns the god object's pose H_WM; the identity before `start` has succeeded. Real-time safe.
  Pose mesh_pose() const noexcept;

  /// Returns the session, or null before `start`. For this project's own tools and tests: its type is not part of the
  /// library's interface.
  const CompiledSession* session() const noexcept { return session_; }

 private:
  CompiledSession* session_ = nullptr;
};

}  // namespace godobject
