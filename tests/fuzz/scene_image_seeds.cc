// scene_image_seeds FOLDER: writes small valid scene images, with which the fuzzer begins.

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/small_scenes.h"

namespace godobject::test {
namespace {

SceneDescription small_plate() {
  const Vector3 half_edges(0.02, 0.02, 0.01);
  const SurfaceSamples ball = sample_ball(0.01, 30);
  SceneDescription description;
  description.distance = [half_edges](const Vector3& p) { return box_distance(p, half_edges); };
  description.surface_min = -half_edges;
  description.surface_max = half_edges;
  description.voxel_size = 0.01;
  description.points = ball.points;
  description.normals = ball.normals;
  description.settings.friction = 1;
  description.settings.friction_static = 0.2;
  description.settings.friction_kinetic = 0.18;
  return description;
}

bool write(const std::filesystem::path& file, const SceneImage& image) {
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(image.bytes().data()), static_cast<std::streamsize>(image.bytes().size()));
  return out.good();
}

int run(const std::filesystem::path& folder) {
  SceneDescription refined = small_plate();
  refined.refined = [](const Vector3& center, double edge) { return center.x() > 0.0 && edge > 0.02; };
  refined.coarse = [](const Vector3& center, double) { return center.y() > 0.0; };
  SceneDescription frictionless = small_plate();
  frictionless.settings.friction = 0;
  frictionless.normals.clear();
  std::filesystem::create_directories(folder);
  const bool written = write(folder / "plate", build_scene_image(small_plate())) &&
                       write(folder / "refined", build_scene_image(refined)) &&
                       write(folder / "frictionless", build_scene_image(frictionless));
  if (!written) std::fprintf(stderr, "scene_image_seeds: %s cannot be written\n", folder.c_str());
  return written ? 0 : 74;
}

}  // namespace
}  // namespace godobject::test

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "usage: scene_image_seeds FOLDER\n"), 64;
  return godobject::test::run(argv[1]);
}
