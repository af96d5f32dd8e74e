#include "toolchain/scene_compiler/mesh/mesh_import.h"

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include <assimp/scene.h>
#include <fmt/format.h>
#include <assimp/Importer.hpp>

#include "toolchain/command_line/failure.h"
#include "toolchain/files/input_file.h"
#include "toolchain/scene_compiler/mesh/ply_reader.h"
#include "toolchain/scene_compiler/mesh/polygon.h"

namespace godobject::scene_compiler {
namespace {

std::string lower_extension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

void check_readable(const std::filesystem::path& file, const std::string& extension) {
  if (extension != ".ply" && extension != ".stl" && extension != ".obj") {
    throw command::Failure(
        command::ExitCode::kBadData,
        fmt::format("{}: has no name of a PLY, STL or OBJ file; export the mesh as one of them", file.string()));
  }
  files::require_regular_input(file, "check `mesh` in the scene file: the path is relative to that file");
  if (std::filesystem::file_size(file) > kMaxMeshBytes) {
    throw command::Failure(command::ExitCode::kBadData,
                           fmt::format("{}: is larger than {} GiB; decimate the mesh, or export it as binary PLY",
                                       file.string(), kMaxMeshBytes >> 30));
  }
  std::ifstream stream(file, std::ios::binary);
  if (stream.peek() == std::ifstream::traits_type::eof()) {
    throw command::Failure(command::ExitCode::kBadData,
                           fmt::format("{}: the file is empty; export the mesh again", file.string()));
  }
}

/// Joins the meshes of the scene, which the importer splits by material and group, and cuts polygons into triangles.
/// The importer's own steps for that crash on indices out of range, which it accepts.
TriangleMesh gather(const aiScene& scene, MeshReport& report) {
  TriangleMesh all;
  std::vector<std::uint32_t> corners;
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& mesh = *scene.mMeshes[m];
    const auto first = static_cast<std::uint32_t>(all.vertices.size());
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      const aiVector3D& p = mesh.mVertices[v];
      all.vertices.emplace_back(static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z));
    }
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      corners.clear();
      for (unsigned i = 0; i < face.mNumIndices; ++i) {
        if (face.mIndices[i] >= mesh.mNumVertices) {
          throw std::runtime_error(
              fmt::format("face {} refers to vertex {}, but there are {}", f, face.mIndices[i], mesh.mNumVertices));
        }
        corners.push_back(first + face.mIndices[i]);
      }
      if (corners.size() > 3) ++report.polygons;
      if (corners.size() < 3) ++report.lines_and_points;
      if (corners.size() >= 3) triangulate(all.vertices, corners, all.triangles);
    }
    report.file_vertices += mesh.mNumVertices;
    report.file_faces += mesh.mNumFaces;
  }
  return all;
}

TriangleMesh read_with_assimp(const std::filesystem::path& file, MeshReport& report) {
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(file.string(), 0);
  if (scene == nullptr) throw std::runtime_error(importer.GetErrorString());
  return gather(*scene, report);
}

}  // namespace

TriangleMesh import_mesh(const std::filesystem::path& file, double scale, MeshReport& report) {
  const std::string extension = lower_extension(file);
  check_readable(file, extension);
  TriangleMesh mesh;
  try {
    // assimp 5.2 silently misreads some binary PLY files, so they have a reader of their own
    mesh = extension == ".ply" ? read_ply(file, report) : read_with_assimp(file, report);
  } catch (const std::exception& error) {
    throw command::Failure(
        command::ExitCode::kBadData,
        fmt::format("{}: not a readable mesh ({}); export it again as binary PLY or STL", file.string(), error.what()));
  }
  for (Eigen::Vector3d& v : mesh.vertices) v *= scale;
  return clean_mesh(std::move(mesh), file.string(), report);
}

}  // namespace godobject::scene_compiler
