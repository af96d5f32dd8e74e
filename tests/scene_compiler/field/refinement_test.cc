#include "toolchain/scene_compiler/field/refinement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "core/scene/voxelmap.h"
#include "tests/scene_compiler/brute_force.h"
#include "tests/scene_compiler/simple_meshes.h"
#include "tests/scene_compiler/test_meshes.h"
#include "toolchain/scene_compiler/field/brick_packing.h"
#include "toolchain/scene_compiler/field/field_slope.h"
#include "toolchain/scene_compiler/mesh/mesh_edges.h"
#include "toolchain/scene_compiler/mesh/mesh_normals.h"

namespace godobject::scene_compiler::refinement_test {
namespace {

using Eigen::Vector3d;

constexpr double kRefinedTolerance = 0.05;             // voxels: depth inside the body
constexpr double kOff = kHeldOff * kRefinedTolerance;  // and height outside it
constexpr double kSteepest = 4.0 * 1.025;              // and rounded
constexpr double kSteepestInterpolated = 2.0 * 1.025;  // in finer bricks that are not exact

DistanceGrid& to_float(DistanceGrid& field) {
  round_distances(field);
  return field;
}

struct RefinedField {
  DistanceGrid coarse, grid;
  RefinementReport report;
  std::vector<format::Brick> coarse_bricks, bricks;
  Voxelmap coarse_map, map;

  RefinedField(const SolidSurface& surface, double s, double tolerance = kRefinedTolerance)
      : RefinedField(surface, s, SurfaceTolerance::of_depth(tolerance * s)) {}

  RefinedField(const SolidSurface& surface, double s, const SurfaceTolerance& tolerance, double slack = 0.0)
      : coarse(make_distance_grid(surface, s, default_band(s, 1.5 * s), {})),
        grid(coarse),
        report(refine(grid, surface, tolerance, {}, slack)),
        coarse_bricks(packed_bricks(to_float(coarse))),
        bricks(packed_bricks(grid)),
        coarse_map(coarse.grid, coarse.index, coarse_bricks, {}),
        map(grid.grid, grid.index, bricks, grid.refined, grid.exact, grid.facet_lists()) {}
};

/// Any rotation, anywhere within a voxel.
Eigen::Isometry3d any_motion(std::mt19937_64& random, double s) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.rotate(
      Eigen::AngleAxisd(3.14 * unit(random), Vector3d(unit(random), unit(random), unit(random)).normalized()));
  motion.pretranslate(s * Vector3d(unit(random), unit(random), unit(random)));
  return motion;
}

/// A prism along y with its sharp edge on the y axis, opening by `angle` [rad] towards +x.
TriangleMesh wedge(double angle, double length, double width) {
  const double half = length * std::tan(0.5 * angle);
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0},     {length, 0, -half},     {length, 0, half},
                   {0, width, 0}, {length, width, -half}, {length, width, half}};
  mesh.triangles = {{0, 2, 1}, {3, 4, 5}, {1, 5, 4}, {1, 2, 5}, {0, 4, 3}, {0, 1, 4}, {0, 5, 2}, {0, 3, 5}};
  return mesh;
}

/// The largest error to either side [m].
struct Worst {
  double into = 0.0;
  double off = 0.0;

  /// `depth` > 0: the stored surface lies inside the body.
  void add(double depth) { (depth > 0.0 ? into : off) = std::max(depth > 0.0 ? into : off, std::abs(depth)); }
};

/// Faces, edges and corners of a mesh whose every triangle bounds the body.
Worst worst_at_surface(const Voxelmap& field, const TriangleMesh& mesh, int per_triangle) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Worst worst;
  for (const auto& t : mesh.triangles) {
    const Vector3d a = mesh.vertices[t[0]];
    const Vector3d b = mesh.vertices[t[1]];
    const Vector3d c = mesh.vertices[t[2]];
    for (int i = 0; i < per_triangle; ++i) {
      double u = unit(random);
      double v = i % 2 == 0 ? 0.0 : unit(random);  // half of them on an edge
      if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
      worst.add(field.sample(a + u * (b - a) + v * (c - a)).distance);
    }
    for (const Vector3d& corner : {a, b, c}) worst.add(field.sample(corner).distance);
  }
  return worst;
}

