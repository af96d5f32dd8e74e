#include "toolchain/scene_compiler/field/field_slope.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

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

double FieldSlope::add(const Brick& brick, std::uint8_t octants, const format::ExactBrick& exact,
                       const FacetLists& facets, double offset, const Vector3d& low, double enough) {
  const FacetDifference difference(facets, exact, offset);
  double deviation = 0.0;
  for_each_cell(brick, octants, [&](const CellEdges& edges, int x, int y, int z) {
    const double plain = edges.largest_gradient(voxel_size_);
    const ExactCell cell(brick, exact, x, y, z);
    const double least = cell.least_weight();
    const double most = cell.most_weight();
    const double mixed = std::max((1.0 - least) * plain + least, (1.0 - most) * plain + most);
    const double per_apart = least < most ? cell.weight_slope() / voxel_size_ : 0.0;
    const int number = cell_number(x, y, z);
    const Vector3d at = low + voxel_size_ * Vector3d(x, y, z);
    double gradient = mixed;
    if (most > 0.0) {
      const double coarse = enough > 0.0 ? difference.coarse(number, at, voxel_size_, cell.distance) : 0.0;
      if (mixed + per_apart * coarse < enough) {
        gradient += per_apart * coarse;
        deviation = std::max(deviation, most * coarse);
      } else {
        // starts from the largest of the other cells: a smaller one need not be found
        FacetDifference::Largest largest{deviation / most, std::numeric_limits<double>::infinity()};
        if (per_apart > 0.0) largest.outside = std::max(0.0, (seamed_ / kRounding - mixed) / per_apart);
        difference.raise(number, at, voxel_size_, cell.distance, largest);
        if (per_apart > 0.0) gradient += per_apart * largest.outside;
        deviation = std::max(deviation, most * largest.anywhere);
      }
    }
    seamed_ = std::max(seamed_, gradient * kRounding);
    smooth_ = std::max(smooth_, gradient * kRounding);
  });
  return deviation;
}

}  // namespace godobject::scene_compiler
