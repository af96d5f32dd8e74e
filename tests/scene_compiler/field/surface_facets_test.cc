#include "toolchain/scene_compiler/field/surface_facets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "core/scene/facets.h"
#include "tests/scene_compiler/brute_force.h"
#include "tests/scene_compiler/simple_meshes.h"
#include "tests/scene_compiler/test_meshes.h"
#include "tests/support/random.h"
#include "toolchain/scene_compiler/field/near_facets.h"
#include "toolchain/scene_compiler/mesh/mesh_edges.h"
#include "toolchain/scene_compiler/mesh/triangle_geometry.h"

namespace godobject::scene_compiler::surface_facets_test {
namespace {

using Eigen::Vector3d;

/// The facets near a cube give the mesh's distance, with its sign, at every point of the cube.
TEST(SurfaceFacets, NearACubeGiveTheDistanceInIt) {
  test::Random random(1);
  for (const TriangleMesh& mesh : {test::moved(test::box_mesh({0.03, 0.02, 0.015}), test::odd_motion()),
                                   test::ball_mesh(0.012, 8), load("bracket", 0.3)}) {
    const SolidSurface surface(mesh, SurfaceKind::kSolid, 0.0);
    const SurfaceFacets facets(surface, 0.0);
    const BruteForce truth(surface.mesh());
    int served = 0;
    for (int i = 0; i < 300; ++i) {
      const auto& t = mesh.triangles[static_cast<std::size_t>(random.integer(0, 1 << 30)) % mesh.triangles.size()];
      const double half = random.between(2e-4, 1e-3);
      const Vector3d center = mesh.vertices[t[0]] + 3.0 * half * random.in_cube(1.0);
      const auto near = facets.near(center, half);
      if (!near) continue;
      ++served;
      for (int k = 0; k < 20; ++k) {
        const Vector3d p = center + half * random.in_cube(1.0);
        const double sign = truth.winding_number(p) > 0.5 ? -1.0 : 1.0;
        ASSERT_NEAR(facet_distance(facets.all(), *near, p).value, sign * truth.distance(p), 1e-9) << p.transpose();
      }
    }
    EXPECT_GT(served, 150);
  }
}

/// In a room every cell near the walls has planes, and its distance is the least height above them. A cell has no more
/// planes than walls that it is near to. About the outside of a box no cell at an edge has two planes.
TEST(SurfaceFacets, HavePlanesWhereTheFreeSpaceIsConvex) {
  test::Random random(4);
  const Vector3d half(0.015, 0.012, 0.009);
  const TriangleMesh box = test::box_mesh(2.0 * half);
  TriangleMesh room = hollow_block({0.09, 0.08, 0.07}, 2.0 * half);
  int with_planes = 0, outside_box = 0, planes_of_rooms = 0;
  for (const bool of_room : {true, false}) {
    const auto motion = test::odd_motion();
    const SolidSurface surface(test::moved(of_room ? room : box, motion), SurfaceKind::kSolid, 0.0);
    const SurfaceFacets facets(surface, 0.0);
    const BruteForce truth(surface.mesh());
    for (int i = 0; i < 400; ++i) {
      const double half_edge = random.between(2e-4, 1e-3);
      Vector3d local = half.cwiseProduct(random.in_cube(0.5));
      const int corners = i % 3;  // 0: about a face, 1: an edge, 2: a corner
      for (int axis = 0; axis <= corners; ++axis) {
        local[axis] = std::copysign(half[axis], local[axis]) + 2.0 * half_edge * random.between(-1.0, 1.0);
      }
      const Vector3d center = motion * local;
      const auto near = facets.near(center, half_edge);
      ASSERT_TRUE(near);
      const auto planes = facets.convex_planes(center, half_edge, *near);
      ASSERT_TRUE(std::includes(near->begin(), near->end(), planes.begin(), planes.end()));
      if (!of_room && corners > 0) {
        // the solid is convex there, the free space is not
        ASSERT_TRUE(planes.size() <= 1) << center.transpose();
        outside_box += planes.empty() ? 1 : 0;
      }
      if (of_room) {
        ASSERT_FALSE(planes.empty()) << center.transpose();
        ASSERT_LE(planes.size(), static_cast<std::size_t>(corners) + 1);
        planes_of_rooms += static_cast<int>(planes.size());
      }
      if (planes.empty()) continue;
      ++with_planes;
      for (int k = 0; k < 20; ++k) {
        const Vector3d p = center + half_edge * random.in_cube(1.0);
        double least = HUGE_VAL;
        for (const std::uint32_t number : planes) {
          const format::Facet& f = facets.all()[number];
          least = std::min(least, face_normal(f).dot(p) + f.plane[3][0]);
        }
        const bool inside = truth.winding_number(p) > 0.5;
        ASSERT_EQ(least < 0.0, inside) << p.transpose();
        if (!inside) {
          ASSERT_NEAR(least, truth.distance(p), 1e-9) << p.transpose();
        }
      }
    }
  }
  EXPECT_GT(with_planes, 400);
  EXPECT_GT(outside_box, 150);
  EXPECT_LT(planes_of_rooms, 900) << "of 400 cells";
}

/// A block ends beside a cell above a floor. Its upper face's plane cuts the cell, but no place of the block is nearest
/// to a point of it.
TEST(SurfaceFacets, HaveNoPlaneOfABodyBeside) {
  const double h = 1e-3;
  const Vector3d up = Vector3d::Ones().normalized();
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.rotate(Eigen::AngleAxisd(std::acos(up.z()), Vector3d::UnitZ().cross(up).normalized()));
  motion.pretranslate(-h * up);
  const TriangleMesh floor = test::moved(test::box_mesh({60 * h, 60 * h, 20 * h}, {-30 * h, -30 * h, -20 * h}), motion);
  const TriangleMesh block = test::box_mesh({6 * h, 8 * h, 2.9 * h}, {3.76 * h, -2.6 * h, -2.3 * h});
  const SolidSurface surface(test::joined(floor, block), SurfaceKind::kSolid, 0.0);
  const SurfaceFacets facets(surface, 0.0);
  const auto near = facets.near(Vector3d::Zero(), h);
  ASSERT_TRUE(near);
  for (const std::uint32_t plane : facets.convex_planes(Vector3d::Zero(), h, *near)) {
    EXPECT_LE((face_normal(facets.all()[plane]) - up).norm(), 1e-9);
  }
}

TEST(SurfaceFacets, AreNoneWhereTheyWouldNotTellTheSide) {
  const Vector3d corner(0.015, 0.01, 0.0075);
  const TriangleMesh box = test::box_mesh(2.0 * corner);
  const auto none_near = [](const TriangleMesh& mesh, SurfaceKind kind, const Vector3d& at, double dilation = 0.0) {
    const SolidSurface surface(mesh, kind, 1e-3, dilation);
    return !SurfaceFacets(surface, 0.0).near(at, 5e-4);
  };
  Vector3d at = corner;
  for (const auto& v : box.vertices) at = v;  // a vertex of the last triangle
  EXPECT_FALSE(none_near(box, SurfaceKind::kSolid, at));
  EXPECT_TRUE(none_near(box, SurfaceKind::kShell, at));
  EXPECT_TRUE(none_near(box, SurfaceKind::kSolid, at, 0.003)) << "dilated";
  TriangleMesh open = box;
  at = open.vertices[open.triangles.back()[0]];
  open.triangles.pop_back();
  EXPECT_TRUE(none_near(open, SurfaceKind::kSolid, at)) << "at a hole";
  // two boxes that overlap by a corner: each is valid away from the other
  const Eigen::Isometry3d to_corner(Eigen::Translation3d(1.8 * corner));
  const TriangleMesh both = test::joined(box, test::moved(box, to_corner));
  EXPECT_TRUE(none_near(both, SurfaceKind::kSolid, corner - Vector3d(2e-3, 0.0, 0.0)));
  EXPECT_TRUE(none_near(both, SurfaceKind::kSolid, corner)) << "within the other one";
  EXPECT_FALSE(none_near(test::joined(box, test::moved(box, Eigen::Isometry3d(Eigen::Translation3d(2.2 * corner)))),
                         SurfaceKind::kSolid, corner));
  // a fan in more planes than a look-up should compare
  const TriangleMesh cone = cone_mesh(0.01, 0.02, 40);
  EXPECT_TRUE(none_near(cone, SurfaceKind::kSolid, cone.vertices[0]));
  EXPECT_FALSE(none_near(cone, SurfaceKind::kSolid, cone.vertices[2]));
}

/// A sliver folded over the face beside it, as exporters leave them, is left out and its slit is closed.
TEST(SurfaceFacets, LeaveOutFoldedSlivers) {
  TriangleMesh mesh = test::box_mesh({0.03, 0.02, 0.015});
  const auto t = mesh.triangles[0];
  const auto vertex = [&](std::uint32_t v) { return mesh.vertices[v]; };
  const Vector3d inward = (vertex(t[2]) - 0.5 * (vertex(t[0]) + vertex(t[1]))).normalized();
  const auto middle = static_cast<std::uint32_t>(mesh.vertices.size());
  const Vector3d up = (vertex(t[1]) - vertex(t[0])).cross(inward).normalized();
  // beyond the edge, and off the face's plane by a rounding, so that the face is not flat
  mesh.vertices.push_back(0.5 * (vertex(t[0]) + vertex(t[1])) - 1e-6 * inward + 1e-11 * up);
  mesh.triangles[0] = {t[0], middle, t[2]};
  mesh.triangles.push_back({middle, t[1], t[2]});
  mesh.triangles.push_back({t[0], t[1], middle});  // the sliver, turned over
  const SolidSurface surface(mesh, SurfaceKind::kSolid, 0.0);
  const Vector3d at = vertex(middle);
  EXPECT_FALSE(SurfaceFacets(surface, 0.0).near(at, 5e-4));
  const SurfaceFacets facets(surface, 2e-6);
  const auto near = facets.near(at, 5e-4);
  ASSERT_TRUE(near);
  test::Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const Vector3d p = at + 5e-4 * random.in_cube(1.0);
    ASSERT_NEAR(facet_distance(facets.all(), *near, p).value, surface.signed_distance(p), 2e-6) << p.transpose();
  }
}

/// Needles between two vertices that are nearly one are left out together with the slits between their long sides.
TEST(SurfaceFacets, LeaveOutNeedles) {
  constexpr double kFlat = 1e-6;
  TriangleMesh mesh = test::box_mesh({0.03, 0.02, 0.015});
  auto& t = mesh.triangles[0];
  const auto to = [&](std::size_t from, std::size_t end) -> Vector3d {
    return (mesh.vertices[t[end % 3]] - mesh.vertices[t[from]]).normalized();
  };
  std::size_t k = 0;
  while (std::abs(to(k, k + 1).dot(to(k, k + 2))) > 1e-9) ++k;  // the right angle
  const std::uint32_t a = t[k];
  const std::uint32_t b = t[(k + 1) % 3];
  const std::uint32_t c = t[(k + 2) % 3];
  const auto twin = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back(mesh.vertices[a] + 0.95 * kFlat * (to(k, k + 1) + to(k, k + 2)));
  t[k] = twin;
  mesh.triangles.push_back({a, b, twin});
  mesh.triangles.push_back({a, twin, c});
  ASSERT_TRUE(MeshEdges(mesh).closed());
  const SolidSurface surface(mesh, SurfaceKind::kSolid, 0.0);
  const Vector3d at = mesh.vertices[a];
  const SurfaceFacets facets(surface, kFlat);
  EXPECT_LE(facets.flat(), 1.5 * kFlat);
  const auto near = facets.near(at, 5e-4);
  ASSERT_TRUE(near);
  test::Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const Vector3d p = at + 5e-4 * random.in_cube(1.0);
    ASSERT_NEAR(facet_distance(facets.all(), *near, p).value, surface.signed_distance(p), facets.flat());
  }
}

