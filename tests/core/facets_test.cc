#include "core/scene/facets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "godobject/pose.h"
#include "tests/support/random.h"

namespace godobject {
namespace {

using Triangle = std::array<std::size_t, 3>;

void store(const Vector3& v, double (&out)[3]) { std::copy(v.data(), v.data() + 3, out); }
void store(const Vector3& v, float (&out)[3]) {
  for (int axis = 0; axis < 3; ++axis) out[axis] = static_cast<float>(v[axis]);
}

/// The facets of a closed mesh, with normals computed face by face.
std::vector<format::Facet> facets_of(const std::vector<Vector3>& vertices, const std::vector<Triangle>& triangles) {
  const auto at = [&](const Triangle& t, std::size_t k) { return vertices[t[k % 3]]; };
  const auto normal_of = [&](const Triangle& t) {
    return Vector3((at(t, 1) - at(t, 0)).cross(at(t, 2) - at(t, 0)).normalized());
  };
  std::vector<format::Facet> facets;
  for (const Triangle& t : triangles) {
    format::Facet facet{};
    for (std::size_t k = 0; k < 3; ++k) {
      store(at(t, k), facet.vertex[k]);
      Vector3 of_edge = normal_of(t), of_vertex = Vector3::Zero();
      for (const Triangle& other : triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
          if (other[i] == t[(k + 1) % 3] && other[(i + 1) % 3] == t[k]) of_edge += normal_of(other);
          if (other[i] != t[k]) continue;
          const Vector3 one = at(other, i + 1) - at(other, i), two = at(other, i + 2) - at(other, i);
          of_vertex += std::acos(one.normalized().dot(two.normalized())) * normal_of(other);
        }
      }
      store(of_edge.normalized(), facet.edge_normal[k]);
      store(of_vertex.normalized(), facet.vertex_normal[k]);
    }
    set_planes(facet, normal_of(t));
    facets.push_back(facet);
  }
  return facets;
}

const std::vector<Triangle> kBoxTriangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                             {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};

std::vector<Vector3> box_vertices(const Vector3& half_edges) {
  std::vector<Vector3> vertices;
  for (int i = 0; i < 8; ++i) {
    vertices.push_back(half_edges.cwiseProduct(Vector3(i % 2 * 2 - 1, i / 2 % 2 * 2 - 1, i / 4 * 2 - 1)));
  }
  return vertices;
}

double box_distance(const Vector3& half_edges, const Vector3& p) {
  const Vector3 beyond = p.cwiseAbs() - half_edges;
  return beyond.cwiseMax(0.0).norm() + std::min(0.0, beyond.maxCoeff());
}

std::vector<std::uint32_t> all(std::size_t count) {
  std::vector<std::uint32_t> numbers(count);
  for (std::size_t i = 0; i < count; ++i) numbers[i] = static_cast<std::uint32_t>(i);
  return numbers;
}

TEST(Facets, HaveTheDistanceOfABox) {
  const Vector3 half(0.3, 0.2, 0.1);
  test::Random random(1);
  for (int turn = 0; turn < 5; ++turn) {
    const Pose pose{exp_rotation(random.between(0.0, 3.0) * random.direction()), random.in_cube(2.0)};
    std::vector<Vector3> vertices = box_vertices(half);
    for (Vector3& v : vertices) v = pose * v;
    const auto facets = facets_of(vertices, kBoxTriangles);
    for (int i = 0; i < 4000; ++i) {
      const Vector3 p = random.in_cube(0.5);
      const ValueAndGradient g = facet_distance(facets, all(12), pose * p);
      ASSERT_NEAR(g.value, box_distance(half, p), 1e-12) << p.transpose();
      ASSERT_NEAR(g.gradient.norm(), 1.0, 1e-12);
      const double step = 1e-6;
      const Vector3 direction = random.direction();
      const double ahead = box_distance(half, p + step * direction), behind = box_distance(half, p - step * direction);
      if (std::fabs(ahead - 2.0 * g.value + behind) > 1e-3 * step) continue;  // a crease within
      ASSERT_NEAR(g.gradient.dot(pose.rotation * direction), (ahead - behind) / (2.0 * step), 1e-4) << p.transpose();
    }
  }
}

/// The corner of a room: the same box inside out.
TEST(Facets, HaveTheDistanceOfACavity) {
  const Vector3 half(0.3, 0.2, 0.1);
  std::vector<Triangle> inward = kBoxTriangles;
  for (Triangle& t : inward) std::swap(t[1], t[2]);
  const auto facets = facets_of(box_vertices(half), inward);
  test::Random random(2);
  for (int i = 0; i < 4000; ++i) {
    const Vector3 p = random.in_cube(0.5);
    ASSERT_NEAR(facet_distance(facets, all(12), p).value, -box_distance(half, p), 1e-12) << p.transpose();
  }
}

/// A tetrahedron so sharp that at its apex most points outside lie behind two of its three faces.
TEST(Facets, TellTheSideAboutASharpApex) {
  const std::vector<Vector3> vertices = {{0, 0, 1}, {0.1, 0, 0}, {-0.05, 0.08, 0}, {-0.05, -0.08, 0}};
  const std::vector<Triangle> triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
  const auto facets = facets_of(vertices, triangles);
  test::Random random(3);
  int above_apex = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vector3 p = Vector3(0, 0, 0.5) + random.in_cube(0.7);
    bool inside = true;
    for (const format::Facet& f : facets) {
      const Vector3 n = face_normal(f);
      inside = inside && n.dot(p - Eigen::Map<const Vector3>(f.vertex[0])) < 0.0;
    }
    const double g = facet_distance(facets, all(4), p).value;
    ASSERT_EQ(g < 0.0, inside) << p.transpose();
    if (std::fabs(g - (p - vertices[0]).norm()) < 1e-12) ++above_apex;
  }
  EXPECT_GT(above_apex, 1000);
}

