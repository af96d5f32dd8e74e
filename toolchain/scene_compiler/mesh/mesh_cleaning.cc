#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <unordered_map>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "toolchain/command_line/failure.h"
#include "toolchain/scene_compiler/mesh/components.h"
#include "toolchain/scene_compiler/mesh/mesh_edges.h"
#include "toolchain/scene_compiler/mesh/mesh_import.h"
#include "toolchain/scene_compiler/mesh/orientation.h"
#include "toolchain/scene_compiler/mesh/slits.h"
#include "toolchain/scene_compiler/mesh/triangle_geometry.h"

namespace godobject::scene_compiler {
namespace {

using Eigen::Vector3d;
using Triangle = std::array<std::uint32_t, 3>;

/// Of the bounding box's diagonal: 16 times the rounding of single-precision coordinates (6e-8).
constexpr double kWeldTolerance = 1e-6;

/// Least height of a triangle, of the weld tolerance. Rounding decides the normal of a lower one.
constexpr double kThinnest = 1e-3;

void measure_box(const std::vector<Vector3d>& vertices, const std::string& name, MeshReport& report) {
  report.low.setConstant(std::numeric_limits<double>::infinity());
  report.high = -report.low;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (!vertices[i].allFinite()) {
      throw command::Failure(
          command::ExitCode::kBadData,
          fmt::format("{}: vertex {} is not a finite number; repair the mesh and export it again", name, i));
    }
    report.low = report.low.cwiseMin(vertices[i]);
    report.high = report.high.cwiseMax(vertices[i]);
  }
  const double largest = report.low.cwiseAbs().cwiseMax(report.high.cwiseAbs()).maxCoeff();
  if (largest > kMaxCoordinate) {
    throw command::Failure(
        command::ExitCode::kBadData,
        fmt::format(
            "{}: a coordinate of {:g} m is beyond the limit of {:g} m; check `scale`, or move the mesh to its origin",
            name, largest, kMaxCoordinate));
  }
}

/// Returns, for each vertex, the index of the vertex that replaces it: the first one within `tolerance`.
std::vector<std::uint32_t> weld(const std::vector<Vector3d>& vertices, double tolerance) {
  using Cell = std::array<std::int64_t, 3>;
  struct Hash {
    std::size_t operator()(const Cell& c) const noexcept {
      std::uint64_t hash = 0;
      for (const std::int64_t v : c) hash = (hash ^ static_cast<std::uint64_t>(v)) * 0x9e3779b97f4a7c15u + (hash >> 29);
      return hash;
    }
  };
  // Cells are twice the tolerance wide. So all points within the tolerance of p lie in the 8 cells around p's nearest
  // corner.
  const double width = 2.0 * tolerance;
  std::unordered_map<Cell, std::vector<std::uint32_t>, Hash> cells;
  cells.reserve(vertices.size());
  std::vector<std::uint32_t> standing(vertices.size());
  for (std::uint32_t i = 0; i < vertices.size(); ++i) {
    const Vector3d p = vertices[i] / width;
    Cell own;
    Cell side;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double value = p[static_cast<Eigen::Index>(axis)];
      own[axis] = static_cast<std::int64_t>(std::floor(value));
      side[axis] = value - std::floor(value) < 0.5 ? -1 : 1;
    }
    standing[i] = i;
    double best = tolerance * tolerance;
    for (std::size_t corner = 0; corner < 8; ++corner) {
      Cell cell = own;
      for (std::size_t axis = 0; axis < 3; ++axis) cell[axis] += ((corner >> axis) & 1u) != 0 ? side[axis] : 0;
      const auto found = cells.find(cell);
      if (found == cells.end()) continue;
      for (const std::uint32_t other : found->second) {
        const double squared = (vertices[other] - vertices[i]).squaredNorm();
        if (squared <= best && (squared < best || other < standing[i])) {
          best = squared;
          standing[i] = other;
        }
      }
    }
    if (standing[i] == i) cells[own].push_back(i);
  }
  return standing;
}

bool has_no_area(const std::vector<Vector3d>& vertices, const Triangle& t, double tolerance) {
  if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return true;
  return !is_higher(vertices[t[0]], vertices[t[1]], vertices[t[2]], kThinnest * tolerance);
}

/// Drops all but one of the triangles on the same three corners. The majority's winding stays. If both senses balance,
/// one of each stays: a fold without volume, which changes neither the winding number nor the boundary.
void drop_duplicates(std::vector<Triangle>& triangles, MeshReport& report) {
  struct Keyed {
    Triangle corners;  // ascending
    std::uint32_t index;
    bool even;  // the corners are an even permutation of the ascending ones
    bool operator<(const Keyed& other) const {
      return corners != other.corners ? corners < other.corners : index < other.index;
    }
  };
  std::vector<Keyed> sorted;
  sorted.reserve(triangles.size());
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const Triangle& t = triangles[i];
    Triangle corners = t;
    std::sort(corners.begin(), corners.end());
    const bool even = (t[0] < t[1]) == ((t[1] < t[2]) == (t[0] < t[2]));
    sorted.push_back({corners, i, even});
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<bool> stays(triangles.size());
  for (std::size_t begin = 0; begin < sorted.size();) {
    std::size_t end = begin;
    std::ptrdiff_t balance = 0;
    while (end < sorted.size() && sorted[end].corners == sorted[begin].corners) balance += sorted[end++].even ? 1 : -1;
    for (const bool even : {true, false}) {
      if (even ? balance < 0 : balance > 0) continue;
      const auto first = std::find_if(sorted.begin() + static_cast<std::ptrdiff_t>(begin), sorted.end(),
                                      [even](const Keyed& k) { return k.even == even; });
      stays[first->index] = true;
    }
    report.folded_triangles += balance == 0 ? 2 : 0;
    begin = end;
  }
  std::size_t count = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (stays[i]) triangles[count++] = triangles[i];
  }
  report.duplicate_triangles = triangles.size() - count;
  triangles.resize(count);
}

