#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Core>

#include "toolchain/scene_compiler/field/distance_grid.h"

namespace godobject::scene_compiler {

/// The largest distances of the stored surface from the exact one.
struct SurfaceTolerance {
  double inside = 0.0;   ///< inside the body: a touching body would sink so deep [m]
  double outside = 0.0;  ///< outside of it: bodies would be held off so far [m]

  /// Returns the tolerance with this depth inside and kHeldOff times as much outside.
  static SurfaceTolerance of_depth(double inside);

  SurfaceTolerance times(double factor) const { return {factor * inside, factor * outside}; }
};

/// An error of the stored surface.
struct SurfaceError {
  double error = 0.0;          ///< stored distance - exact one: positive if the stored surface lies inside the body [m]
  double in_tolerances = 0.0;  ///< its size over the tolerance on its side [1]
  Eigen::Vector3d at = Eigen::Vector3d::Zero();

  /// Takes the other error if it is larger.
  void add(const SurfaceError& other) {
    if (other.in_tolerances > in_tolerances) *this = other;
  }
};

struct RefinementReport {
  std::array<std::uint64_t, format::kMaxRefinement + 1>
      bricks{};               ///< leaf bricks by number of halvings, 0 .. kMaxRefinement
  std::uint64_t refined = 0;  ///< bricks with halved octants
  std::uint64_t finer = 0;    ///< bricks stored in addition to those of the positions
  std::uint64_t exact = 0;    ///< exact bricks
  std::uint64_t facets = 0;   ///< of exact bricks
  std::uint64_t sets = 0;     ///< of facets
  std::uint64_t numbers = 0;  ///< of facets in sets
  SurfaceError worst;         ///< of those that exceed the tolerance; bricks cannot be halved there. 0: none

  /// Returns the size of finer and exact bricks in the image.
  std::uint64_t bytes() const {
    return finer * sizeof(format::Brick) + refined * sizeof(format::Refined) + exact * sizeof(format::ExactBrick) +
           facets * sizeof(format::Facet) + sets * sizeof(format::FacetSet) + numbers * sizeof(std::uint32_t);
  }
};

/// The stored surface may lie this far outside the exact one, in tolerances. A chosen value: penetration is worse than
/// a force that starts too early, by 0.25 voxels at the default tolerance.
inline constexpr double kHeldOff = 5.0;

inline SurfaceTolerance SurfaceTolerance::of_depth(double inside) { return {inside, kHeldOff * inside}; }

/// Refines `field` until it represents the surface of a solid, or the offset surface of a shell, within `tolerance`.
///
/// About edges, corners, thin walls and narrow gaps of solids, cells become exact (format::ExactBrick) where they err
/// by more than a part of the tolerance. Bricks that would have too many facets, and those that would be too steep
/// where the distance to facets passes to interpolation, do not.
///
/// Remaining errors are refined: octants of bricks are halved, up to format::kMaxRefinement times. That happens where
/// the field says "free" more than `tolerance.inside` inside the mesh (convex edges and corners, thin walls, into which
/// a touching body would sink), or "solid" more than `tolerance.outside` outside it (re-entrant edges, narrow gaps,
/// which would hold a body off). The error is measured on the surface itself, where the exact distance is 0, at all
/// edges and vertices of the mesh and in between at the spacing of a cell. A dilated body has no mesh of its surface;
/// its error is measured in the middle of all cells about it. A neighbour is halved only if its values on the common
/// face spoil the finer brick's or are too steep for it. Bricks that hold a seam stay as they are, and so do those in
/// which one would appear.
///
/// At the end all distances are increased by `slack` [m], which makes the body smaller, and rounded as the image
/// requires.
///
/// Updates the constants of `field.grid`. Deterministic. Throws Failure (kBadData) naming the cure if there would be
/// more than kMaxBricks bricks.
RefinementReport refine(DistanceGrid& field, const SolidSurface& surface, const SurfaceTolerance& tolerance,
                        const parallel::Progress& progress, double slack = 0.0);

/// Rounds a field without refining it.
void round_distances(DistanceGrid& field);

}  // namespace godobject::scene_compiler