/// Returns the distances of points of the stored zero level from the mesh, by testing every triangle.
Worst worst_of_zero_level(const Voxelmap& field, const TriangleMesh& mesh, int points) {
  const BruteForce truth(mesh);
  std::mt19937_64 random(12);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const double s = field.voxel_size();
  Worst worst;
  int found = 0;
  for (int i = 0; i < points; ++i) {
    const auto& t = mesh.triangles[random() % mesh.triangles.size()];
    const double u = std::abs(unit(random));
    const Vector3d on_edge = mesh.vertices[t[0]] + u * (mesh.vertices[t[1]] - mesh.vertices[t[0]]);
    Vector3d from = on_edge + 1.5 * s * Vector3d(unit(random), unit(random), unit(random));
    Vector3d to = on_edge + 1.5 * s * Vector3d(unit(random), unit(random), unit(random));
    const double sign = field.sample(from).distance < 0.0 ? -1.0 : 1.0;
    if (sign * field.sample(to).distance >= 0.0) continue;
    for (int k = 0; k < 40; ++k) {
      const Vector3d middle = 0.5 * (from + to);
      (sign * field.sample(middle).distance >= 0.0 ? from : to) = middle;
    }
    ++found;
    const bool inside = std::abs(truth.winding_number(from)) > 0.5;  // for either winding of the mesh
    worst.add(inside ? truth.distance(from) : -truth.distance(from));
  }
  EXPECT_GT(found, points / 20);
  return worst;
}

/// The field must not jump anywhere in the stored bricks. Tests pairs of points a millionth of a voxel apart, most of
/// them on both sides of the faces, edges and corners of cells of all sizes.
double largest_jump(const RefinedField& field, int pairs) {
  const format::Grid& g = field.grid.grid;
  const double s = g.voxel_size;
  const Vector3d origin(g.origin[0], g.origin[1], g.origin[2]);
  std::vector<std::size_t> refined;
  for (std::size_t i = 0; i < field.grid.index.size(); ++i) {
    const std::uint32_t entry = field.grid.index[i];
    const std::uint32_t finer = format::index_entry::kRefined | format::index_entry::kExact;
    if ((entry & format::index_entry::kFar) == 0 && (entry & finer) != 0) refined.push_back(i);
  }
  std::mt19937_64 random(13);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  double largest = 0.0;
  for (int i = 0; i < pairs && !refined.empty(); ++i) {
    const std::size_t at = refined[random() % refined.size()];
    const auto nx = static_cast<std::size_t>(g.bricks[0]);
    const auto ny = static_cast<std::size_t>(g.bricks[1]);
    const Vector3d brick(static_cast<double>(at % nx), static_cast<double>(at / nx % ny),
                         static_cast<double>(at / nx / ny));
    Vector3d units = 64.0 * brick + Vector3d(unit(random), unit(random), unit(random)) * 64.0;  // cells of s / 16
    for (int axis = 0; axis < 3; ++axis) {
      const double cell = 4 << (random() % 5);  // bricks of every level
      if (random() % 2 == 0) units[axis] = std::round(units[axis] / cell) * cell;
    }
    const Vector3d p = origin + s / 16.0 * units;
    const Vector3d apart = 1e-6 * s * Vector3d(unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5);
    const FieldSample ahead = field.map.sample(p + apart);
    const FieldSample behind = field.map.sample(p - apart);
    if (!ahead.known || !behind.known) continue;
    largest = std::max(largest, std::abs(ahead.distance - behind.distance) - g.lipschitz_seam * 2.0 * apart.norm());
  }
  return largest;
}

