#include "toolchain/scene_compiler/field/surface_facets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>

#include "core/scene/facets.h"
#include "toolchain/parallel/parallel.h"
#include "toolchain/scene_compiler/field/near_facets.h"
#include "toolchain/scene_compiler/mesh/body_mesh.h"
#include "toolchain/scene_compiler/mesh/components.h"
#include "toolchain/scene_compiler/mesh/flat_vertices.h"
#include "toolchain/scene_compiler/mesh/mesh_edges.h"
#include "toolchain/scene_compiler/mesh/mesh_normals.h"
#include "toolchain/scene_compiler/mesh/near_triangles.h"
#include "toolchain/scene_compiler/mesh/needles.h"
#include "toolchain/scene_compiler/mesh/slits.h"
#include "toolchain/scene_compiler/mesh/triangle_geometry.h"

namespace godobject::scene_compiler {
namespace {

using Eigen::Vector3d;

constexpr double kFolded = 1e-4;         // length of the sum of two unit normals that point against each other
constexpr std::size_t kMostPlanes = 24;  // of a cube's facets; chosen: a look-up compares them all
constexpr double kSamePlane = 1e-6;      // length of the difference of two unit normals
constexpr int kParts = 2;                // halvings of a cube in which the nearest triangles are searched
constexpr double kHalfDiagonal = 0.86602540378443865;  // of a cube, of its edge

Eigen::Map<const Vector3d> vector(const double (&v)[3]) { return Eigen::Map<const Vector3d>(v); }

void store(const Vector3d& v, double (&out)[3]) { std::copy(v.data(), v.data() + 3, out); }

void store(const Vector3d& v, float (&out)[3]) {
  for (int axis = 0; axis < 3; ++axis) out[axis] = static_cast<float>(v[axis]);
}

/// Returns the mean of the normals of the faces at a vertex, weighted by their angles there.
Vector3d vertex_normal(const TriangleMesh& mesh, const std::vector<Vector3d>& face_normals,
                       const VertexCorners& corners, std::uint32_t vertex) {
  Vector3d sum = Vector3d::Zero();
  for (const std::size_t corner : corners.of(vertex)) {
    sum += corner_angle(mesh, corner / 3, corner % 3) * face_normals[corner / 3];
  }
  return sum;
}

/// Adds the facets that are near to one of the parts of a cube, divided so many times: the balls about small parts
/// reach less far beyond them. A part whose facets have all been added is not divided.
void add_near(NearFacets& search, const std::vector<std::uint32_t>& near, const Vector3d& center, double half_edge,
              int divisions, std::vector<std::uint32_t>& numbers) {
  if (numbers.size() > format::kMostFacets) return;  // there are too many, whatever follows
  const auto is_added = [&](std::uint32_t number) {
    return std::find(numbers.begin(), numbers.end(), number) != numbers.end();
  };
  if (std::all_of(near.begin(), near.end(), is_added)) return;
  if (divisions == 0 || near.size() == 1) {
    for (const std::uint32_t number : near) {
      if (!is_added(number)) numbers.push_back(number);
    }
    return;
  }
  std::vector<std::uint32_t> of_part;
  for (int part = 0; part < 8; ++part) {
    const Vector3d side((part & 1) != 0 ? 0.5 : -0.5, (part & 2) != 0 ? 0.5 : -0.5, (part & 4) != 0 ? 0.5 : -0.5);
    const Vector3d middle = center + half_edge * side;
    search.find(near, middle, kHalfDiagonal * half_edge, of_part);
    add_near(search, of_part, middle, 0.5 * half_edge, divisions - 1, numbers);
  }
}

/// Leaves out needles and the triangles that are no higher than `flat`, closes the slits that they leave, and joins the
/// triangles of flat faces. Returns the vertices to which others were pulled.
std::vector<bool> leave_out_flat(TriangleMesh& mesh, double flat) {
  std::vector<bool> pulled_to = collapse_needles(mesh, flat);
  std::erase_if(mesh.triangles, [&](const auto& t) {
    return !is_higher(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], flat);
  });
  close_slits(mesh, flat);
  remove_flat_vertices(mesh, flat);
  return pulled_to;
}

/// Returns the height of a point above the plane of a facet [m].
double height(const format::Facet& facet, const Vector3d& p) { return face_normal(facet).dot(p) + facet.plane[3][0]; }

using Corners = std::array<Vector3d, 3>;

/// True if an edge of a triangle meets another triangle, off its plane or at one end.
bool meets(const Corners& edges_of, const Corners& triangle) {
  const Vector3d normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d& from = edges_of[k];
    const Vector3d& to = edges_of[(k + 1) % 3];
    const double from_height = normal.dot(from - triangle[0]);
    const double to_height = normal.dot(to - triangle[0]);
    if (from_height == to_height || (from_height > 0.0) == (to_height > 0.0)) continue;
    const Vector3d at = from + from_height / (from_height - to_height) * (to - from);
    bool within = true;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3d& corner = triangle[i];
      within = within && normal.dot((triangle[(i + 1) % 3] - corner).cross(at - corner)) >= 0.0;
    }
    if (within) return true;
  }
  return false;
}

