#pragma once

#include <algorithm>
#include <cstdint>

#include <Eigen/Core>

#include "core/scene/facets.h"
#include "toolchain/scene_compiler/field/cell_edges.h"

namespace godobject::scene_compiler {

/// Lipschitz constant of the stored field: its largest gradient, on seams and off them.
class FieldSlope {
 public:
  /// `rounded_apart`: largest amount by which rounding increases the difference of neighbouring nodes [m].
  explicit FieldSlope(double voxel_size, double rounded_apart = 0.0)
      : voxel_size_(voxel_size), rounded_apart_(rounded_apart) {}

  /// Adds the given octants of a brick, x fastest, one bit each.
  void add(const Brick& brick, std::uint8_t octants) {
    for_each_cell(brick, octants, [this](const CellEdges& edges, int, int, int) {
      const double gradient = edges.largest_gradient(voxel_size_) * kRounding;
      seamed_ = std::max(seamed_, gradient);
      if (!edges.on_seam(voxel_size_ + rounded_apart_)) smooth_ = std::max(smooth_, gradient);
    });
  }

  /// Adds an exact brick with its first node at `low`; `offset` as format::Grid::facet_offset. Uses a bound of the
  /// gradient of format::ExactBrick's field, with w for I[w]:
  ///
  ///     |grad phi| <= (1 - w) |grad I[phi]| + w + |g + offset - I[phi]| |grad w|.
  ///
  /// Returns a bound of |phi - I[phi]| [m]. Where a coarse bound of the gradient is below `enough`, both are coarse.
  double add(const Brick& brick, std::uint8_t octants, const format::ExactBrick& exact, const FacetLists& facets,
             double offset, const Eigen::Vector3d& low, double enough = 0.0);

  double largest() const { return smooth_; }
  double largest_with_seams() const { return seamed_; }

 private:
  static constexpr double kRounding = 1.0 + 1e-5;  // the core interpolates in single precision

  double voxel_size_;
  double rounded_apart_;
  double smooth_ = 0.0;
  double seamed_ = 0.0;
};

}  // namespace godobject::scene_compiler
