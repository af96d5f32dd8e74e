// Example 1: open a scene image and ask for the distance of points from the still body.
// usage: 1_query X.scene < points, one "x y z" [m] a line

#include <cstdio>

#include <godobject/scene.h>

#include "aligned_file.h"

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "usage: 1_query X.scene < points\n"), 64;
  AlignedBytes image = read_file(argv[1]);
  godobject::Scene scene;
  if (const auto status = godobject::Scene::open(image.span(), scene); status != godobject::Status::kOk) {
    return std::fprintf(stderr, "%s: %s\n", argv[1], godobject::describe(status)), 65;
  }
  std::printf("voxels of %.2f mm, %s friction\n", 1e3 * scene.voxel_size(), scene.has_friction() ? "with" : "without");
  godobject::Vector3 p_W;
  while (std::scanf("%lf %lf %lf", &p_W.x(), &p_W.y(), &p_W.z()) == 3) {
    const godobject::SurfaceDistance surface = scene.distance(p_W);
    if (surface.known) {
      const godobject::Vector3& n = surface.normal_W;
      std::printf("%.2f mm, normal (%.2f, %.2f, %.2f)\n", 1e3 * surface.distance, n.x(), n.y(), n.z());
    } else {
      std::printf("%s by more than %.2f mm\n", surface.distance > 0.0 ? "outside" : "inside",
                  1e3 * std::abs(surface.distance));
    }
  }
  return 0;
}