/// A box with a cluster of vertices in its upper face, as near to each other as the vertices of needles, which make it
/// uneven by a length. No triangle is folded.
TriangleMesh box_with_cluster(test::Random& random, std::uint32_t n, double step, double uneven) {
  TriangleMesh mesh = test::box_mesh({0.02, 0.03, 0.01});
  std::erase_if(mesh.triangles, [](const auto& t) { return std::min({t[0], t[1], t[2]}) >= 4; });  // the upper face
  const auto at = [&](std::uint32_t x, std::uint32_t y) { return 8 + x + n * y; };
  const double half = 0.5 * (n - 1);
  for (std::uint32_t y = 0; y < n; ++y) {
    for (std::uint32_t x = 0; x < n; ++x) {
      mesh.vertices.emplace_back(step * (x - half + 0.4 * random.between(-1.0, 1.0)),
                                 step * (y - half + 0.4 * random.between(-1.0, 1.0)),
                                 0.005 + uneven * random.between(-1.0, 1.0));
    }
  }
  for (std::uint32_t y = 0; y + 1 < n; ++y) {
    for (std::uint32_t x = 0; x + 1 < n; ++x) {
      const bool other = random.between(0.0, 1.0) < 0.5;  // diagonal
      mesh.triangles.push_back({at(x, y), at(x + 1, y), other ? at(x, y + 1) : at(x + 1, y + 1)});
      mesh.triangles.push_back({other ? at(x + 1, y) : at(x, y), at(x + 1, y + 1), at(x, y + 1)});
    }
  }
  for (std::uint32_t i = 0; i + 1 < n; ++i) {
    mesh.triangles.push_back({4, at(i + 1, 0), at(i, 0)});
    mesh.triangles.push_back({5, at(n - 1, i + 1), at(n - 1, i)});
    mesh.triangles.push_back({7, at(i, n - 1), at(i + 1, n - 1)});
    mesh.triangles.push_back({6, at(0, i), at(0, i + 1)});
  }
  mesh.triangles.push_back({4, 5, at(n - 1, 0)});
  mesh.triangles.push_back({5, 7, at(n - 1, n - 1)});
  mesh.triangles.push_back({7, 6, at(0, n - 1)});
  mesh.triangles.push_back({6, 4, at(0, 0)});
  return mesh;
}

