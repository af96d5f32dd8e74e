#include "toolchain/report/contact_quality/scenes.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "toolchain/report/contact_quality/meshes.h"
#include "toolchain/scene_compiler/mesh/mesh_import.h"

namespace godobject::report {
namespace {

using analytic::Ball;
using analytic::Bore;
using analytic::Box;
using analytic::HalfSpace;
using analytic::Solid;

constexpr double kPi = std::numbers::pi;
constexpr double kKinetic = 0.18;
constexpr double kPlateHalf = 0.3;         // wider than any dash
constexpr double kPlateThickness = 0.004;  // two voxels
constexpr double kBallRadius = 0.05;
constexpr double kSlotGap = 0.031;
constexpr double kHoleRadius = 0.010;
constexpr double kHoleDepth = 0.03;
constexpr double kPegRadius = 0.0098;
constexpr double kPegVoxel = 0.00025;

/// Returns one half of a V with the full opening angle `opening` [deg].
double half_angle(double opening) { return 0.5 * opening * kPi / 180.0; }

Solid plane() { return Solid({HalfSpace{}}); }
Solid edge() { return Solid({Box{.center = Vector3(-0.15, 0.0, -0.15), .half_edges = Vector3(0.15, 0.2, 0.15)}}); }
Solid ball() { return Solid({Ball{.center = Vector3(0.0, 0.0, -kBallRadius), .radius = kBallRadius}}); }
Solid groove(double opening) {
  const double a = half_angle(opening);
  return Solid({HalfSpace{.n = Vector3(std::cos(a), 0.0, std::sin(a))},
                HalfSpace{.n = Vector3(-std::cos(a), 0.0, std::sin(a))}});
}
Solid corner() {
  return Solid({HalfSpace{.n = Vector3::UnitX()}, HalfSpace{.n = Vector3::UnitY()}, HalfSpace{.n = Vector3::UnitZ()}});
}
Solid slot() {
  return Solid({HalfSpace{.n = Vector3::UnitX(), .offset = -0.5 * kSlotGap},
                HalfSpace{.n = -Vector3::UnitX(), .offset = -0.5 * kSlotGap}});
}
Solid plate() {
  return Solid({Box{.center = Vector3::Zero(), .half_edges = Vector3(kPlateHalf, kPlateHalf, 0.5 * kPlateThickness)}});
}
Solid sheet() {
  return Solid({Box{
      .center = Vector3::Zero(), .half_edges = Vector3(kPlateHalf, kPlateHalf, 0.0), .radius = 0.5 * kPlateThickness}});
}
Solid hole() { return Solid({Bore{.radius = kHoleRadius}, HalfSpace{.offset = -kHoleDepth}}); }

TriangleMesh plane_mesh() { return box_mesh(Vector3(-0.1, -0.1, -0.03), Vector3(0.1, 0.1, 0.0)); }
TriangleMesh edge_mesh() { return box_mesh(Vector3(-0.12, -0.1, -0.06), Vector3(0.0, 0.1, 0.0)); }
TriangleMesh still_ball_mesh() {
  constexpr int kRings = 200;
  Pose below;
  below.translation = Vector3(0.0, 0.0, -kBallRadius);
  return moved(ball_mesh(kBallRadius, kRings), below);
}
TriangleMesh groove_mesh(double opening) {
  constexpr double kHeight = 0.04;
  const double half = kHeight * std::tan(half_angle(opening));
  const std::vector<double> xs = {-half - 0.02, -half, 0.0, half, half + 0.02};
  const std::vector<double> heights = {kHeight, kHeight, 0.0, kHeight, kHeight};
  return profile_solid(xs, heights, -0.02, 0.08);
}
TriangleMesh corner_mesh() {
  const std::vector<double> planes = {-0.02, 0.0, 0.08};
  return cell_solid({planes, planes, planes}, [](int i, int j, int k) { return i == 0 || j == 0 || k == 0; });
}
TriangleMesh slot_mesh() {
  const double h = 0.5 * kSlotGap;
  return cell_solid({{{-h - 0.02, -h, h, h + 0.02}, {-0.06, 0.1}, {-0.09, -0.07, 0.02}}},  // as long as the slide
                    [](int i, int, int k) { return k == 0 || i != 1; });
}
TriangleMesh plate_mesh() {
  const double h = kPlateHalf;
  return box_mesh(Vector3(-h, -h, -0.5 * kPlateThickness), Vector3(h, h, 0.5 * kPlateThickness));
}
TriangleMesh hole_mesh() {
  constexpr double kOuter = 0.014;
  constexpr double kBottom = 0.004;
  constexpr int kAround = 256;
  const std::vector<TurnedCorner> profile = {
      {0.0, -kHoleDepth - kBottom}, {kOuter, -kHoleDepth - kBottom}, {kOuter, 0.0},
      {kHoleRadius, 0.0},           {kHoleRadius, -kHoleDepth},      {0.0, -kHoleDepth}};
  return turned_solid(profile, kAround);
}

/// Returns a rotation and translation without symmetry.
Pose odd_motion(const Vector3& shift) {
  Pose pose;
  pose.rotation = exp_rotation(0.7 * Vector3(1.0, -2.0, 0.5).normalized());
  pose.translation = shift;
  return pose;
}
Pose far_away() { return odd_motion(Vector3(6.0, -7.0, 3.9)); }
Pose off_the_lattice() { return odd_motion(Vector3(0.0007, -0.0003, 0.0011)); }

Pose at(const Vector3& translation, const Vector3& rotation = Vector3::Zero()) {
  Pose pose;
  pose.translation = translation;
  pose.rotation = exp_rotation(rotation);
  return pose;
}

const Vector3 kDown = -Vector3::UnitZ();
const Vector3 kInPlane = Vector3(std::cos(0.6), std::sin(0.6), 0.0);  // not a lattice direction

/// Returns a tilted box that touches with a corner first.
const Vector3 kTilt = Vector3(0.3, -0.4, 0.2);

SceneSpec on_plane(BodyShape body) {
  SceneSpec scene{.name = std::string(name(body)) + "-plane", .body = body, .solid = plane()};
  scene.placement = {.H_OC = at(Vector3(-0.02, -0.02, 0.1)), .into = kDown, .along = kInPlane};
  scene.motions = {.press = true, .slide = true, .turn = true, .retreat = true};
  scene.plain = body != BodyShape::kBunny;
  return scene;
}

SceneSpec on_edge(BodyShape body) {
  SceneSpec scene{.name = std::string(name(body)) + "-edge", .body = body, .solid = edge()};
  scene.placement = {.H_OC = at(Vector3(0.06, 0.0, 0.06), Vector3(0.0, 0.2, 0.1)),
                     .into = Vector3(-1.0, 0.0, -1.0).normalized(),
                     .along = Vector3::UnitY(),
                     .axis = Vector3(0.0, 0.6, 0.8)};
  scene.motions = {.press = true, .turn = true, .retreat = true};
  scene.plain = body != BodyShape::kL && body != BodyShape::kBunny;
  scene.tight = body == BodyShape::kL;
  scene.sharp = true;
  return scene;
}

SceneSpec off_edge(BodyShape body) {
  SceneSpec scene{.name = std::string(name(body)) + "-off-edge", .body = body, .solid = edge()};
  scene.placement = {.H_OC = at(Vector3(-0.001, 0.0, 0.1)), .into = kDown, .along = Vector3::UnitX()};
  scene.motions = {.slip = true};
  scene.sharp = true;
  return scene;
}

SceneSpec on_ball(BodyShape body) {
  SceneSpec scene{.name = std::string(name(body)) + "-sphere", .body = body, .solid = ball()};
  scene.placement = {.H_OC = at(Vector3(0.01, 0.005, 0.12)), .into = kDown, .axis = kInPlane};
  scene.motions = {.press = true, .turn = true, .retreat = true};
  scene.plain = body != BodyShape::kBunny;
  return scene;
}

SceneSpec in_groove(BodyShape body, int opening) {
  SceneSpec scene{
      .name = std::string(name(body)) + "-groove-" + std::to_string(opening), .body = body, .solid = groove(opening)};
  scene.placement = {
      .H_OC = at(Vector3(0.001, 0.0, 0.14)), .into = kDown, .along = Vector3::UnitY(), .axis = Vector3(0.6, 0.0, 0.8)};
  scene.motions = {.press = true, .slide = true, .turn = true, .retreat = true};
  scene.groove = true;
  scene.friction_ratio = kKinetic / std::sin(half_angle(opening));
  return scene;
}

SceneSpec in_corner(BodyShape body) {
  SceneSpec scene{.name = std::string(name(body)) + "-corner", .body = body, .solid = corner()};
  scene.placement = {.H_OC = at(Vector3(0.05, 0.052, 0.048)),
                     .into = Vector3(-1.0, -1.1, -0.9).normalized(),
                     .axis = Vector3(0.6, 0.0, 0.8)};
  scene.motions = {.press = true, .turn = true, .retreat = true};
  scene.tight = body == BodyShape::kL;
  return scene;
}

SceneSpec in_slot() {
  SceneSpec scene{.name = "box-slot", .body = BodyShape::kBox, .solid = slot()};
  scene.placement = {.H_OC = at(Vector3(0.0, 0.0, -0.02), Vector3(0.0, 0.5 * kPi, 0.0)),
                     .into = Vector3::UnitX(),
                     .along = Vector3::UnitY(),
                     .clear = 4e-4,
                     .axis = Vector3::UnitZ()};
  scene.motions = {.press = true, .slide = true, .turn = true, .retreat = true};
  scene.tight = true;
  return scene;
}

SceneSpec in_hole() {
  SceneSpec scene{.name = "peg-hole", .body = BodyShape::kPeg, .solid = hole()};
  scene.placement = {.H_OC = at(Vector3(0.0, 0.0, -0.0095)),
                     .into = Vector3(0.9, 0.0, -0.4).normalized(),
                     .clear = 1e-4,
                     .axis = Vector3(0.0, 1.0, 0.0)};
  scene.motions = {.press = true, .turn = true, .retreat = true};
  scene.voxel_size = kPegVoxel;
  scene.depth = 0.003;
  scene.angle = 0.1;
  scene.tight = true;
  return scene;
}

SceneSpec through(BodyShape body, bool is_sheet) {
  SceneSpec scene{.name = std::string(name(body)) + (is_sheet ? "-sheet" : "-plate"),
                  .kind = WorldKind::kCompiled,
                  .body = body,
                  .solid = is_sheet ? sheet() : plate()};
  scene.still = {.mesh = is_sheet ? sheet_mesh(kPlateHalf) : plate_mesh(), .shell = is_sheet};
  scene.placement = {.H_OC = at(Vector3(0.01, -0.02, 0.12), kTilt), .into = kDown};
  scene.motions = {.press = true, .dashes = true};
  scene.one_sided = true;
  scene.barrier = Rectangle{kPlateHalf, kPlateHalf};
  return scene;
}

SceneSpec compiled(SceneSpec scene, TriangleMesh mesh, const Pose& H_WO) {
  scene.kind = WorldKind::kCompiled;
  scene.still.mesh = std::move(mesh);
  scene.H_WO = H_WO;
  return scene;
}

SceneSpec moved_away(SceneSpec scene) {
  scene.kind = WorldKind::kMoved;
  scene.H_WO = far_away();
  scene.motions = {.press = scene.motions.press, .slide = scene.motions.slide, .turn = scene.motions.turn};
  return scene;
}

SceneSpec with_friction(SceneSpec scene, bool tremor) {
  scene.motions.friction_slide = true;
  scene.motions.tremor = tremor;
  return scene;
}

SceneSpec quick(SceneSpec scene) {
  scene.quick = true;
  return scene;
}

}  // namespace

const char* name(WorldKind kind) {
  switch (kind) {
    case WorldKind::kAnalytic: return "analytic";
    case WorldKind::kMoved: return "moved";
    case WorldKind::kCompiled: return "compiled";
  }
  return "";
}

const char* name(BodyShape shape) {
  switch (shape) {
    case BodyShape::kSphere: return "sphere";
    case BodyShape::kBox: return "box";
    case BodyShape::kL: return "l";
    case BodyShape::kNeedle: return "needle";
    case BodyShape::kBunny: return "bunny";
    case BodyShape::kPeg: return "peg";
  }
  return "";
}

std::vector<SceneSpec> scenes() {
  using enum BodyShape;
  SceneSpec tilted_box = on_plane(kBox);
  tilted_box.name = "box-corner-down-plane";
  tilted_box.placement.H_OC.rotation = exp_rotation(kTilt);
  SceneSpec needle = on_plane(kNeedle);
  needle.placement.H_OC = at(Vector3(-0.02, 0.0, 0.12), Vector3(0.3, 1.2, 0.0));
  SceneSpec needle_plate = through(kNeedle, false);
  needle_plate.placement.H_OC = at(Vector3(0.01, 0.0, 0.15), Vector3(2.6, 0.1, 0.0));

  return {
      quick(with_friction(on_plane(kSphere), true)),
      with_friction(on_plane(kBox), true),
      tilted_box,
      needle,
      with_friction(on_plane(kBunny), true),
      on_edge(kSphere),
      quick(off_edge(kSphere)),
      on_edge(kBox),
      off_edge(kBox),
      on_ball(kSphere),
      on_ball(kBunny),
      with_friction(in_groove(kSphere, 60), false),
      quick(with_friction(in_groove(kSphere, 90), false)),
      with_friction(in_groove(kSphere, 120), false),
      in_groove(kBunny, 90),
      in_corner(kSphere),
      in_corner(kL),
      quick(in_slot()),
      in_hole(),
      quick(moved_away(in_groove(kSphere, 90))),
      moved_away(on_edge(kBox)),
      moved_away(on_plane(kBunny)),
      with_friction(compiled(on_plane(kSphere), plane_mesh(), off_the_lattice()), true),
      with_friction(compiled(on_plane(kBox), plane_mesh(), off_the_lattice()), true),
      compiled(on_ball(kSphere), still_ball_mesh(), at(Vector3(0.0007, -0.0003, 0.0011))),
      compiled(on_ball(kBunny), still_ball_mesh(), at(Vector3(0.0007, -0.0003, 0.0011))),
      quick(compiled(on_edge(kBox), edge_mesh(), off_the_lattice())),
      compiled(on_edge(kL), edge_mesh(), off_the_lattice()),
      compiled(off_edge(kBox), edge_mesh(), off_the_lattice()),
      with_friction(compiled(in_groove(kSphere, 90), groove_mesh(90), off_the_lattice()), false),
      compiled(in_corner(kSphere), corner_mesh(), off_the_lattice()),
      compiled(in_slot(), slot_mesh(), off_the_lattice()),
      compiled(in_hole(), hole_mesh(), at(Vector3(0.00011, -0.00007, 0.00005))),
      quick(through(kBox, false)),
      through(kBunny, false),
      needle_plate,
      through(kBox, true),
      through(kBunny, true),
  };
}

CompiledStill placed(const SceneSpec& scene) {
  return {.mesh = moved(scene.still.mesh, scene.H_WO), .shell = scene.still.shell};
}

scene_compiler::TriangleMesh body_mesh(BodyShape shape, const std::filesystem::path& mesh_folder) {
  switch (shape) {
    case BodyShape::kSphere: return ball_mesh(0.02, 96);
    case BodyShape::kBox: return box_mesh(Vector3(-0.03, -0.02, -0.015), Vector3(0.03, 0.02, 0.015));
    case BodyShape::kL:
      return cell_solid({{{0.0, 0.015, 0.05}, {0.0, 0.02}, {0.0, 0.015, 0.06}}},
                        [](int i, int, int k) { return i == 0 || k == 0; });
    case BodyShape::kNeedle: {
      const std::vector<TurnedCorner> profile = {{0.0, 0.0}, {0.0005, 0.15}, {0.0, 0.15}};
      return turned_solid(profile, 16);
    }
    case BodyShape::kBunny: {
      constexpr double kScale = 0.0161497;
      scene_compiler::MeshReport report;
      return scene_compiler::import_mesh(mesh_folder / kBunnyMesh, kScale, report);
    }
    case BodyShape::kPeg: {
      const std::vector<TurnedCorner> profile = {
          {0.0, -0.0195}, {kPegRadius, -0.0195}, {kPegRadius, 0.0195}, {0.0, 0.0195}};
      return turned_solid(profile, 128);
    }
  }
  return {};
}

std::uint32_t body_points(BodyShape shape) {
  switch (shape) {
    case BodyShape::kBunny: return 4000;
    case BodyShape::kNeedle: return 600;
    case BodyShape::kSphere:
    case BodyShape::kBox:
    case BodyShape::kL:
    case BodyShape::kPeg: return 2000;
  }
  return 0;
}

}  // namespace godobject::report
