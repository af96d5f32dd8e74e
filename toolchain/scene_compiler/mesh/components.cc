#include "toolchain/scene_compiler/mesh/components.h"

#include <numeric>

namespace godobject::scene_compiler {

Components connected_components(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> parent(mesh.vertices.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const auto& t : mesh.triangles) {
    parent[root(t[1])] = root(t[0]);
    parent[root(t[2])] = root(t[0]);
  }
  constexpr std::uint32_t kUnnumbered = ~0u;
  std::vector<std::uint32_t> number(mesh.vertices.size(), kUnnumbered);
  Components components;
  components.of_triangle.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    std::uint32_t& n = number[root(t[0])];
    if (n == kUnnumbered) n = components.count++;
    components.of_triangle.push_back(n);
  }
  return components;
}

}  // namespace godobject::scene_compiler
