#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "toolchain/files/scene_image.h"
#include "toolchain/precision/mesh_overlap.h"
#include "toolchain/scene_compiler/mesh/triangle_mesh.h"

namespace godobject::report {

/// Two parts that fit into each other: their scene image, and their meshes for everything that is exact.
struct Pair {
  files::SceneImage image;
  precision::MeshOverlap overlap;       ///< too small by at most a fifth of the accuracy
  scene_compiler::TriangleMesh still;   ///< in W [m]
  scene_compiler::TriangleMesh moving;  ///< in M [m]
  double accuracy = 0.0;                ///< of the scene file [m]
};

/// Returns the pair of a scene file with an `accuracy`. Its image is compiled once and stored in `kept`, which must
/// exist, for all cases and runs of this program. Throws Failure.
std::unique_ptr<Pair> read_pair(const std::filesystem::path& scene_file, const std::filesystem::path& kept);

/// Returns all inputs of a pair as text: the scene file and digests of its meshes. Throws Failure (kNoInput).
std::string inputs_of_pair(const std::filesystem::path& scene_file);

}  // namespace godobject::report
