#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/scene/clearance_kernel.h"
#include "core/scene/field.h"
#include "core/scene/format.h"
#include "core/scene/sample_kernel.h"

namespace godobject {

/// A compiled body, still or moving: trilinear value and gradient of signed distances stored in sparse bricks. A view;
/// owns nothing. Real-time safe; every call looks at one brick (one index entry, where the position is refined at most
/// format::kMaxRefinement more entries, 8 nodes of the brick, and the edge of one that has one).
class Voxelmap {
 public:
  Voxelmap() = default;

  /// The parts must have been validated (SceneView::open does) and must outlive the view.
  Voxelmap(const format::Grid& grid, std::span<const std::uint32_t> index, std::span<const format::Brick> bricks,
           std::span<const format::Refined> refined, std::span<const format::Edge> edges = {}) noexcept;

  double voxel_size() const noexcept { return voxel_size_; }
  double band() const noexcept { return band_; }
  double lipschitz() const noexcept { return clearance_slope_; }
  double assured_clearance() const noexcept { return assured_clearance_; }

  /// No point of the surface is farther from `center` [m].
  double surface_radius(const Vector3& center) const noexcept {
    return (center - surface_min_).cwiseMax(surface_max_ - center).norm();
  }

  /// The stored field at p_W, trilinear but for bricks with an edge (format::Edge), and its exact gradient. Outside the
  /// grid is free space (+band), deep inside is solid (-band), both with `known` false. A p that is not finite counts
  /// as outside. The clearance is the distance over Brick::lipschitz, more beyond the band.
  FieldSample sample(const Vector3& p_W) const noexcept;

  /// See DistanceField. In single precision, of each position's own nodes, with allowance for both; eight points at a
  /// time where the processor gathers (some 10 ns a point in cache).
  void clearances(const Pose& H, PointBatch& batch) const noexcept;

  /// See DistanceField: to the last bit what `sample` gives there, several points at a time where the processor has
  /// vectors; what lies in bricks with an edge, or where nothing is stored, one by one.
  void samples(const Pose& H, SampleBatch& batch) const noexcept;
  /// By one of sample_kernels(), or by none.
  void samples_by(const detail::SampleKernel* kernel, const Pose& H, SampleBatch& batch) const noexcept;

  /// See DistanceField. Knows it of a chord through at most four cells without an edge, one after the other, in each of
  /// which the cubic that the field is there has positive Bernstein coefficients; 0 where the processor has no vectors:
  /// there balls decide alone, so what a cycle with long chords comes to may differ in value.
  std::uint64_t free_chords(const Pose& H0, const Pose& H1, SampleBatch& batch) const noexcept;
  /// By one of sample_kernels(), or by none; the batch was looked up by one at least as wide.
  std::uint64_t free_chords_by(const detail::SampleKernel* kernel, const Pose& H0, const Pose& H1,
                               SampleBatch& batch) const noexcept;

  /// The data that the kernels of `clearances` read, for points of a frame at H. Requires in_batches().
  detail::FieldOfCells in_cells(const Pose& H) const noexcept;
  bool in_batches() const noexcept { return in_batches_; }

  /// The paper's voxel layer v = round(-phi(C) / s) at the centre C of the voxel (node) nearest to p_W; beyond the band
  /// that of the band's edge. Nothing more is stored for it: voxels have one size, so a refined position answers from
  /// its own nodes.
  LayerSample layer(const Vector3& p_W) const noexcept;

  /// See DistanceField. Within the band from Brick::lipschitz, beyond it from the clearance kept in the brick index,
  /// outside the grid from the surface's bounding box.
  double lower_bound(const Vector3& center_W, double radius) const noexcept;

 private:
  /// Largest error of trilinear interpolation of a 1-Lipschitz function, in voxels: half the cell's diagonal. It holds
  /// for refinements too: nodes that carry a coarser brick's value weigh coarser nodes m, of mean x in all, so the
  /// error is at most the root of sum w_m |m - x|^2, which the halved edges leave below 3/4 (faces add 1/2, 1/8, ...,
  /// the cell itself 3/4 of its squared edge).
  static constexpr double kInterpolationError = 0.8660254037844387;
  /// With what rounding adds.
  static constexpr double kFieldError = kInterpolationError + format::kMostRoundedOff * format::kLargestQuantum;

  struct Cell {
    std::uint32_t entry;  ///< of the brick index; of a refinement after `descend`
    int x, y, z;          ///< cell within the brick, 0 .. kBrickCells - 1
    float fx, fy, fz;     ///< position within the cell, 0 .. 1
  };

  detail::FieldOfNodes in_nodes(const Pose& H) const noexcept;
  bool locate(const Vector3& p_W, Cell& cell) const noexcept;
  double descend(Cell& cell) const noexcept;
  const format::Brick& unrefined(std::uint32_t entry) const noexcept;
  double outside_clearance(const Vector3& p_W) const noexcept;
  double far_clearance(const Cell& cell) const noexcept;
  double distance_to_box(const Vector3& p_W) const noexcept;

  const std::uint32_t* index_ = nullptr;
  const format::Brick* bricks_ = nullptr;
  const format::Refined* refined_ = nullptr;
  const format::Edge* edges_ = nullptr;
  Vector3 origin_ = Vector3::Zero();
  Vector3 surface_min_ = Vector3::Zero();
  Vector3 surface_max_ = Vector3::Zero();
  double voxel_size_ = 1.0;
  double per_voxel_ = 1.0;
  double band_ = 0.0;
  double quantum_ = 0.0;  ///< of the stored distances; less where they are refined [m]
  double quantum_per_voxel_ = 0.0;
  double near_band_ = 0.0;  ///< largest part of a distance that a clearance may use: the band less its rounding, at
                            ///< most a brick's edge [m]
  double lipschitz_ = 1.0;  ///< of the whole field
  double clearance_slope_ = 1.0;
  double assured_clearance_ = 0.0;
  double outside_off_ = 0.0;         ///< of the distance to the surface's box, as clearance [m]
  bool in_batches_ = false;          ///< the index and the nodes are few enough for 32 bits
  Vector3 cells_ = Vector3::Zero();  ///< of the grid along x, y, z
  std::ptrdiff_t stride_y_ = 0;      ///< brick positions from one to its neighbour in y, in z
  std::ptrdiff_t stride_z_ = 0;
};

static_assert(DistanceField<Voxelmap>);

}  // namespace godobject
