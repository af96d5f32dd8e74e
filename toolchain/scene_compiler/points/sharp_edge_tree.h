#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "core/scene/format.h"
#include "toolchain/scene_compiler/mesh/body_mesh.h"

namespace godobject::scene_compiler {

/// The convex sharp edges of one body as the image stores them.
struct SharpEdgeTree {
  std::vector<format::SharpEdge> edges;  ///< in tree order
  std::vector<format::Node> nodes;       ///< pre-order
  std::uint32_t left_out = 0;            ///< the least sharp edges beyond format::kMaxSharpEdges
};

/// Returns the sharp edges of a body with their sphere tree, moved by X. Each node is split in the middle of its longer
/// axis. Deterministic.
SharpEdgeTree make_sharp_edges(const BodyMesh& body, const Eigen::Isometry3d& X);

/// Returns the ends of the edges [m].
std::vector<Eigen::Vector3d> ends_of(const SharpEdgeTree& tree);

}  // namespace godobject::scene_compiler