/// Returns the largest slope in finer bricks that are not exact.
double steepest_interpolated(const DistanceGrid& field, std::uint32_t entry, double cell_edge) {
  const std::uint32_t number = entry & format::index_entry::kNumber;
  const auto slope = [&](std::uint32_t brick, std::uint8_t octants) {
    if (cell_edge == field.grid.voxel_size || field.bricks[brick].exact != 0) return 0.0;
    FieldSlope slope_of(cell_edge);
    slope_of.add(field.bricks[brick], octants);
    return slope_of.largest_with_seams();
  };
  if ((entry & format::index_entry::kRefined) == 0) return slope(number, kAllOctants);
  const format::Refined& refined = field.refined[number];
  double steepest = 0.0;
  for (unsigned octant = 0; octant < 8; ++octant) {
    const bool coarse = (refined.child[octant] & format::index_entry::kCoarse) != 0;
    steepest = std::max(steepest, coarse ? slope(refined.brick, static_cast<std::uint8_t>(1u << octant))
                                         : steepest_interpolated(field, refined.child[octant], 0.5 * cell_edge));
  }
  return steepest;
}

double steepest_interpolated(const DistanceGrid& field) {
  double steepest = 0.0;
  for (const std::uint32_t entry : field.index) {
    if ((entry & format::index_entry::kFar) != 0) continue;
    steepest = std::max(steepest, steepest_interpolated(field, entry, field.grid.voxel_size));
  }
  return steepest;
}

/// Rounding of floats of a few voxels, and of the place of a point in its cell.
constexpr double kFloatRounding = 3e-6;  // voxels

void expect_true_surface(const TriangleMesh& mesh, double s, const char* what, int per_triangle = 400) {
  const SolidSurface surface(mesh, SurfaceKind::kSolid, 2.0 * s);
  const RefinedField field(surface, s);
  const Worst before = worst_at_surface(field.coarse_map, mesh, per_triangle);
  const Worst at_surface = worst_at_surface(field.map, mesh, per_triangle);
  const Worst zero_level = worst_of_zero_level(field.map, mesh, 4000);
  EXPECT_LE(at_surface.into, kRefinedTolerance * s) << what;
  EXPECT_LE(at_surface.off, kOff * s) << what;
  EXPECT_LE(zero_level.into, kRefinedTolerance * s) << what;
  /// In a re-entrant edge the distance grows more slowly than the distance travelled.
  EXPECT_LE(zero_level.off, 1.5 * kOff * s) << what;
  EXPECT_LE(largest_jump(field, 40000), kFloatRounding * s) << what;
  EXPECT_LE(field.grid.grid.lipschitz, kSteepest) << what;
  EXPECT_LE(steepest_interpolated(field.grid), kSteepestInterpolated) << what;
  std::printf(
      "%-12s into and off the body at the surface, unrefined: %.3f, %.3f s; refined: %.3f, %.3f s, its zero level "
      "%.3f, %.3f s; bricks %zu -> %zu, lipschitz %.3f -> %.3f\n",
      what, before.into / s, before.off / s, at_surface.into / s, at_surface.off / s, zero_level.into / s,
      zero_level.off / s, field.coarse.bricks.size(), field.grid.bricks.size(), field.coarse.grid.lipschitz,
      field.grid.grid.lipschitz);
}

TEST(Refinement, MakesATurnedBoxTrue) {
  std::mt19937_64 random(14);
  for (int i = 0; i < 2; ++i) {
    expect_true_surface(test::moved(test::box_mesh({0.04, 0.03, 0.05}), any_motion(random, 0.004)), 0.004, "box");
  }
}

TEST(Refinement, MakesABoxAlongTheLatticeTrue) {
  expect_true_surface(test::box_mesh({0.04, 0.03, 0.05}), 0.004, "aligned box");
}

TEST(Refinement, MakesSharpWedgesTrue) {
  std::mt19937_64 random(15);
  for (const int degrees : {60, 30}) {
    const TriangleMesh mesh = wedge(degrees * std::numbers::pi / 180.0, 0.03, 0.02);
    expect_true_surface(test::moved(mesh, any_motion(random, 0.002)), 0.002, degrees == 60 ? "wedge 60" : "wedge 30");
  }
}

