#include "toolchain/scene_compiler/mesh/slits.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "toolchain/scene_compiler/mesh/mesh_edges.h"

namespace godobject::scene_compiler {
namespace {

using Eigen::Vector3d;

constexpr std::uint64_t key(std::uint32_t a, std::uint32_t b) {
  return (std::uint64_t{std::min(a, b)} << 32) | std::max(a, b);
}

/// The edges that have one triangle, while slits are closed.
class Slits {
 public:
  Slits(TriangleMesh& mesh, double tolerance) : mesh_(mesh), tolerance_(tolerance) {
    const MeshEdges edges(mesh);
    for (const MeshEdges::Edge& edge : edges.all()) {
      const auto sides = edges.sides(edge);
      if (sides.size() == 1) open(edge.low, edge.high, sides[0].triangle);
    }
    for (const MeshEdges::Edge& edge : edges.all()) {
      const bool is_shut = edges.sides(edge).size() > 1 && beside_.contains(edge.low) && beside_.contains(edge.high);
      if (is_shut) shut_.insert(key(edge.low, edge.high));
    }
  }

  std::uint64_t close() {
    std::uint64_t cuts = 0;
    while (!to_do_.empty()) {
      const auto [a, b] = to_do_.back();
      to_do_.pop_back();
      const auto found = triangle_of_.find(key(a, b));
      if (found == triangle_of_.end()) continue;
      const std::uint32_t t = found->second;
      const std::optional<std::uint32_t> x = vertex_on(a, b, t);
      if (!x) continue;
      cut(t, a, b, *x);
      ++cuts;
    }
    return cuts;
  }

 private:
  using Ends = std::pair<std::uint32_t, std::uint32_t>;

  /// Returns the vertex on the edge a b of the triangle that an open edge joins to one of its ends; nothing if there is
  /// none.
  std::optional<std::uint32_t> vertex_on(std::uint32_t a, std::uint32_t b, std::uint32_t triangle) const {
    const auto& corners = mesh_.triangles[triangle];
    for (const std::uint32_t end : {a, b}) {
      for (const std::uint32_t x : beside_.at(end)) {
        if (std::find(corners.begin(), corners.end(), x) == corners.end() && lies_on(x, a, b) &&
            can_cut(triangle, x, a, b))
          return x;
      }
    }
    return {};
  }

  bool lies_on(std::uint32_t x, std::uint32_t a, std::uint32_t b) const {
    const Vector3d along = mesh_.vertices[b] - mesh_.vertices[a];
    const Vector3d from = mesh_.vertices[x] - mesh_.vertices[a];
    const double length = along.norm();
    const double at = from.dot(along) / length;
    return at > tolerance_ && at < length - tolerance_ && (from - at / length * along).norm() <= tolerance_;
  }

  /// False if a cut would turn or flatten a piece of a thin triangle, or give an edge a third triangle.
  bool can_cut(std::uint32_t triangle, std::uint32_t x, std::uint32_t a, std::uint32_t b) const {
    constexpr double kLeast = 0.1;  // of the piece's share of the triangle
    const auto& t = mesh_.triangles[triangle];
    const std::uint32_t opposite = *std::find_if(t.begin(), t.end(), [&](auto v) { return v != a && v != b; });
    if (shut_.contains(key(a, x)) || shut_.contains(key(x, b)) || shut_.contains(key(x, opposite))) return false;
    const auto area = [&](std::uint32_t from, std::uint32_t to) -> Vector3d {
      const Vector3d& o = mesh_.vertices[opposite];
      return (mesh_.vertices[from] - o).cross(mesh_.vertices[to] - o);
    };
    const Vector3d whole = area(a, b);
    const double length = (mesh_.vertices[b] - mesh_.vertices[a]).norm();
    const auto keeps = [&](std::uint32_t from, std::uint32_t to) {
      const double share = (mesh_.vertices[to] - mesh_.vertices[from]).norm() / length;
      return area(from, to).dot(whole) > kLeast * share * whole.squaredNorm();
    };
    return keeps(a, x) && keeps(x, b);
  }

  void cut(std::uint32_t triangle, std::uint32_t a, std::uint32_t b, std::uint32_t x) {
    auto& t = mesh_.triangles[triangle];
    std::size_t i = 0;
    while (key(t[i], t[(i + 1) % 3]) != key(a, b)) ++i;
    const std::uint32_t from = t[i];
    const std::uint32_t to = t[(i + 1) % 3];
    const std::uint32_t opposite = t[(i + 2) % 3];
    t = {from, x, opposite};
    const auto rest = static_cast<std::uint32_t>(mesh_.triangles.size());
    mesh_.triangles.push_back({x, to, opposite});
    shut(from, to);
    if (const auto moved = triangle_of_.find(key(to, opposite)); moved != triangle_of_.end()) moved->second = rest;
    join(from, x, triangle);
    join(x, to, rest);
  }

  /// Adds the edge of a new triangle: the second one of an open edge closes it.
  void join(std::uint32_t a, std::uint32_t b, std::uint32_t triangle) {
    if (triangle_of_.contains(key(a, b))) {
      shut(a, b);
      shut_.insert(key(a, b));
    } else {
      open(a, b, triangle);
    }
  }

  void open(std::uint32_t a, std::uint32_t b, std::uint32_t triangle) {
    triangle_of_.emplace(key(a, b), triangle);
    beside_[a].push_back(b);
    beside_[b].push_back(a);
    for (const std::uint32_t end : {a, b}) {
      for (const std::uint32_t other : beside_[end]) to_do_.emplace_back(end, other);
    }
  }

  void shut(std::uint32_t a, std::uint32_t b) {
    triangle_of_.erase(key(a, b));
    std::erase(beside_[a], b);
    std::erase(beside_[b], a);
  }

  TriangleMesh& mesh_;
  double tolerance_;
  std::unordered_map<std::uint64_t, std::uint32_t> triangle_of_;          ///< of each open edge
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> beside_;  ///< by vertex: the other ends of open edges
  std::unordered_set<std::uint64_t> shut_;  ///< edges of more than one triangle, with both ends on open edges
  std::vector<Ends> to_do_;
};

}  // namespace

std::uint64_t close_slits(TriangleMesh& mesh, double tolerance) { return Slits(mesh, tolerance).close(); }

}  // namespace godobject::scene_compiler
