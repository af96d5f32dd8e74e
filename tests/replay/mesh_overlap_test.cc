// Two cubes whose edges cross between all points. Without edge against edge the replay tells what the points see from
// what the meshes do, and the compiler's bound holds on the meshes. With it the meshes do not overlap.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>

#include <fmt/format.h>
#include <sys/wait.h>

#include "tests/scene_compiler/simple_meshes.h"
#include "tests/support/folder_test.h"
#include "tests/support/random.h"
#include "toolchain/files/csv_lines.h"
#include "toolchain/precision/mesh_overlap.h"
#include "toolchain/scene_compiler/compile_scene.h"
#include "toolchain/scene_compiler/report_text.h"

namespace godobject::scene_compiler {
namespace {

constexpr double kEdge = 0.03;
constexpr double kVoxel = 0.002;

class ReplayOfCrossingEdges : public test::FolderTest {
 protected:
  void compile(bool edges) {
    write("cube.obj", test::obj_text(test::box_mesh(Vector3::Constant(kEdge))));
    write("scene.toml", fmt::format("[still]\nmesh = \"cube.obj\"\nvoxel_size = {}\n[moving]\nmesh = \"cube.obj\"\n"
                                    "points = 300\nlevels = 3\n[contact]\nedges = {}\n",
                                    kVoxel, edges));
    CompileRequest request;
    request.scene_file = folder_ / "scene.toml";
    request.output = folder_ / "out.scene";
    report_ = compile_scene(request);
  }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }

  /// Presses an edge of the moving cube on an edge of the still one, turned by `angle`, and slides it.
  void write_path(double angle) const {
    const Quaternion on_edge = exp_rotation(0.25 * M_PI * Vector3::UnitX());
    const Quaternion R = on_edge.conjugate() * exp_rotation(angle * Vector3::UnitZ()) * on_edge;
    std::string text = "t,px,py,pz,qw,qx,qy,qz\n";
    for (int k = 0; k < 400; ++k) {
      const double down = kEdge * std::sqrt(2.0) + 2e-3 - 4e-3 * std::min(1.0, k / 200.0);
      const Vector3 p = on_edge.conjugate() * Vector3(2e-3 * std::sin(0.03 * k), 0.5e-3 * std::sin(0.05 * k), down);
      text += fmt::format("{},{},{},{},{},{},{},{}\n", 1e-3 * k, p.x(), p.y(), p.z(), R.w(), R.x(), R.y(), R.z());
    }
    write("path.csv", text);
  }