bool has_folded_triangle(const TriangleMesh& mesh) {
  return std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& t) {
    const Vector3d& a = mesh.vertices[t[0]];
    const double z = (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).z();
    return std::max({t[0], t[1], t[2]}) >= 8 && z <= 0.0;
  });
}

/// In a cluster of vertices facets may turn over as needles go. They tell no side, and the others tell it.
TEST(SurfaceFacets, TellTheSideWhereNeedlesWere) {
  constexpr double kFlat = 1e-6;
  test::Random random(5);
  int found = 0;
  for (unsigned i = 0; i < 1500; ++i) {
    const double uneven = kFlat * random.between(0.05, 1.0);
    const TriangleMesh mesh = box_with_cluster(random, 3 + i % 2, random.between(1.0, 1.4) * kFlat, uneven);
    ASSERT_TRUE(MeshEdges(mesh).closed());
    if (has_folded_triangle(mesh)) continue;
    const SolidSurface surface(mesh, SurfaceKind::kSolid, 0.0);
    const SurfaceFacets facets(surface, kFlat);
    for (const double half_edge : {5.0 * kFlat, 100.0 * kFlat}) {
      const Vector3d center = Vector3d(0.0, 0.0, 0.005) + 3.0 * kFlat * random.in_cube(1.0);
      const auto near = facets.near(center, half_edge);
      if (!near) continue;
      ++found;
      for (int k = 0; k < 60; ++k) {
        const Vector3d p = center + half_edge * random.in_cube(1.0);
        ASSERT_NEAR(facet_distance(facets.all(), *near, p).value, surface.signed_distance(p), 3.0 * kFlat)
            << i << ", " << (p - center).transpose();
      }
    }
  }
  EXPECT_GE(found, 100);
}