/// True if two facets lie in one plane with their outer sides, within a length.
bool same_plane(const format::Facet& facet, const format::Facet& other, double within) {
  if ((face_normal(facet) - face_normal(other)).norm() > kSamePlane) return false;
  return std::all_of(std::begin(facet.vertex), std::end(facet.vertex),
                     [&](const double(&vertex)[3]) { return std::abs(height(other, vector(vertex))) <= within; });
}

/// A convex polygon: the part of a triangle in a cube.
class Polygon {
 public:
  Polygon() = default;
  explicit Polygon(const Corners& triangle) : size_(triangle.size()) {
    std::copy(triangle.begin(), triangle.end(), vertices_.begin());
  }
  bool empty() const { return size_ == 0; }
  std::span<const Vector3d> vertices() const { return std::span(vertices_).first(size_); }
  void add(const Vector3d& vertex) { vertices_[size_++] = vertex; }

 private:
  // of 3 vertices each side of a cube makes at most 1.5 times as many, even if rounding bends the polygon
  std::array<Vector3d, 29> vertices_;
  std::size_t size_ = 0;
};

/// Returns the part of a convex polygon in a cube; empty if there is none.
Polygon clipped(Polygon polygon, const Vector3d& center, double half_edge) {
  for (int side = 0; side < 6 && !polygon.empty(); ++side) {
    const int axis = side / 2;
    const double sign = side % 2 == 0 ? 1.0 : -1.0;
    const auto room = [&](const Vector3d& vertex) { return half_edge - sign * (vertex[axis] - center[axis]); };
    const auto vertices = polygon.vertices();
    if (std::all_of(vertices.begin(), vertices.end(), [&](const Vector3d& v) { return room(v) >= 0.0; })) continue;
    Polygon within;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const Vector3d& from = vertices[i];
      const Vector3d& to = vertices[(i + 1) % vertices.size()];
      const double from_room = room(from);
      const double to_room = room(to);
      if (from_room >= 0.0) within.add(from);
      if ((from_room < 0.0) != (to_room < 0.0)) within.add(from + from_room / (from_room - to_room) * (to - from));
    }
    polygon = within;
  }
  return polygon;
}

/// Returns the sum of the unit normals of the faces at an edge; zero where it tells no side.
Vector3d edge_normal(const MeshEdges& edges, const std::vector<Vector3d>& face_normals, const MeshEdges::Edge& edge) {
  const auto sides = edges.sides(edge);
  if (sides.size() != 2 || sides[0].forward == sides[1].forward) return Vector3d::Zero();
  const Vector3d sum = face_normals[sides[0].triangle] + face_normals[sides[1].triangle];
  return sum.norm() < kFolded ? Vector3d::Zero() : sum;
}

}  // namespace

