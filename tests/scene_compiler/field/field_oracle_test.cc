#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "core/scene/voxelmap.h"
#include "tests/scene_compiler/brute_force.h"
#include "tests/scene_compiler/test_meshes.h"
#include "toolchain/scene_compiler/field/brick_packing.h"
#include "toolchain/scene_compiler/field/distance_grid.h"
#include "toolchain/scene_compiler/field/refinement.h"

namespace godobject::scene_compiler::field_oracle_test {
namespace {

using Eigen::Vector3d;

struct Case {
  const char* name;
  double scale;
  double voxel_size;
};

class FieldOracle : public testing::TestWithParam<Case> {};

/// The stored field against a slow oracle that shares no code with the compiler: stored node values are exact, and
/// between the nodes nothing is worse than trilinear interpolation must be.
TEST_P(FieldOracle, StoresExactDistances) {
  const auto [name, scale, s] = GetParam();
  const SolidSurface surface(load(name, scale), SurfaceKind::kAuto, 2.0 * s);
  DistanceGrid grid = make_distance_grid(surface, s, default_band(s, 1.5 * s), {});
  round_distances(grid);
  const std::vector<format::Brick> bricks = packed_bricks(grid);
  const Voxelmap field(grid.grid, grid.index, bricks, {});
  const TriangleMesh& mesh = surface.mesh();
  const BruteForce truth(mesh);
  const double band = grid.grid.band;
  const int points = static_cast<int>(std::clamp(1e6 / static_cast<double>(mesh.triangles.size()), 60.0, 600.0));

  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  double squared = 0.0;
  double floor_squared = 0.0;
  int sign_errors = 0;
  int floor_sign_errors = 0;
  for (int found = 0; found < points;) {
    const auto& t = mesh.triangles[random() % mesh.triangles.size()];
    const Vector3d p = mesh.vertices[t[random() % 3]] + band * Vector3d(unit(random), unit(random), unit(random));
    const FieldSample sample = field.sample(p);
    if (!sample.known) continue;
    ++found;
    double interpolated = 0.0;
    const Vector3d origin(grid.grid.origin[0], grid.grid.origin[1], grid.grid.origin[2]);
    const Vector3d low = ((p - origin) / s).array().floor();
    const Vector3d at = (p - origin) / s - low;
    for (int corner = 0; corner < 8; ++corner) {
      const Vector3d offset(corner & 1, corner >> 1 & 1, corner >> 2);
      const Vector3d node = origin + s * (low + offset);
      const double exact = truth.signed_distance(node);
      interpolated += exact * (offset.array() * at.array() + (1.0 - offset.array()) * (1.0 - at.array())).prod();
      const double stored = field.sample(node).distance;
      if (exact * stored < 0.0 && std::abs(truth.winding_number(node) - 0.5) < 1e-6) continue;  // either side is right
      ASSERT_NEAR(stored, std::clamp(exact, -band, band), 1e-5) << "node " << node.transpose();
    }
    const double exact = truth.signed_distance(p);
    squared += std::pow(sample.distance - exact, 2);
    floor_squared += std::pow(interpolated - exact, 2);
    if (std::abs(exact) > 0.1 * s) {
      sign_errors += (sample.distance < 0.0) != (exact < 0.0) ? 1 : 0;
      floor_sign_errors += (interpolated < 0.0) != (exact < 0.0) ? 1 : 0;
    }
  }
  EXPECT_LE(std::sqrt(squared), 1.05 * std::sqrt(floor_squared));
  EXPECT_LE(sign_errors, floor_sign_errors);
}

INSTANTIATE_TEST_SUITE_P(Meshes, FieldOracle,
                         testing::Values(Case{"teapot", 0.037, 0.002}, Case{"bunny_npm", 0.0161497, 0.002},
                                         Case{"gear", 1.0, 0.002}, Case{"bracket", 1.0, 0.002},
                                         Case{"anchor_part", 0.12, 0.002}, Case{"dragon_clean", 0.975199, 0.002},
                                         Case{"hole_round", 1.0, 0.0005}, Case{"peg_round", 1.0, 0.0005}),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace godobject::scene_compiler::field_oracle_test