TEST(Refinement, MakesAnEngineeredPartTrue) { expect_true_surface(load("bracket", 1.0), 0.006, "bracket", 60); }

/// A tolerance that is as small outside as inside holds in a cavity's edges and corners too, where bodies would be held
/// off.
TEST(Refinement, MakesACavityTrueToTheSameLengthOnEitherSide) {
  std::mt19937_64 random(21);
  const double s = 0.002;
  const double accuracy = 0.05 * s;
  for (const bool turned : {false, true}) {
    const TriangleMesh block = hollow_block({0.03, 0.028, 0.026}, {0.0101, 0.0083, 0.0067});
    const TriangleMesh mesh = turned ? test::moved(block, any_motion(random, s)) : block;
    const SolidSurface surface(mesh, SurfaceKind::kSolid, 2.0 * s);
    const RefinedField field(surface, s, SurfaceTolerance{accuracy, accuracy});
    EXPECT_EQ(field.report.worst.in_tolerances, 0.0);
    EXPECT_GT(worst_at_surface(field.coarse_map, mesh, 4000).off, accuracy) << "interpolation holds bodies off";
    const Worst worst = worst_at_surface(field.map, mesh, 4000);
    EXPECT_LE(worst.into, accuracy);
    EXPECT_LE(worst.off, accuracy);
    EXPECT_LE(largest_jump(field, 40000), kFloatRounding * s);
  }
}

/// A thickened sheet ends in half cylinders, with parts of balls at its corners; outside a fold is round, too.
TEST(Refinement, MakesRimsCornersAndFoldsOfASheetTrue) {
  constexpr double s = 0.002;
  std::mt19937_64 random(14);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::normal_distribution<double> normal;
  TriangleMesh folded = test::sheet_mesh(0.02);
  folded.vertices.insert(folded.vertices.end(), {{0.01, 0.01, 0.02}, {0.01, -0.01, 0.02}});
  folded.triangles.insert(folded.triangles.end(), {{1, 5, 4}, {1, 4, 2}});
  for (const TriangleMesh& sheet : {test::sheet_mesh(0.02), folded}) {
    const TriangleMesh mesh = test::moved(sheet, any_motion(random, s));
    const RefinedField field(SolidSurface(mesh, SurfaceKind::kShell, 2.0 * s), s);
    const BruteForce truth(mesh);
    Worst worst;
    int judged = 0;
    for (int i = 0; i < 20'000; ++i) {
      const auto& t = mesh.triangles[random() % mesh.triangles.size()];
      const Vector3d a = mesh.vertices[t[random() % 3]];
      const Vector3d b = mesh.vertices[t[random() % 3]];
      const Vector3d direction = Vector3d(normal(random), normal(random), normal(random)).normalized();
      const Vector3d p = a + unit(random) * (b - a) + s * direction;
      if (truth.distance(p) < (1.0 - 1e-9) * s) continue;  // within the sheet
      worst.add(field.map.sample(p).distance);
      ++judged;
    }
    EXPECT_GT(judged, 1000);
    EXPECT_LE(worst.into, 1.1 * kRefinedTolerance * s) << "between the points that the compiler compares";
    EXPECT_LE(worst.off, 1.1 * kOff * s);
  }
}

