#include "toolchain/scene_compiler/field/straight_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include <Eigen/Geometry>

#include "core/scene/edge.h"
#include "toolchain/parallel/parallel.h"
#include "toolchain/scene_compiler/mesh/body_mesh.h"
#include "toolchain/scene_compiler/mesh/mesh_normals.h"
#include "toolchain/scene_compiler/mesh/sharp_features.h"
#include "toolchain/scene_compiler/mesh/triangle_tree.h"

namespace godobject::scene_compiler {
namespace {

using Eigen::Vector3d;

constexpr double kOffPlane = 1e-3;  // [voxels] largest distance of a plane's vertex from the plane: half of kWrong
constexpr double kGap = 0.5;        // [voxels] between stretches on one line: twice the edge of a finest brick
constexpr double kShortest = 1.0;   // [voxels] least length of a stretch, chosen
constexpr double kTie = 1e-6;       // [voxels] so that rounding does not decide between equals
constexpr double kAlongStep = 0.1;  // [voxels] between the places along an edge at which its surroundings are measured
/// Slopes and radii, of the largest one, among which the widest tube is searched.
constexpr std::array<double, 4> kSlopes = {0.2, 0.1, 0.05, 0.0};
constexpr std::array<double, 8> kRadii = {1.0, 0.8, 0.6, 0.45, 0.3, 0.2, 0.15, 0.1};

void store(const Vector3d& v, double (&out)[3]) { std::copy(v.data(), v.data() + 3, out); }

Eigen::Map<const Vector3d> vector(const double (&v)[3]) { return Eigen::Map<const Vector3d>(v); }

/// A mesh edge at which two triangles of solids meet at a crease.
struct CreasedEdge {
  std::array<Vector3d, 2> ends;
  std::array<Vector3d, 2> opposite;  ///< vertices of the two triangles
  std::array<Vector3d, 2> normals;   ///< unit, out of the body
  std::array<Vector3d, 2> faces;     ///< unit, in the triangles, across the edge
  std::array<double, 2> areas;
  double side;  ///< as in format::Edge
};

std::optional<CreasedEdge> creased(const BodyMesh& body, const MeshEdges::Edge& edge) {
  constexpr double kFolded = 1e-9;
  const auto sides = body.edges.sides(edge);
  if (sides.size() != 2 || body.in_shell[sides[0].triangle] || sides[0].forward == sides[1].forward) return {};
  CreasedEdge made{};
  made.ends = {body.mesh.vertices[edge.low], body.mesh.vertices[edge.high]};
  const Vector3d span = made.ends[1] - made.ends[0];
  const Vector3d along = span.normalized();
  for (std::size_t i = 0; i < 2; ++i) {
    made.opposite[i] = body.mesh.vertices[sides[i].opposite];
    const Vector3d across = made.opposite[i] - made.ends[0];
    const Vector3d face = across - across.dot(along) * along;
    made.areas[i] = 0.5 * face.norm() * span.norm();
    if (made.areas[i] == 0.0) return {};
    made.faces[i] = face.normalized();
    made.normals[i] = (sides[i].forward ? 1.0 : -1.0) * along.cross(made.faces[i]).normalized();
  }
  const double cosine = made.normals[0].dot(made.normals[1]);
  if (cosine >= kCreaseCosine || cosine <= -1.0 + kFolded) return {};
  made.side = made.normals[0].dot(made.faces[1]) < 0.0 ? 1.0 : -1.0;
  return made;
}

/// The relation of two mesh edges: whether the edge and the triangles of `other` lie in the planes of `one`, and with
/// which numbers of the faces.
enum class Fit { kNot, kSame, kSwapped };

Fit fit(const CreasedEdge& one, const CreasedEdge& other, double tolerance) {
  if (one.side != other.side) return Fit::kNot;
  const auto in_plane = [&](const Vector3d& p, std::size_t face) {
    return std::abs(one.normals[face].dot(p - one.ends[0])) < tolerance;
  };
  for (const Vector3d& end : other.ends) {
    if (!in_plane(end, 0) || !in_plane(end, 1)) return Fit::kNot;
  }
  const bool swapped = one.normals[0].dot(other.normals[1]) > one.normals[0].dot(other.normals[0]);
  for (std::size_t i = 0; i < 2; ++i) {
    const std::size_t face = swapped ? 1 - i : i;
    if (!in_plane(other.opposite[i], face) || one.faces[face].dot(other.faces[i]) <= 0.0) return Fit::kNot;
  }
  return swapped ? Fit::kSwapped : Fit::kSame;
}

/// A wedge, and the range of its edge that the mesh has [m].
struct Crease {
  format::Edge wedge;
  double from, to;
};

/// Joins mesh edges that continue each other to creases.
class Creases {
 public:
  Creases(const BodyMesh& body, double voxel_size) : tolerance_(kOffPlane * voxel_size) {
    std::vector<std::vector<std::size_t>> at_vertex(body.mesh.vertices.size());
    for (const MeshEdges::Edge& edge : body.edges.all()) {
      const auto made = creased(body, edge);
      if (!made) continue;
      const std::size_t number = edges_.size();
      edges_.push_back(*made);
      parent_.push_back(number);
      for (const std::uint32_t vertex : {edge.low, edge.high}) {
        for (const std::size_t other : at_vertex[vertex]) {
          if (fit(edges_[other], *made, tolerance_) != Fit::kNot) join(number, other);
        }
        at_vertex[vertex].push_back(number);
      }
    }
  }

