#include "toolchain/scene_compiler/compile_scene.h"

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <limits>
#include <numbers>
#include <optional>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/scene_compiler/compiled_once.h"
#include "tests/scene_compiler/test_meshes.h"
#include "toolchain/command_line/failure.h"
#include "toolchain/scene_compiler/report_json.h"
#include "toolchain/scene_compiler/report_text.h"

namespace godobject::scene_compiler::compile_scene_test {
namespace {

/// A scene of two meshes, scaled by `size`.
struct SceneText {
  const char* still = "bracket";
  const char* moving = "cube_100mm";
  double size = 1.0;
  double voxel_size = 0.004;
  const char* forced = "auto";
  std::string more = "";

  std::string text() const {
    return "[still]\nmesh = \"" + mesh_file(still).string() + "\"\nscale = " + number(size) +
           "\nvoxel_size = " + number(size * voxel_size) + "\nsurface = \"" + forced + "\"" + "\n[moving]\nmesh = \"" +
           mesh_file(moving).string() + "\"\nscale = " + number(0.3 * size) + "\npoints = 300\nlevels = 3\n" + more;
  }
  static std::string number(double value) {
    std::ostringstream stream;
    stream << std::showpoint << std::setprecision(12) << value;
    return stream.str();
  }
};

class CompileScene : public testing::Test {
 protected:
  CompileReport compile(const SceneText& scene, const char* output = "out.scene",
                        std::optional<format::Solver> only = {}) {
    return compile_once(scene.text(), folder_, output, only);
  }