SurfaceFacets::SurfaceFacets(const SolidSurface& surface, double flat) : flat_(std::numbers::sqrt2 * flat) {
  if (surface.dilation() > 0.0) return;
  BodyMesh body(surface);
  TriangleMesh& mesh = body.mesh;
  const bool solid = std::find(body.in_shell.begin(), body.in_shell.end(), true) == body.in_shell.end();
  std::vector<bool> pulled_to;
  if (solid) {
    pulled_to = leave_out_flat(mesh, flat);
    body.in_shell.assign(mesh.triangles.size(), false);
  }
  const std::vector<Vector3d> normals = scene_compiler::face_normals(mesh);
  const MeshEdges edges(mesh);
  const VertexCorners corners(mesh);
  facets_.resize(mesh.triangles.size());
  valid_.resize(mesh.triangles.size());
  std::vector<TriangleTree::Triangle> triangles;
  for (std::size_t t = 0; t < facets_.size(); ++t) {
    const auto& triangle = mesh.triangles[t];
    triangles.push_back({mesh.vertices[triangle[0]], mesh.vertices[triangle[1]], mesh.vertices[triangle[2]],
                         static_cast<std::uint32_t>(t)});
    valid_[t] = !body.in_shell[t] && !normals[t].isZero();
    for (std::size_t k = 0; k < 3; ++k) {
      store(mesh.vertices[triangle[k]], facets_[t].vertex[k]);
      const Vector3d normal = vertex_normal(mesh, normals, corners, triangle[k]);
      valid_[t] = valid_[t] && normal.norm() >= kFolded;
      store(normal.normalized(), facets_[t].vertex_normal[k]);
    }
    set_planes(facets_[t], normals[t]);
  }
  for (const MeshEdges::Edge& edge : edges.all()) {
    const Vector3d normal = edge_normal(edges, normals, edge);
    for (const MeshEdges::Side& side : edges.sides(edge)) {
      const auto& triangle = mesh.triangles[side.triangle];
      const auto k =
          std::find(triangle.begin(), triangle.end(), side.forward ? edge.low : edge.high) - triangle.begin();
      store(normal.normalized(), facets_[side.triangle].edge_normal[k]);
      if (normal.isZero()) valid_[side.triangle] = false;
    }
  }
  tree_ = TriangleTree(std::move(triangles));
  if (const auto component = connected_components(mesh).of_triangle;
      std::any_of(component.begin(), component.end(), [](std::uint32_t c) { return c != 0; })) {
    bar_crossing(mesh, component);
    bar_buried(surface);
  }
  if (solid) bar_turned(surface, mesh, pulled_to);
}

/// Bars the facets that turned over as needles were collapsed. A facet that tells the side has free space above it and
/// the solid below it.
void SurfaceFacets::bar_turned(const SolidSurface& surface, const TriangleMesh& mesh,
                               const std::vector<bool>& pulled_to) {
  for (std::size_t t = 0; t < facets_.size(); ++t) {
    const auto& triangle = mesh.triangles[t];
    if (!valid_[t] || std::none_of(triangle.begin(), triangle.end(), [&](auto v) { return pulled_to[v]; })) continue;
    const Vector3d center =
        (mesh.vertices[triangle[0]] + mesh.vertices[triangle[1]] + mesh.vertices[triangle[2]]) / 3.0;
    const Vector3d off = 2.0 * flat_ * face_normal(facets_[t]);
    valid_[t] = surface.signed_distance(center + off) > 0.0 && surface.signed_distance(center - off) < 0.0;
  }
}

/// The facets that meet a facet of another component do not tell the side: beyond the line in which they meet they lie
/// within the body.
void SurfaceFacets::bar_crossing(const TriangleMesh& mesh, const std::vector<std::uint32_t>& component) {
  const auto corners = [&](std::size_t t) {
    const auto& triangle = mesh.triangles[t];
    return Corners{mesh.vertices[triangle[0]], mesh.vertices[triangle[1]], mesh.vertices[triangle[2]]};
  };
  std::vector<char> crosses(facets_.size());
  parallel::for_each_index(facets_.size(), [&](std::size_t t) {
    const Corners own = corners(t);
    const Vector3d center = (own[0] + own[1] + own[2]) / 3.0;
    const double radius = std::max({(own[0] - center).norm(), (own[1] - center).norm(), (own[2] - center).norm()});
    tree_.within(center, radius, [&](const TriangleTree::Triangle& other) {
      if (crosses[t] != 0 || component[other.id] == component[t]) return;
      const Corners others = corners(other.id);
      crosses[t] = meets(own, others) || meets(others, own) ? 1 : 0;
    });
  });
  for (std::size_t t = 0; t < facets_.size(); ++t) valid_[t] = valid_[t] && crosses[t] == 0;
}

