// write_scene OUT.scene: a ball of 20 mm radius above a plate whose top is at z = 10 mm, for the examples to open.

#include <cstdlib>
#include <fstream>
#include <iostream>

#include "tests/support/analytic_shapes.h"
#include "tests/support/scene_image_builder.h"

int main(int argc, char** argv) {
  using namespace godobject;
  if (argc != 2 || argv[1][0] == '-') {
    std::cerr << "usage: write_scene OUT.scene\n";
    return 64;
  }
  const Vector3 half_edges(0.05, 0.05, 0.01);
  const test::SurfaceSamples ball = test::sample_ball(0.02, 500);
  test::SceneDescription description;
  description.distance = [&](const Vector3& p) { return test::box_distance(p, half_edges); };
  description.surface_min = -half_edges;
  description.surface_max = half_edges;
  description.voxel_size = 0.002;
  description.points = ball.points;
  description.normals = ball.normals;
  const test::SceneImage image = test::build_scene_image(description);
  std::ofstream file(argv[1], std::ios::binary);
  file.write(reinterpret_cast<const char*>(image.bytes().data()), static_cast<std::streamsize>(image.bytes().size()));
  file.close();
  return file ? EXIT_SUCCESS : 74;
}
