#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/scene/facets.h"
#include "core/scene/format.h"
#include "toolchain/scene_compiler/mesh/solid_surface.h"
#include "toolchain/scene_compiler/mesh/triangle_tree.h"

namespace godobject::scene_compiler {

/// The facets of a surface's solids: its triangles, without those that are no higher than a length `flat` (exporters
/// leave such slivers, often folded). Needles are collapsed, slivers left out, and slits closed by their neighbours:
/// three steps, each of which moves the surface by 1.5 times that length at most.
///
/// Some facets do not tell the side of a point: one of a shell, one without area, one with an edge at which the surface
/// is open, folded or branched, one that meets another component or lies within one, and one that turned over as a
/// needle was collapsed. Near such a facet there are no facets. A dilated surface is round and has none.
class SurfaceFacets {
 public:
  SurfaceFacets() = default;
  SurfaceFacets(const SolidSurface& surface, double flat);

  const std::vector<format::Facet>& all() const { return facets_; }
  bool empty() const { return facets_.empty(); }
  double flat() const { return flat_; }  ///< largest way of the surface in one of these steps [m]

  /// Returns the facets that may be the nearest ones of a point in the cube about `center`, ascending; none if one
  /// of them does not tell the side, if there are more than format::kMostFacets, or if they lie in more than 24 planes.
  /// Includes few others. Cost: a search among all triangles, and some comparisons for each that is near.
  std::optional<std::vector<std::uint32_t>> near(const Eigen::Vector3d& center, double half_edge) const;

  /// The same among the facets `about` a larger cube, without the search.
  std::optional<std::vector<std::uint32_t>> near(const Eigen::Vector3d& center, double half_edge,
                                                 std::span<const std::uint32_t> about) const;

  /// Returns the facets among which are the nearest ones of all points in a cube; none if there are no facets.
  std::vector<std::uint32_t> about(const Eigen::Vector3d& center, double half_edge) const;

  /// Returns the facets of format::FacetSet's first part, ascending: of the planes of the facets near a cube (`near`),
  /// those that are the lowest for some point of it. None unless the free space about the cube is convex. Cost: a
  /// search among all triangles; then the height of each facet about the cube above the plane of each other one.
  std::vector<std::uint32_t> convex_planes(const Eigen::Vector3d& center, double half_edge,
                                           std::span<const std::uint32_t> near) const;

  /// True if the surface turns by more than the crease angle among these facets: an edge, a corner, or another part of
  /// the surface. There interpolation errs by a share of the cell, elsewhere by a share of its square.
  bool turns(std::span<const std::uint32_t> facets) const;

 private:
  void bar_crossing(const TriangleMesh& mesh, const std::vector<std::uint32_t>& component);
  void bar_buried(const SolidSurface& surface);
  void bar_turned(const SolidSurface& surface, const TriangleMesh& mesh, const std::vector<bool>& pulled_to);

  std::vector<format::Facet> facets_;
  std::vector<char> valid_;
  double flat_ = 0.0;
  TriangleTree tree_;
};

/// Bounds the differences of an exact brick's interpolated distances from the distance to its facets.
class FacetDifference {
 public:
  /// Stores references to facets and brick.
  FacetDifference(const FacetLists& facets, const format::ExactBrick& exact, double offset)
      : facets_(facets), exact_(exact), offset_(offset) {}

  /// Bounds of |g + offset - I[phi]| in a cell [m].
  struct Largest {
    double anywhere = 0.0;
    double outside = 0.0;  ///< where one of g + offset and I[phi] is positive
  };

  /// Raises `largest` to bounds in a cell at `low` with these distances at its corners, x fastest. Cost: some distances
  /// to facets for each part of the cell in which g is about a plane; some hundreds where the surface turns. Parts that
  /// do not raise the bounds cost less.
  void raise(int cell, const Eigen::Vector3d& low, double cell_edge, const double (&corners)[8],
             Largest& largest) const;

  /// Returns a coarser bound of |g + offset - I[phi]| in a cell: g changes by at most the way from a corner. Cost:
  /// eight distances to facets.
  double coarse(int cell, const Eigen::Vector3d& low, double cell_edge, const double (&corners)[8]) const;

 private:
  struct Cell;
  struct Box;
  void add(const Cell& cell, const Box& box, std::span<const std::uint32_t> numbers, Largest& largest) const;

  std::uint32_t set_of(int cell) const { return (exact_.cell[cell] & format::cell_facets::kSet) - 1; }

  FacetLists facets_;
  const format::ExactBrick& exact_;
  double offset_;
};

}  // namespace godobject::scene_compiler