/// Bars the facets that lie within the body, as those of a solid within another. Above them is no free space, so their
/// normals do not tell the side.
void SurfaceFacets::bar_buried(const SolidSurface& surface) {
  constexpr double kAbove = 1e-6;  // of the longest edge; chosen: far above rounding, below all gaps that are stored
  parallel::for_each_index(facets_.size(), [&](std::size_t t) {
    if (valid_[t] == 0) return;
    const format::Facet& facet = facets_[t];
    const Corners at = {vector(facet.vertex[0]), vector(facet.vertex[1]), vector(facet.vertex[2])};
    const double longest = std::max({(at[1] - at[0]).norm(), (at[2] - at[1]).norm(), (at[0] - at[2]).norm()});
    const double above = std::max(2.0 * flat_, kAbove * longest);
    const Vector3d p = (at[0] + at[1] + at[2]) / 3.0 + above * face_normal(facet);
    valid_[t] = surface.winding_number(p) < 0.5 ? 1 : 0;
  });
}

std::vector<std::uint32_t> SurfaceFacets::about(const Vector3d& center, double half_edge) const {
  return NearTriangles(tree_, center, 2.0 * kHalfDiagonal * half_edge).ids();
}

std::optional<std::vector<std::uint32_t>> SurfaceFacets::near(const Vector3d& center, double half_edge) const {
  return near(center, half_edge, about(center, half_edge));
}

std::optional<std::vector<std::uint32_t>> SurfaceFacets::near(const Vector3d& center, double half_edge,
                                                              std::span<const std::uint32_t> about) const {
  if (about.empty()) return {};
  NearFacets search(facets_);
  std::vector<std::uint32_t> of_cube;
  search.find(about, center, 2.0 * kHalfDiagonal * half_edge, of_cube);
  std::vector<std::uint32_t> numbers;
  add_near(search, of_cube, center, half_edge, kParts, numbers);
  std::sort(numbers.begin(), numbers.end());
  if (numbers.size() > format::kMostFacets) return {};
  std::vector<Vector3d> planes;
  for (const std::uint32_t number : numbers) {
    if (!valid_[number]) return {};
    const Vector3d normal = face_normal(facets_[number]);
    const auto same = [&normal](const Vector3d& other) { return (other - normal).norm() <= kSamePlane; };
    if (std::none_of(planes.begin(), planes.end(), same)) planes.push_back(normal);
  }
  if (planes.size() > kMostPlanes) return {};
  return numbers;
}

