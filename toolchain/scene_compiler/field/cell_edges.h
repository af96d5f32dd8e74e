#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/scene/format.h"
#include "toolchain/scene_compiler/field/brick.h"

namespace godobject::scene_compiler {

/// The differences of the distance along the twelve edges of one cell of a brick [m].
struct CellEdges {
  std::array<std::array<double, 4>, 3>
      along{};                 ///< along[axis][a + 2 b]: a, b the corner in the next two axes (cyclic)
  double largest_value = 0.0;  ///< largest |distance| at the corners

  CellEdges(const Brick& brick, int x, int y, int z) {
    constexpr std::array<int, 3> kStride = {1, format::kBrickNodes, format::kBrickNodes * format::kBrickNodes};
    const float* corner = brick.value + x + kStride[1] * y + kStride[2] * z;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (int edge = 0; edge < 4; ++edge) {
        const float* v = corner + (edge & 1) * kStride[(axis + 1) % 3] + (edge >> 1) * kStride[(axis + 2) % 3];
        along[axis][static_cast<std::size_t>(edge)] = static_cast<double>(v[kStride[axis]]) - static_cast<double>(v[0]);
        largest_value = std::max(
            {largest_value, std::abs(static_cast<double>(v[0])), std::abs(static_cast<double>(v[kStride[axis]]))});
      }
    }
  }

  double largest_jump() const {
    double largest = 0.0;
    for (const auto& edges : along) {
      for (const double d : edges) largest = std::max(largest, std::abs(d));
    }
    return largest;
  }

  /// True if the distance changes along an edge by more than the edge's length, which no distance does. The slack
  /// covers rounding, also of the values to float.
  bool on_seam(double voxel_size) const { return largest_jump() > voxel_size * (1.0 + 1e-4) + 1e-6 * largest_value; }

  /// Returns the largest gradient of the trilinear field in the cell [1]. The squared norm is convex in each of x, y
  /// and z alone. So its maximum is at a corner, where each component is the difference along one edge.
  double largest_gradient(double voxel_size) const {
    double largest = 0.0;
    for (std::size_t corner = 0; corner < 8; ++corner) {
      const std::array<std::size_t, 3> at = {corner & 1, corner >> 1 & 1, corner >> 2};
      double squared = 0.0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double d = along[axis][at[(axis + 1) % 3] + 2 * at[(axis + 2) % 3]];
        squared += d * d;
      }
      largest = std::max(largest, squared);
    }
    return std::sqrt(largest) / voxel_size;
  }
};

inline constexpr std::uint8_t kAllOctants = 0xff;

/// Returns the octant of a brick that contains a cell, x fastest.
constexpr unsigned octant_of_cell(int x, int y, int z) {
  constexpr int kHalf = format::kBrickCells / 2;
  return static_cast<unsigned>(x / kHalf + 2 * (y / kHalf) + 4 * (z / kHalf));
}

/// Calls visit(edges, x, y, z) for every cell of the given octants of a brick, one bit each.
template <class Visit>
void for_each_cell(const Brick& brick, std::uint8_t octants, Visit&& visit) {
  for (int z = 0; z < format::kBrickCells; ++z) {
    for (int y = 0; y < format::kBrickCells; ++y) {
      for (int x = 0; x < format::kBrickCells; ++x) {
        if ((octants >> octant_of_cell(x, y, z) & 1) != 0) visit(CellEdges(brick, x, y, z), x, y, z);
      }
    }
  }
}

}  // namespace godobject::scene_compiler
