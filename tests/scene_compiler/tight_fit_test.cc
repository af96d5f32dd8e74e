// Whatever the compiler writes, the core opens: over small pegs in small holes, with coordinates in single precision.
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/scene_compiler/simple_meshes.h"
#include "tests/scene_compiler/test_meshes.h"
#include "tests/support/random.h"
#include "toolchain/files/scene_image.h"
#include "toolchain/scene_compiler/compile_scene.h"

namespace godobject::scene_compiler::tight_fit_test {
namespace {

using Eigen::Vector3d;

/// A block about the origin with a rectangular hole through it along z.
TriangleMesh block_with_hole(const Vector3d& block, const Vector3d& hole) {
  TriangleMesh mesh;
  for (const double side : {-0.5, 0.5}) {
    for (const Vector3d& edges : {block, hole}) {
      for (const auto& [x, y] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}})
        mesh.vertices.emplace_back(x * edges.x(), y * edges.y(), side * block.z());
    }
  }
  const auto add_quadrangle = [&mesh](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  };
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t j = (i + 1) % 4;
    add_quadrangle(i, j, 8 + j, 8 + i);            // outer wall
    add_quadrangle(4 + j, 4 + i, 12 + i, 12 + j);  // hole's wall
    add_quadrangle(j, i, 4 + i, 4 + j);            // bottom
    add_quadrangle(8 + i, 8 + j, 12 + j, 12 + i);  // top
  }
  return mesh;
}

TEST(TightFit, CompilesToAnImageThatTheCoreOpens) {
  const ScratchFolder folder;
  test::Random random(5);
  for (int i = 0; i < 3; ++i) {
    const double voxel_size = random.between(0.5e-4, 2e-4);
    const double clearance = random.between(0.3, 1.2) * voxel_size;
    const Vector3d peg = voxel_size * Vector3d(random.integer(8, 12), random.integer(8, 12), random.integer(10, 16));
    const Vector3d hole(peg.x() + clearance, peg.y() + clearance, 0.0);
    const Vector3d block = Vector3d(hole.x(), hole.y(), 8.0 * voxel_size) + 10.0 * voxel_size * Vector3d(1.0, 1.0, 0.0);
    const Vector3d at = random.in_cube(0.02);
    folder.write("peg.obj", test::obj_text(test::box_mesh(peg), at));
    folder.write("hole.obj", test::obj_text(block_with_hole(block, hole), at));
    const std::string scene = fmt::format(
        "[still]\nmesh = \"hole.obj\"\nvoxel_size = {:.9g}\n[moving]\nmesh = \"peg.obj\"\npoints = 300\n"
        "[contact]\nbetween_points = {:.9g}\n[friction]\nstatic = 0.2\n",
        voxel_size, 4.0 * voxel_size);
    CompileRequest request;
    request.scene_file = folder.write("scene.toml", scene);
    request.output = folder.file("out.scene");
    EXPECT_NO_THROW(compile_scene(request)) << i << ": " << scene;
    EXPECT_NO_THROW(files::SceneImage::read(request.output)) << i;
    std::filesystem::remove(request.output);
  }
}

}  // namespace
}  // namespace godobject::scene_compiler::tight_fit_test