/// Let D be a cube that holds the cell and the nearest places of all its points, E a cube with some room about D, and C
/// the points of E on the outer side of the planes of all facets in E. If all these facets lie in C, then they are on
/// its border. A face of C is convex, hence in one piece, and the surface has no border of its own; so it covers each
/// face that it has a part of. The foot of a point of D on the lowest of the planes that have a facet in D lies on the
/// border of C, hence on a facet. The comparison allows for rounding. A facet that it overlooks enters E by no more
/// than that, and does not reach D.
std::vector<std::uint32_t> SurfaceFacets::convex_planes(const Vector3d& center, double half_edge,
                                                        std::span<const std::uint32_t> near) const {
  constexpr std::size_t kMost = 256;  // facets in E, chosen: bounds the cost
  constexpr double kRounding = 2e-5;  // of a facet's height, in half edges
  const double least = -kRounding * half_edge;
  // a point is at most half a diagonal from the centre, and as much farther from its nearest place than the centre is
  const double half_diagonal = 2.0 * kHalfDiagonal * half_edge;
  const double of_d = half_edge + half_diagonal + std::abs(facet_distance(facets_, near, center).value);
  const double of_e = of_d + half_edge;
  const auto above = [&](std::uint32_t plane, std::span<const Vector3d> vertices) {
    return std::all_of(vertices.begin(), vertices.end(),
                       [&](const Vector3d& vertex) { return height(facets_[plane], vertex) >= least; });
  };
  std::vector<Vector3d> vertices;     // of the parts of facets in E
  std::vector<std::uint32_t> planes;  // facets, one in each plane
  std::vector<std::uint32_t> in_d;
  std::size_t facets_in_e = 0;
  bool serves = true;
  tree_.within(center, 2.0 * kHalfDiagonal * of_e, [&](const TriangleTree::Triangle& triangle) {
    if (!serves) return;
    const Polygon part = clipped(Polygon({triangle.a, triangle.b, triangle.c}), center, of_e);
    if (part.empty()) return;
    serves = valid_[triangle.id] != 0 && ++facets_in_e <= kMost &&
             std::all_of(planes.begin(), planes.end(), [&](auto plane) { return above(plane, part.vertices()); });
    if (!clipped(part, center, of_d).empty()) in_d.push_back(triangle.id);
    const auto same = [&](std::uint32_t other) { return same_plane(facets_[triangle.id], facets_[other], -least); };
    vertices.insert(vertices.end(), part.vertices().begin(), part.vertices().end());
    if (std::none_of(planes.begin(), planes.end(), same)) {
      planes.push_back(triangle.id);
      serves = serves && above(triangle.id, vertices);
    }
  });
  if (!serves) return {};
  std::sort(in_d.begin(), in_d.end());
  std::vector<std::uint32_t> of_near;
  for (const std::uint32_t number : near) {
    if (!std::binary_search(in_d.begin(), in_d.end(), number)) continue;
    const auto same = [&](std::uint32_t other) { return same_plane(facets_[number], facets_[other], -least); };
    if (std::none_of(of_near.begin(), of_near.end(), same)) of_near.push_back(number);
  }
  // The difference of two heights changes linearly, so it is least at a corner.
  const auto has_greater_height = [&](std::uint32_t number, std::uint32_t other) {
    const Vector3d turn = face_normal(facets_[number]) - face_normal(facets_[other]);
    return height(facets_[number], center) - height(facets_[other], center) > half_edge * turn.lpNorm<1>();
  };
  std::vector<std::uint32_t> lowest;
  for (const std::uint32_t number : of_near) {
    const auto below = [&](std::uint32_t other) { return has_greater_height(number, other); };
    if (std::none_of(of_near.begin(), of_near.end(), below)) lowest.push_back(number);
  }
  return lowest;
}

bool SurfaceFacets::turns(std::span<const std::uint32_t> facets) const {
  for (std::size_t i = 1; i < facets.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (face_normal(facets_[facets[i]]).dot(face_normal(facets_[facets[k]])) < kCreaseCosine) return true;
    }
  }
  return false;
}

/// A cell with the distances at its corners.
struct FacetDifference::Cell {
  Vector3d low;
  double edge;
  const double (&corners)[8];

  /// Interpolates at the corners of a box in the cell, x fastest. `least` and `most`: of its coordinates, 0 .. 1.
  std::array<double, 8> interpolated(const Vector3d& least, const Vector3d& most) const {
    std::array<double, 8> value{};
    for (unsigned corner = 0; corner < 8; ++corner) value[corner] = corners[corner];
    for (unsigned axis = 0; axis < 3; ++axis) {
      const unsigned next = 1u << axis;
      for (unsigned corner = 0; corner < 8; ++corner) {
        if ((corner & next) != 0) continue;
        const double from = value[corner];
        const double to = value[corner | next];
        value[corner] = (1.0 - least[axis]) * from + least[axis] * to;
        value[corner | next] = (1.0 - most[axis]) * from + most[axis] * to;
      }
    }
    return value;
  }
};

/// A cube in a cell.
struct FacetDifference::Box {
  Vector3d center;  ///< 0 .. 1
  double half_edge;
};

void FacetDifference::raise(int cell, const Vector3d& low, double cell_edge, const double (&corners)[8],
                            Largest& largest) const {
  add({low, cell_edge, corners}, {Vector3d::Constant(0.5), 0.5}, facets_.of(set_of(cell)), largest);
}