  std::vector<Crease> all() {
    std::vector<std::vector<std::size_t>> chains(edges_.size());
    for (std::size_t i = 0; i < edges_.size(); ++i) chains[find(i)].push_back(i);
    std::vector<Crease> creases;
    for (const auto& chain : chains) {
      if (!chain.empty()) creases.push_back(make(chain));
    }
    return creases;
  }

 private:
  /// Makes a crease of the line through the chain's far ends and the mean faces of its triangles, weighted by area.
  /// Single vertices are rounded.
  Crease make(const std::vector<std::size_t>& chain) const {
    const CreasedEdge& first = edges_[chain.front()];
    const Vector3d direction = (first.ends[1] - first.ends[0]).normalized();
    Vector3d low = first.ends[0];
    Vector3d high = first.ends[1];
    std::array<Vector3d, 2> sum = {Vector3d::Zero(), Vector3d::Zero()};
    for (const std::size_t i : chain) {
      for (const Vector3d& end : edges_[i].ends) {
        if (direction.dot(end - low) < 0.0) low = end;
        if (direction.dot(end - high) > 0.0) high = end;
      }
      const bool swapped = first.normals[0].dot(edges_[i].normals[1]) > first.normals[0].dot(edges_[i].normals[0]);
      for (std::size_t k = 0; k < 2; ++k) sum[swapped ? 1 - k : k] += edges_[i].areas[k] * edges_[i].normals[k];
    }
    const Vector3d along = (high - low).normalized();
    Crease crease{};
    crease.to = (high - low).norm();
    crease.wedge.side = first.side;
    store(low, crease.wedge.point);
    store(along, crease.wedge.along);
    for (std::size_t k = 0; k < 2; ++k) {
      const Vector3d normal = (sum[k] - sum[k].dot(along) * along).normalized();
      const Vector3d face = along.cross(normal);
      store(crease.wedge.side * normal, crease.wedge.normal[k]);
      store(face.dot(first.faces[k]) < 0.0 ? Vector3d(-face) : face, crease.wedge.face[k]);
    }
    return crease;
  }

  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

  double tolerance_;
  std::vector<CreasedEdge> edges_;
  std::vector<std::size_t> parent_;
};

/// The surroundings of an edge: all triangles, and the rims of holes as triangles without area.
class Surroundings {
 public:
  Surroundings(const SolidSurface& surface, const BodyMesh& body, double voxel_size)
      : surface_(surface), body_(body), voxel_size_(voxel_size) {
    std::vector<TriangleTree::Triangle> triangles;
    for (const auto& t : body.mesh.triangles) {
      triangles.push_back({body.mesh.vertices[t[0]], body.mesh.vertices[t[1]], body.mesh.vertices[t[2]],
                           static_cast<std::uint32_t>(triangles.size())});
    }
    for (const MeshEdges::Edge& edge : body.edges.all()) {
      if (edge.side_count == 2) continue;
      const Vector3d& high = body.mesh.vertices[edge.high];
      triangles.push_back({body.mesh.vertices[edge.low], high, high, static_cast<std::uint32_t>(triangles.size())});
    }
    tree_ = TriangleTree(std::move(triangles));
  }