void drop_loose_vertices(TriangleMesh& mesh) {
  constexpr std::uint32_t kUnused = ~0u;
  std::vector<std::uint32_t> renumbered(mesh.vertices.size(), kUnused);
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) renumbered[v] = 0;
  }
  std::uint32_t used = 0;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (renumbered[i] == kUnused) continue;
    renumbered[i] = used;
    mesh.vertices[used++] = mesh.vertices[i];
  }
  mesh.vertices.resize(used);
  for (Triangle& t : mesh.triangles) {
    for (std::uint32_t& v : t) v = renumbered[v];
  }
}

std::uint64_t misoriented(const MeshEdges& edges) {
  return static_cast<std::uint64_t>(
      std::count_if(edges.all().begin(), edges.all().end(), [&edges](const MeshEdges::Edge& edge) {
        const auto sides = edges.sides(edge);
        return sides.size() == 2 && sides[0].forward == sides[1].forward;
      }));
}

/// Turns triangles round where neighbours disagree, and measures what remains.
void settle_topology(TriangleMesh& mesh, MeshReport& report) {
  MeshEdges edges(mesh);
  report.misoriented_edges = misoriented(edges);
  if (report.misoriented_edges > 0) {
    report.turned_triangles = agree_on_sense(mesh, edges);
    edges = MeshEdges(mesh);
    report.misoriented_edges = misoriented(edges);
  }
  for (const MeshEdges::Edge& edge : edges.all()) {
    const auto sides = edges.sides(edge);
    if (sides.size() == 1) ++report.boundary_edges;
    if (sides.size() > 2) ++report.nonmanifold_edges;
  }
  report.vertices = mesh.vertices.size();
  report.triangles = mesh.triangles.size();
  report.euler = static_cast<std::int64_t>(report.vertices) - static_cast<std::int64_t>(edges.all().size()) +
                 static_cast<std::int64_t>(report.triangles);
  report.components = connected_components(mesh).count;
}

}  // namespace

TriangleMesh clean_mesh(TriangleMesh mesh, const std::string& name, MeshReport& report) {
  if (mesh.triangles.empty()) {
    throw command::Failure(command::ExitCode::kBadData,
                           fmt::format("{}: contains no triangles; export a surface mesh, not points or lines", name));
  }
  if (mesh.triangles.size() > kMaxTriangles) {
    throw command::Failure(command::ExitCode::kBadData,
                           fmt::format("{}: {} triangles are more than the limit of {}; decimate the mesh", name,
                                       mesh.triangles.size(), kMaxTriangles));
  }
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) {
      if (v >= mesh.vertices.size()) {
        throw command::Failure(
            command::ExitCode::kBadData,
            fmt::format("{}: a face refers to vertex {}, but there are {} vertices; export the mesh again", name, v,
                        mesh.vertices.size()));
      }
    }
  }
  measure_box(mesh.vertices, name, report);
  const double diagonal = (report.high - report.low).norm();
  report.weld_tolerance = kWeldTolerance * diagonal;
  if (!(diagonal > 0.0)) {
    throw command::Failure(command::ExitCode::kBadData,
                           fmt::format("{}: all vertices are one point; export the mesh again", name));
  }

  const std::vector<std::uint32_t> standing = weld(mesh.vertices, report.weld_tolerance);
  for (std::uint32_t i = 0; i < standing.size(); ++i) report.welded_vertices += standing[i] != i ? 1u : 0u;
  for (Triangle& t : mesh.triangles) {
    for (std::uint32_t& v : t) v = standing[v];
  }
  report.degenerate_triangles = std::erase_if(
      mesh.triangles, [&](const Triangle& t) { return has_no_area(mesh.vertices, t, report.weld_tolerance); });
  drop_duplicates(mesh.triangles, report);
  if (mesh.triangles.empty()) {
    throw command::Failure(command::ExitCode::kBadData,
                           fmt::format("{}: every triangle is degenerate; export the mesh again", name));
  }
  const std::size_t before = mesh.vertices.size();
  drop_loose_vertices(mesh);
  report.unreferenced_vertices = before - mesh.vertices.size() - report.welded_vertices;
  measure_box(mesh.vertices, name, report);
  report.cuts_at_slits = close_slits(mesh, report.weld_tolerance);
  settle_topology(mesh, report);
  return mesh;
}

}  // namespace godobject::scene_compiler
