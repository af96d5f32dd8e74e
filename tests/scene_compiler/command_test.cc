#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include <sys/wait.h>

#include <gtest/gtest.h>

#include "tests/scene_compiler/simple_meshes.h"
#include "tests/scene_compiler/test_meshes.h"
#include "toolchain/scene_compiler/mesh/thin_places.h"

namespace godobject::scene_compiler::command_test {
namespace {

struct Outcome {
  int exit_code = -1;
  std::string output;  // stdout and stderr
};

Outcome run(const std::string& command) {
  Outcome outcome;
  FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  std::array<char, 4096> buffer;
  while (const std::size_t got = std::fread(buffer.data(), 1, buffer.size(), pipe))
    outcome.output.append(buffer.data(), got);
  outcome.exit_code = WEXITSTATUS(::pclose(pipe));
  return outcome;
}

const std::string kScenec = GODOBJECT_SCENEC;
const std::string kQuery = GODOBJECT_QUERY;

/// Expects one line that names the place and the cure, and the exit code.
void expect_refusal(const std::string& command, int exit_code, const std::string& names) {
  const Outcome outcome = run(command);
  EXPECT_EQ(outcome.exit_code, exit_code) << outcome.output;
  EXPECT_NE(outcome.output.find(names), std::string::npos) << outcome.output;
  ASSERT_FALSE(outcome.output.empty());
  EXPECT_EQ(outcome.output.find('\n'), outcome.output.size() - 1) << "not one line: " << outcome.output;
}

TEST(Command, HelpShowsAnExampleAndVersion) {
  for (const std::string& command : {kScenec, kQuery}) {
    const Outcome help = run(command + " --help");
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_NE(help.output.find("Example"), std::string::npos);
    EXPECT_NE(help.output.find("Exit codes: 0 done, 64 usage"), std::string::npos);
    EXPECT_EQ(help.output.find("TEXT"), std::string::npos) << "says not what is wanted: " << help.output;
    const Outcome version = run(command + " --version");
    EXPECT_EQ(version.exit_code, 0);
    EXPECT_NE(version.output.find("godobject-"), std::string::npos);
  }
}

TEST(Command, HelpStatesTheRuleOfRefusal) {
  EXPECT_NE(run(kScenec + " --help").output.find(std::string("A wall of a solid is\n") + kRefusalRule),
            std::string::npos);
}

TEST(Command, RefusesInOneLineWithTheRightExitCode) {
  const ScratchFolder folder;
  const std::string out = " -o " + folder.file("o.scene").string();
  const auto scene = [&folder](const std::string& text) { return folder.write("s.toml", text).string(); };
  const std::string moving = "[moving]\nmesh = \"" + mesh_file("cube_100mm").string() + "\"\npoints = 50\nlevels = 2\n";
  const auto still = [](const std::string& mesh) { return "[still]\nmesh = \"" + mesh + "\"\nvoxel_size = 0.004\n"; };
  expect_refusal(kScenec, 64, "SCENE.toml");
  expect_refusal(kScenec + " --wrong", 64, "--wrong");
  expect_refusal(kScenec + " " + scene(moving), 64, "-o");
  expect_refusal(kScenec + " /nowhere.toml" + out, 66, "/nowhere.toml");
  expect_refusal(kScenec + " " + scene("[still]\nmush = 1\n" + moving) + out, 78, "still.mush");
  expect_refusal(kScenec + " " + scene(still("gone.ply") + moving) + out, 66, "gone.ply");
  folder.write("empty.ply", "");
  expect_refusal(kScenec + " " + scene(still("empty.ply") + moving) + out, 65, "empty.ply");
  expect_refusal(kScenec + " " + scene(still(mesh_file("cube_100mm").string()) + moving) + " -o /nowhere/o.scene", 74,
                 "/nowhere/o.scene");
  const std::string good = scene(still(mesh_file("cube_100mm").string()) + moving);
  expect_refusal(kScenec + " " + good + " -o /dev/null", 74, "/dev/null: is a device");
  expect_refusal(kScenec + " " + good + out + " --report /dev", 74, "/dev: is a folder");
  EXPECT_FALSE(std::filesystem::exists(folder.file("o.scene")));
  expect_refusal(kScenec + " " + good + " -o " + folder.file("s.toml").string() + "/o.scene", 74, "is not a folder");
  expect_refusal(kScenec + " " + good + out + " --report /nowhere/r.json", 74, "there is no folder /nowhere");
  EXPECT_FALSE(std::filesystem::exists(folder.file("o.scene")));
  expect_refusal(kScenec + " " + folder.file("").string() + out, 66, "is a folder");
  expect_refusal(kScenec + " " + scene(still(folder.file("").string() + "x.ply/") + moving) + out, 65, "x.ply/");
  std::filesystem::create_directory(folder.file("f.ply"));
  expect_refusal(kScenec + " " + scene(still("f.ply") + moving) + out, 66, "f.ply: is a folder");
  expect_refusal(kScenec + " --inspect", 64, "the image is missing");
  expect_refusal(kScenec + " --inspect a.scene b.scene", 64, "--inspect takes one image");
  expect_refusal(kScenec + " --inspect a.scene" + out, 64, "--inspect takes one image");
  expect_refusal(kScenec + " --inspect a.scene --traits a.cmake", 64, "--inspect takes one image");
  expect_refusal(kScenec + " --inspect " + folder.write("x.scene", "nonsense").string(), 65,
                 "x.scene: is not a scene image (X.scene, made by godobject-scenec)");
  expect_refusal(kQuery + " " + good + " p.csv -o o.csv", 65, "s.toml: is not a scene image");
  expect_refusal(kScenec + " --inspect /nowhere.scene", 66, "/nowhere.scene");
  expect_refusal(kQuery + " /nowhere.scene p.csv -o o.csv", 66, "/nowhere.scene: no such file");
}

TEST(Command, CompilesInspectsAndQueries) {
  const ScratchFolder folder;
  const std::string mesh = mesh_file("cube_100mm").string();
  const std::string scene =
      folder
          .write("s.toml", "[still]\nmesh = \"" + mesh + "\"\nvoxel_size = 0.004\n[moving]\nmesh = \"" + mesh +
                               "\"\nscale = 0.2\npoints = 100\nlevels = 2\n")
          .string();
  const std::string image = folder.file("o.scene").string();
  const Outcome compiled = run(kScenec + " " + scene + " -o " + image + " --report " + folder.file("r.json").string());
  EXPECT_EQ(compiled.exit_code, 0) << compiled.output;
  EXPECT_NE(compiled.output.find("floor of trilinear interpolation"), std::string::npos);
  EXPECT_NE(compiled.output.find("points on the wrong side by more than 0.1 voxel: "), std::string::npos);
  EXPECT_EQ(compiled.output.find(" 0.0 KiB saved"), std::string::npos) << compiled.output;
  EXPECT_EQ(compiled.output.find(": -"), std::string::npos) << compiled.output;
  EXPECT_TRUE(std::filesystem::exists(folder.file("r.json")));
  const Outcome inspected = run(kScenec + " --inspect " + image);
  EXPECT_EQ(inspected.exit_code, 0);
  EXPECT_EQ(inspected.output.find("{"), 0u);
  EXPECT_EQ(run(kScenec + " " + image + " --inspect").output, inspected.output);
  expect_refusal(kQuery + " " + image + " " + folder.file("q.csv").string() + " -o o.csv", 66, "q.csv: no such file");
  expect_refusal(kQuery + " " + image + " p.csv -o /nowhere/o.csv", 74, "there is no folder /nowhere");
  const std::string points = folder.write("p.csv", "0,0,0.06\n").string();
  EXPECT_EQ(run(kQuery + " " + image + " " + points + " -o " + folder.file("d.csv").string()).exit_code, 0);
}

/// A tube without ends is neither a solid nor a sheet. The verdict says what it was taken for, unless the scene file
/// does.
TEST(Command, NamesAPartThatMayBeASolidOrASheet) {
  const ScratchFolder folder;
  const TriangleMesh tube = box(Eigen::Vector3d::Zero(), {0.02, 0.02, 0.03}, {true, true, true, true, false, false});
  folder.write("tube.obj", test::obj_text(tube));
  folder.write("cube.obj", test::obj_text(test::box_mesh(Eigen::Vector3d::Constant(0.01))));
  const auto verdict = [&](const std::string& surface) {
    const std::string text = "[still]\nmesh = \"tube.obj\"\nvoxel_size = 0.002\n" + surface +
                             "[moving]\nmesh = \"cube.obj\"\npoints = 60\nlevels = 2\n";
    return run(kScenec + " " + folder.write("s.toml", text).string() + " -o " + folder.file("o.scene").string()).output;
  };
  const std::string said = verdict("");
  EXPECT_NE(said.find("a part of the still mesh with 8 triangles is taken as a"), std::string::npos) << said;
  EXPECT_NE(said.find("set still.surface"), std::string::npos) << said;
  EXPECT_EQ(verdict("surface = \"shell\"\n").find("doubtful"), std::string::npos);
}

/// The voxel edge that the refusal of an accuracy names is one that will do.
TEST(Command, NamesTheVoxelEdgeThatAnAccuracyNeeds) {
  const ScratchFolder folder;
  const std::string mesh = mesh_file("cube_100mm").string();
  // around its tip, where too many faces meet for exact bricks
  folder.write("cone.obj", test::obj_text(cone_mesh(0.01, 0.02, 80)));
  const auto compile = [&](const std::string& voxel_size) {
    const std::string text = "[still]\nmesh = \"cone.obj\"\naccuracy = 2e-5\nvoxel_size = " + voxel_size +
                             "\n[moving]\nmesh = \"" + mesh +
                             "\"\nscale = 0.1\npoints = 60\nlevels = 2\nvoxel_size = 0.0003\n";
    return run(kScenec + " " + folder.write("s.toml", text).string() + " -o " + folder.file("o.scene").string());
  };
  const Outcome refused = compile("0.002");
  EXPECT_EQ(refused.exit_code, 65) << refused.output;
  EXPECT_FALSE(std::filesystem::exists(folder.file("o.scene")));
  const std::string cure = "Take still.voxel_size = ";
  const std::size_t at = refused.output.find(cure);
  ASSERT_NE(at, std::string::npos) << refused.output;
  const std::size_t begin = at + cure.size();
  const std::string named = refused.output.substr(begin, refused.output.find(',', begin) - begin);
  EXPECT_LT(std::stod(named), 0.002);
  EXPECT_GT(std::stod(named), 0.0002) << "not much smaller than needed";
  const Outcome compiled = compile(named);
  EXPECT_EQ(compiled.exit_code, 0) << named << "\n" << compiled.output;
  EXPECT_NE(compiled.output.find("the stored surfaces lie within 0.02 mm of the meshes'"), std::string::npos)
      << compiled.output;
}

/// Without voxel edges the compiler finds some that hold the accuracy; edges that are stated stay as they are.
TEST(Command, ChoosesVoxelEdgesForAnAccuracy) {
  const ScratchFolder folder;
  const std::string mesh = mesh_file("cube_100mm").string();
  const auto compile = [&](const std::string& moving) {
    const std::string text = "[still]\nmesh = \"" + mesh + "\"\nscale = 0.2\naccuracy = 1e-4\n[moving]\nmesh = \"" +
                             mesh + "\"\nscale = 0.1\npoints = 60\nlevels = 2\n" + moving;
    return run(kScenec + " " + folder.write("s.toml", text).string() + " -o " + folder.file("o.scene").string());
  };
  const Outcome compiled = compile("");
  EXPECT_EQ(compiled.exit_code, 0) << compiled.output;
  EXPECT_NE(compiled.output.find("chosen for the accuracy"), std::string::npos) << compiled.output;
  EXPECT_NE(compiled.output.find("the stored surfaces lie within 0.1 mm of the meshes'"), std::string::npos)
      << compiled.output;
  // a block of 20 mm with a wall of 1 mm, which the first choice of 2.5 mm cannot hold
  TriangleMesh hollow = test::box_mesh(Eigen::Vector3d::Constant(0.02));
  const TriangleMesh cavity = test::box_mesh(Eigen::Vector3d::Constant(0.018));
  for (const auto& t : cavity.triangles) hollow.triangles.push_back({8 + t[0], 8 + t[2], 8 + t[1]});
  hollow.vertices.insert(hollow.vertices.end(), cavity.vertices.begin(), cavity.vertices.end());
  folder.write("hollow.obj", test::obj_text(hollow));
  const std::string walls =
      "[still]\nmesh = \"hollow.obj\"\nsurface = \"solid\"\naccuracy = 1e-4\n[moving]\nmesh = \"" + mesh +
      "\"\nscale = 0.1\npoints = 60\nlevels = 2\nvoxel_size = 0.001\n";
  const Outcome thin =
      run(kScenec + " " + folder.write("w.toml", walls).string() + " -o " + folder.file("w.scene").string());
  EXPECT_EQ(thin.exit_code, 0) << thin.output;
  std::filesystem::remove(folder.file("o.scene"));
  folder.write("cone.obj", test::obj_text(cone_mesh(0.01, 0.02, 80)));
  const std::string cone = "[still]\nmesh = \"" + mesh +
                           "\"\nscale = 0.2\naccuracy = 1e-4\n[moving]\nmesh = \"cone.obj\"\n"
                           "points = 60\nlevels = 2\nvoxel_size = 0.004\n";
  const Outcome refused =
      run(kScenec + " " + folder.write("c.toml", cone).string() + " -o " + folder.file("o.scene").string());
  EXPECT_EQ(refused.exit_code, 65) << refused.output;
  EXPECT_NE(refused.output.find("Take moving.voxel_size = "), std::string::npos) << refused.output;
  EXPECT_FALSE(std::filesystem::exists(folder.file("o.scene")));
}

/// A small tilted cube, pressed on the top of a large one and moved along: one pose for each period [s].
std::string pressed_cube(double period = 1e-3) {
  std::string rows = "t,px,py,pz,qw,qx,qy,qz\n";
  for (int k = 0; k < 40; ++k) {
    const double height = 0.082 - 0.0005 * std::min(k, 20);
    rows += std::to_string(period * k) + "," + std::to_string(1e-4 * k) + ",0.003," + std::to_string(height) +
            ",0.98,0.14,0.14,0\n";
  }
  return rows;
}

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// A scene of two cubes that compiles quickly.
std::string small_scene() {
  const std::string mesh = "mesh = \"" + mesh_file("cube_100mm").string() + "\"\n";
  return "[still]\n" + mesh + "voxel_size = 0.02\nfield_tolerance = 2\n[moving]\n" + mesh +
         "scale = 0.4\npoints = 60\nlevels = 2\n[contact]\nboth_directions = false\n";
}

/// Runs the command that tries settings of a small scene for a budget and writes IMAGE. `more`: further arguments.
Outcome tried(const ScratchFolder& folder, const std::string& image, const std::string& more) {
  return run(kScenec + " " + folder.write("s.toml", small_scene()).string() + " -o " + folder.file(image).string() +
             " --path " + folder.write("p.csv", pressed_cube()).string() + more);
}

TEST(Command, ChoosesSettingsForABudget) {
  const ScratchFolder folder;
  const Outcome generous = tried(folder, "a.scene", " --budget 1000ms");  // everything fits, so times do not matter
  ASSERT_EQ(generous.exit_code, 0) << generous.output;
  EXPECT_NE(generous.output.find("chosen   contact,"), std::string::npos) << generous.output;
  const Outcome inspected = run(kScenec + " --inspect " + folder.file("a.scene").string());
  EXPECT_NE(inspected.output.find("\"budget_ns\": 1000000000.0"), std::string::npos) << inspected.output;
  EXPECT_EQ(inspected.output.find("p99"), std::string::npos) << "a time in the image: " << inspected.output;
  ASSERT_EQ(tried(folder, "b.scene", " --budget 1000ms").exit_code, 0);
  EXPECT_TRUE(bytes_of(folder.file("a.scene")) == bytes_of(folder.file("b.scene"))) << "the same choice, another image";
}

TEST(Command, RefusesABudgetThatNothingFits) {
  const ScratchFolder folder;
  const Outcome hopeless = tried(folder, "c.scene", " --budget 1ns --only-solver paper");
  EXPECT_EQ(hopeless.exit_code, 65) << hopeless.output;
  EXPECT_NE(hopeless.output.find("--budget 1ns: none of the 8 settings that were tried is that quick"),
            std::string::npos)
      << hopeless.output;
  const Outcome without_unit = tried(folder, "c.scene", " --budget 20");
  EXPECT_EQ(without_unit.exit_code, 64);
  EXPECT_NE(without_unit.output.find("give the time of a cycle"), std::string::npos);
  const Outcome without_budget = tried(folder, "c.scene", "");
  EXPECT_EQ(without_budget.exit_code, 64);
  EXPECT_NE(without_budget.output.find("--path is for --budget"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder.file("c.scene")));
}

/// A motion at another rate than the scene's would be tried at the wrong speed.
TEST(Command, TriesMotionsOfThePeriodOfTheScene) {
  const ScratchFolder folder;
  const std::string scene = folder.write("s.toml", small_scene() + "[coupling]\nperiod = 0.004\n").string();
  const auto with = [&](const std::filesystem::path& motion) {
    return run(kScenec + " " + scene + " -o " + folder.file("a.scene").string() +
               " --budget 1000ms --only-solver paper" + " --path " + motion.string());
  };
  const Outcome rows = with(folder.write("fast.csv", pressed_cube(0.001)));
  EXPECT_EQ(rows.exit_code, 65) << rows.output;
  EXPECT_NE(rows.output.find("is not 4 ms"), std::string::npos) << rows.output;
  const std::string poses =
      "[[keyframe]]\nt = 0\nposition = [0, 0, 0.1]\n[[keyframe]]\nt = 1\nposition = [0, 0, 0.07]\n";
  const Outcome keyframes = with(folder.write("fast.toml", poses));
  EXPECT_EQ(keyframes.exit_code, 78) << keyframes.output;
  EXPECT_NE(keyframes.output.find("set period = 0.004"), std::string::npos) << keyframes.output;
  EXPECT_FALSE(std::filesystem::exists(folder.file("a.scene")));
  EXPECT_EQ(with(folder.write("slow.csv", pressed_cube(0.004))).exit_code, 0);
}

}  // namespace
}  // namespace godobject::scene_compiler::command_test