/// A turned body with a waist. Between its bulges the stored field is flat.
TriangleMesh waisted(const std::array<double, 3>& radius, const std::array<double, 3>& height, double top) {
  constexpr std::uint32_t kAround = 24;
  TriangleMesh mesh;
  for (std::size_t k = 0; k < radius.size(); ++k) {
    for (std::uint32_t i = 0; i < kAround; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kAround;
      mesh.vertices.emplace_back(radius[k] * std::cos(angle), radius[k] * std::sin(angle), height[k]);
    }
  }
  const auto low = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.emplace_back(0.0, 0.0, height[0]);
  mesh.vertices.emplace_back(0.0, 0.0, top);
  for (std::uint32_t i = 0; i < kAround; ++i) {
    const std::uint32_t next = (i + 1) % kAround;
    mesh.triangles.push_back({low, next, i});
    mesh.triangles.push_back({low + 1, 2 * kAround + i, 2 * kAround + next});
    for (std::uint32_t k = 0; k < 2 * kAround; k += kAround) {
      mesh.triangles.push_back({k + i, k + next, k + kAround + next});
      mesh.triangles.push_back({k + i, k + kAround + next, k + kAround + i});
    }
  }
  return mesh;
}

/// A point of a mesh, and the unit normal of its triangle into the body.
struct MeshPlace {
  Vector3d p, inward;
};

MeshPlace any_place(const TriangleMesh& mesh, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const auto& t = mesh.triangles[random() % mesh.triangles.size()];
  const Vector3d& a = mesh.vertices[t[0]];
  const Vector3d along = mesh.vertices[t[1]] - a;
  const Vector3d across = mesh.vertices[t[2]] - a;
  const double u = unit(random);
  return {a + u * along + (1.0 - u) * unit(random) * across, -along.cross(across).normalized()};
}

/// The stored surface lies no deeper than the tolerance allows where the field is flat, too. A small value of the field
/// on the mesh does not prove that: its zero level may lie several times as deep as the value says.
TEST(Refinement, MakesTheSurfaceTrueWhereTheFieldIsFlat) {
  std::mt19937_64 random(24);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const double s = 0.002;
  const double tolerance = kRefinedTolerance * s;
  const auto between = [&](double low, double high) { return s * (low + (high - low) * unit(random)); };
  for (int m = 0; m < 4; ++m) {
    const TriangleMesh mesh = test::moved(
        waisted({between(4, 8), between(2, 4), between(4, 8)}, {-10.0 * s, -between(4, 7), -between(0.5, 2.5)}, 0.0),
        any_motion(random, s));
    const TriangleMesh wound = m % 2 == 0 ? mesh : turned_inside_out(mesh);  // which is corrected
    const SolidSurface surface(wound, SurfaceKind::kSolid, 2.0 * s);
    const RefinedField field(surface, s);
    double deepest = 0.0;
    for (int i = 0; i < 100'000; ++i) {
      const auto [p, inward] = any_place(mesh, random);
      for (double depth = 1.0; depth < 4.0; depth += 0.1) {
        const Vector3d q = p + depth * tolerance * inward;
        if (field.map.sample(q).distance <= 0.0) break;
        deepest = std::max(deepest, -surface.signed_distance(q));
      }
    }
    EXPECT_LE(deepest, 1.2 * tolerance);
  }
}

/// A body that is made smaller by a slack touches at the level so deep inside. There the field bends below each convex
/// edge, and interpolation makes it shallower than it is.
TEST(Refinement, MakesTheLevelOfTheSlackTrue) {
  std::mt19937_64 random(25);
  const double s = 0.002;
  const double slack = 0.25 * s;
  const SurfaceTolerance tolerance = SurfaceTolerance::of_depth(kRefinedTolerance * s);
  for (int m = 0; m < 4; ++m) {
    const TriangleMesh body = m % 2 == 0 ? test::ball_mesh(9.0 * s, 10) : test::box_mesh({4.0 * s, 3.0 * s, 2.0 * s});
    const TriangleMesh mesh = test::moved(body, any_motion(random, s));
    const SolidSurface surface(mesh, SurfaceKind::kSolid, 2.0 * s);
    const RefinedField field(surface, s, tolerance, slack);
    double deepest = 0.0;
    for (int i = 0; i < 20'000; ++i) {
      const auto [p, inward] = any_place(mesh, random);
      for (double depth = 0.8; depth < 4.0; depth += 0.1) {
        const Vector3d q = p + (slack + depth * tolerance.inside) * inward;
        if (field.map.sample(q).distance > 0.0) deepest = std::max(deepest, -surface.signed_distance(q) - slack);
      }
    }
    EXPECT_LE(deepest, 1.2 * tolerance.inside) << m;
  }
}

