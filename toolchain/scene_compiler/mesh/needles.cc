#include "toolchain/scene_compiler/mesh/needles.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "toolchain/scene_compiler/mesh/triangle_geometry.h"

namespace godobject::scene_compiler {
namespace {

using Eigen::Vector3d;
using Triangle = std::array<std::uint32_t, 3>;

bool has(const Triangle& triangle, std::uint32_t vertex) {
  return std::find(triangle.begin(), triangle.end(), vertex) != triangle.end();
}

/// The triangles about each vertex, while needles go.
class Needles {
 public:
  Needles(TriangleMesh& mesh, double flat)
      : mesh_(mesh),
        flat_(flat),
        longest_(std::numbers::sqrt2 * flat),
        about_(mesh.vertices.size()),
        pulled_(mesh.vertices.size()) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      for (const std::uint32_t v : mesh.triangles[t]) about_[v].push_back(t);
    }
  }

  std::vector<bool> collapse() {
    for (bool any = true; any;) {  // a pull may make needles of the triangles about it
      any = false;
      for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) any = collapse_triangle(t) || any;
    }
    std::erase_if(mesh_.triangles, is_gone);
    std::vector<bool> pulled_to(pulled_.size());
    for (std::size_t v = 0; v < pulled_to.size(); ++v) pulled_to[v] = !pulled_[v].empty();
    return pulled_to;
  }

 private:
  static bool is_gone(const Triangle& t) { return t[0] == t[1]; }

  bool collapse_triangle(std::size_t number) {
    const Triangle triangle = mesh_.triangles[number];
    if (is_gone(triangle)) return false;
    const Vector3d& a = mesh_.vertices[triangle[0]];
    const Vector3d& b = mesh_.vertices[triangle[1]];
    const Vector3d& c = mesh_.vertices[triangle[2]];
    const double side[3] = {(b - a).norm(), (c - b).norm(), (a - c).norm()};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      if (side[k] > longest_ || is_higher(a, b, c, flat_)) continue;
      if (pull(triangle[k], triangle[next]) || pull(triangle[next], triangle[k])) return true;
    }
    return false;
  }

  bool pull(std::uint32_t from, std::uint32_t to) {
    const auto is_far = [&](auto v) { return (mesh_.vertices[v] - mesh_.vertices[to]).norm() > longest_; };
    if (is_far(from) || std::any_of(pulled_[from].begin(), pulled_[from].end(), is_far)) return false;
    if (joins_the_surface(from, to)) return false;

    pulled_[to].push_back(from);
    const std::vector<std::uint32_t> with_it = std::exchange(pulled_[from], {});
    pulled_[to].insert(pulled_[to].end(), with_it.begin(), with_it.end());
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

  /// True if an edge would get more triangles than the two that it had, or two triangles the same vertices.
  bool joins_the_surface(std::uint32_t from, std::uint32_t to) const {
    std::vector<std::uint32_t> opposite;
    for (const std::uint32_t t : about_[from]) {
      if (!has(mesh_.triangles[t], to)) continue;
      for (const std::uint32_t v : mesh_.triangles[t]) {
        if (v != from && v != to) opposite.push_back(v);
      }
    }
    make_set(opposite);
    const std::vector<std::uint32_t> of_from = neighbours(from);
    const std::vector<std::uint32_t> of_to = neighbours(to);
    std::vector<std::uint32_t> common;
    std::set_intersection(of_from.begin(), of_from.end(), of_to.begin(), of_to.end(), std::back_inserter(common));
    if (common != opposite) return true;
    const auto beside = [&](std::uint32_t vertex) {  // triangles of which only this vertex is not common
      std::vector<std::array<std::uint32_t, 2>> sides;
      for (const std::uint32_t t : about_[vertex]) {
        std::vector<std::uint32_t> others;
        for (const std::uint32_t v : mesh_.triangles[t]) {
          if (std::binary_search(common.begin(), common.end(), v)) others.push_back(v);
        }
        if (others.size() == 2) sides.push_back({std::min(others[0], others[1]), std::max(others[0], others[1])});
      }
      return sides;
    };
    const auto of_target = beside(to);
    const auto sides = beside(from);
    return std::any_of(sides.begin(), sides.end(), [&](const auto& s) {
      return std::find(of_target.begin(), of_target.end(), s) != of_target.end();
    });
  }

  static void make_set(std::vector<std::uint32_t>& numbers) {
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  }

  /// Returns the vertices that share a triangle with this one, ascending.
  std::vector<std::uint32_t> neighbours(std::uint32_t vertex) const {
    std::vector<std::uint32_t> found;
    for (const std::uint32_t t : about_[vertex]) {
      for (const std::uint32_t v : mesh_.triangles[t]) {
        if (v != vertex) found.push_back(v);
      }
    }
    make_set(found);
    return found;
  }

  TriangleMesh& mesh_;
  double flat_;
  double longest_;  ///< side of a needle
  std::vector<std::vector<std::uint32_t>> about_;
  std::vector<std::vector<std::uint32_t>> pulled_;  ///< to each vertex: the vertices that it stands for
};

}  // namespace

std::vector<bool> collapse_needles(TriangleMesh& mesh, double flat) { return Needles(mesh, flat).collapse(); }

}  // namespace godobject::scene_compiler
