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
  kMoved,     ///< the same, turned by an odd rotation and shifted by 10 m, the device path with it
  kCompiled,  ///< through the scene compiler
};
const char* name(WorldKind kind);

enum class BodyShape { kSphere, kBox, kL, kNeedle, kBunny, kPeg };
const char* name(BodyShape shape);

/// What is done in a scene, one run each.
struct Motions {
  bool press = false;
  bool slide = false;  ///< along a straight, flat way: drag is measured
  bool turn = false;
  bool retreat = false;
  bool slip = false;
  bool friction_slide = false;
  bool tremor = false;
  bool dashes = false;
};

/// A body, a still body and what is done with them. Geometry in the still body's own frame O.
struct SceneSpec {
  std::string name;
  WorldKind kind = WorldKind::kAnalytic;
  BodyShape body = BodyShape::kSphere;
  analytic::Solid solid;     ///< exact; of compiled scenes only what `mesh` is made after
  CompiledStill still = {};  ///< compiled scenes
  Pose H_WO = {};
  Placement placement = {};  ///< from a free pose, not touching yet
  Motions motions = {};
  double voxel_size = 0.002;
  double depth = 0.007;          ///< of the device [m]
  double angle = 0.25;           ///< of turns [rad]
  double friction_ratio = 0.18;  ///< expected of sliding: tangential over normal spring force
  bool groove = false;
  bool tight = false;                     ///< slot, peg, L: the wider target for the optimum
  bool plain = false;                     ///< convex body on a flat or convex one
  bool sharp = false;                     ///< still body with convex edges or corners at the contact
  bool one_sided = false;                 ///< a thin wall: the best pose cannot be reached
  std::optional<Rectangle> barrier = {};  ///< in the plane z = 0 of O: no sample point may cross it
  bool quick = false;                     ///< part of the quick run
};

std::vector<SceneSpec> scenes();

/// The still body's mesh in W.
CompiledStill placed(const SceneSpec& scene);

inline constexpr const char* kBunnyMesh = "bunny_npm.ply";

/// The generated meshes of the moving bodies; the bunny's is read from `mesh_folder`.
scene_compiler::TriangleMesh body_mesh(BodyShape shape, const std::filesystem::path& mesh_folder);
std::uint32_t body_points(BodyShape shape);

}  // namespace godobject::report
