#include "toolchain/scene_compiler/field/field_slope.h"

#include <array>
#include <cmath>

#include "core/scene/edge.h"
#include "toolchain/scene_compiler/field/straight_edges.h"

namespace godobject::scene_compiler {
namespace {

using Eigen::Vector3d;
using format::kBrickNodes;

Vector3d corner_offset(unsigned corner) { return Vector3d(corner & 1, corner >> 1 & 1, corner >> 2); }

/// Returns the trilinear interpolation of values at the corners of a cube, x fastest, at `at` in 0 .. 1.
double trilinear(const std::array<double, 8>& value, const Vector3d& at) {
  double sum = 0.0;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const Vector3d high = corner_offset(corner);
    double share = 1.0;
    for (int axis = 0; axis < 3; ++axis) share *= high[axis] > 0.0 ? at[axis] : 1.0 - at[axis];
    sum += share * value[corner];
  }
  return sum;
}

/// Returns the `index`-th point of a lattice with `side` points along each axis, x fastest.
Vector3d lattice_point(int index, int side) {
  return Vector3d(index % side, index / side % side, index / (side * side));
}

/// Returns a bound of |g - I[phi]| on a cell, phi its nodes. The function side g is convex. In each part of the cell it
/// lies above its tangent plane at the part's middle and below its interpolation between the part's corners. The
/// difference of I[phi] and either is trilinear there, so it is largest at a corner.
double largest_difference(const format::Edge& edge, const Vector3d& low, double cell_edge,
                          const std::array<double, 8>& nodes) {
  constexpr int kParts = 3;  // of a cell's edge, chosen: a tighter bound saves halvings, a looser one time
  double largest = 0.0;
  bool one_face = true;
  Vector3d normal;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const ValueAndGradient at = wedge_distance(edge, low + cell_edge * corner_offset(corner));
    largest = std::max(largest, std::abs(nodes[corner] - at.value));
    if (corner == 0) normal = at.gradient;
    one_face = one_face && at.gradient == normal;
  }
  // The region nearest to one face is convex. So g is linear on a cell with all corners in it.
  if (one_face) return largest;
  constexpr int kCorners = kParts + 1;  // of the parts, along an edge
  std::array<double, kCorners * kCorners * kCorners> interpolated{};
  for (int corner = 0; corner < kCorners * kCorners * kCorners; ++corner) {
    const Vector3d at = lattice_point(corner, kCorners) / kParts;
    const auto c = static_cast<std::size_t>(corner);
    interpolated[c] = trilinear(nodes, at);
    largest = std::max(largest, edge.side * (wedge_distance(edge, low + cell_edge * at).value - interpolated[c]));
  }
  for (int part = 0; part < kParts * kParts * kParts; ++part) {
    const Vector3d first = lattice_point(part, kParts);
    const Vector3d middle = first / kParts + Vector3d::Constant(0.5 / kParts);
    const ValueAndGradient tangent = wedge_distance(edge, low + cell_edge * middle);
    for (unsigned offset = 0; offset < 8; ++offset) {
      const Vector3d corner = first + corner_offset(offset);
      const double plane = tangent.value + cell_edge * tangent.gradient.dot(corner / kParts - middle);
      const auto c = static_cast<std::size_t>(corner.dot(Vector3d(1.0, kCorners, kCorners * kCorners)));
      largest = std::max(largest, edge.side * (interpolated[c] - plane));
    }
  }
  return largest;
}

/// Returns the nodes of a cell, x fastest.
std::array<double, 8> nodes_of(const Brick& brick, int x, int y, int z) {
  std::array<double, 8> nodes{};
  for (unsigned c = 0; c < 8; ++c) {
    const int node = x + static_cast<int>(c & 1) +
                     kBrickNodes * (y + static_cast<int>(c >> 1 & 1) + kBrickNodes * (z + static_cast<int>(c >> 2)));
    nodes[c] = static_cast<double>(brick.value[node]);
  }
  return nodes;
}

}  // namespace

double edge_deviation(const Brick& brick, std::uint8_t octants, const format::Edge& edge, const Vector3d& low,
                      double cell_edge) {
  double largest = 0.0;
  for_each_cell(brick, octants, [&](const CellEdges&, int x, int y, int z) {
    const Vector3d first = low + cell_edge * Vector3d(x, y, z);
    if (!reaches(edge, first + Vector3d::Constant(0.5 * cell_edge), 0.5 * cell_edge)) return;
    largest = std::max(largest, largest_difference(edge, first, cell_edge, nodes_of(brick, x, y, z)));
  });
  return largest;
}

void FieldSlope::add(const Brick& brick, std::uint8_t octants, const format::Edge& edge, const Vector3d& low) {
  const double half_diagonal = 0.5 * std::sqrt(3.0) * voxel_size_;
  for_each_cell(brick, octants, [&](const CellEdges& edges, int x, int y, int z) {
    const double plain = edges.largest_gradient(voxel_size_);
    const Vector3d first = low + voxel_size_ * Vector3d(x, y, z);
    const Vector3d center = first + Vector3d::Constant(0.5 * voxel_size_);
    double gradient = plain;
    if (reaches(edge, center, 0.5 * voxel_size_)) {
      const double t = Eigen::Map<const Vector3d>(edge.along).dot(center - Eigen::Map<const Vector3d>(edge.point));
      const double thinnest = std::max(edge_radius(edge, t) - edge.slope * half_diagonal, edge.end_radius);
      const bool at_end = std::min(t - edge.begin, edge.end - t) < edge.ramp + half_diagonal;
      const double steepest = std::max(at_end ? 1.0 / edge.ramp : 0.0, 2.0 / thinnest * std::hypot(1.0, edge.slope));
      const double weight = edge_weight(edge, center).value;
      const double least = std::max(0.0, weight - steepest * half_diagonal);
      const double most = std::min(1.0, weight + steepest * half_diagonal);
      gradient = std::max((1.0 - least) * plain + least, (1.0 - most) * plain + most);
      if (least < 1.0) gradient += steepest * largest_difference(edge, first, voxel_size_, nodes_of(brick, x, y, z));
    }
    seamed_ = std::max(seamed_, gradient * kRounding);
    smooth_ = std::max(smooth_, gradient * kRounding);
  });
}

}  // namespace godobject::scene_compiler