/// Where bricks cannot be fine enough, the report names the worst place. No place on the surface is worse.
TEST(Refinement, NamesTheWorstPlaceOfAToleranceThatIsOutOfReach) {
  std::mt19937_64 random(22);
  const double s = 0.002;
  for (int i = 0; i < 2; ++i) {
    const TriangleMesh mesh = test::moved(cone_mesh(0.01, 0.02, 80), any_motion(random, s));  // too many facets
    const double out_of_reach = 0.01 * s;
    const RefinedField field(SolidSurface(mesh, SurfaceKind::kSolid, 2.0 * s), s,
                             SurfaceTolerance{out_of_reach, out_of_reach});
    const SurfaceError& worst = field.report.worst;
    ASSERT_GT(worst.in_tolerances, 1.0);
    EXPECT_NEAR(worst.in_tolerances, std::abs(worst.error) / out_of_reach, 1e-9);
    EXPECT_NEAR(field.map.sample(worst.at).distance, worst.error, 0.01 * s) << "but for rounding";
    const Worst seen = worst_at_surface(field.map, mesh, 4000);
    EXPECT_LE(std::max(seen.into, seen.off), std::abs(worst.error) + 0.01 * s);
    EXPECT_LT(BruteForce(mesh).distance(worst.at), 1e-9);
  }
}

/// The teapot is open at its spout, where seams keep bricks as they are, and its parts run into one another.
TEST(Refinement, JoinsTheBricksOfAnOpenMeshWithoutAJump) {
  const double s = 0.006;
  const SolidSurface surface(load("teapot", 0.037), SurfaceKind::kAuto, 2.0 * s);
  const RefinedField field(surface, s);
  EXPECT_GT(field.grid.refined.size(), 100u);
  EXPECT_LE(largest_jump(field, 60000), kFloatRounding * s);
  EXPECT_LE(field.grid.grid.lipschitz, kSteepest);
  EXPECT_LE(steepest_interpolated(field.grid), kSteepestInterpolated);
  EXPECT_LE(field.grid.grid.lipschitz_seam, std::max(kSteepest, field.coarse.grid.lipschitz_seam));
}

/// Calls visit(p) at `count` random places of each sharp edge of a mesh, and at its ends.
template <class Visit>
void visit_creases(const TriangleMesh& mesh, int count, const Visit& visit) {
  std::mt19937_64 random(20);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const MeshEdges edges(mesh);
  const auto normals = face_normals(mesh);
  for (const MeshEdges::Edge& edge : edges.all()) {
    const auto sides = edges.sides(edge);
    if (normals[sides[0].triangle].dot(normals[sides[1].triangle]) > kCreaseCosine) continue;
    const Vector3d& from = mesh.vertices[edge.low];
    const Vector3d& to = mesh.vertices[edge.high];
    visit(from);
    visit(to);
    for (int i = 0; i < count; ++i) visit(from + unit(random) * (to - from));
  }
}

/// Along edges, and in corners of both kinds, the field is the distance of the mesh to double precision. It may ripple
/// a little where an edge passes through no more than the corner of a cell.
TEST(Refinement, MakesTheFieldExactAlongEdgesAndInCorners) {
  std::mt19937_64 random(18);
  const double s = 0.002;
  const TriangleMesh box = test::moved(test::box_mesh({0.06, 0.05, 0.07}), any_motion(random, s));
  const TriangleMesh block = hollow_block({0.03, 0.028, 0.026}, {0.0101, 0.0083, 0.0067});
  for (const TriangleMesh& mesh : {box, block, test::moved(block, any_motion(random, s)),
                                   test::moved(cone_mesh(0.02, 0.03, 12), any_motion(random, s))}) {
    const RefinedField field(SolidSurface(mesh, SurfaceKind::kSolid, 2.0 * s), s);
    int exact = 0;
    int rippled = 0;
    int all = 0;
    visit_creases(mesh, 300, [&](const Vector3d& p) {
      const FieldSample sample = field.map.sample(p);
      ++all;
      if (std::abs(sample.distance) < 1e-12) ++exact;
      ASSERT_LE(std::abs(sample.distance), kRefinedTolerance * s) << p.transpose();
      if (std::abs(sample.distance) > 0.4 * kRefinedTolerance * s) ++rippled;
    });
    EXPECT_GT(exact, 9 * all / 10) << field.report.exact;
    EXPECT_LT(rippled, all / 100);
    EXPECT_GT(field.report.exact, 20u);
  }
}

