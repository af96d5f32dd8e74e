#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

#include "tests/scene_compiler/simple_meshes.h"
#include "toolchain/scene_compiler/mesh/mesh_import.h"

namespace godobject::scene_compiler {

/// Returns the file of one of the project's meshes.
inline std::filesystem::path mesh_file(const std::string& name) {
  return std::filesystem::path(GODOBJECT_MESH_FOLDER) / (name + ".ply");
}

inline TriangleMesh load(const std::string& name, double scale) {
  MeshReport report;
  return import_mesh(mesh_file(name), scale, report);
}

/// A folder of this test. The destructor removes it.
class ScratchFolder {
 public:
  ScratchFolder() : path_(std::filesystem::temp_directory_path() / ("godobject_test_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~ScratchFolder() { std::filesystem::remove_all(path_); }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }
  std::filesystem::path file(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

/// Returns a box from `low` to `high` with outward triangles. `faces`: which of -x, +x, -y, +y, -z, +z exist.
inline TriangleMesh box(const Eigen::Vector3d& low, const Eigen::Vector3d& high,
                        const std::array<bool, 6>& faces = {true, true, true, true, true, true}) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.emplace_back((i & 1) != 0 ? high.x() : low.x(), (i & 2) != 0 ? high.y() : low.y(),
                               (i & 4) != 0 ? high.z() : low.z());
  }
  constexpr std::array<std::array<std::uint32_t, 4>, 6> kQuads = {
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  for (std::size_t f = 0; f < 6; ++f) {
    if (!faces[f]) continue;
    const auto& q = kQuads[f];
    mesh.triangles.push_back({q[0], q[1], q[2]});
    mesh.triangles.push_back({q[0], q[2], q[3]});
  }
  return mesh;
}

/// Returns both meshes as one, with separate vertices.
inline TriangleMesh joined(TriangleMesh a, const TriangleMesh& b) {
  const auto first = static_cast<std::uint32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& t : b.triangles) a.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  return a;
}

inline TriangleMesh turned_inside_out(TriangleMesh mesh) {
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

/// A cone with many faces on the plane z = 0: its apex is vertex 0, the middle of its ground vertex 1.
inline TriangleMesh cone_mesh(double radius, double height, std::uint32_t faces) {
  TriangleMesh cone;
  cone.vertices = {{0, 0, height}, {0, 0, 0}};
  for (std::uint32_t i = 0; i < faces; ++i) {
    const double angle = 2.0 * M_PI * i / faces;
    cone.vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0);
    const std::uint32_t here = 2 + i;
    const std::uint32_t next = 2 + (i + 1) % faces;
    cone.triangles.push_back({0, here, next});
    cone.triangles.push_back({1, next, here});
  }
  return cone;
}

/// A block with a box-shaped cavity inside.
inline TriangleMesh hollow_block(const Eigen::Vector3d& block, const Eigen::Vector3d& cavity) {
  return joined(test::box_mesh(block), turned_inside_out(test::box_mesh(cavity)));
}

}  // namespace godobject::scene_compiler