  /// Returns the distance from a point of the crease to the nearest triangle of neither face, at most `most` [m].
  double distance(const Crease& crease, const Vector3d& p, double most) const {
    TriangleTree::Nearest nearest{most * most, Vector3d::Zero(), 0};
    tree_.nearest(
        p, most * most, [&](std::uint32_t id) { return !on_faces(crease.wedge, id); }, nearest);
    return std::sqrt(nearest.squared_distance);
  }

  /// True if the wedge is the surface at `radius` about a point of its edge. Near triangles alone do not decide that:
  /// solids lie within solids, shells are thick, and a hole makes the inside outside.
  bool is_surface(const format::Edge& wedge, const Vector3d& p, double radius) const {
    const Vector3d normal = vector(wedge.normal[0]);
    const Vector3d face = vector(wedge.face[0]);
    for (int i = 0; i < 8; ++i) {
      const double angle = 0.25 * std::numbers::pi * (i + 0.3);  // off the faces themselves
      const Vector3d around = std::cos(angle) * normal + std::sin(angle) * face;
      for (const double share : {0.6, 1.0}) {
        const Vector3d q = p + share * radius * around;
        const double exact = surface_.signed_distance(q);
        if (!(std::abs(wedge_distance(wedge, q).value - exact) <= kWrong * voxel_size_)) return false;
      }
    }
    return true;
  }

 private:
  bool on_faces(const format::Edge& wedge, std::uint32_t id) const {
    if (id >= body_.mesh.triangles.size()) return false;
    const auto& t = body_.mesh.triangles[id];
    const Eigen::Map<const Vector3d> point = vector(wedge.point);
    for (int face = 0; face < 2; ++face) {
      const auto on_face = [&](std::uint32_t vertex) {
        const Vector3d from = body_.mesh.vertices[vertex] - point;
        return std::abs(vector(wedge.normal[face]).dot(from)) < kOffPlane * voxel_size_ &&
               vector(wedge.face[face]).dot(from) > -kOffPlane * voxel_size_;
      };
      if (on_face(t[0]) && on_face(t[1]) && on_face(t[2])) return true;
    }
    return false;
  }

