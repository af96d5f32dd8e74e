#include "toolchain/scene_compiler/mesh/flat_vertices.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

namespace godobject::scene_compiler {
namespace {

using Eigen::Vector3d;
using Triangle = std::array<std::uint32_t, 3>;

/// The triangles about each vertex, while vertices are removed.
class FlatVertices {
 public:
  FlatVertices(TriangleMesh& mesh, double flat) : mesh_(mesh), flat_(flat), about_(mesh.vertices.size()) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      for (const std::uint32_t v : mesh.triangles[t]) about_[v].push_back(t);
    }
    alive_.assign(mesh.triangles.size(), true);
    off_.assign(mesh.triangles.size(), 0.0);
  }

  void remove() {
    for (bool any = true; any;) {
      any = false;
      for (std::uint32_t v = 0; v < about_.size(); ++v) any = remove(v) || any;
    }
    std::vector<Triangle> left;
    for (std::size_t t = 0; t < alive_.size(); ++t) {
      if (alive_[t]) left.push_back(mesh_.triangles[t]);
    }
    mesh_.triangles = std::move(left);
  }

 private:
  bool remove(std::uint32_t v) {
    const std::vector<std::uint32_t>& about = about_[v];
    if (about.size() < 3) return false;
    const std::vector<std::uint32_t> neighbours = neighbours_of(v);
    if (neighbours.size() != about.size()) return false;  // open, or no disc
    for (const std::uint32_t u : neighbours) {
      const std::optional<double> off = off_if_pulled(v, u);
      if (!off || *off > flat_) continue;
      pull(v, u, *off);
      return true;
    }
    return false;
  }

  std::vector<std::uint32_t> neighbours_of(std::uint32_t v) const {
    std::vector<std::uint32_t> neighbours;
    for (const std::uint32_t t : about_[v]) {
      for (const std::uint32_t u : mesh_.triangles[t]) {
        if (u != v) neighbours.push_back(u);
      }
    }
    std::sort(neighbours.begin(), neighbours.end());
    neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
    return neighbours;
  }

  bool has(std::uint32_t t, std::uint32_t v) const {
    const Triangle& corners = mesh_.triangles[t];
    return std::find(corners.begin(), corners.end(), v) != corners.end();
  }

  /// Returns how far the surface about v may be from the given one after v is pulled to u: as far as it is already, and
  /// as far as v is from the new triangles' planes. None if a new triangle faces another way than its old one, or if
  /// the surface would not stay closed.
  std::optional<double> off_if_pulled(std::uint32_t v, std::uint32_t u) const {
    std::size_t shared = 0;
    double before = 0.0;
    double height = 0.0;
    for (const std::uint32_t t : about_[v]) {
      before = std::max(before, off_[t]);
      if (has(t, u)) {
        ++shared;
        continue;
      }
      const std::optional<double> of_face = height_above(t, v, u);
      if (!of_face) return {};
      height = std::max(height, *of_face);
    }
    if (shared != 2) return {};
    // both ends of an edge must have only two neighbours in common
    const std::vector<std::uint32_t> of_v = neighbours_of(v);
    const std::vector<std::uint32_t> of_u = neighbours_of(u);
    std::vector<std::uint32_t> common;
    std::set_intersection(of_v.begin(), of_v.end(), of_u.begin(), of_u.end(), std::back_inserter(common));
    if (common.size() != 2) return {};
    return before + std::max(height, height_of_vanishing(v, u));
  }

  Vector3d area_vector(const Triangle& t) const {
    const Vector3d& a = mesh_.vertices[t[0]];
    return (mesh_.vertices[t[1]] - a).cross(mesh_.vertices[t[2]] - a);
  }

  /// Returns the height of v above the plane of a triangle after v is pulled to u; none if it turns or is a sliver.
  std::optional<double> height_above(std::uint32_t t, std::uint32_t v, std::uint32_t u) const {
    Triangle pulled = mesh_.triangles[t];
    std::replace(pulled.begin(), pulled.end(), v, u);
    const Vector3d area = area_vector(pulled);
    double longest = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      longest = std::max(longest, (mesh_.vertices[pulled[k]] - mesh_.vertices[pulled[(k + 1) % 3]]).norm());
    }
    if (area.norm() <= 2.0 * flat_ * longest) return {};
    const Vector3d normal = area.normalized();
    constexpr double kSameFace = 0.999;
    if (normal.dot(area_vector(mesh_.triangles[t]).normalized()) <= kSameFace) return {};
    return std::abs(normal.dot(mesh_.vertices[v] - mesh_.vertices[u]));
  }

  /// Returns how far the faces that vanish with the edge v u are from faces that stay: of the neighbours at v, off the
  /// edge, the one that is nearest to their plane.
  double height_of_vanishing(std::uint32_t v, std::uint32_t u) const {
    double most = 0.0;
    for (const std::uint32_t t : about_[v]) {
      if (!has(t, u)) continue;
      const Vector3d normal = area_vector(mesh_.triangles[t]).normalized();
      double least = std::numeric_limits<double>::infinity();
      for (const std::uint32_t other : about_[v]) {
        const Triangle& corners = mesh_.triangles[other];
        if (has(other, u)) continue;
        if (std::none_of(corners.begin(), corners.end(), [&](auto w) { return w != v && has(t, w); })) continue;
        double height = 0.0;
        for (const std::uint32_t w : corners) {
          height = std::max(height, std::abs(normal.dot(mesh_.vertices[w] - mesh_.vertices[v])));
        }
        least = std::min(least, height);
      }
      most = std::max(most, least);
    }
    return most;
  }

  void pull(std::uint32_t v, std::uint32_t u, double off) {
    for (const std::uint32_t t : about_[v]) {
      if (has(t, u)) {
        alive_[t] = false;
        for (const std::uint32_t w : mesh_.triangles[t]) {
          if (w != v) std::erase(about_[w], t);
        }
      } else {
        std::replace(mesh_.triangles[t].begin(), mesh_.triangles[t].end(), v, u);
        off_[t] = off;
        about_[u].push_back(t);
      }
    }
    about_[v].clear();
  }

  TriangleMesh& mesh_;
  double flat_;
  std::vector<std::vector<std::uint32_t>> about_;
  std::vector<bool> alive_;
  std::vector<double> off_;  ///< of each triangle: bound of its distance from the given surface [m]
};

}  // namespace

void remove_flat_vertices(TriangleMesh& mesh, double flat) { FlatVertices(mesh, flat).remove(); }

}  // namespace godobject::scene_compiler
