#include "toolchain/scene_compiler/scene_config.h"

#include <optional>

#include <gtest/gtest.h>

#include "godobject/scene.h"
#include "tests/scene_compiler/test_meshes.h"
#include "toolchain/command_line/failure.h"

namespace godobject::scene_compiler::scene_config_test {
namespace {

constexpr const char* kStill = "[still]\nmesh = \"a.ply\"\nvoxel_size = 0.002\n";
constexpr const char* kMoving = "[moving]\nmesh = \"b.ply\"\n";

SceneConfig read(const std::string& text) {
  const ScratchFolder folder;
  return read_scene_config(folder.write("scene.toml", text));
}

/// Reads a scene that must be refused. The message must name the line and the key.
void expect_refused(const std::string& text, const std::string& line, const std::string& key) {
  try {
    read(text);
    FAIL() << "took it:\n" << text;
  } catch (const command::Failure& failure) {
    EXPECT_EQ(failure.exit_code(), command::ExitCode::kBadConfig);
    const std::string message = failure.what();
    EXPECT_NE(message.find(line), std::string::npos) << message;
    EXPECT_NE(message.find(key), std::string::npos) << message;
  }
}

TEST(SceneConfig, FillsInDefaultsAsMultiplesOfTheVoxel) {
  const SceneConfig config = read(std::string(kStill) + kMoving);
  EXPECT_EQ(config.still.scale, 1.0);
  EXPECT_EQ(config.still.surface, SurfaceKind::kAuto);
  EXPECT_DOUBLE_EQ(config.thickness, 0.004);
  EXPECT_DOUBLE_EQ(config.settings.safety_distance, 0.003);
  EXPECT_DOUBLE_EQ(config.settings.margin, 2e-5);
  EXPECT_EQ(config.settings.default_solver, static_cast<std::uint32_t>(format::Solver::kContact));
  EXPECT_EQ(config.settings.solvers, 7u);
  EXPECT_EQ(config.settings.friction, 0u);
  EXPECT_DOUBLE_EQ(config.settings.paper_rotation_static, 0.2);
  EXPECT_DOUBLE_EQ(config.settings.paper_rotation_kinetic, 0.18);
  EXPECT_DOUBLE_EQ(config.settings.paper_viscous, 0.002);
  EXPECT_DOUBLE_EQ(config.settings.stiffness, 2000.0);
  EXPECT_EQ(config.settings.period, 1e-3);
  EXPECT_EQ(config.levels, 7u);
}

TEST(SceneConfig, ReadsTheSecondDirection) {
  const SceneConfig plain = read(std::string(kStill) + kMoving);
  EXPECT_TRUE(plain.both_directions);
  EXPECT_DOUBLE_EQ(plain.between_points, 0.002);
  EXPECT_DOUBLE_EQ(plain.body_voxel_size, 0.002);
  const SceneConfig said = read(std::string(kStill) + kMoving +
                                "voxel_size = 0.001\n[contact]\nboth_directions = false\nbetween_points = 1e-4\n");
  EXPECT_FALSE(said.both_directions);
  EXPECT_DOUBLE_EQ(said.between_points, 1e-4);
  EXPECT_DOUBLE_EQ(said.body_voxel_size, 0.001);
  expect_refused(std::string(kStill) + kMoving + "[contact]\nboth_directions = 1\n", ":7", "contact.both_directions");
}

TEST(SceneConfig, ReadsTheFieldsTolerance) {
  EXPECT_DOUBLE_EQ(read(std::string(kStill) + kMoving).field_tolerance, 0.05);
  EXPECT_DOUBLE_EQ(read(std::string(kStill) + "field_tolerance = 0.2\n" + kMoving).field_tolerance, 0.2);
  expect_refused(std::string(kStill) + "field_tolerance = 0\n" + kMoving, ":4:", "still.field_tolerance");
  expect_refused(std::string(kStill) + "field_tolerance = \"fine\"\n" + kMoving, ":4:", "still.field_tolerance");
}

TEST(SceneConfig, ReadsAnAccuracyForBothBodiesInPlaceOfATolerance) {
  const SceneConfig usual = read(std::string(kStill) + kMoving);
  EXPECT_FALSE(usual.accuracy);
  EXPECT_DOUBLE_EQ(usual.surface_tolerance(0.002).inside, 0.05 * 0.002);
  EXPECT_DOUBLE_EQ(usual.surface_tolerance(0.002).outside, 0.25 * 0.002);
  const SceneConfig config = read(std::string(kStill) + "accuracy = 1e-5\n" + kMoving + "voxel_size = 0.001\n");
  for (const double voxel : {0.002, 0.001}) {
    EXPECT_EQ(config.surface_tolerance(voxel).inside, 1e-5);
    EXPECT_EQ(config.surface_tolerance(voxel).outside, 1e-5);
  }
  EXPECT_EQ(config.settings.margin, 1e-5) << "no gap is wider";
  EXPECT_EQ(read(std::string(kStill) + "accuracy = 1e-4\n" + kMoving).settings.margin, 2e-5);
  expect_refused(std::string(kStill) + "accuracy = 0\n" + kMoving, ":4:", "still.accuracy");
  expect_refused(std::string(kStill) + "accuracy = 0.0021\n" + kMoving, ":4:", "still.accuracy");
  expect_refused(std::string(kStill) + "accuracy = 1e-5\nfield_tolerance = 0.1\n" + kMoving,
                 ":5:", "leave one of them out");
}

TEST(SceneConfig, LeavesTheVoxelsToTheCompilerIfItStatesAnAccuracy) {
  EXPECT_FALSE(read(std::string(kStill) + "accuracy = 1e-5\n" + kMoving).chooses_voxels);
  const ScratchFolder folder;
  const auto read_chosen = [&](const std::string& more, const VoxelSizes& chosen) {
    return read_scene_config(
        folder.write("scene.toml", "[still]\nmesh = \"a.ply\"\naccuracy = 1e-5\n" + std::string(kMoving) + more),
        chosen);
  };
  const SceneConfig first = read_chosen("", {});
  EXPECT_TRUE(first.chooses_voxels);
  EXPECT_TRUE(first.chooses_body_voxels);
  EXPECT_DOUBLE_EQ(first.voxel_size, 4e-4);
  EXPECT_DOUBLE_EQ(first.body_voxel_size, 4e-4);
  EXPECT_DOUBLE_EQ(first.between_points, 2e-4);
  const SceneConfig next = read_chosen("", {1e-4, 5e-5});
  EXPECT_DOUBLE_EQ(next.voxel_size, 1e-4);
  EXPECT_DOUBLE_EQ(next.body_voxel_size, 5e-5);
  EXPECT_DOUBLE_EQ(next.between_points, 1e-4);
  EXPECT_DOUBLE_EQ(next.thickness, 2e-4) << "other lengths follow";
  const SceneConfig stated = read_chosen("voxel_size = 3e-4\n", {1e-4, 5e-5});
  EXPECT_FALSE(stated.chooses_body_voxels);
  EXPECT_DOUBLE_EQ(stated.body_voxel_size, 3e-4);
  EXPECT_EQ(stated.voxel_size, 1e-4);
}

TEST(SceneConfig, HasEdgeAgainstEdgeAsTold) {
  const std::string bodies = std::string(kStill) + kMoving;
  EXPECT_EQ(read(bodies).edges, std::nullopt);
  EXPECT_EQ(read(bodies + "[contact]\nedges = false\n").edges, false);
  EXPECT_EQ(read(bodies + "[contact]\nedges = true\n").edges, true);
  expect_refused(bodies + "[contact]\nedges = 1\n", ":", "contact.edges");
}

TEST(SceneConfig, ReadsTheWorkspace) {
  const std::string bodies = std::string(kStill) + kMoving;
  EXPECT_FALSE(read(bodies).workspace);
  const SceneConfig config = read(bodies + "[workspace]\nlow = [-0.1, 0, -1e-3]\nhigh = [0.1, 0, 2]\n");
  ASSERT_TRUE(config.workspace);
  EXPECT_EQ(config.workspace->low[0], -0.1);
  EXPECT_EQ(config.workspace->low[2], -1e-3);
  EXPECT_EQ(config.workspace->high[1], 0.0);  // flat is allowed
  EXPECT_EQ(config.workspace->high[2], 2.0);
  const auto refused = [&](const std::string& low, const std::string& high, const char* line, const char* words) {
    expect_refused(bodies + "[workspace]\nlow = " + low + "\nhigh = " + high + "\n", line, words);
  };
  refused("[0, 0, 0]", "[1, -1e-9, 1]", ":8", "workspace.high lies below low along y, -1e-09 < 0");
  refused("[0, 0]", "[1, 1, 1]", ":7", "workspace.low");
  refused("[0, 0, 0]", "[1, 1, 1, 1]", ":8", "workspace.high");
  refused("[0, nan, 0]", "[1, 1, 1]", ":7", "workspace.low");
  refused("[0, 0, 0]", "[1, 1, inf]", ":8", "workspace.high");
  refused("[0, 0, -2e7]", "[1, 1, 1]", ":7", "workspace.low");
  refused("[0, 0, \"0\"]", "[1, 1, 1]", ":7", "workspace.low");
  refused("0", "[1, 1, 1]", ":7", "workspace.low");
  expect_refused(bodies + "[workspace]\nlow = [0, 0, 0]\n", ":6", "workspace.high");
  expect_refused(bodies + "[workspace]\nhigh = [0, 0, 0]\n", ":6", "workspace.low");
  expect_refused(bodies + "[workspace]\nlow = [0, 0, 0]\nhigh = [1, 1, 1]\nmiddle = 0\n", ":9", "workspace.middle");
}

TEST(SceneConfig, ReadsEveryKey) {
  const SceneConfig config = read(
      "[still]\nmesh = \"m/a.ply\"\nscale = 2\nvoxel_size = 0.001\nsurface = \"shell\"\nthickness = 0.003\n"
      "[moving]\nmesh = \"b.stl\"\nscale = 0.5\nsurface = \"solid\"\npoints = 100\nlevels = 3\n"
      "[contact]\nsolver = \"paper\"\nsafety_distance = 0.002\nmargin = 1e-5\npoint_budget = 500\n"
      "[friction]\nstatic = 0.3\nkinetic = 0.25\nviscous = 0.1\n"
      "[paper]\nrotation_static = 0.1\nrotation_kinetic = 0.05\nviscous = 0.001\n"
      "[coupling]\nstiffness = 1000\ndamping = 0\nrotational = 0.01\nperiod = 0.002\n");
  EXPECT_EQ(config.settings.period, 0.002);
  EXPECT_EQ(config.still.file.filename(), "a.ply");
  EXPECT_EQ(config.still.file.parent_path().filename(), "m");
  EXPECT_EQ(config.still.surface, SurfaceKind::kShell);
  EXPECT_EQ(config.moving.surface, SurfaceKind::kSolid);
  EXPECT_EQ(config.points, 100u);
  EXPECT_EQ(config.settings.default_solver, static_cast<std::uint32_t>(format::Solver::kPaper));
  EXPECT_EQ(config.settings.point_budget, 500u);
  EXPECT_EQ(config.settings.friction, 1u);
  EXPECT_DOUBLE_EQ(config.settings.friction_kinetic, 0.25);
  EXPECT_DOUBLE_EQ(config.settings.paper_viscous, 0.001);
  EXPECT_DOUBLE_EQ(config.settings.damping, 0.0);
}

TEST(SceneConfig, RefusesWithLineAndKey) {
  const std::string still = kStill;
  const std::string moving = kMoving;
  expect_refused(still + "voxelsize = 1\n" + moving,
                 ":4:", "still.voxelsize is not a known key; known here: mesh, scale, voxel_size, ");
  expect_refused("[still]\nvoxel_size = 0.002\n" + moving,
                 ":1:", "still.mesh is missing and has no default; below [still] write mesh = \"teapot.ply\"");
  expect_refused("[still]\nmesh = \"a.ply\"\n" + moving, ":1:", "below [still] write voxel_size = 0.002");
  expect_refused(still, "scene.toml", "below [moving] write mesh = ");
  expect_refused("[still]\nmesh = \"a.ply\"\nvoxel_size = -1\n" + moving, ":3:", "still.voxel_size");
  expect_refused("[still]\nmesh = \"a.ply\"\nvoxel_size = nan\n" + moving, ":3:", "still.voxel_size");
  expect_refused("[still]\nmesh = \"a.ply\"\nvoxel_size = \"2 mm\"\n" + moving, ":3:", "must be a number");
  expect_refused("[still]\nmesh = 3\nvoxel_size = 1\n" + moving, ":2:", "still.mesh");
  expect_refused(still + "surface = \"both\"\n" + moving, ":4:", "still.surface");
  expect_refused(still + "thickness = 0.001\n" + moving, ":4:", "still.thickness");
  expect_refused(still + moving + "points = 2.5\n", ":6:", "moving.points");
  expect_refused(still + moving + "points = 0\n", ":6:", "moving.points");
  expect_refused(still + moving + "levels = 99\n", ":6:", "moving.levels");
  expect_refused(still + moving + "[contact]\nsolver = \"best\"\n", ":7:", "contact.solver");
  expect_refused(still + moving + "[contact]\nmargin = 0.1\n", ":7:", "contact.margin");
  expect_refused(still + moving + "[contact]\npoint_budget = -1\n", ":7:", "contact.point_budget");
  expect_refused(still + moving + "[friction]\nkinetic = 0.1\n", ":6:", "below [friction] write static = 0.2");
  expect_refused(still + moving + "[friction]\nstatic = 0.1\nkinetic = 0.2\n", ":8:", "friction.kinetic");
  expect_refused(still + moving + "[coupling]\nstiffness = 0\n", ":7:", "coupling.stiffness");
  expect_refused(still + moving + "[coupling]\nperiod = 0.0001\n", ":7:", "coupling.period");
  expect_refused(still + moving + "[coupling]\nperiod = 0.011\n", ":7:", "coupling.period");
  expect_refused(still + moving + "[colour]\nred = 1\n", ":6:", "colour is not a known table; known: still, moving, ");
  expect_refused("still = 3\n" + moving, ":1:", "still");
  expect_refused(still + "mesh = \"again.ply\"\n", ":4:", "not TOML");
}

TEST(SceneConfig, SaysWhenThereIsNoFile) {
  try {
    read_scene_config("/nowhere/scene.toml");
    FAIL();
  } catch (const command::Failure& failure) {
    EXPECT_EQ(failure.exit_code(), command::ExitCode::kNoInput);
  }
}

}  // namespace
}  // namespace godobject::scene_compiler::scene_config_test
