#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/scene/clearance_kernel.h"
#include "core/scene/facets.h"
#include "core/scene/field.h"
#include "core/scene/format.h"
#include "core/scene/sample_kernel.h"

namespace godobject {
namespace detail {

/// A cell's trilinear function at a point, in single precision on whole numbers.
struct Trilinear {
  float value;
  float gradient[3];  ///< per cell
};

}  // namespace detail

/// The distance field of a compiled body, still or moving: trilinear value and gradient of signed distances stored in
/// sparse bricks. A view; owns nothing. Real-time safe. Each call reads one brick: an index entry, at most
/// format::kMaxRefinement entries of refinements, 8 nodes, and in an exact brick 8 weights and its facets.
class Voxelmap {
 public:
  Voxelmap() = default;

  /// The parts must have been validated (SceneView::open does) and must outlive the view.
  Voxelmap(const format::Grid& grid, std::span<const std::uint32_t> index, std::span<const format::Brick> bricks,
           std::span<const format::Refined> refined, std::span<const format::ExactBrick> exact = {},
           const FacetLists& facets = {}) noexcept;

  double voxel_size() const noexcept { return voxel_size_; }
  double band() const noexcept { return band_; }
  double lipschitz() const noexcept { return clearance_slope_; }
  double assured_clearance() const noexcept { return assured_clearance_; }

  /// Returns an upper bound of the distance of the surface's points from `center` [m].
  double surface_radius(const Vector3& center) const noexcept {
    return (center - surface_min_).cwiseMax(surface_max_ - center).norm();
  }

  /// Returns the stored field at p_W and its exact gradient. The field is trilinear, except in exact bricks
  /// (format::ExactBrick). It is +band outside the grid and -band deep inside, both with `known` false. A point that is
  /// not finite counts as outside. Within the band the clearance is the distance over Brick::lipschitz; beyond it,
  /// larger.
  FieldSample sample(const Vector3& p_W) const noexcept;

  /// As in DistanceField. Works in single precision on each position's own nodes, and subtracts bounds of both errors.
  /// With gather instructions eight points at a time, some 10 ns a point from the cache.
  void clearances(const Pose& H, PointBatch& batch) const noexcept;

  /// As in DistanceField. The results equal those of `sample` to the last bit. Vectors do several points at a time;
  /// distances to facets, and points where nothing is stored, are done one by one.
  void samples(const Pose& H, SampleBatch& batch) const noexcept;
  /// The same with one of sample_kernels(); null: without vectors.
  void samples_by(const detail::SampleKernel* kernel, const Pose& H, SampleBatch& batch) const noexcept;

  /// As in DistanceField. Proves chords through at most four cells. In each cell the interpolated field along the chord
  /// is a cubic, and the proof is that its Bernstein coefficients are positive. In a cell with facets the chord's piece
  /// must also pass these: both ends are above all planes of the set (format::FacetSet), or a plane of each facet, of
  /// its face or of an edge, lies between the facet and the piece, which begins outside.
  /// Returns 0 if the processor has no vectors: then free balls alone decide, and a cycle with long chords may have a
  /// different result.
  std::uint64_t free_chords(const Pose& H0, const Pose& H1, SampleBatch& batch) const noexcept;
  /// The same with one of sample_kernels(); null: 0. The batch was looked up by a kernel at least as wide.
  std::uint64_t free_chords_by(const detail::SampleKernel* kernel, const Pose& H0, const Pose& H1,
                               SampleBatch& batch) const noexcept;

  /// Returns the data that the kernels of `clearances` read, for points of a frame at H. Requires in_batches().
  detail::FieldOfCells in_cells(const Pose& H) const noexcept;
  bool in_batches() const noexcept { return in_batches_; }

  /// Returns the paper's voxel layer v = round(-phi(C) / s) at the centre C of the voxel (node) nearest to p_W; beyond
  /// the band the layer of the band's edge. The paper's voxels have one size, so a refined position answers from its
  /// own nodes.
  LayerSample layer(const Vector3& p_W) const noexcept;