  const SolidSurface& surface_;
  const BodyMesh& body_;
  double voxel_size_;
  TriangleTree tree_;
};

/// Returns the least allowed R at which a stretch goes on: the end radius, less the rounding of equals [m].
double least_radius(double voxel_size) { return (kEndRadius - kTie) * voxel_size; }

/// A tube between two places: R at every sample is at most the allowed one.
struct Tube {
  double radius = 0.0;
  double slope = 0.0;
  double volume = -1.0;  ///< sum of R over the samples
};

/// Finds the widest tube. There is one, the one of the end radius, if no `allowed` is less than least_radius().
Tube widest_tube(std::span<const double> allowed, double voxel_size, double largest_radius) {
  const double step = kAlongStep * voxel_size;
  const double end_radius = kEndRadius * voxel_size;
  const double slack = end_radius - least_radius(voxel_size);
  Tube best;
  for (const double share : kRadii) {
    const double radius = std::max(share * largest_radius, end_radius);
    for (const double slope : kSlopes) {
      double volume = 0.0;
      for (std::size_t i = 0; i < allowed.size() && volume >= 0.0; ++i) {
        const auto to_end = step * static_cast<double>(std::min(i, allowed.size() - 1 - i));
        const double r = std::min(radius, end_radius + slope * to_end);
        volume = r <= allowed[i] + slack ? volume + r : -1.0;
      }
      if (volume > best.volume) best = {radius, slope, volume};
    }
  }
  return best;
}

std::vector<format::Edge> stretches(const Surroundings& surroundings, const Crease& crease, double voxel_size,
                                    double largest_radius) {
  const double end_radius = kEndRadius * voxel_size;
  const double least = least_radius(voxel_size);
  const double step = kAlongStep * voxel_size;
  std::vector<format::Edge> edges;
  if (crease.to - crease.from < kShortest * voxel_size) return edges;
  const double search_radius = largest_radius / kShare + step;
  const auto count = static_cast<std::size_t>((crease.to - crease.from) / step + kTie) + 1;
  std::vector<double> allowed(count);  // largest R between this sample and the next
  for (std::size_t i = 0; i < count; ++i) {
    const double t = crease.from + step * static_cast<double>(i);
    const Vector3d p = vector(crease.wedge.point) + t * vector(crease.wedge.along);
    allowed[i] = kShare * (surroundings.distance(crease, p, search_radius) - step);
    if (allowed[i] >= least && !surroundings.is_surface(crease.wedge, p, std::min(allowed[i], largest_radius))) {
      allowed[i] = 0.0;
    }
  }
  for (std::size_t begin = 0; begin < count;) {
    if (allowed[begin] < least) {
      ++begin;
      continue;
    }
    std::size_t end = begin;
    while (end < count && allowed[end] >= least) ++end;
    const Tube tube = widest_tube(std::span(allowed).subspan(begin, end - begin), voxel_size, largest_radius);
    format::Edge edge = crease.wedge;
    edge.begin = crease.from + step * static_cast<double>(begin);
    edge.end = crease.from + step * static_cast<double>(end - 1);
    edge.ramp = end_radius;
    edge.radius = tube.radius;
    edge.end_radius = end_radius;
    edge.slope = tube.slope;
    if (edge.end - edge.begin >= kShortest * voxel_size) edges.push_back(edge);
    begin = end;
  }
  return edges;
}

/// Shortens `edge` to the part apart from `other`, if both run side by side nearer than their radii. Nothing may be
/// left.
void keep_apart(format::Edge& edge, const format::Edge& other, double gap) {
  constexpr double kParallel = 1.0 - 1e-6;
  const Vector3d along = vector(edge.along);
  if (std::abs(along.dot(vector(other.along))) < kParallel) return;
  const Vector3d offset = vector(other.point) - vector(edge.point);
  if ((offset - offset.dot(along) * along).norm() > edge.radius + other.radius) return;
  const double direction = along.dot(vector(other.along));
  const auto [from, to] =
      std::minmax({offset.dot(along) + direction * other.begin, offset.dot(along) + direction * other.end});
  if (from - gap >= edge.end || to + gap <= edge.begin) return;
  if (from - edge.begin > edge.end - to) {
    edge.end = from - gap;
  } else {
    edge.begin = to + gap;
  }
}

}  // namespace

std::vector<format::Edge> straight_edges(const SolidSurface& surface, double voxel_size, double largest_radius) {
  if (surface.dilation() > 0.0) return {};
  const BodyMesh body(surface);
  const std::vector<Crease> creases = Creases(body, voxel_size).all();
  if (creases.empty()) return {};
  const Surroundings surroundings(surface, body, voxel_size);
  std::vector<std::vector<format::Edge>> found(creases.size());
  parallel::for_each_index(creases.size(), [&](std::size_t i) {
    found[i] = stretches(surroundings, creases[i], voxel_size, largest_radius);
  });
  std::vector<format::Edge> edges;
  for (const auto& some : found) {
    for (format::Edge edge : some) {
      for (const format::Edge& other : edges) keep_apart(edge, other, kGap * voxel_size);
      if (edge.end - edge.begin >= kShortest * voxel_size) edges.push_back(edge);
    }
  }
  return edges;
}

bool reaches(const format::Edge& edge, const Vector3d& center, double half_edge) {
  const Vector3d along = vector(edge.along);
  const Vector3d from = center - vector(edge.point);
  const double t = along.dot(from);
  const double half_length = half_edge * along.lpNorm<1>();
  const double low = std::max(t - half_length, edge.begin);
  const double high = std::min(t + half_length, edge.end);
  if (low >= high) return false;
  const double widest = std::clamp(0.5 * (edge.begin + edge.end), low, high);  // R decreases towards both ends
  const Vector3d across = from - t * along;
  const double r = across.norm();
  return r == 0.0 || r - half_edge * (across / r).lpNorm<1>() < edge_radius(edge, widest) * (1.0 + kTie);
}

}  // namespace godobject::scene_compiler
