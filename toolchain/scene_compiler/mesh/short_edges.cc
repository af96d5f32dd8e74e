#include "toolchain/scene_compiler/mesh/short_edges.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

namespace godobject::scene_compiler {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

bool has(const Triangle& triangle, std::uint32_t vertex) {
  return std::find(triangle.begin(), triangle.end(), vertex) != triangle.end();
}

/// The triangles about each vertex, while edges collapse.
class ShortEdges {
 public:
  ShortEdges(TriangleMesh& mesh, double longest)
      : mesh_(mesh), longest_(longest), about_(mesh.vertices.size()), pulled_(mesh.vertices.size()) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      for (const std::uint32_t v : mesh.triangles[t]) about_[v].push_back(t);
    }
  }

  void collapse() {
    for (const Triangle& given : std::vector<Triangle>(mesh_.triangles)) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = given[k];
        const std::uint32_t b = given[(k + 1) % 3];
        if (joined(a, b) && !collapse(a, b)) collapse(b, a);
      }
    }
    std::erase_if(mesh_.triangles, [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
  }

 private:
  /// True if a triangle still has both vertices.
  bool joined(std::uint32_t a, std::uint32_t b) const {
    return std::any_of(about_[a].begin(), about_[a].end(), [&](auto t) { return has(mesh_.triangles[t], b); });
  }

  bool collapse(std::uint32_t from, std::uint32_t to) {
    const auto is_far = [&](auto v) { return (mesh_.vertices[v] - mesh_.vertices[to]).norm() > longest_; };
    if (is_far(from) || std::any_of(pulled_[from].begin(), pulled_[from].end(), is_far)) return false;
    std::size_t shared = 0;
    for (const std::uint32_t t : about_[from]) shared += has(mesh_.triangles[t], to) ? 1u : 0u;
    // with another common neighbour an edge would get more than two triangles
    const std::vector<std::uint32_t> of_from = neighbours(from);
    const std::vector<std::uint32_t> of_to = neighbours(to);
    std::vector<std::uint32_t> common;
    std::set_intersection(of_from.begin(), of_from.end(), of_to.begin(), of_to.end(), std::back_inserter(common));
    if (common.size() != shared) return false;

    pulled_[to].push_back(from);
    pulled_[to].insert(pulled_[to].end(), pulled_[from].begin(), pulled_[from].end());
    for (const std::uint32_t t : std::exchange(about_[from], {})) {
      Triangle& triangle = mesh_.triangles[t];
      if (has(triangle, to)) {
        for (const std::uint32_t v : triangle) std::erase(about_[v], t);
        triangle = {to, to, to};
      } else {
        *std::find(triangle.begin(), triangle.end(), from) = to;
        about_[to].push_back(t);
      }
    }
    return true;
  }

  /// Returns the vertices that share a triangle with this one, ascending.
  std::vector<std::uint32_t> neighbours(std::uint32_t vertex) const {
    std::vector<std::uint32_t> found;
    for (const std::uint32_t t : about_[vertex]) {
      for (const std::uint32_t v : mesh_.triangles[t]) {
        if (v != vertex) found.push_back(v);
      }
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

  TriangleMesh& mesh_;
  double longest_;
  std::vector<std::vector<std::uint32_t>> about_;
  std::vector<std::vector<std::uint32_t>> pulled_;  ///< to each vertex: the vertices that it stands for
};

}  // namespace

void collapse_short_edges(TriangleMesh& mesh, double longest) { ShortEdges(mesh, longest).collapse(); }

}  // namespace godobject::scene_compiler
