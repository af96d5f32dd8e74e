#include "toolchain/scene_compiler/field/field_slope.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "toolchain/scene_compiler/field/surface_facets.h"

namespace godobject::scene_compiler {
namespace {

using Eigen::Vector3d;
using format::kBrickNodes;

int cell_number(int x, int y, int z) { return x + format::kBrickCells * (y + format::kBrickCells * z); }

/// Distances and weights at the corners of a cell, x fastest.
struct ExactCell {
  double distance[8];
  std::array<double, 8> weight;

  ExactCell(const Brick& brick, const format::ExactBrick& exact, int x, int y, int z) {
    for (unsigned c = 0; c < 8; ++c) {
      const int node = x + static_cast<int>(c & 1) +
                       kBrickNodes * (y + static_cast<int>(c >> 1 & 1) + kBrickNodes * (z + static_cast<int>(c >> 2)));
      distance[c] = static_cast<double>(brick.value[node]);
      weight[c] = static_cast<double>(exact.weight[node]) / format::kOneWeight;
    }
  }

  double least_weight() const { return *std::min_element(weight.begin(), weight.end()); }
  double most_weight() const { return *std::max_element(weight.begin(), weight.end()); }

  /// Returns a bound of the weight's gradient per cell: of the largest change along each axis.
  double weight_slope() const {
    double squared = 0.0;
    for (unsigned axis = 0; axis < 3; ++axis) {
      double most = 0.0;
      for (unsigned c = 0; c < 8; ++c) {
        if ((c >> axis & 1) == 0) most = std::max(most, std::abs(weight[c | 1u << axis] - weight[c]));
      }
      squared += most * most;
    }
    return std::sqrt(squared);
  }
};

}  // namespace

double exact_deviation(const Brick& brick, std::uint8_t octants, const format::ExactBrick& exact,
                       std::span<const format::Facet> facets, double offset, const Vector3d& low, double cell_edge) {
  const FacetDifference difference(facets, exact, offset);
  double largest = 0.0;
  for_each_cell(brick, octants, [&](const CellEdges&, int x, int y, int z) {
    const ExactCell cell(brick, exact, x, y, z);
    if (cell.most_weight() == 0.0) return;
    const double most =
        difference.largest(cell_number(x, y, z), low + cell_edge * Vector3d(x, y, z), cell_edge, cell.distance)
            .anywhere;
    largest = std::max(largest, cell.most_weight() * most);
  });
  return largest;
}

void FieldSlope::add(const Brick& brick, std::uint8_t octants, const format::ExactBrick& exact,
                     std::span<const format::Facet> facets, double offset, const Vector3d& low) {
  const FacetDifference difference(facets, exact, offset);
  for_each_cell(brick, octants, [&](const CellEdges& edges, int x, int y, int z) {
    const double plain = edges.largest_gradient(voxel_size_);
    const ExactCell cell(brick, exact, x, y, z);
    const double least = cell.least_weight();
    const double most = cell.most_weight();
    double gradient = std::max((1.0 - least) * plain + least, (1.0 - most) * plain + most);
    if (least < most) {
      const double apart =
          difference.largest(cell_number(x, y, z), low + voxel_size_ * Vector3d(x, y, z), voxel_size_, cell.distance)
              .outside;
      gradient += cell.weight_slope() / voxel_size_ * apart;
    }
    seamed_ = std::max(seamed_, gradient * kRounding);
    smooth_ = std::max(smooth_, gradient * kRounding);
  });
}

}  // namespace godobject::scene_compiler