/// With shares s of the corners, |g - I[phi]| <= sum s |g - phi| <= sum s |p - corner| + largest |g - phi| at a corner.
/// The sum of the ways is largest in the middle.
double FacetDifference::coarse(int cell, const Vector3d& low, double cell_edge, const double (&corners)[8]) const {
  double off = 0.0;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const Vector3d p = low + cell_edge * Vector3d(corner & 1, corner >> 1 & 1, corner >> 2);
    off = std::max(off, std::abs(facet_distance(facets_, set_of(cell), p).value + offset_ - corners[corner]));
  }
  return kHalfDiagonal * cell_edge + off;
}

/// Adds a box. Only the facets that are nearest to some point of the box count. There the gradient of g is the normal
/// of one of them, or lies between those of several. So g is as far from its tangent plane at the centre as the normals
/// are apart, per length. The difference of that plane and I[phi] is largest at a corner. Boxes are divided unless that
/// cannot change the result by much.
void FacetDifference::add(const Cell& cell, const Box& box, std::span<const std::uint32_t> numbers,
                          Largest& largest) const {
  constexpr double kSmallest = 1.0 / 16.0;  // half edge of the last boxes, of the cell's edge
  constexpr double kEnough = 0.05;          // of the cell's edge
  const Vector3d p = cell.low + cell.edge * box.center;
  const double radius = 2.0 * kHalfDiagonal * box.half_edge * cell.edge;
  std::array<double, format::kMostFacets> squared;
  double nearest = std::numeric_limits<double>::infinity();
  double furthest = nearest;  // squared, of a facet that counts
  std::size_t first = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    squared[i] = squared_distance_within(facets_.facets[numbers[i]], p, furthest);
    if (squared[i] >= nearest) continue;
    nearest = squared[i];
    const double far = std::sqrt(nearest) + 2.0 * radius;
    furthest = far * far;
    first = i;
  }
  const Vector3d normal = face_normal(facets_.facets[numbers[first]]);
  std::array<std::uint32_t, format::kMostFacets> near;
  near[0] = numbers[first];  // probably the nearest one of some parts
  std::size_t count = 1;
  double squared_apart = 0.0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (squared[i] > furthest || i == first) continue;
    near[count++] = numbers[i];
    squared_apart = std::max(squared_apart, (face_normal(facets_.facets[numbers[i]]) - normal).squaredNorm());
  }
  double apart = std::sqrt(squared_apart);
  const auto counting = std::span(near).first(count);
  const double value = facet_distance(facets_.facets, counting, p).value + offset_;
  const Vector3d half = Vector3d::Constant(box.half_edge);
  const std::array<double, 8> interpolated = cell.interpolated(box.center - half, box.center + half);
  double bound = 0.0;
  bool outside = value + radius > 0.0;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const Vector3d side((corner & 1) != 0 ? 1.0 : -1.0, (corner & 2) != 0 ? 1.0 : -1.0, (corner & 4) != 0 ? 1.0 : -1.0);
    const double plane = value + cell.edge * box.half_edge * normal.dot(side);
    outside = outside || interpolated[corner] > 0.0;
    bound = std::max(bound, std::abs(plane - interpolated[corner]));
  }
  // between normals that are more than a right angle apart any direction may lie
  if (apart > std::numbers::sqrt2) apart = 2.0;
  bound += apart * radius;
  if (bound <= largest.anywhere && (!outside || bound <= largest.outside)) return;
  if (box.half_edge <= kSmallest || apart * radius <= kEnough * cell.edge) {
    largest.anywhere = std::max(largest.anywhere, bound);
    if (outside) largest.outside = std::max(largest.outside, bound);
    return;
  }
  for (unsigned part = 0; part < 8; ++part) {
    const Vector3d side((part & 1) != 0 ? 0.5 : -0.5, (part & 2) != 0 ? 0.5 : -0.5, (part & 4) != 0 ? 0.5 : -0.5);
    add(cell, {box.center + box.half_edge * side, 0.5 * box.half_edge}, counting, largest);
  }
}

}  // namespace godobject::scene_compiler
