#include "toolchain/scene_compiler/mesh_import.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <sstream>

#include <assimp/Importer.hpp>
#include <assimp/scene.h>
#include <fmt/format.h>

#include "toolchain/scene_compiler/failure.h"
#include "toolchain/scene_compiler/polygon.h"

namespace godobject::scene_compiler {
namespace {

std::string lower_extension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

/// Faces that a PLY header announces; 0 if it says nothing. The importer takes a file that ends early for a smaller mesh.
std::uint64_t announced_ply_faces(std::ifstream& file) {
  std::string line;
  for (int i = 0; i < 1000 && std::getline(file, line); ++i) {
    std::istringstream words(line);
    std::string keyword;
    std::string name;
    std::uint64_t count = 0;
    words >> keyword;
    if (keyword == "end_header") break;
    if (keyword == "element" && words >> name >> count && name == "face") return count;
  }
  return 0;
}

void check_readable(const std::filesystem::path& file, std::uint64_t& announced_faces) {
  const std::string extension = lower_extension(file);
  if (extension != ".ply" && extension != ".stl" && extension != ".obj") {
    throw Failure(ExitCode::kBadData,
                  fmt::format("{}: not a PLY, STL or OBJ file by its name; export the mesh as one of them", file.string()));
  }
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) {
    throw Failure(ExitCode::kNoInput, fmt::format("{}: no such file; check `mesh` in the scene file", file.string()));
  }
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw Failure(ExitCode::kNoInput, fmt::format("{}: cannot be opened; check its permissions", file.string()));
  if (stream.peek() == std::ifstream::traits_type::eof()) {
    throw Failure(ExitCode::kBadData, fmt::format("{}: the file is empty; export the mesh again", file.string()));
  }
  announced_faces = extension == ".ply" ? announced_ply_faces(stream) : 0;
}

/// All meshes of the scene as one (the importer splits a file by material and group), polygons cut into triangles. The
/// importer's own step for that is not used: it crashes on some meshes of triangles.
TriangleMesh gather(const aiScene& scene, double scale, MeshReport& report) {
  TriangleMesh all;
  std::vector<std::uint32_t> corners;
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& mesh = *scene.mMeshes[m];
    const auto first = static_cast<std::uint32_t>(all.vertices.size());
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      const aiVector3D& p = mesh.mVertices[v];
      all.vertices.emplace_back(scale * static_cast<double>(p.x), scale * static_cast<double>(p.y),
                                scale * static_cast<double>(p.z));
    }
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      corners.clear();
      for (unsigned i = 0; i < face.mNumIndices; ++i) {
        if (face.mIndices[i] >= mesh.mNumVertices) {
          throw std::runtime_error(fmt::format("face {} names vertex {} of {}", f, face.mIndices[i], mesh.mNumVertices));
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

}  // namespace

TriangleMesh import_mesh(const std::filesystem::path& file, double scale, MeshReport& report) {
  std::uint64_t announced_faces = 0;
  check_readable(file, announced_faces);
  if (announced_faces > kMaxTriangles) {
    throw Failure(ExitCode::kBadData, fmt::format("{}: {} faces are more than the limit of {}; decimate the mesh", file.string(),
                                                  announced_faces, kMaxTriangles));
  }
  Assimp::Importer importer;
  TriangleMesh mesh;
  const auto unreadable = [&](const std::string& why) {
    return Failure(ExitCode::kBadData,
                   fmt::format("{}: not a readable mesh ({}); export it again as binary PLY or STL", file.string(), why));
  };
  try {
    const aiScene* scene = importer.ReadFile(file.string(), 0);
    if (scene == nullptr) throw unreadable(importer.GetErrorString());
    mesh = gather(*scene, scale, report);
    if (report.file_faces < announced_faces) {
      throw unreadable(fmt::format("{} of the {} announced faces are there", report.file_faces, announced_faces));
    }
  } catch (const Failure&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw unreadable("it asks for more memory than there is");
  } catch (const std::exception& error) {
    throw unreadable(error.what());
  }
  return clean_mesh(std::move(mesh), file.string(), report);
}

}  // namespace godobject::scene_compiler
