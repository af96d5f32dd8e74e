#include "toolchain/scene_compiler/mesh/orientation.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Geometry>

#include "toolchain/scene_compiler/mesh/triangle_geometry.h"

namespace godobject::scene_compiler {
namespace {

constexpr std::uint32_t kNone = ~0u;

/// A triangle across an edge. `disagrees`: both run along the edge in the same direction.
struct Neighbour {
  std::uint32_t triangle = kNone;
  bool disagrees = false;
};

using Neighbours = std::vector<std::array<Neighbour, 3>>;

Neighbours neighbours_of(const TriangleMesh& mesh, const MeshEdges& edges) {
  Neighbours neighbours(mesh.triangles.size());
  const auto add = [&neighbours](std::uint32_t triangle, const Neighbour& neighbour) {
    auto& all = neighbours[triangle];
    *std::find_if(all.begin(), all.end(), [](const Neighbour& n) { return n.triangle == kNone; }) = neighbour;
  };
  for (const MeshEdges::Edge& edge : edges.all()) {
    const auto sides = edges.sides(edge);
    if (sides.size() != 2) continue;
    const bool disagree = sides[0].forward == sides[1].forward;
    add(sides[0].triangle, {sides[1].triangle, disagree});
    add(sides[1].triangle, {sides[0].triangle, disagree});
  }
  return neighbours;
}

/// The triangles of one patch, and which of them have the other sense than the first.
struct Patch {
  std::vector<std::uint32_t> triangles;
  bool two_sided = true;
};

/// Collects the patch of the triangle `first` and sets `other_sense` of its triangles.
Patch patch_of(std::uint32_t first, const Neighbours& neighbours, std::vector<bool>& seen,
               std::vector<bool>& other_sense) {
  Patch patch;
  patch.triangles.push_back(first);
  seen[first] = true;
  for (std::size_t i = 0; i < patch.triangles.size(); ++i) {
    const std::uint32_t triangle = patch.triangles[i];
    for (const Neighbour& neighbour : neighbours[triangle]) {
      if (neighbour.triangle == kNone) continue;
      const bool sense = other_sense[triangle] != neighbour.disagrees;
      if (seen[neighbour.triangle]) {
        patch.two_sided = patch.two_sided && other_sense[neighbour.triangle] == sense;
        continue;
      }
      seen[neighbour.triangle] = true;
      other_sense[neighbour.triangle] = sense;
      patch.triangles.push_back(neighbour.triangle);
    }
  }
  return patch;
}

double area_of(const TriangleMesh& mesh, std::uint32_t triangle) {
  const auto& t = mesh.triangles[triangle];
  return triangle_area(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]);
}

}  // namespace

std::uint64_t agree_on_sense(TriangleMesh& mesh, const MeshEdges& edges) {
  const Neighbours neighbours = neighbours_of(mesh, edges);
  std::vector<bool> seen(mesh.triangles.size());
  std::vector<bool> other_sense(mesh.triangles.size());
  std::uint64_t turned = 0;
  for (std::uint32_t first = 0; first < mesh.triangles.size(); ++first) {
    if (seen[first]) continue;
    const Patch patch = patch_of(first, neighbours, seen, other_sense);
    if (!patch.two_sided) continue;
    std::array<double, 2> area{};
    for (const std::uint32_t triangle : patch.triangles) area[other_sense[triangle] ? 1 : 0] += area_of(mesh, triangle);
    const bool turn_others = area[0] >= area[1];
    for (const std::uint32_t triangle : patch.triangles) {
      if (other_sense[triangle] != turn_others) continue;
      std::swap(mesh.triangles[triangle][1], mesh.triangles[triangle][2]);
      ++turned;
    }
  }
  return turned;
}

}  // namespace godobject::scene_compiler
