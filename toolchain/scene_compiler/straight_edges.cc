#include "toolchain/scene_compiler/straight_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include <Eigen/Geometry>

#include "core/scene/edge.h"
#include "toolchain/scene_compiler/body_mesh.h"
#include "toolchain/scene_compiler/mesh_normals.h"
#include "toolchain/scene_compiler/parallel.h"
#include "toolchain/scene_compiler/sharp_features.h"
#include "toolchain/scene_compiler/triangle_tree.h"

namespace godobject::scene_compiler {
namespace {

using Eigen::Vector3d;

constexpr double kSamePlane = 1e-12;  // squared difference of unit vectors: meshes are written in single precision
constexpr double kOffPlane = 1e-4;    // voxels: a vertex further off a plane is not of it
constexpr double kTie = 1e-6;         // voxels: rounding must not decide between equals
constexpr double kStep = 0.1;         // voxels: of the places along an edge at which its surroundings are measured
constexpr std::array<double, 4> kSlopes = {0.2, 0.1, 0.05, 0.0};
constexpr std::array<double, 8> kRadii = {1.0, 0.8, 0.6, 0.45, 0.3, 0.2, 0.15, 0.1};  // of the largest

void store(const Vector3d& v, double (&out)[3]) { std::copy(v.data(), v.data() + 3, out); }

Eigen::Map<const Vector3d> vector(const double (&v)[3]) { return Eigen::Map<const Vector3d>(v); }

/// The wedge of a mesh edge at which two solid triangles meet at a crease.
std::optional<format::Edge> wedge_at(const BodyMesh& body, const MeshEdges::Edge& edge) {
  const auto sides = body.edges.sides(edge);
  if (sides.size() != 2 || body.in_shell[sides[0].triangle] || sides[0].forward == sides[1].forward) return {};
  const Vector3d& low = body.mesh.vertices[edge.low];
  const Vector3d along = (body.mesh.vertices[edge.high] - low).normalized();
  std::array<Vector3d, 2> normals;
  std::array<Vector3d, 2> faces;
  for (std::size_t i = 0; i < 2; ++i) {
    faces[i] = -away_from_triangle(body.mesh, edge, sides[i]);
    if (faces[i].squaredNorm() == 0.0) return {};
    faces[i] = (faces[i] - faces[i].dot(along) * along).normalized();
    normals[i] = (sides[i].forward ? 1.0 : -1.0) * along.cross(faces[i]).normalized();
  }
  if (normals[0].dot(normals[1]) >= kCreaseCosine) return {};
  format::Edge wedge{};
  wedge.side = normals[0].dot(faces[1]) < 0.0 ? 1.0 : -1.0;
  store(low, wedge.point);
  store(along, wedge.along);
  for (std::size_t i = 0; i < 2; ++i) {
    store(wedge.side * normals[i], wedge.normal[i]);
    store(faces[i], wedge.face[i]);
  }
  return wedge;
}

bool same_planes(const format::Edge& a, const format::Edge& b) {
  const auto same = [&](int i, int j) {
    return (vector(a.normal[i]) - vector(b.normal[j])).squaredNorm() < kSamePlane &&
           (vector(a.face[i]) - vector(b.face[j])).squaredNorm() < kSamePlane;
  };
  return a.side == b.side && ((same(0, 0) && same(1, 1)) || (same(0, 1) && same(1, 0)));
}

/// A wedge and how far along its edge the mesh's edges go [m].
struct Crease {
  format::Edge wedge;
  double from, to;
};

/// Creases whose mesh edges go on in one another, as one.
class Creases {
 public:
  explicit Creases(const BodyMesh& body) {
    std::vector<std::vector<std::size_t>> at_vertex(body.mesh.vertices.size());
    for (const MeshEdges::Edge& edge : body.edges.all()) {
      const auto wedge = wedge_at(body, edge);
      if (!wedge) continue;
      const std::size_t number = wedges_.size();
      wedges_.push_back(*wedge);
      ends_.push_back({body.mesh.vertices[edge.low], body.mesh.vertices[edge.high]});
      parent_.push_back(number);
      for (const std::uint32_t vertex : {edge.low, edge.high}) {
        for (const std::size_t other : at_vertex[vertex]) {
          if (same_planes(*wedge, wedges_[other])) join(number, other);
        }
        at_vertex[vertex].push_back(number);
      }
    }
  }

  std::vector<Crease> all() {
    constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
    std::vector<std::size_t> place(wedges_.size(), kNone);
    std::vector<Crease> creases;
    for (std::size_t i = 0; i < wedges_.size(); ++i) {
      const std::size_t first = find(i);
      if (place[first] == kNone) {
        place[first] = creases.size();
        creases.push_back({wedges_[first], 0.0, 0.0});
      }
      Crease& crease = creases[place[first]];
      for (const Vector3d& end : ends_[i]) {
        const double t = vector(crease.wedge.along).dot(end - vector(crease.wedge.point));
        crease.from = std::min(crease.from, t);
        crease.to = std::max(crease.to, t);
      }
    }
    return creases;
  }

 private:
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