  /// As in DistanceField. The bound follows from Brick::lipschitz within the band, from the far clearance of the brick
  /// index beyond it, and from the surface's bounding box outside the grid.
  double lower_bound(const Vector3& center_W, double radius) const noexcept;

 private:
  /// Largest error of trilinear interpolation of a 1-Lipschitz function: half the cell's diagonal [voxels]. The bound
  /// also holds in refinements. There a shared node has the weighted mean of coarser nodes m around it. The error at x
  /// is at most the root of sum w_m |m - x|^2. The halved edges keep that sum below 3/4: faces add 1/2, 1/8, ..., and
  /// the cell itself 3/4 of its squared edge.
  static constexpr double kInterpolationError = 0.8660254037844387;
  /// The same with the rounding of the nodes [voxels].
  static constexpr double kFieldError = kInterpolationError + format::kMostRoundedOff * format::kLargestQuantum;

  struct Cell {
    std::uint32_t entry;  ///< entry of the brick index; after `descend`, of a refinement
    int x, y, z;          ///< cell within the brick, 0 .. kBrickCells - 1
    float fx, fy, fz;     ///< position within the cell, 0 .. 1
  };

  /// A cell with facets, and the interpolated weight at a point of it.
  struct CellOfFacets {
    std::uint32_t word;        ///< see format::cell_facets
    float edge;                ///< [voxels]
    detail::Trilinear weight;  ///< in units of 1 / kOneWeight; of no meaning where all nodes have the weight 1
  };

  detail::FieldOfNodes in_nodes(const Pose& H) const noexcept;
  bool locate(const Vector3& p_W, Cell& cell) const noexcept;
  double descend(Cell& cell) const noexcept;
  void blend(const CellOfFacets& cell, const Vector3& p, ValueAndGradient& field) const noexcept;
  void blend_lanes(const detail::LanesWithFacets& lanes, SampleBatch& batch, std::uint32_t first) const noexcept;
  FieldSample sample_of(const ValueAndGradient& field, double lipschitz) const noexcept;
  const format::Brick& unrefined(std::uint32_t entry) const noexcept;
  double outside_clearance(const Vector3& p_W) const noexcept;
  double far_clearance(const Cell& cell) const noexcept;
  double distance_to_box(const Vector3& p_W) const noexcept;

  const std::uint32_t* index_ = nullptr;
  const format::Brick* bricks_ = nullptr;
  const format::Refined* refined_ = nullptr;
  const format::ExactBrick* exact_ = nullptr;
  FacetLists facets_;
  Vector3 origin_ = Vector3::Zero();
  Vector3 surface_min_ = Vector3::Zero();
  Vector3 surface_max_ = Vector3::Zero();
  double voxel_size_ = 1.0;
  double per_voxel_ = 1.0;
  double band_ = 0.0;
  double quantum_{};  ///< unit of the stored distances without refinement [m]
  double quantum_per_voxel_{};
  double near_band_{};  ///< largest part of a distance that a clearance may use: the band less its rounding, at
                        ///< most a brick's edge [m]
  double lipschitz_ = 1.0;  ///< bound of the gradient in the whole field [1]
  double clearance_slope_ = 1.0;
  double assured_clearance_ = 0.0;
  double outside_off_ = 0.0;         ///< distance to the surface's box minus clearance, outside the grid [m]
  double facet_offset_{};            ///< added to the distance to facets [m]
  bool in_batches_ = false;          ///< index and nodes can be addressed with 32 bits
  Vector3 cells_ = Vector3::Zero();  ///< number of cells of the grid along x, y, z
  std::ptrdiff_t stride_y_{};        ///< index difference of neighbouring positions in y; stride_z_ in z
  std::ptrdiff_t stride_z_{};
};

static_assert(DistanceField<Voxelmap>);

}  // namespace godobject
