#include "toolchain/query/query_points.h"

#include <cstdio>
#include <filesystem>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "tests/scene_compiler/compiled_once.h"
#include "tests/scene_compiler/test_meshes.h"
#include "toolchain/command_line/failure.h"

namespace godobject::query {
namespace {

/// Queries against the image of a cube of 100 mm with voxels of 4 mm.
class QueryPoints : public testing::Test {
 protected:
  files::SceneImage compiled() {
    const std::string mesh = "mesh = \"" + scene_compiler::mesh_file("cube_100mm").string() + "\"\n";
    scene_compiler::compile_once("[still]\n" + mesh + "voxel_size = 0.004\n[moving]\n" + mesh +
                                     "scale = 0.3\npoints = 300\nlevels = 3\n[contact]\nboth_directions = false\n",
                                 folder_, "out.scene");
    return files::SceneImage::read(folder_.file("out.scene"));
  }

  scene_compiler::ScratchFolder folder_;
};

TEST_F(QueryPoints, GivesDistancesNormalsAndTheBand) {
  const files::SceneImage image = compiled();
  const auto points = folder_.write("p.csv", "x,y,z\r\n0.0,0.0,0.053\n0, 0 ,0\n1e3,0,0\n\n");
  const std::uint64_t rows = query_points(image.scene, points, folder_.file("d.csv"), {});
  EXPECT_EQ(rows, 3u);
  std::istringstream lines(scene_compiler::bytes_of(folder_.file("d.csv")));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "x,y,z,distance,nx,ny,nz,known");
  std::getline(lines, line);
  double v[8];
  ASSERT_EQ(
      std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf", v, v + 1, v + 2, v + 3, v + 4, v + 5, v + 6, v + 7),
      8);
  EXPECT_EQ(v[2], 0.053);
  EXPECT_NEAR(v[3], 0.003, 1e-7 + image.scene.grid.quantum);
  EXPECT_NEAR(v[6], 1.0, 1e-6);
  EXPECT_EQ(v[7], 1.0);
  std::getline(lines, line);
  EXPECT_EQ(line, "0, 0 ,0,-0.013,0,0,0,0");
  std::getline(lines, line);
  EXPECT_EQ(line, "1e3,0,0,0.013,0,0,0,0");
}

TEST_F(QueryPoints, ReadsPointsAsOtherTables) {
  const files::SceneImage image = compiled();
  for (const char* text : {"\xef\xbb\xbf+0.01,0,0\n0,0,0\n", "# made by hand\nx,y,z\n0,0,0\n\n# end\n1,1,1"}) {
    EXPECT_EQ(query_points(image.scene, folder_.write("p.csv", text), folder_.file("d.csv"), {}), 2u) << text;
  }
}

TEST_F(QueryPoints, NamesTheLineOfABadRow) {
  const files::SceneImage image = compiled();
  for (const char* row : {"1,2", "1,2,3,4", "1,2,x", "nan,0,0", "1,,3", "inf,0,0", "+-1,0,0"}) {
    try {
      query_points(image.scene, folder_.write("p.csv", "0,0,0\n" + std::string(row) + "\n"), folder_.file("d.csv"), {});
      FAIL() << "took " << row;
    } catch (const command::Failure& failure) {
      EXPECT_EQ(failure.exit_code(), command::ExitCode::kBadData);
      EXPECT_NE(std::string(failure.what()).find("p.csv:2:"), std::string::npos) << failure.what();
    }
  }
  EXPECT_FALSE(std::filesystem::exists(folder_.file("d.csv")));
}

}  // namespace
}  // namespace godobject::query
