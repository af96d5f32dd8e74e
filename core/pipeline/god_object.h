#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "core/pipeline/contact/contact_cycle.h"
#include "core/pipeline/corrected/corrected_cycle.h"
#include "core/pipeline/paper/paper_cycle.h"
#include "core/pipeline/cycle/scene_traits.h"
#include "core/scene/scene.h"

namespace godobject {

using Solver = format::Solver;

/// What `contact` carries from cycle to cycle beside State, and its room to work in.
struct ContactMemory {
  ContactSearch search;
  ContactWorkspace workspace;
};

/// The god object of a compiled scene: one `update` a millisecond, from the device's pose to the force on the device.
///
/// Poses are those of the moving mesh's own frame M (scaled to metres) in W, the still mesh's frame.
/// No allocation, no exceptions, no locks; about 600 KiB, most of them the contact solver's workspace, of which a cycle
/// touches what its contacts need. The scene must outlive it, and so must the memory that it is given.
///
///     GodObject god_object;
///     std::vector<std::uint32_t> memory(GodObject::memory(scene));
///     if (god_object.start(scene, scene.default_solver(), true, memory) != Status::kOk) ...
///     while (running) if (god_object.update({H_WM, velocity_W}, report) == Status::kOk) use(report.force.total_W);
class GodObject {
 public:
  /// Device pose of the moving mesh, and its velocity at the centre of mass, for the damping.
  struct Input {
    Pose H_WM;          ///< a rotation within 1e-3 of unit length is normalised
    Motion velocity_W;  ///< of the body's centre of mass [m/s], angular [rad/s]
  };

  /// Words that `contact` remembers about the scene from cycle to cycle: some nine a sample or feature point and a node
  /// of their trees, until when they cannot be near and where they are.
  static std::size_t memory(const Scene& scene) noexcept {
    return kHasSearch ? ContactSearch::memory(scene.pointshell, scene.features) : 0;
  }

  /// Chooses the pipeline once. Without a friction table in the scene `friction` = true is refused. `memory`: at least
  /// memory(scene) words, this god object's alone; with fewer, or none, results are the same, and `contact` looks at
  /// all nodes in every cycle.
  /// kNotInImage: the image was compiled without that solver, or without friction; kNotInBuild: this build is without
  /// (missing_part says what). Nothing changed.
  Status start(const Scene& scene, Solver solver, bool friction, std::span<std::uint32_t> memory = {}) noexcept;

  /// Forgets the god object: the next update starts with it at the device pose.
  void reset() noexcept { state_ = State{}; }

  /// Nothing is rendered: forgets the god object and puts it at the device pose, without a look at the scene. The
  /// report is that of a free cycle. Statuses as those of `update`, of the pose alone. Cost: 0.1 us. Real-time safe.
  Status follow(const Pose& H_WM, CycleReport& report) noexcept;

  /// One cycle, steps #1-#7. The first one after `start` or `reset` puts the god object at the device pose; if that
  /// penetrates, the outcome is kStartInside until it has come out: by a share of its depth a cycle where the field
  /// gives a direction, with the device where it gives none.
  /// kNotFinite, kNotUnit, kOutOfRange: the input is no pose, or would have led to a NaN; the god object is held, the
  /// force is zero, the report's outcome is kBadInput. Cost: step #1's look-ups, up to 60 ns each, and for the
  /// rest 0.3 us (`paper` and `corrected` 0.5 us), with friction 1-2 us; more where many contacts begin to hold at
  /// once. Real-time safe.
  ///
  /// In a scene with a workspace the god object follows the device within it only; the device feels the workspace's
  /// faces, as stiff as the coupling (workspace_limit.h). Until it has been within for the first time nothing is
  /// rendered, as by `follow`. `report.outside` tells either.
  Status update(const Input& input, CycleReport& report, StepTimes* times = nullptr) noexcept;

  /// The god object as a pose of the moving mesh's frame in W.
  Pose mesh_pose() const noexcept { return state_.H_WS * H_BM_; }

  const Parameters& parameters() const noexcept { return parameters_; }
  const State& state() const noexcept { return state_; }

 private:
  static constexpr bool kHasSearch = kSceneTraits.contact && kSceneTraits.points;
  struct NoMemory {};
  using Memory = std::conditional_t<kHasSearch, ContactMemory, NoMemory>;
  using Cycle = Status (*)(const Scene&, const Parameters&, const CycleInput&, Memory&, State&, CycleReport&,
                           StepTimes*) noexcept;
  struct Paper;
  struct Corrected;
  struct Contact;

  template <class Pipeline>
  static Cycle cycle_of(bool friction) noexcept;
  static Cycle cycle_of(Solver solver, bool friction) noexcept;
  Status run(const CycleInput& input, CycleReport& report, StepTimes* times) noexcept;
  Status run_pushed(const CycleInput& input, const Vector3& back_W, CycleReport& report, StepTimes* times) noexcept;

  const Scene* scene_ = nullptr;
  Cycle cycle_ = nullptr;
  Pose H_MB_;
  Pose H_BM_;
  Parameters parameters_;
  State state_;
  Memory memory_;
};

}  // namespace godobject