TEST(SurfaceFacets, TurnAtCreasesAndThinWallsOnly) {
  const TriangleMesh box = test::box_mesh({0.03, 0.02, 1e-3});
  const SurfaceFacets facets(SolidSurface(box, SurfaceKind::kSolid, 0.0), 0.0);
  const Vector3d low = *std::min_element(box.vertices.begin(), box.vertices.end(),
                                         [](const auto& a, const auto& b) { return a.sum() < b.sum(); });
  const auto turns_at = [&](const Vector3d& from_corner, double half) {
    return facets.turns(*facets.near(low + from_corner, half));
  };
  EXPECT_FALSE(turns_at({0.01, 0.01, 0.0}, 1e-4)) << "a face";
  EXPECT_TRUE(turns_at({0.01, 0.01, 0.0}, 1e-3)) << "both faces of a wall";
  EXPECT_TRUE(turns_at({0.01, 0.0, 0.0}, 1e-4)) << "an edge";
  const TriangleMesh ball = test::ball_mesh(0.012, 16);
  const SurfaceFacets round(SolidSurface(ball, SurfaceKind::kSolid, 0.0), 0.0);
  EXPECT_FALSE(round.turns(*round.near(ball.vertices[20], 1e-4)));
}

/// A facet of these vertices, with its planes; without area it has no normal, and its planes are zero.
format::Facet facet_of(const Vector3d (&vertex)[3]) {
  format::Facet facet{};
  for (int k = 0; k < 3; ++k) std::copy(vertex[k].data(), vertex[k].data() + 3, facet.vertex[k]);
  set_planes(facet, (vertex[1] - vertex[0]).cross(vertex[2] - vertex[0]).normalized());
  return facet;
}