  int run(const std::string& arguments) {
    const std::string command = fmt::format("cd {} && {} out.scene path.csv -o out.csv {} > log.txt 2>&1",
                                            folder_.string(), GODOBJECT_REPLAY, arguments);
    const int status = std::system(command.c_str());
    std::ostringstream text;
    text << std::ifstream(folder_ / "log.txt").rdbuf();
    output_ = text.str();
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  struct Row {
    double point_depth, overlap;
    Pose H_WM;
  };

  std::vector<Row> rows() const {
    std::vector<Row> rows;
    files::CsvLines lines(folder_ / "out.csv");
    std::string_view line;
    lines.next(line);
    EXPECT_TRUE(line.ends_with(",status,mesh_overlap")) << line;
    while (lines.next(line)) {
      std::array<double, 28> v{};
      std::istringstream fields{std::string(line)};
      std::string field;
      for (double& value : v) {
        std::getline(fields, field, ',');
        files::read_number(field, value);
      }
      rows.push_back({v[21], v[27], {Quaternion(v[11], v[12], v[13], v[14]), Vector3(v[8], v[9], v[10])}});
    }
    return rows;
  }

  CompileReport report_;
  std::string output_;
};

TEST_F(ReplayOfCrossingEdges, MeasuresTheOverlapThatNoPointSees) {
  compile(false);
  const double bound = report_.second.between.bound + report_.second.slack + report_.check.field_error.near.largest;
  test::Random random(4);
  double deepest = 0.0;
  for (int i = 0; i < 4; ++i) {
    write_path(random.between(0.1, 1.5));
    ASSERT_EQ(run("--meshes scene.toml"), 0) << output_;
    double overlap = 0.0;
    double deepest_point = -1.0;
    for (const Row& row : rows()) {
      overlap = std::max(overlap, row.overlap);
      deepest_point = std::max(deepest_point, row.point_depth);
      EXPECT_LE(row.overlap, bound) << "the bound of the compiler";
      if (row.overlap > 0.0) {
        const precision::MeshOverlap exact({test::box_mesh(Vector3::Constant(kEdge)), SurfaceKind::kSolid, 0.0},
                                           {test::box_mesh(Vector3::Constant(kEdge)), SurfaceKind::kSolid, 0.0}, 1e-7);
        EXPECT_NEAR(row.overlap, exact.depth(row.H_WM), 0.01 * row.overlap + 1e-3 * kVoxel);
      }
    }
    EXPECT_LT(deepest_point, 0.0) << "the points see nothing";
    EXPECT_NE(output_.find("no sample point inside, the nearest "), std::string::npos) << output_;
    EXPECT_EQ(output_.find("gap"), std::string::npos) << output_;
    const std::string words =
        overlap > 0.0 ? fmt::format("the meshes overlap by up to {:.4f} mm, at ", 1e3 * overlap) : "do not overlap";
    EXPECT_NE(output_.find(words), std::string::npos) << output_;
    deepest = std::max(deepest, overlap);
  }
  EXPECT_GT(deepest, 2e-5) << "edges cross between the points";
  EXPECT_NE(verdict_text(report_).find("between the points meshes, their edges too, may overlap by up to 2 mm"),
            std::string::npos)
      << verdict_text(report_);
}

/// The watch looks at every cycle with code of its own: it finds nothing, until the mesh is another than the one that
/// was compiled.
TEST_F(ReplayOfCrossingEdges, IsJudgedByTheWatch) {
  compile(true);
  write_path(0.7);
  ASSERT_EQ(run("--watch scene.toml"), 0) << output_;
  EXPECT_NE(output_.find("watch: 400 cycles, "), std::string::npos) << output_;
  EXPECT_TRUE(std::regex_search(output_, std::regex(", 0 of [1-9][0-9]* properties violated"))) << output_;
  EXPECT_TRUE(std::regex_search(output_, std::regex("\\nout.csv: 400 cycles, [^\\n]*\\n$")))
      << "the last line, as ever";
  EXPECT_NE(output_.find("points deeper in the mesh than the field's accuracy: 0 of "), std::string::npos) << output_;
  write("cube.obj", test::obj_text(test::box_mesh(Vector3::Constant(1.05 * kEdge))));
  EXPECT_EQ(run("--watch scene.toml"), 70) << output_;
  EXPECT_TRUE(std::regex_search(output_, std::regex("than the field's accuracy: [1-9]"))) << output_;
}

/// Whatever the angle of the edges, the meshes stay apart, but the contact is felt.
TEST_F(ReplayOfCrossingEdges, KeepsEdgesApart) {
  compile(true);
  EXPECT_EQ(report_.edges.still, 12u);
  EXPECT_EQ(report_.edges.moving, 12u);
  test::Random random(4);
  for (const double angle : {0.01, 0.1, random.between(0.1, 1.5), 0.5 * M_PI}) {
    write_path(angle);
    ASSERT_EQ(run("--meshes scene.toml"), 0) << output_;
    double overlap = 0.0;
    double lowest = 1.0;
    for (const Row& row : rows()) {
      overlap = std::max(overlap, row.overlap);
      lowest = std::min(lowest, Vector3(0.0, M_SQRT1_2, M_SQRT1_2).dot(row.H_WM.translation));
    }
    EXPECT_LE(overlap, 2e-6) << "the resolution of the measurement, at " << angle;
    EXPECT_LT(lowest, kEdge * M_SQRT2 + 5e-5) << "the edges touch";
  }
}

TEST_F(ReplayOfCrossingEdges, RefusesTheMeshesOfAnotherScene) {
  compile(true);
  write_path(1.0);
  write("other.toml", "[still]\nmesh = \"cube.obj\"\nscale = 2.0\nvoxel_size = 0.002\n[moving]\nmesh = \"cube.obj\"\n");
  EXPECT_EQ(run("--meshes other.toml"), 78) << output_;
  EXPECT_NE(
      output_.find("other.toml: is not the scene file of out.scene: the still mesh is cube.obj with scale 2, that "
                   "of the image cube.obj with scale 1; name the one that was compiled"),
      std::string::npos)
      << output_;
  EXPECT_EQ(run("--meshes absent.toml"), 66) << output_;
  EXPECT_EQ(run("--watch other.toml"), 78) << output_;
}

}  // namespace
}  // namespace godobject::scene_compiler