  std::vector<format::Edge> wedges_;
  std::vector<std::array<Vector3d, 2>> ends_;
  std::vector<std::size_t> parent_;
};

/// What is not of a crease's two faces and nearer to it than `reach`: triangles, and the rims of holes as triangles
/// without area.
TriangleTree surroundings(const BodyMesh& body, const Crease& crease, double reach, double voxel_size) {
  const Vector3d point = vector(crease.wedge.point);
  const Vector3d along = vector(crease.wedge.along);
  const Vector3d from = point + crease.from * along;
  const Vector3d to = point + crease.to * along;
  const Vector3d low = from.cwiseMin(to) - Vector3d::Constant(reach);
  const Vector3d high = from.cwiseMax(to) + Vector3d::Constant(reach);
  const auto beside = [&](std::initializer_list<Vector3d> corners) {
    Vector3d least = Vector3d::Constant(std::numeric_limits<double>::infinity());
    Vector3d most = -least;
    for (const Vector3d& corner : corners) {
      least = least.cwiseMin(corner);
      most = most.cwiseMax(corner);
    }
    return (least.array() > high.array()).any() || (most.array() < low.array()).any();
  };
  const auto on_face = [&](const Vector3d& p, int face) {
    return std::abs(vector(crease.wedge.normal[face]).dot(p - point)) < kOffPlane * voxel_size &&
           vector(crease.wedge.face[face]).dot(p - point) > -kOffPlane * voxel_size;
  };
  std::vector<TriangleTree::Triangle> triangles;
  for (const auto& t : body.mesh.triangles) {
    const Vector3d& a = body.mesh.vertices[t[0]];
    const Vector3d& b = body.mesh.vertices[t[1]];
    const Vector3d& c = body.mesh.vertices[t[2]];
    if (beside({a, b, c})) continue;
    if (on_face(a, 0) && on_face(b, 0) && on_face(c, 0)) continue;
    if (on_face(a, 1) && on_face(b, 1) && on_face(c, 1)) continue;
    triangles.push_back({a, b, c, 0});
  }
  for (const MeshEdges::Edge& edge : body.edges.all()) {
    if (edge.side_count == 2) continue;
    const Vector3d& a = body.mesh.vertices[edge.low];
    const Vector3d& b = body.mesh.vertices[edge.high];
    if (!beside({a, b})) triangles.push_back({a, b, b, 0});
  }
  return TriangleTree(std::move(triangles));
}

/// The widest tube between two places: R at every sample at most what is allowed there.
struct Tube {
  double radius = 0.0;
  double slope = 0.0;
  double volume = -1.0;  ///< sum of R over the samples
};

Tube widest_tube(std::span<const double> allowed, double step, double end_radius, double largest_radius) {
  const double slack = kTie * end_radius;
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

std::vector<format::Edge> stretches(const BodyMesh& body, const Crease& crease, double voxel_size,
                                    double largest_radius) {
  const double end_radius = kEndRadius * voxel_size;
  const double least = end_radius - kTie * voxel_size;
  const double step = kStep * voxel_size;
  std::vector<format::Edge> edges;
  const double shortest = 4.0 * end_radius;
  if (crease.to - crease.from < shortest) return edges;
  const double reach = largest_radius / kShare + step;
  const TriangleTree others = surroundings(body, crease, reach, voxel_size);
  const auto count = static_cast<std::size_t>((crease.to - crease.from) / step + kTie) + 1;
  std::vector<double> allowed(count);  // R, between this sample and the next as well
  for (std::size_t i = 0; i < count; ++i) {
    const double t = crease.from + step * static_cast<double>(i);
    TriangleTree::Nearest nearest{reach * reach, Vector3d::Zero(), 0};
    others.nearest(vector(crease.wedge.point) + t * vector(crease.wedge.along), reach * reach, nearest);
    allowed[i] = kShare * (std::sqrt(nearest.squared_distance) - step);
  }
  for (std::size_t begin = 0; begin < count;) {
    if (allowed[begin] < least) {
      ++begin;
      continue;
    }
    std::size_t end = begin;
    while (end < count && allowed[end] >= least) ++end;
    const Tube tube = widest_tube(std::span(allowed).subspan(begin, end - begin), step, end_radius, largest_radius);
    format::Edge edge = crease.wedge;
    edge.begin = crease.from + step * static_cast<double>(begin);
    edge.end = crease.from + step * static_cast<double>(end - 1);
    edge.ramp = end_radius;
    edge.radius = tube.radius;
    edge.end_radius = end_radius;
    edge.slope = tube.slope;
    if (edge.end - edge.begin >= shortest) edges.push_back(edge);
    begin = end;
  }
  return edges;
}

}  // namespace

std::vector<format::Edge> straight_edges(const SolidSurface& surface, double voxel_size, double largest_radius) {
  const BodyMesh body(surface);
  const std::vector<Crease> creases = Creases(body).all();
  std::vector<std::vector<format::Edge>> found(creases.size());
  parallel_for(creases.size(),
               [&](std::size_t i) { found[i] = stretches(body, creases[i], voxel_size, largest_radius); });
  std::vector<format::Edge> edges;
  for (const auto& some : found) edges.insert(edges.end(), some.begin(), some.end());
  return edges;
}

bool reaches(const format::Edge& edge, const Vector3d& center, double half_edge) {
  const Vector3d along = vector(edge.along);
  const Vector3d from = center - vector(edge.point);
  const double t = along.dot(from);
  const double reach = half_edge * along.lpNorm<1>();
  const double low = std::max(t - reach, edge.begin);
  const double high = std::min(t + reach, edge.end);
  if (low >= high) return false;
  const double widest = std::clamp(0.5 * (edge.begin + edge.end), low, high);  // R falls off to both ends
  const Vector3d across = from - t * along;
  const double r = across.norm();
  return r == 0.0 || r - half_edge * (across / r).lpNorm<1>() < edge_radius(edge, widest) * (1.0 + kTie);
}

}  // namespace godobject::scene_compiler