/// Random triangles, obtuse ones, slivers and some without area: the comparison of planes leaves out none that is near.
TEST(NearFacets, AreThoseOfAllDistances) {
  test::Random random(5);
  for (int trial = 0; trial < 2000; ++trial) {
    std::vector<format::Facet> facets;
    std::vector<std::uint32_t> numbers;
    const Vector3d p = random.in_cube(1.0);
    std::vector<double> exact;
    for (std::uint32_t i = 0; i < 12; ++i) {
      Vector3d vertex[3] = {random.in_cube(1.0), random.in_cube(1.0), random.in_cube(1.0)};
      if (i % 4 == 1) vertex[2] = vertex[0] + random.between(-0.5, 1.5) * (vertex[1] - vertex[0]) + 0.01 * vertex[2];
      if (i % 4 == 2) vertex[2] = vertex[0];
      facets.push_back(facet_of(vertex));
      numbers.push_back(i);
      exact.push_back((nearest_point_on_triangle(p, vertex[0], vertex[1], vertex[2]) - p).norm());
    }
    const double most = random.between(0.0, 1.0);
    for (std::size_t i = 0; i < exact.size(); ++i) {
      const double squared = squared_distance_within(facets[i], p, most);
      if (exact[i] * exact[i] > most) {
        EXPECT_GT(squared, most);
      } else {
        EXPECT_NEAR(squared, exact[i] * exact[i], 1e-12);
      }
    }
    const double radius = random.between(0.0, 0.3);
    const double furthest = *std::min_element(exact.begin(), exact.end()) + 2.0 * radius;
    std::vector<std::uint32_t> expected;
    for (const std::uint32_t i : numbers) {
      if (exact[i] <= furthest) expected.push_back(i);
    }
    std::vector<std::uint32_t> near;
    NearFacets(facets).find(numbers, p, radius, near);
    EXPECT_EQ(near, expected) << trial;
  }
}