/// Off the surface too: in a cell that an edge crosses, distance and gradient are those of the mesh.
TEST(Refinement, MakesTheFieldExactInTheCellsOfEdges) {
  std::mt19937_64 random(21);
  const double s = 0.002;
  const TriangleMesh mesh = test::moved(test::box_mesh({0.06, 0.05, 0.07}), any_motion(random, s));
  const SolidSurface surface(mesh, SurfaceKind::kSolid, 2.0 * s);
  const RefinedField field(surface, s);
  const Eigen::Map<const Vector3d> origin(field.grid.grid.origin);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int exact = 0;
  int all = 0;
  visit_creases(mesh, 200, [&](const Vector3d& on_edge) {
    const Vector3d cell = ((on_edge - origin) / s).array().floor();
    const Vector3d p = origin + s * (cell + Vector3d(unit(random), unit(random), unit(random)));
    const FieldSample sample = field.map.sample(p);
    ++all;
    if (std::abs(sample.distance - surface.signed_distance(p)) < 1e-12) {
      ++exact;
      ASSERT_NEAR(sample.gradient.norm(), 1.0, 1e-12);
    }
  });
  EXPECT_GT(exact, 9 * all / 10);
}

/// For any shape of bricks and exact cells: the distances of two points outside differ by no more than the constant
/// allows.
TEST(Refinement, KeepsTheFieldAsSteepAsItSays) {
  std::mt19937_64 random(19);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (const char* name : {"box", "block", "bracket"}) {
    const double s = 0.004;
    TriangleMesh mesh = std::string(name) == "box"
                            ? test::moved(test::box_mesh({0.06, 0.05, 0.07}), any_motion(random, s))
                        : std::string(name) == "block" ? hollow_block({0.06, 0.056, 0.052}, {0.0202, 0.0166, 0.0134})
                                                       : load(name, 1.0);
    const RefinedField field(SolidSurface(mesh, SurfaceKind::kSolid, 2.0 * s), s);
    double steepest = 0.0;
    visit_creases(mesh, 3000, [&](const Vector3d& on_edge) {
      const Vector3d p = on_edge + 3.0 * s * Vector3d(unit(random), unit(random), unit(random));
      const FieldSample here = field.map.sample(p);
      if (!here.known || here.distance < 0.0) return;
      const double bound = here.distance / here.clearance;  // of the brick, unless the clearance is limited
      if (here.distance < field.map.band() - 2.0 * s) {
        ASSERT_LE(here.gradient.norm(), bound) << name;
      }
      steepest = std::max(steepest, here.gradient.norm());
    });
    EXPECT_LE(steepest, field.grid.grid.lipschitz) << name;
    EXPECT_GT(steepest, 1.1) << name;  // the test covers steep places
  }
}

