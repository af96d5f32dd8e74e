#pragma once

#include <cmath>
#include <cstdint>
#include <iomanip>
#include <numbers>
#include <sstream>
#include <string>

#include <Eigen/Geometry>

#include "toolchain/scene_compiler/mesh/solid_surface.h"
#include "toolchain/scene_compiler/mesh/triangle_mesh.h"

/// Meshes with properties that are known by hand calculation. Counter-clockwise seen from outside; metres.
namespace godobject::test {

using scene_compiler::TriangleMesh;

/// A mesh, how it becomes a surface, and by how much that is dilated [m].
struct BodyOfMesh {
  TriangleMesh mesh;
  scene_compiler::SurfaceKind kind = scene_compiler::SurfaceKind::kAuto;
  double dilation = 0.0;
};

/// A box from `low` to `low + edges`: 8 vertices, 12 triangles.
inline TriangleMesh box_mesh(const Eigen::Vector3d& edges, const Eigen::Vector3d& low) {
  TriangleMesh mesh;
  for (unsigned i = 0; i < 8; ++i) {
    const Eigen::Vector3d corner(i & 1u, (i >> 1) & 1u, (i >> 2) & 1u);
    mesh.vertices.push_back(low + corner.cwiseProduct(edges));
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

/// A box about the origin.
inline TriangleMesh box_mesh(const Eigen::Vector3d& edges) { return box_mesh(edges, -0.5 * edges); }

/// A ball about the origin, `rings` x 2 `rings` facets with vertices on the sphere.
inline TriangleMesh ball_mesh(double radius, std::uint32_t rings) {
  TriangleMesh mesh;
  const std::uint32_t around = 2 * rings;
  mesh.vertices.emplace_back(0.0, 0.0, radius);
  for (std::uint32_t i = 1; i < rings; ++i) {
    const double polar = std::numbers::pi * i / rings;
    for (std::uint32_t j = 0; j < around; ++j) {
      const double azimuth = 2.0 * std::numbers::pi * j / around;
      mesh.vertices.emplace_back(radius * std::sin(polar) * std::cos(azimuth),
                                 radius * std::sin(polar) * std::sin(azimuth), radius * std::cos(polar));
    }
  }
  mesh.vertices.emplace_back(0.0, 0.0, -radius);
  const auto bottom = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  const auto at = [around](std::uint32_t ring, std::uint32_t j) { return 1 + (ring - 1) * around + j % around; };
  for (std::uint32_t j = 0; j < around; ++j) {
    mesh.triangles.push_back({0, at(1, j), at(1, j + 1)});
    for (std::uint32_t i = 1; i + 1 < rings; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
    mesh.triangles.push_back({at(rings - 1, j), bottom, at(rings - 1, j + 1)});
  }
  return mesh;
}

/// Returns the mesh, moved by `by`, as an OBJ file. Its numbers are read in single precision.
inline std::string obj_text(const TriangleMesh& mesh, const Eigen::Vector3d& by = Eigen::Vector3d::Zero()) {
  std::ostringstream text;
  text << std::setprecision(9);
  for (const Eigen::Vector3d& vertex : mesh.vertices) text << "v " << (vertex + by).transpose() << "\n";
  for (const auto& t : mesh.triangles) text << "f " << t[0] + 1 << " " << t[1] + 1 << " " << t[2] + 1 << "\n";
  return text.str();
}

/// An open square sheet in the plane z = 0 about the origin, normal +z: 2 triangles.
inline TriangleMesh sheet_mesh(double edge) {
  const double half = 0.5 * edge;
  return {{{-half, -half, 0.0}, {half, -half, 0.0}, {half, half, 0.0}, {-half, half, 0.0}}, {{0, 1, 2}, {0, 2, 3}}};
}

/// A closed needle along x: apex at the origin, a base of 16 corners of `radius` at x = `length`.
inline TriangleMesh needle_mesh(double length, double radius) {
  constexpr std::uint32_t kAround = 16;
  TriangleMesh mesh;
  mesh.vertices = {Eigen::Vector3d::Zero(), {length, 0.0, 0.0}};
  for (std::uint32_t j = 0; j < kAround; ++j) {
    const double angle = 2.0 * std::numbers::pi * j / kAround;
    mesh.vertices.emplace_back(length, radius * std::cos(angle), radius * std::sin(angle));
  }
  for (std::uint32_t j = 0; j < kAround; ++j) {
    const std::uint32_t a = 2 + j;
    const std::uint32_t b = 2 + (j + 1) % kAround;
    mesh.triangles.push_back({0, b, a});
    mesh.triangles.push_back({1, a, b});
  }
  return mesh;
}

/// Both meshes as one, as separate components.
inline TriangleMesh joined(TriangleMesh mesh, const TriangleMesh& other) {
  const auto offset = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& t : other.triangles) mesh.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  return mesh;
}

inline TriangleMesh moved(TriangleMesh mesh, const Eigen::Isometry3d& motion) {
  for (Eigen::Vector3d& vertex : mesh.vertices) vertex = motion * vertex;
  return mesh;
}

inline TriangleMesh inside_out(TriangleMesh mesh) {
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

/// A rotation and translation without any symmetry.
inline Eigen::Isometry3d odd_motion() {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.rotate(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1.0, -2.0, 0.5).normalized()));
  motion.pretranslate(Eigen::Vector3d(0.11, -0.23, 0.37));
  return motion;
}

}  // namespace godobject::test
