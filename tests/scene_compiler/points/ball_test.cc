#include "toolchain/scene_compiler/points/ball.h"
#include "toolchain/scene_compiler/field/brick_packing.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <sstream>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/scene_compiler/compiled_once.h"
#include "tests/scene_compiler/simple_meshes.h"
#include "tests/scene_compiler/test_meshes.h"
#include "toolchain/command_line/failure.h"
#include "toolchain/query/query_points.h"
#include "toolchain/scene_compiler/compile_scene.h"
#include "toolchain/scene_compiler/report_json.h"
#include "toolchain/scene_compiler/report_text.h"
#include "toolchain/session/owned_god_object.h"

namespace godobject::scene_compiler::ball_test {
namespace {

using Eigen::Vector3d;

constexpr double kRadius = 0.01;
constexpr double kHalfCube = 0.05;
constexpr double kVoxel = 0.002;
const Vector3d kCenter(0.003, -0.002, 0.001);  // of the ball, in its mesh's frame

SolidSurface solid(TriangleMesh mesh) { return {std::move(mesh), SurfaceKind::kAuto, 0.001}; }

TriangleMesh stretched(TriangleMesh mesh, const Vector3d& factors) {
  for (Vector3d& vertex : mesh.vertices) vertex = vertex.cwiseProduct(factors);
  return mesh;
}

TriangleMesh rounded(TriangleMesh mesh) {
  for (Vector3d& vertex : mesh.vertices) vertex = vertex.cast<float>().cast<double>();
  return mesh;
}

/// Removes the first triangle.
TriangleMesh opened(TriangleMesh mesh) {
  mesh.triangles.erase(mesh.triangles.begin());
  return mesh;
}

TEST(Ball, IsToldByItsSurface) {
  for (const bool turned : {false, true}) {
    TriangleMesh mesh = rounded(test::moved(test::ball_mesh(kRadius, 60), test::odd_motion()));
    if (turned) mesh = turned_inside_out(mesh);
    const std::optional<Ball> ball = as_ball(solid(mesh));
    ASSERT_TRUE(ball);
    EXPECT_LT((ball->center - test::odd_motion().translation()).norm(), 1e-7);
    EXPECT_NEAR(ball->radius, kRadius, 1e-7);
    // facets of 3 by 3 degrees: their corners are 2.12 degrees off their middles
    EXPECT_NEAR(ball->deviation, kRadius * (1.0 - std::cos(0.0370)), 1e-7);
  }
}

TEST(Ball, IsNothingElse) {
  const TriangleMesh ball = test::ball_mesh(kRadius, 40);
  TriangleMesh dented = ball;
  dented.vertices[500] *= 0.95;
  TriangleMesh spiked = ball;
  spiked.vertices[500] *= 1.05;
  const std::vector<std::pair<const char*, TriangleMesh>> others = {
      {"box", test::box_mesh({0.02, 0.02, 0.02})},
      {"ellipsoid", stretched(ball, {1.0, 1.0, 0.95})},
      {"two balls of two radii", test::joined(ball, stretched(ball, Vector3d::Constant(0.995)))},
      {"hollow ball", test::joined(ball, test::inside_out(stretched(ball, Vector3d::Constant(0.99))))},
      {"open ball", opened(ball)},
      {"dented", dented},
      {"spiked", spiked},
      {"coarse", test::ball_mesh(kRadius, 8)},
      {"sheet", test::sheet_mesh(0.02)}};
  for (const auto& [name, mesh] : others) EXPECT_FALSE(as_ball(solid(mesh))) << name;
}

TEST(Convex, IsToldFromWhatIsNot) {
  const std::vector<std::pair<const char*, TriangleMesh>> convex = {{"box", test::box_mesh({0.1, 0.02, 0.3})},
                                                                    {"thin box", test::box_mesh({0.1, 0.1, 1e-4})},
                                                                    {"ball", test::ball_mesh(0.05, 40)},
                                                                    {"needle", test::needle_mesh(0.1, 0.002)}};
  for (const auto& [name, mesh] : convex) {
    EXPECT_TRUE(is_convex(solid(mesh))) << name;
    EXPECT_TRUE(is_convex(solid(rounded(test::moved(mesh, test::odd_motion()))))) << name;
    EXPECT_TRUE(is_convex(solid(turned_inside_out(mesh)))) << name;
    EXPECT_FALSE(is_convex(solid(opened(mesh)))) << name;
    EXPECT_FALSE(is_convex(solid(test::joined(mesh, test::moved(mesh, test::odd_motion()))))) << name;
  }
  TriangleMesh dented = test::ball_mesh(0.05, 40);
  dented.vertices[500] *= 0.999;  // 50 um: the vertices about it stand above the facets that it is a corner of
  EXPECT_FALSE(is_convex(solid(dented)));
  for (const char* name : {"bracket", "teapot", "gear"}) EXPECT_FALSE(is_convex(solid(load(name, 0.01)))) << name;
}

/// Signed distance to the cube.
double to_cube(const Vector3d& p) {
  const Vector3d q = p.cwiseAbs() - Vector3d::Constant(kHalfCube);
  return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0);
}

TEST(Dilation, LessensEveryDistanceAndLeavesNoFacet) {
  const SolidSurface cube = {test::box_mesh(Vector3d::Constant(2.0 * kHalfCube)), SurfaceKind::kSolid, 0.001, kRadius};
  const double band = default_band(kVoxel, 1.5 * kVoxel);
  for (const double tolerance : {0.05, 0.01}) {
    DistanceGrid grid = make_distance_grid(cube, kVoxel, band, {});
    const RefinementReport refined = refine(grid, cube, SurfaceTolerance::of_depth(tolerance * kVoxel), {});
    EXPECT_EQ(refined.exact, 0u);
    const std::vector<format::Brick> bricks = packed_bricks(grid);
    const Voxelmap field(grid.grid, grid.index, bricks, grid.refined, grid.exact, grid.facet_lists());
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    double worst = 0.0;
    int near = 0;
    for (int i = 0; i < 100000; ++i) {
      const Vector3d p = (kHalfCube + kRadius + band) * Vector3d(unit(random), unit(random), unit(random));
      const double exact = to_cube(p) - kRadius;
      EXPECT_NEAR(cube.signed_distance(p), exact, 1e-12);
      const FieldSample sample = field.sample(p);
      EXPECT_TRUE(sample.known || std::abs(exact) > band - kVoxel);
      if (std::abs(exact) > 1e-4) continue;
      ++near;
      EXPECT_GT(sample.distance - exact, -1e-8 - 0.5 * grid.grid.quantum)
          << "a convex function is never missed from below but by rounding";
      worst = std::max(worst, sample.distance - exact);
    }
    EXPECT_GT(near, 150);
    EXPECT_LT(worst, tolerance * kVoxel);
  }
}

std::string as_obj(const TriangleMesh& mesh) {
  std::string text;
  for (const Vector3d& v : mesh.vertices) text += fmt::format("v {:.9g} {:.9g} {:.9g}\n", v.x(), v.y(), v.z());
  for (const auto& t : mesh.triangles) text += fmt::format("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  return text;
}

/// A god object in a compiled scene.
struct Rendered {
  explicit Rendered(const std::filesystem::path& file, Solver solver = Solver::kContact, bool friction = false)
      : image(files::SceneImage::read(file)) {
    EXPECT_EQ(god_object.start(image.scene, solver, friction), Status::kOk);
  }

  /// `center`: of the ball at the device.
  CycleReport update(const Vector3d& center, const Quaternion& rotation) {
    GodObject::Input input;
    input.H_WM.rotation = rotation;
    input.H_WM.translation = center - rotation * kCenter;
    CycleReport report;
    EXPECT_EQ(god_object->update(input, report), Status::kOk);
    return report;
  }
  Vector3d center() const { return god_object->mesh_pose() * kCenter; }

  files::SceneImage image;
  OwnedGodObject god_object;
};

class BallScene : public testing::Test {
 protected:
  struct Text {
    bool ball = true;
    std::string still = mesh_file("cube_100mm").string();
    std::string moving = "ball.obj";
    double voxel_size = kVoxel;
    double tolerance = 0.05;
    std::string more = "";
  };

  /// Returns the scene file's text, and writes its ball.
  std::string scene(const Text& text) {
    Eigen::Isometry3d to_center = Eigen::Isometry3d::Identity();
    to_center.translation() = kCenter;
    folder_.write("ball.obj", as_obj(test::moved(test::ball_mesh(kRadius, 60), to_center)));
    return fmt::format(
        "[still]\nmesh = \"{}\"\nvoxel_size = {:.9g}\nfield_tolerance = {:.9g}\n[moving]\n"
        "mesh = \"{}\"\npoints = 1000\nlevels = 4\nball = {}\n{}",
        text.still, text.voxel_size, text.tolerance, text.moving, text.ball, text.more);
  }

  CompileReport compile(const Text& text, const char* output = "out.scene", std::optional<format::Solver> only = {}) {
    return compile_once(scene(text), folder_, output, only);
  }

  void expect_refused(const Text& text, command::ExitCode code, const std::string& words,
                      std::optional<format::Solver> only = {}) {
    try {
      compile(text, "refused.scene", only);
      FAIL() << "took what should say: " << words;
    } catch (const command::Failure& failure) {
      EXPECT_EQ(failure.exit_code(), code);
      const std::string said = failure.what();
      EXPECT_NE(said.find(words), std::string::npos) << said;
      EXPECT_NE(said.find("moving.ball"), std::string::npos) << "names no cure: " << said;
    }
    EXPECT_FALSE(std::filesystem::exists(folder_.file("refused.scene")));
  }

  ScratchFolder folder_;
};

TEST_F(BallScene, HoldsOnePointAndNothingOfTheSecondDirection) {
  const CompileReport report = compile({});
  ASSERT_TRUE(report.ball);
  const SceneView& scene = files::SceneImage::read(folder_.file("out.scene")).scene;
  EXPECT_EQ(scene.pointshell.size, 1u);
  EXPECT_EQ(scene.pointshell.point(0), Vector3::Zero());
  EXPECT_LT((scene.H_MB.translation - kCenter).norm(), 1e-8);
  EXPECT_FALSE(scene.has_features());
  EXPECT_FALSE(scene.holds(format::Solver::kPaper));
  EXPECT_TRUE(scene.holds(format::Solver::kCorrected));
  EXPECT_NEAR(ball_radius(scene), kRadius, 1e-8);
  const std::string text = report_text(report);
  EXPECT_NE(text.find("ball     of 10 mm radius, the mesh at most 0.00685"), std::string::npos) << text;
  EXPECT_NE(text.find("points of the ball, which its centre stands for"), std::string::npos) << text;
  EXPECT_EQ(text.find("from friction, whose lever"), std::string::npos) << text;
  EXPECT_EQ(verdict_text(report), "ready: the field is within its tolerance near the surface at the ball's radius");
  const CompileReport rough = compile({.more = "[friction]\nstatic = 0.2\n"});
  EXPECT_NE(report_text(rough).find("from friction, whose lever"), std::string::npos);
  EXPECT_NE(verdict_text(rough).find("with limits: friction cannot turn a ball"), std::string::npos);
}

/// Moves the device 1 mm under the surface of the cube dilated by the ball, along a polygon outside: over faces, edges
/// and corners. `at` gets the place on the cube and the outward direction.
template <class At>
void follow_cube(At&& at) {
  const std::vector<Vector3d> corners = {{0.0, 0.0, 0.08},   {0.08, 0.01, 0.08},   {0.08, 0.0, 0.0}, {0.08, 0.08, 0.08},
                                         {0.01, 0.08, 0.02}, {-0.08, 0.08, -0.08}, {0.0, 0.0, -0.08}};
  constexpr double kStep = 1e-4;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const Vector3d way = corners[i] - corners[i - 1];
    for (double t = 0.0; t < 1.0; t += kStep / way.norm()) {
      const Vector3d outside = corners[i - 1] + t * way;
      const Vector3d nearest = outside.cwiseMax(-kHalfCube).cwiseMin(kHalfCube);
      if ((outside - nearest).norm() > 1e-3) at(nearest, Vector3d((outside - nearest).normalized()));
    }
  }
}

constexpr double kDepth = 1e-3;
constexpr double kStiffness = 2000.0;

/// The field's gradient may be that of a place up to a cell away, where the rounded edge is turned by cell / kRadius.
struct Tolerated {
  double field_tolerance;  // voxels
  double cell;             // largest on the rounded edges [voxels]
};

class BallOnCube : public BallScene, public testing::WithParamInterface<Tolerated> {};

TEST_P(BallOnCube, StandsWhereGeometryHasIt) {
  const Tolerated& tolerated = GetParam();
  compile({.tolerance = tolerated.field_tolerance});
  Rendered ball(folder_.file("out.scene"));
  const double margin = ball.image.scene.settings.margin;
  const double angle = tolerated.cell * kVoxel / kRadius;
  double lowest = 1.0, highest = -1.0, worst_angle = 0.0, force_off = 0.0;
  int cycle = 0;
  follow_cube([&](const Vector3d& on_cube, const Vector3d& normal) {
    const Quaternion rotation(Eigen::AngleAxisd(1e-3 * cycle++, Vector3d(0.6, 0.0, 0.8)));
    const CycleReport report = ball.update(on_cube + (kRadius - kDepth) * normal, rotation);
    EXPECT_LT(ball.god_object->mesh_pose().rotation.angularDistance(rotation), 1e-7);
    EXPECT_LT(report.force.spring_W.torque.norm(), 1e-9);
    if (cycle < 20) return;  // it started inside and moves out
    EXPECT_LE(report.penetration, 0.0);
    const double gap = to_cube(ball.center()) - kRadius;
    lowest = std::min(lowest, gap);
    highest = std::max(highest, gap);
    const Vector3d& f = report.force.spring_W.force;
    worst_angle = std::max(worst_angle, std::acos(std::min(1.0, f.normalized().dot(normal))));
    force_off = std::max(force_off, std::abs(f.norm() - kStiffness * (kDepth + margin)));
  });
  fmt::print(
      "{} cycles, field tolerance {} voxels: gap {:.4f} .. {:.4f} mm, force off by {:.3f} N and {:.2f} degrees\n",
      cycle, tolerated.field_tolerance, 1e3 * lowest, 1e3 * highest, force_off, 57.3 * worst_angle);
  EXPECT_GT(cycle, 4000);
  const double tolerance = tolerated.field_tolerance * kVoxel;
  EXPECT_GT(lowest, margin - tolerance);
  EXPECT_LT(highest, margin + 2e-6);
  EXPECT_LT(worst_angle, angle);
  EXPECT_LT(force_off, kStiffness * (tolerance + kRadius * angle * angle));
}

INSTANTIATE_TEST_SUITE_P(OfTolerance, BallOnCube, testing::Values(Tolerated{0.05, 1.0}, Tolerated{0.005, 0.5}));

/// The same image with `contact_cycle`, for which the ball's centre is an ordinary point.
TEST_F(BallScene, StandsWhereTheCycleOfManyPointsHasItsCentre) {
  compile({});
  Rendered ball(folder_.file("out.scene"));
  const SceneView& scene = ball.image.scene;
  const Parameters& parameters = ball.god_object.parameters();
  const ContactScene<Voxelmap, Voxelmap> contact(scene.voxelmap, scene.pointshell, {}, parameters);
  const auto memory = std::make_unique<ContactMemory>();
  std::vector<std::uint32_t> words(ContactSearch::memory(scene.pointshell, {}));
  memory->search.start(contact, words);
  ProxyState state;
  double apart = 0.0, force_apart = 0.0, damped_apart = 0.0;
  int cycle = 0;
  follow_cube([&](const Vector3d& on_cube, const Vector3d& normal) {
    const Vector3d center = on_cube + (kRadius - kDepth * std::sin(2e-3 * cycle++)) * normal;
    CycleInput input;
    input.H_WD.rotation = Quaternion(Eigen::AngleAxisd(1e-3 * cycle, Vector3d(0.6, 0.0, 0.8)));
    input.H_WD.translation = center;
    input.velocity_W.translation = Vector3(0.05 * std::cos(0.01 * cycle), 0.03, -0.04);
    GodObject::Input device;
    device.H_WM = input.H_WD * scene.H_MB.inverse();
    device.velocity_W = input.velocity_W;
    CycleReport report, expected;
    ASSERT_EQ(ball.god_object->update(device, report), Status::kOk);
    if (!state.started) state.H_WS = input.H_WD;
    ASSERT_EQ(contact_cycle<false>(contact, input, *memory, state, expected), Status::kOk);
    EXPECT_EQ(report.outcome, expected.outcome) << cycle;
    apart = std::max(apart, (report.H_WS.translation - expected.H_WS.translation).norm());
    force_apart = std::max(force_apart, (report.force.spring_W.force - expected.force.spring_W.force).norm());
    damped_apart = std::max(damped_apart, (report.force.total_W.force - expected.force.total_W.force).norm());
  });
  fmt::print("{} cycles: {:.3g} m apart, {:.3g} N, {:.3g} N with damping\n", cycle, apart, force_apart, damped_apart);
  // required gap increases are met within the tolerance, and ContactRows stores them in single precision
  const double tolerance = 1.5 * ContactLengths::make(parameters).metric.tolerance;
  EXPECT_LT(apart, tolerance);
  EXPECT_LT(force_apart, kStiffness * tolerance);
  EXPECT_LT(damped_apart, 0.01) << "of 1.2 N: the normals are those of places as far apart";
}

TEST_F(BallScene, StandsOnFacesWhereManyPointsStand) {
  const CompileReport with = compile({}, "with.scene");
  const CompileReport without =
      compile({.ball = false, .more = "[contact]\nboth_directions = false\n"}, "without.scene");
  Rendered ball(folder_.file("with.scene"));
  Rendered points(folder_.file("without.scene"));
  // the mesh lies inside the ball, and its points are up to `coverage` from a place of it
  const double polyhedron = with.ball->deviation + std::pow(without.points.spread.coverage, 2) / (2.0 * kRadius);
  double apart = 0.0, force_apart = 0.0, torque = 0.0;
  int compared = 0;
  follow_cube([&](const Vector3d& on_cube, const Vector3d& normal) {
    // beside an edge, which can enter between the points, the ball is lifted
    const bool on_face = (on_cube.cwiseAbs().array() > kHalfCube - kRadius).count() == 1;
    const Vector3d device = on_cube + (kRadius + (on_face ? -kDepth : 5e-3)) * normal;
    const CycleReport one = ball.update(device, Quaternion::Identity());
    const CycleReport many = points.update(device, Quaternion::Identity());
    if (!on_face || many.outcome != Outcome::kContact || one.outcome != Outcome::kContact) return;
    ++compared;
    apart = std::max(apart, (ball.center() - points.center()).norm());
    force_apart = std::max(force_apart, (one.force.spring_W.force - many.force.spring_W.force).norm());
    torque = std::max(torque, many.force.spring_W.torque.norm());
  });
  fmt::print(
      "{} cycles: centres {:.4f} mm apart, {:.4f} mm are the polyhedron's own; forces {:.3f} N apart, torque of "
      "the points {:.2g} Nm\n",
      compared, 1e3 * apart, 1e3 * polyhedron, force_apart, torque);
  EXPECT_GT(compared, 1000);
  EXPECT_LT(apart, polyhedron);
  EXPECT_LT(force_apart, kStiffness * polyhedron);
}

TEST_F(BallScene, CrossesNothingWhateverTheDeviceDoes) {
  compile({});
  Rendered ball(folder_.file("out.scene"));
  const double tolerance = 0.05 * kVoxel;
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  Vector3d device(0.0, 0.0, 0.09);
  for (int throws = 0; throws < 300; ++throws) {
    const Vector3d target = 0.1 * Vector3d(unit(random), unit(random), unit(random));
    const double step = 0.5e-3 * std::pow(14.0, std::abs(unit(random)));  // 0.5 .. 7 m/s
    const Quaternion rotation(Eigen::AngleAxisd(unit(random), Vector3d::UnitX()));
    while ((target - device).norm() > 1e-9) {
      device += std::min(1.0, step / (target - device).norm()) * (target - device);
      const CycleReport report = ball.update(device, rotation);
      ASSERT_LE(report.penetration, 0.0);
      ASSERT_GT(to_cube(ball.center()) - kRadius, -tolerance);
    }
  }
}

TEST_F(BallScene, RendersWithTheClosedFormToo) {
  compile({});
  Rendered ball(folder_.file("out.scene"), Solver::kCorrected);
  CycleReport report;
  for (int i = 0; i < 300; ++i) {
    report = ball.update({0.01, 0.0, 0.062 - 1e-5 * std::min(i, 250)}, Quaternion::Identity());
  }
  EXPECT_NEAR(ball.center().z(), kHalfCube + kRadius, 1e-5);
  EXPECT_NEAR(report.force.spring_W.force.z(), 2000.0 * 0.5e-3, 0.02);
  EXPECT_LT(report.force.spring_W.torque.norm(), 1e-9);
}

TEST_F(BallScene, RubsWithoutALever) {
  compile({.more = "[friction]\nstatic = 0.2\nkinetic = 0.2\n"});
  Rendered ball(folder_.file("out.scene"), Solver::kContact, true);
  CycleReport report;
  for (int i = 0; i < 400; ++i) {
    const Quaternion rotation(Eigen::AngleAxisd(1e-3 * i, Vector3d::UnitY()));
    report = ball.update({1e-4 * (i - 200), 0.0, 0.059}, rotation);
    EXPECT_LT(ball.god_object->mesh_pose().rotation.angularDistance(rotation), 1e-7);
  }
  const Vector3d f = report.force.spring_W.force;
  EXPECT_NEAR(-f.x() / f.z(), 0.2, 2e-3);
  EXPECT_LT(report.force.spring_W.torque.norm(), 1e-9);
}

TEST_F(BallScene, TellsDistancesFromTheMesh) {
  compile({});
  const files::SceneImage image = files::SceneImage::read(folder_.file("out.scene"));
  const auto points = folder_.write("p.csv", "0,0,0.061\n0,0.0585,0.01\n0,0,0\n0,0,1\n");
  query::query_points(image.scene, points, folder_.file("d.csv"), {});
  std::ifstream rows(folder_.file("d.csv"));
  std::string row;
  std::getline(rows, row);
  const double band = image.scene.grid.band;
  for (const double expected : {0.011, 0.0085, kRadius - band, kRadius + band}) {
    std::getline(rows, row);
    std::replace(row.begin(), row.end(), ',', ' ');
    std::istringstream numbers(row);
    double x = 0.0, y = 0.0, z = 0.0, distance = 0.0;
    numbers >> x >> y >> z >> distance;
    EXPECT_NEAR(distance, expected, 1e-7 + 0.5 * image.scene.grid.quantum);
  }
}

TEST_F(BallScene, RefusesWhatItWouldRenderWrongly) {
  using command::ExitCode;
  expect_refused({.moving = mesh_file("cube_100mm").string()}, ExitCode::kBadData, "is not a ball");
  expect_refused({.still = mesh_file("bracket").string()}, ExitCode::kBadData, "is not one closed convex solid");
  expect_refused({.voxel_size = 0.011}, ExitCode::kBadData, "smaller than a voxel");
  expect_refused({.more = "[contact]\nsolver = \"paper\"\n"}, ExitCode::kBadConfig, "contact.solver");
  expect_refused({}, ExitCode::kBadConfig, "--only-solver paper", format::Solver::kPaper);
}

}  // namespace
}  // namespace godobject::scene_compiler::ball_test
