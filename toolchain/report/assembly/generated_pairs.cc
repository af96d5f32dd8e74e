#include "toolchain/report/assembly/generated_pairs.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "toolchain/files/atomic_file.h"
#include "toolchain/report/assembly/thread_mesh.h"
#include "toolchain/report/contact_quality/meshes.h"

namespace godobject::report {
namespace {

struct PairText {
  TriangleMesh still;
  TriangleMesh moving;
  double voxel_size = 0.0;
  double accuracy = 0.0;
  int points = 0;
  double turning = 1e-4;  ///< turning stiffness over stiffness [m^2]
};

std::filesystem::path write_pair(const PairText& pair, const std::filesystem::path& folder) {
  write_ply(pair.still, folder / "still.ply");
  write_ply(pair.moving, folder / "moving.ply");
  files::AtomicFile toml(folder / "pair.toml");
  toml.write(
      fmt::format("[still]\nmesh = \"still.ply\"\nvoxel_size = {}\nsurface = \"solid\"\naccuracy = {}\n"
                  "[moving]\nmesh = \"moving.ply\"\nsurface = \"solid\"\npoints = {}\n"
                  "[friction]\nstatic = 0.2\nkinetic = 0.2\n[coupling]\nrotational = {}\n",
                  pair.voxel_size, pair.accuracy, pair.points, pair.turning));
  toml.commit();
  return folder / "pair.toml";
}

/// Returns a block with a rectangular hole through it along z.
TriangleMesh block_with_hole(double half_x, double half_y, double outer, double height) {
  return cell_solid({{{-outer, -half_x, half_x, outer}, {-outer, -half_y, half_y, outer}, {0.0, height}}},
                    [](int i, int j, int) { return i != 1 || j != 1; });
}

/// Returns a tube about z from z = 0 to `height`, with its vertices on both radii.
TriangleMesh tube(double inner, double outer, double height, int around) {
  TriangleMesh mesh;
  for (int j = 0; j < around; ++j) {
    const double angle = 2.0 * std::numbers::pi * j / around;
    for (const auto& [radius, z] : {std::pair{inner, 0.0}, {outer, 0.0}, {outer, height}, {inner, height}}) {
      mesh.vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    }
  }
  const auto count = static_cast<std::uint32_t>(mesh.vertices.size());
  for (std::uint32_t first = 0; first < count; first += 4) {
    const std::uint32_t next = (first + 4) % count;
    for (std::uint32_t i = 0; i < 4; ++i) {
      const std::uint32_t up = (i + 1) % 4;
      mesh.triangles.push_back({first + i, next + i, next + up});
      mesh.triangles.push_back({first + i, next + up, first + up});
    }
  }
  return mesh;
}

}  // namespace

std::filesystem::path write_cavity(double half_edge, double clearance, double voxel_size,
                                   const std::filesystem::path& folder) {
  const double inner = half_edge + clearance;
  const double outer = inner + 6.0 * voxel_size;
  const std::vector<double> planes = {-outer, -inner, inner, outer};
  const Vector3 corner(half_edge, half_edge, half_edge);
  return write_pair(
      {.still = cell_solid({planes, planes, planes}, [](int i, int j, int k) { return i != 1 || j != 1 || k != 1; }),
       .moving = box_mesh(-corner, corner),
       .voxel_size = voxel_size,
       .accuracy = 1e-5,
       .points = 600},
      folder);
}

std::filesystem::path write_round_peg(const std::filesystem::path& folder) {
  constexpr double kHole = 4.05e-3;
  constexpr double kPeg = 4e-3;
  constexpr double kOuter = 6e-3;
  constexpr double kDeep = 8e-3;
  constexpr double kLong = 16e-3;
  constexpr int kAround = 48;
  const std::array<TurnedCorner, 4> peg{{{0.0, 0.0}, {kPeg, 0.0}, {kPeg, kLong}, {0.0, kLong}}};
  return write_pair({.still = tube(kHole, kOuter, kDeep, kAround),
                     .moving = turned_solid(peg, kAround),
                     .voxel_size = 2e-4,
                     .accuracy = 1e-5,
                     .points = 1000},
                    folder);
}

std::filesystem::path write_rectangular_peg(const std::filesystem::path& folder) {
  return write_pair({.still = block_with_hole(4.05e-3, 3.55e-3, 6e-3, 8e-3),
                     .moving = box_mesh({-4e-3, -3.5e-3, 0.0}, {4e-3, 3.5e-3, 16e-3}),
                     .voxel_size = 1.5e-4,
                     .accuracy = 1e-5,
                     .points = 1000},
                    folder);
}

std::filesystem::path write_turnstile(const std::filesystem::path& folder) {
  constexpr double kMillimetre = 1e-3;
  const auto scaled = [](std::vector<double> planes) {
    for (double& plane : planes) plane *= kMillimetre;
    return planes;
  };
  const std::vector<double> arms = scaled({-8.0, -2.0, 2.0, 8.0});
  const std::vector<double> posts = scaled({-9.0, -7.5, -5.5, -4.5, -2.2, 2.2, 4.5, 5.5, 7.5, 9.0});
  const auto between = [](int i, int low, int high) { return i == low || i == high; };
  // between the planes of `posts`: 1, 7 lie 5.5 to 7.5 from the middle, 3, 5 lie 2.2 to 4.5 from it
  const auto is_post = [&](int i, int j) {
    return (between(i, 1, 7) && between(j, 3, 5)) || (between(i, 3, 5) && between(j, 1, 7));
  };
  return write_pair(
      {.still = cell_solid({posts, posts, scaled({-1.5, -0.2, 4.0})},
                           [&](int i, int j, int k) { return k == 0 || is_post(i, j); }),
       .moving = cell_solid({arms, arms, scaled({0.0, 3.0})}, [](int i, int j, int) { return i == 1 || j == 1; }),
       .voxel_size = 1.5e-4,
       .accuracy = 1e-5,
       .points = 1000},
      folder);
}

std::filesystem::path write_nut(const std::filesystem::path& folder) {
  return write_pair({.still = bolt_mesh({}, 18e-3),
                     .moving = nut_mesh({}, 14e-3, 0.0, 6e-3),
                     .voxel_size = 2.5e-4,
                     .accuracy = 2e-5,
                     .points = 2000,
                     .turning = 0.1},  // stiff: where facets meet, a soft coupling would let the nut jump and lose work
                    folder);
}

}  // namespace godobject::report