TEST(Refinement, LeavesEveryPositionsOwnNodes) {
  std::mt19937_64 random(16);
  const SolidSurface surface(test::moved(test::ball_mesh(0.012, 24), any_motion(random, 0.004)), SurfaceKind::kSolid,
                             0.008);
  const RefinedField field(surface, 0.004, 0.01);
  int refined = 0;
  for (std::size_t i = 0; i < field.grid.index.size(); ++i) {
    const std::uint32_t entry = field.grid.index[i];
    if ((entry & format::index_entry::kFar) != 0) continue;
    std::uint32_t own = entry & format::index_entry::kNumber;
    if ((entry & format::index_entry::kRefined) != 0) ++refined, own = field.grid.refined[own].brick;
    const Brick& before = field.coarse.bricks[field.coarse.index[i] & format::index_entry::kNumber];
    for (int node = 0; node < format::kBrickValues; ++node) {
      ASSERT_NEAR(field.grid.bricks[own].value[node], before.value[node],
                  (format::kMostRoundedOff + 0.5) * field.grid.grid.quantum);
    }
  }
  EXPECT_GT(refined, 7);
}

TEST(Refinement, KeepsLowerBoundsAndClearancesTrue) {
  std::mt19937_64 random(17);
  const SolidSurface surface(test::moved(wedge(1.0, 0.03, 0.02), any_motion(random, 0.002)), SurfaceKind::kSolid,
                             0.004);
  const RefinedField field(surface, 0.002);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  int bounded = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vector3d center = 0.04 * Vector3d(unit(random), unit(random), unit(random));
    const double radius = 0.01 * std::pow(unit(random), 2);
    const double bound = field.map.lower_bound(center, radius);
    const double clearance = field.map.sample(center).clearance;
    if (bound >= 0.0) ++bounded;
    for (int k = 0; k < 30; ++k) {
      const Vector3d direction = Vector3d(unit(random), unit(random), unit(random)).normalized();
      if (bound >= 0.0) {
        ASSERT_GE(field.map.sample(center + radius * std::cbrt(std::abs(unit(random))) * direction).distance,
                  std::min(bound, field.map.band()) - 1e-8);
      }
      if (clearance <= 0.0) continue;
      ASSERT_GT(field.map.sample(center + 0.999 * clearance * std::abs(unit(random)) * direction).distance + 1e-9, 0.0);
    }
  }
  EXPECT_GT(bounded, 1000);
}

TEST(Refinement, LeavesWhatIsGoodEnough) {
  const SolidSurface surface(test::box_mesh({0.04, 0.03, 0.05}), SurfaceKind::kSolid, 0.008);
  const RefinedField field(surface, 0.004, 1000.0);
  EXPECT_TRUE(field.grid.refined.empty());
  EXPECT_EQ(field.grid.bricks.size(), field.coarse.bricks.size());
  EXPECT_EQ(field.grid.index, field.coarse.index);
  EXPECT_EQ(field.grid.grid.lipschitz, field.coarse.grid.lipschitz);
  EXPECT_EQ(field.report.bricks[0], field.coarse.bricks.size());
}

TEST(Refinement, GivesTheSameEveryTime) {
  const SolidSurface surface(load("bracket", 1.0), SurfaceKind::kAuto, 0.016);
  const RefinedField one(surface, 0.008);
  const RefinedField other(surface, 0.008);
  ASSERT_EQ(one.grid.bricks.size(), other.grid.bricks.size());
  EXPECT_EQ(one.grid.index, other.grid.index);
  EXPECT_EQ(std::memcmp(one.grid.bricks.data(), other.grid.bricks.data(), one.grid.bricks.size() * sizeof(Brick)), 0);
  const auto same = [](const auto& a, const auto& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
  };
  EXPECT_TRUE(same(one.grid.exact, other.grid.exact));
  EXPECT_TRUE(same(one.grid.facets, other.grid.facets));
  EXPECT_TRUE(same(one.grid.facet_sets, other.grid.facet_sets));
  EXPECT_EQ(one.grid.facet_numbers, other.grid.facet_numbers);
  EXPECT_GT(one.grid.exact.size(), 0u);
  EXPECT_EQ(std::memcmp(one.grid.refined.data(), other.grid.refined.data(),
                        one.grid.refined.size() * sizeof(format::Refined)),
            0);
}

}  // namespace
}  // namespace godobject::scene_compiler::refinement_test