  ScratchFolder folder_;
};

/// A prism with two rims of 600 edges has more sharp edges than the default takes.
TEST_F(CompileScene, LeavesManySharpEdgesOutUnlessTold) {
  constexpr int kAround = 600;
  const std::filesystem::path file = folder_.file("prism.obj");
  {
    std::ofstream obj(file);
    for (const double z : {0.0, 0.05}) {
      obj << "v 0 0 " << z << "\n";
      for (int i = 0; i < kAround; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / kAround;
        obj << "v " << 0.1 * std::cos(angle) << " " << 0.1 * std::sin(angle) << " " << z << "\n";
      }
    }
    for (int i = 0; i < kAround; ++i) {
      const int a = 2 + i;
      const int b = 2 + (i + 1) % kAround;
      const int top = kAround + 1;
      obj << "f 1 " << b << " " << a << "\nf " << top + 1 << " " << top + a << " " << top + b << "\n";
      obj << "f " << a << " " << b << " " << top + b << "\nf " << a << " " << top + b << " " << top + a << "\n";
    }
  }
  const std::string text = "[still]\nmesh = \"" + file.string() +
                           "\"\nvoxel_size = 0.008\nfield_tolerance = 10.0\n[moving]\nmesh = \"" +
                           mesh_file("cube_100mm").string() + "\"\nscale = 0.3\npoints = 300\nlevels = 3\n[contact]\n" +
                           "both_directions = false\n";
  const CompileReport by_default = compile_once(text, folder_, "a.scene", {});
  EXPECT_EQ(by_default.edges.too_many, 2u * kAround);
  EXPECT_EQ(by_default.edges.still, 0u);
  EXPECT_TRUE(files::SceneImage::read(folder_.file("a.scene")).scene.edges.empty());
  const CompileReport told = compile_once(text + "edges = true\n", folder_, "b.scene", {});
  EXPECT_EQ(told.edges.too_many, 0u);
  EXPECT_EQ(told.edges.still, 2u * kAround);
  EXPECT_EQ(files::SceneImage::read(folder_.file("b.scene")).scene.edges.edges.size(), 2u * kAround);
}

TEST_F(CompileScene, WritesAnImageThatTheCoreOpens) {
  const CompileReport report = compile({});
  const files::SceneImage image = files::SceneImage::read(folder_.file("out.scene"));
  EXPECT_EQ(image.bytes.span().size(), report.image_bytes);
  EXPECT_TRUE(image.scene.holds(format::Solver::kPaper));
  EXPECT_TRUE(image.scene.holds(format::Solver::kCorrected));
  EXPECT_EQ(image.scene.pointshell.size, 300u + report.second.added_points);
  EXPECT_NE(image.scene.pointshell.normal_x, nullptr);
  EXPECT_LE(report.check.field_error.largest_node_error, 1e-5);
  EXPECT_LE(report.check.field_error.largest_node_excess, report.check.field_error.largest_node_error);
  EXPECT_LE(report.check.field_error.rms, 1.001 * report.check.field_error.floor_rms);
  EXPECT_LE(report.check.field_error.sign_errors, report.check.field_error.floor_sign_errors);
  EXPECT_GE(report.check.field_error.points, 10000u);
}

TEST_F(CompileScene, LeavesTheSecondDirectionOutWhereNobodyReadsIt) {
  compile({});
  EXPECT_TRUE(files::SceneImage::read(folder_.file("out.scene")).scene.has_features());
  compile({.more = "[contact]\nboth_directions = false\n"});
  EXPECT_FALSE(files::SceneImage::read(folder_.file("out.scene")).scene.has_features());
  compile({}, "paper.scene", format::Solver::kPaper);
  const files::SceneImage paper = files::SceneImage::read(folder_.file("paper.scene"));
  EXPECT_FALSE(paper.scene.has_features());
  EXPECT_EQ(paper.scene.pointshell.size, 300u);
}

TEST_F(CompileScene, GivesTheSameBytesEveryTime) {
  compile({}, "a.scene");
  compile_anew(SceneText().text(), folder_, "b.scene");
  const std::string a = bytes_of(folder_.file("a.scene"));
  EXPECT_FALSE(a.empty());
  EXPECT_EQ(a, bytes_of(folder_.file("b.scene")));
}

TEST_F(CompileScene, OnlySolverStripsNormalsAndSaysSo) {
  const CompileReport all = compile({}, "all.scene");
  const CompileReport one = compile({}, "one.scene", format::Solver::kCorrected);
  const files::SceneImage image = files::SceneImage::read(folder_.file("one.scene"));
  EXPECT_FALSE(image.scene.holds(format::Solver::kPaper));
  EXPECT_EQ(image.scene.pointshell.normal_x, nullptr);
  EXPECT_LT(one.image_bytes, all.image_bytes);
  EXPECT_NE(report_json(one).dump().find("normals"), std::string::npos);
  compile({}, "paper.scene", format::Solver::kPaper);
  const files::SceneImage paper = files::SceneImage::read(folder_.file("paper.scene"));
  EXPECT_FALSE(paper.scene.holds(format::Solver::kCorrected));
  EXPECT_EQ(paper.scene.settings.default_solver, static_cast<std::uint32_t>(format::Solver::kPaper));
}

TEST_F(CompileScene, InspectShowsWhatWasCompiled) {
  compile({.more = "[friction]\nstatic = 0.3\n"});
  const Json json = inspect_json(files::SceneImage::read(folder_.file("out.scene")));
  EXPECT_EQ(json["settings"]["solver"], "contact");
  EXPECT_DOUBLE_EQ(json["settings"]["friction"]["kinetic"], 0.27);
  EXPECT_DOUBLE_EQ(json["grid"]["voxel_size"], 0.004);
  EXPECT_GE(json["body"]["points"], 300);
  EXPECT_GT(json["sections"]["bricks"]["bytes"], 0);
  EXPECT_TRUE(json["provenance"]["walls"].contains("found"));
  EXPECT_FALSE(json["provenance"].contains("seconds"));
}

TEST_F(CompileScene, BehavesAlikeFromAThousandthToAThousandfold) {
  const CompileReport one = compile({});
  for (const double size : {1e-3, 1e3}) {
    const CompileReport scaled = compile({.size = size});
    EXPECT_EQ(scaled.field.grid.brick_count, one.field.grid.brick_count) << size;
    EXPECT_NEAR(scaled.check.field_error.rms / size, one.check.field_error.rms, 1e-3 * one.check.field_error.rms)
        << size;
    EXPECT_NEAR(scaled.field.grid.lipschitz, one.field.grid.lipschitz, 1e-3) << size;
    EXPECT_NEAR(scaled.points.spread.coverage / size, one.points.spread.coverage, 0.05 * one.points.spread.coverage)
        << size;
  }
}

TEST(FieldCheck, HoldsNodesToTheSmallerOfTenMicrometresAndAThousandthOfAVoxel) {
  const auto takes = [](double excess, double voxel_size, double quantum = 0.0) {
    format::Grid grid{};
    grid.voxel_size = voxel_size;
    grid.quantum = quantum;
    try {
      require_exact_nodes({.largest_node_error = 1.0, .largest_node_excess = excess}, grid);
      return true;
    } catch (const command::Failure& failure) {
      EXPECT_EQ(failure.exit_code(), command::ExitCode::kInternal);
      return false;
    }
  };
  EXPECT_TRUE(takes(0.9e-5, 1.0));
  EXPECT_FALSE(takes(1.1e-5, 1.0));
  EXPECT_TRUE(takes(0.9e-6, 1e-3));
  EXPECT_FALSE(takes(1.1e-6, 1e-3));
  EXPECT_FALSE(takes(1.1e-9, 1e-6));
  EXPECT_TRUE(takes(1.6e-5, 1.0, 1e-6)) << "what rounding adds";
  EXPECT_FALSE(takes(1.9e-5, 1.0, 1e-6));
}

TEST_F(CompileScene, SaysWhatTheFieldLosesAndTheRuleOfRefusal) {
  // too small a patch to refuse, but it is reported
  CompileReport report = compile({.still = "cube_100mm"});
  EXPECT_EQ(report_text(report).find("thinner than one voxel"), std::string::npos);
  report.thin.walls = {.samples = 9, .area = 3e-5, .smallest = 2e-3, .voxel_needed = 1e-3, .lost_area = 2e-5};
  report.thin.walls.at = {0.01, 0.02, 0.03};
  const std::string text = report_text(report);
  EXPECT_NE(text.find("thinner than one voxel: 0.2 cm^2, the field cannot hold them, bodies may pass there; at (0.01, "
                      "0.02, 0.03) m"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find(kRefusalRule), std::string::npos) << text;
  EXPECT_EQ(report_json(report)["walls"]["area_thinner_than_a_voxel"], 2e-5);
  EXPECT_NE(std::string(kRefusalRule).find(std::to_string(static_cast<int>(kRefusedFaces)) + " voxel faces"),
            std::string::npos);
}

TEST_F(CompileScene, CountsStoredPositionsApartFromFinerBricks) {
  const CompileReport report = compile({.still = "sheet_open"});
  ASSERT_GT(report.field.refinement.refined, 0u);
  const std::string image = bytes_of(folder_.file("out.scene"));
  const Json index = inspect_json(files::SceneImage::read(folder_.file("out.scene")))["sections"]["brick_index"];
  std::uint64_t positions = 0;
  std::uint64_t stored = 0;
  for (std::uint64_t at = index["offset"];
       at < index["offset"].get<std::uint64_t>() + index["bytes"].get<std::uint64_t>(); at += sizeof(std::uint32_t)) {
    std::uint32_t entry = 0;
    std::memcpy(&entry, image.data() + at, sizeof(entry));
    ++positions;
    if ((entry & format::index_entry::kFar) == 0) ++stored;
  }
  const std::string text = report_text(report);
  EXPECT_NE(text.find(fmt::format(": {} of {} positions stored", stored, positions)), std::string::npos) << text;
  EXPECT_NE(text.find(fmt::format("{} finer bricks", report.field.grid.brick_count - stored)), std::string::npos)
      << text;
}

TEST_F(CompileScene, EndsWithAVerdictThatNamesEveryLimit) {
  const CompileReport good = compile({.still = "cube_100mm"});
  const std::string text = report_text(good);
  const std::string verdict = verdict_text(good);
  EXPECT_EQ(verdict.find("ready: the field is within its tolerance"), 0u) << verdict;
  EXPECT_EQ(text.substr(text.size() - verdict.size() - 1), verdict + "\n");
  EXPECT_EQ(verdict.find('\n'), std::string::npos);

  const auto expect_limit = [&good](auto spoil, const std::string& words) {
    CompileReport report = good;
    spoil(report);
    const std::string said = verdict_text(report);
    EXPECT_EQ(said.find("ready, with limits: "), 0u) << said;
    EXPECT_NE(said.find(words), std::string::npos) << said;
    EXPECT_EQ(said.find(';'), std::string::npos) << "one limit: " << said;
  };
  // 5 times the tolerance of 0.05 voxels of 4 mm is 1 mm
  expect_limit([](CompileReport& r) { r.check.field_error.near.largest = 1.2e-3; },
               "0.30 voxels off near the surface (0.25");
  expect_limit([](CompileReport& r) { r.thin.walls.samples = 3; }, "walls thinner than two voxels");
  expect_limit(
      [](CompileReport& r) {
        r.thin.walls.samples = 3;
        r.thin.walls.lost_area = 1e-5;
      },
      "walls thinner than a voxel, which bodies may pass");
  expect_limit([](CompileReport& r) { r.thin.gaps.samples = 3; }, "gaps thinner than two voxels");
  expect_limit([](CompileReport& r) { r.field.seams.cells = 1; }, "the still mesh is open");
  expect_limit([](CompileReport& r) { r.second.seams.cells = 1; }, "the moving mesh is open");
  expect_limit([](CompileReport& r) { r.edges.too_many = 2000; }, "sharp edges may cross, because one body has 2000");
  expect_limit([](CompileReport& r) { r.second.sought = false; }, "the depth between the points is not bounded");
  expect_limit([](CompileReport& r) { r.second.between.bound = 0.006 - r.second.slack; },
               "between the points meshes may overlap by up to 6 mm (4 mm");
  expect_limit([](CompileReport& r) { r.second.between.bound = std::numeric_limits<double>::infinity(); },
               "no bound is known");
}

TEST_F(CompileScene, RefusalLeavesNoFileBehind) {
  try {
    compile({.still = "plate_2mm", .voxel_size = 0.005});
    FAIL() << "took a wall thinner than a voxel";
  } catch (const command::Failure& failure) {
    EXPECT_EQ(failure.exit_code(), command::ExitCode::kBadData);
  }
  EXPECT_FALSE(std::filesystem::exists(folder_.file("out.scene")));
}

TEST_F(CompileScene, RefusesABodyThatLeavesNothingInside) {
  for (const SceneText& scene :
       {SceneText{.still = "cube_100mm", .voxel_size = 0.9}, SceneText{.still = "sheet_open", .forced = "solid"}}) {
    try {
      compile(scene);
      FAIL() << "took a body that is no obstacle";
    } catch (const command::Failure& failure) {
      EXPECT_EQ(failure.exit_code(), command::ExitCode::kBadData) << failure.what();
    }
  }
}
/// A scale that was forgotten is told at once, with the numbers that show it.
TEST_F(CompileScene, RefusesMeshesOfSizesThatDoNotFit) {
  const auto refusal = [this](double moving_scale) -> std::string {
    const std::string text = fmt::format(
        "[still]\nmesh = \"{}\"\nvoxel_size = 0.004\n[moving]\nmesh = \"{}\"\nscale = {:#g}\npoints = 300\n",
        mesh_file("cube_100mm").string(), mesh_file("cube_100mm").string(), moving_scale);
    try {
      compile_once(text, folder_, "out.scene", {});
    } catch (const command::Failure& failure) {
      EXPECT_EQ(failure.exit_code(), command::ExitCode::kBadData);
      return failure.what();
    }
    return "";
  };
  EXPECT_NE(refusal(300.0).find("the moving mesh of 30 m is 300 times as large as the still mesh of 0.1 m"),
            std::string::npos)
      << refusal(300.0);
  EXPECT_NE(refusal(1e-3).find("the moving mesh of 0.0001 m is far smaller than a voxel of 0.004 m"), std::string::npos)
      << refusal(1e-3);
}

/// A cube without one face is a solid whose distances jump at the hole, whichever body it is.
TEST_F(CompileScene, SaysWhichMeshIsOpen) {
  constexpr const char* kOpenCube =
      "v 0 0 0\nv 0.02 0 0\nv 0.02 0.02 0\nv 0 0.02 0\nv 0 0 0.02\nv 0.02 0 0.02\nv 0.02 0.02 0.02\nv 0 0.02 0.02\n"
      "f 1 3 2\nf 1 4 3\nf 1 2 6\nf 1 6 5\nf 2 3 7\nf 2 7 6\nf 3 4 8\nf 3 8 7\nf 4 1 5\nf 4 5 8\n";
  const std::string open = folder_.write("open.obj", kOpenCube).string();
  const std::string closed = mesh_file("cube_100mm").string();
  const auto verdict = [&](const std::string& still, double still_scale, const std::string& moving, double scale) {
    return verdict_text(compile_once(
        fmt::format(
            "[still]\nmesh = \"{}\"\nscale = {:#g}\nvoxel_size = 0.004\n[moving]\nmesh = \"{}\"\nscale = {:#g}\n"
            "points = 300\n",
            still, still_scale, moving, scale),
        folder_, "out.scene", {}));
  };
  const std::string of_moving = verdict(closed, 0.4, open, 1.0);
  EXPECT_NE(of_moving.find("the moving mesh is open"), std::string::npos) << of_moving;
  EXPECT_EQ(of_moving.find("the still mesh is open"), std::string::npos) << of_moving;
  const std::string of_still = verdict(open, 1.0, closed, 0.2);
  EXPECT_NE(of_still.find("the still mesh is open"), std::string::npos) << of_still;
  EXPECT_EQ(of_still.find("the moving mesh is open"), std::string::npos) << of_still;
}

/// Each line on edges names what is the case for this image.
TEST_F(CompileScene, TellsWhyEdgesAreLeftOut) {
  const auto line = [this](const std::string& more, std::optional<format::Solver> only) {
    const SceneText scene{
        .still = "cube_100mm", .voxel_size = 0.01, .more = "[contact]\nboth_directions = false\n" + more};
    const std::string text = report_text(compile(scene, "out.scene", only));
    const std::size_t at = text.find("\nedges ") + 1;
    return text.substr(at, text.find('\n', at) - at);
  };
  EXPECT_NE(line("", {}).find(" sharp edges of the still body against "), std::string::npos);
  EXPECT_NE(line("", format::Solver::kCorrected).find("only the solver contact reads them"), std::string::npos);
  EXPECT_NE(line("edges = false\n", {}).find("contact.edges = true prevents that"), std::string::npos);
}

TEST_F(CompileScene, DamageIsSeen) {
  compile({});
  std::string bytes = bytes_of(folder_.file("out.scene"));
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  EXPECT_THROW(files::SceneImage::read(folder_.write("bad.scene", bytes)), command::Failure);
  EXPECT_THROW(files::SceneImage::read(folder_.write("short.scene", bytes.substr(0, 100))), command::Failure);
  EXPECT_THROW(files::SceneImage::read(folder_.write("none.scene", "")), command::Failure);
}

}  // namespace
}  // namespace godobject::scene_compiler::compile_scene_test
