#include "toolchain/scene_compiler/mesh/mesh_edges.h"

#include <algorithm>
#include <tuple>

namespace godobject::scene_compiler {

MeshEdges::MeshEdges(const TriangleMesh& mesh) {
  struct HalfEdge {
    std::uint32_t low, high;
    Side side;
  };
  std::vector<HalfEdge> halves;
  halves.reserve(3 * mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& corners = mesh.triangles[t];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t from = corners[i];
      const std::uint32_t to = corners[(i + 1) % 3];
      halves.push_back({std::min(from, to), std::max(from, to), {t, corners[(i + 2) % 3], from < to}});
    }
  }
  std::sort(halves.begin(), halves.end(), [](const HalfEdge& a, const HalfEdge& b) {
    return std::tie(a.low, a.high, a.side.triangle) < std::tie(b.low, b.high, b.side.triangle);
  });
  sides_.reserve(halves.size());
  for (const HalfEdge& half : halves) {
    if (edges_.empty() || edges_.back().low != half.low || edges_.back().high != half.high) {
      edges_.push_back({half.low, half.high, static_cast<std::uint32_t>(sides_.size()), 0});
    }
    ++edges_.back().side_count;
    sides_.push_back(half.side);
  }
}

bool MeshEdges::closed() const {
  return std::all_of(edges_.begin(), edges_.end(), [this](const Edge& edge) {
    return edge.side_count == 2 && sides(edge)[0].forward != sides(edge)[1].forward;
  });
}

}  // namespace godobject::scene_compiler