/// On the surface the gradient is the normal of a face; just off it, the direction from the nearest place.
TEST(Facets, HaveANormalOnTheSurfaceItself) {
  const auto facets = facets_of(box_vertices(Vector3::Constant(0.5)), kBoxTriangles);
  const auto at = [&](const Vector3& p) { return facet_distance(facets, all(12), p); };
  EXPECT_EQ(at({0.1, 0.2, 0.5}).gradient, Vector3::UnitZ());
  EXPECT_EQ(at({0.1, 0.2, 0.5}).value, 0.0);
  for (const Vector3& p : {Vector3(0.5, 0.2, 0.5), Vector3(0.5, -0.5, 0.5)}) {
    EXPECT_EQ(at(p).value, 0.0);
    EXPECT_EQ(at(p).gradient.cwiseProduct(p).sum(), 0.5) << "one face's";
  }
  const double tiny = 1e-9;
  EXPECT_LE((at({0.5 + tiny, 0.2, 0.5 + tiny}).gradient - Vector3(1, 0, 1).normalized()).norm(), 1e-6);
  EXPECT_LE((at({0.5 + tiny, 0.5 + tiny, 0.5 + tiny}).gradient - Vector3::Ones().normalized()).norm(), 1e-6);
}

/// Above the middle of a face, however high, the gradient is the face's normal without rounding.
TEST(Facets, HaveTheFacesNormalAboveIt) {
  test::Random random(8);
  const std::vector<Vector3> corners = {Vector3(0.0, 0.0, 0.0), Vector3(0.3, 0.1, 0.0), Vector3(0.1, 0.3, 0.1),
                                        Vector3(0.1, 0.1, -0.4)};
  const std::vector<format::Facet> facets = facets_of(corners, {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}});
  std::vector<std::uint32_t> numbers = {0, 1, 2, 3};
  for (int i = 0; i < 300; ++i) {
    const format::Facet& facet = facets[static_cast<std::size_t>(i % 4)];
    Vector3 middle = Vector3::Zero();
    for (const auto& vertex : facet.vertex) middle += Vector3(vertex[0], vertex[1], vertex[2]) / 3.0;
    const double height = 0.01 * std::pow(10.0, -random.between(0.0, 8.0));
    const ValueAndGradient found = facet_distance(facets, numbers, middle + height * face_normal(facet));
    EXPECT_EQ(found.gradient, face_normal(facet)) << height;
    EXPECT_NEAR(found.value, height, 1e-15);
  }
}

TEST(Facets, OfASetAreThoseOfItsNumbers) {
  const auto facets = facets_of(box_vertices(Vector3::Constant(0.5)), kBoxTriangles);
  const std::vector<std::uint32_t> numbers = {10, 2, 3};
  // half of the face at +x; the upper face
  const std::vector<format::FacetSet> sets = {{0, 1, 0}, {1, 2, 0}};
  const FacetLists lists{facets, sets, numbers};
  const Vector3 p(0.7, -0.4, 0.8);
  EXPECT_NEAR(facet_distance(lists, 1, p).value, std::hypot(0.2, 0.3), 1e-12);
  EXPECT_EQ(facet_distance(lists, 0, p).value, facet_distance(facets, std::array{10u}, p).value);
}

/// A room whose walls are planes: the least height above them inside it, the distance to the facets outside.
TEST(Facets, OfConvexSpaceArePlanes) {
  const Vector3 half(0.3, 0.2, 0.1);
  std::vector<Triangle> inward = kBoxTriangles;
  for (Triangle& t : inward) std::swap(t[1], t[2]);
  const auto facets = facets_of(box_vertices(half), inward);
  std::vector<std::uint32_t> numbers = {0, 2, 4, 6, 8, 10, 1, 3, 5, 7, 9, 11};
  const std::vector<format::FacetSet> sets = {{0, 12, 6}, {0, 12, 2}};
  test::Random random(4);
  int inside = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vector3 p = random.in_cube(0.5);
    const ValueAndGradient g = facet_distance({facets, sets, numbers}, 0, p);
    const ValueAndGradient by_facets = facet_distance(facets, all(12), p);
    ASSERT_NEAR(g.value, -box_distance(half, p), 1e-12) << p.transpose();
    ASSERT_LE((g.gradient - by_facets.gradient).norm(), 1e-9) << p.transpose();
    if (g.value < 0.0) continue;
    ++inside;
    // only the planes of the first part count: those of the faces at -z and +z
    const double above_two = facet_distance({facets, sets, numbers}, 1, p).value;
    ASSERT_NEAR(above_two, 0.1 - std::fabs(p.z()), 1e-12);
  }
  EXPECT_GT(inside, 150);
}

}  // namespace
}  // namespace godobject
