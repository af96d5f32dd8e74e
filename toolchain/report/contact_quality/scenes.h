#pragma once

#include <optional>
#include <string>
#include <vector>

#include "toolchain/report/analytic/solid.h"
#include "toolchain/report/contact_quality/device_path.h"
#include "toolchain/report/contact_quality/signals.h"
#include "toolchain/report/contact_quality/world.h"

namespace godobject::report {

enum class WorldKind {
  kAnalytic,  ///< exact distance
  kMoved,     ///< the same and its device path, rotated without symmetry and shifted by 10 m
  kCompiled,  ///< compiled by the scene compiler
};
const char* name(WorldKind kind);

enum class BodyShape { kSphere, kBox, kL, kNeedle, kBunny, kPeg };
const char* name(BodyShape shape);

/// The motions of a scene, one run each.
struct Motions {
  bool press = false;
  bool slide = false;  ///< along a straight, flat path; measures drag
  bool turn = false;
  bool retreat = false;
  bool slip = false;
  bool friction_slide = false;
  bool tremor = false;
  bool dashes = false;
};

/// A body, a still body and the motions. Geometry in the still body's own frame O.
struct SceneSpec {
  std::string name;
  WorldKind kind = WorldKind::kAnalytic;
  BodyShape body = BodyShape::kSphere;
  analytic::Solid solid;     ///< exact; in compiled scenes only the model of `mesh`
  CompiledStill still = {};  ///< of compiled scenes
  Pose H_WO = {};
  Placement placement = {};  ///< a free pose, before the touch
  Motions motions = {};
  double voxel_size = 0.002;
  double depth = 0.007;          ///< of the device [m]
  double angle = 0.25;           ///< of turns [rad]
  double friction_ratio = 0.18;  ///< expected ratio of tangential to normal spring force while sliding
  bool groove = false;
  bool tight = false;                     ///< slot, peg, L: wider target for the optimum
  bool plain = false;                     ///< convex body on a flat or convex one
  bool sharp = false;                     ///< still body with convex edges or corners at the contact
  bool one_sided = false;                 ///< thin wall: the god object cannot reach the best pose
  std::optional<Rectangle> barrier = {};  ///< in the plane z = 0 of O: no sample point may cross it
  bool quick = false;                     ///< part of the quick run
};

std::vector<SceneSpec> scenes();

/// Returns the still body's mesh in W.
CompiledStill placed(const SceneSpec& scene);

inline constexpr const char* kBunnyMesh = "bunny_npm.ply";

/// Returns the mesh of a moving body: generated, or that of the bunny from `mesh_folder`.
scene_compiler::TriangleMesh body_mesh(BodyShape shape, const std::filesystem::path& mesh_folder);
std::uint32_t body_points(BodyShape shape);

}  // namespace godobject::report