/// The bound of the difference holds at random points, and is not far above the largest.
TEST(FacetDifference, BoundsWhatIsMeasured) {
  test::Random random(3);
  const TriangleMesh mesh =
      test::moved(hollow_block({0.03, 0.028, 0.026}, {0.0101, 0.0083, 0.0067}), test::odd_motion());
  const SolidSurface surface(mesh, SurfaceKind::kSolid, 0.0);
  const SurfaceFacets facets(surface, 0.0);
  double loosest = 0.0;
  for (int i = 0; i < 400; ++i) {
    const auto& t = mesh.triangles[static_cast<std::size_t>(random.integer(0, 1 << 30)) % mesh.triangles.size()];
    const double edge = 1e-3;
    const double share = random.between(0.0, 1.0);
    const Vector3d on_edge = mesh.vertices[t[0]] + share * (mesh.vertices[t[1]] - mesh.vertices[t[0]]);
    const Vector3d center = on_edge + edge * random.in_cube(1.0);
    const Vector3d low = center - Vector3d::Constant(0.5 * edge);
    const auto near = facets.near(center, 0.5 * edge);
    ASSERT_TRUE(near);
    const format::FacetSet sets[] = {{}, {0, static_cast<std::uint16_t>(near->size()), 0}};
    format::ExactBrick exact{};
    exact.cell[7] = format::cell_facets::kWhole | 2;
    const double offset = random.between(-0.2, 0.2) * edge;
    double corners[8];
    for (unsigned c = 0; c < 8; ++c) {
      corners[c] = surface.signed_distance(low + edge * Vector3d(c & 1, c >> 1 & 1, c >> 2)) + offset;
    }
    const FacetDifference difference({facets.all(), sets, *near}, exact, offset);
    FacetDifference::Largest bound;
    difference.raise(7, low, edge, corners, bound);
    FacetDifference::Largest raised{0.3 * edge, 0.1 * edge};
    difference.raise(7, low, edge, corners, raised);
    double anywhere = 0.0, outside = 0.0;
    for (int k = 0; k < 500; ++k) {
      const Vector3d at = 0.5 * (random.in_cube(1.0) + Vector3d::Ones());
      double interpolated = 0.0;
      for (unsigned c = 0; c < 8; ++c) {
        double weight = 1.0;
        for (unsigned axis = 0; axis < 3; ++axis) weight *= (c >> axis & 1) != 0 ? at[axis] : 1.0 - at[axis];
        interpolated += weight * corners[c];
      }
      const double g = surface.signed_distance(low + edge * at) + offset;
      anywhere = std::max(anywhere, std::abs(g - interpolated));
      if (g > 0.0 || interpolated > 0.0) outside = std::max(outside, std::abs(g - interpolated));
    }
    ASSERT_GE(bound.anywhere, anywhere - 1e-12);
    ASSERT_GE(bound.outside, outside - 1e-12);
    ASSERT_GE(bound.anywhere, bound.outside);
    ASSERT_GE(raised.anywhere, std::max(anywhere - 1e-12, 0.3 * edge)) << "starts from a bound";
    ASSERT_GE(raised.outside, std::max(outside - 1e-12, 0.1 * edge));
    ASSERT_GE(difference.coarse(7, low, edge, corners), anywhere);
    loosest = std::max(loosest, bound.anywhere - anywhere);
  }
  EXPECT_LT(loosest, 0.4e-3);
}

}  // namespace
}  // namespace godobject::scene_compiler::surface_facets_test
