#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "toolchain/scene_compiler/field/brick_lattice.h"
#include "toolchain/scene_compiler/field/distance_grid.h"
#include "toolchain/scene_compiler/field/facet_sets.h"
#include "toolchain/scene_compiler/field/field_slope.h"
#include "toolchain/scene_compiler/field/surface_facets.h"

namespace godobject::scene_compiler {

/// The bricks of a field during refinement, which halves their octants. Bricks are numbered: first those of the field,
/// then octants in the order of their creation. An octant that is not halved uses the nodes of its brick, which stays a
/// leaf there. Places are counted in cells of the finest level ("units") from the lattice's origin.
class BrickTree {
 public:
  static constexpr std::uint32_t kNone = ~0u;
  static constexpr int kUnits = 1 << format::kMaxRefinement;  ///< units along a voxel

  static constexpr std::size_t kMostAbout = 27;  ///< octants that touch a cell of the finest leaf around it

  using Units = std::array<int, 3>;

  /// One octant of a brick.
  struct Octant {
    std::uint32_t brick;
    std::uint8_t number;

    bool operator==(const Octant&) const = default;
    std::uint8_t bit() const { return static_cast<std::uint8_t>(1u << number); }
  };

  /// The leaf that holds a cell: a brick, and an octant of it that is not halved. kNone at a position that is not
  /// stored.
  struct Leaf {
    std::uint32_t brick = kNone;
    int level = 0;
    std::uint8_t octant = 0;

    Octant where() const { return {brick, octant}; }
  };

  using Octants = std::array<Octant, kMostAbout>;

  /// Starts from a field without refinement. Stores references: `field` and `facets` must outlive the tree, and the
  /// field must not change before `write`. The facets are those of the same surface.
  BrickTree(const DistanceGrid& field, const SurfaceFacets& facets);

  std::uint32_t brick_count() const { return static_cast<std::uint32_t>(places_.size()); }
  /// Returns the number of bricks that `write` may write: those that are not forgotten.
  std::uint32_t live_count() const { return brick_count() - forgotten_; }
  int level(std::uint32_t brick) const { return places_[brick].level; }
  std::uint32_t root(std::uint32_t brick) const { return places_[brick].root; }
  /// Returns the octants that are not halved, one bit each.
  std::uint8_t whole(std::uint32_t brick) const { return static_cast<std::uint8_t>(~places_[brick].halved); }
  Eigen::Vector3d low(std::uint32_t brick) const;
  /// Returns the brick's lowest node in units, and its level.
  std::array<int, 4> place(std::uint32_t brick) const {
    const Place& p = places_[brick];
    return {p.low[0], p.low[1], p.low[2], p.level};
  }
  double cell_edge(int level) const { return voxel_size_ / (1 << level); }

  /// Return the brick with the exact distances, and with those that `join` made.
  const Brick& exact(std::uint32_t brick) const;
  const Brick& stored(std::uint32_t brick) const;

  Units unit_cell(const Eigen::Vector3d& p) const;
  Leaf find(const Units& unit_cell) const;

  /// Return the field at p [m], which `leaf` holds: with the stored and with the exact nodes. In an exact brick it is
  /// blended with the distance to its facets (format::ExactBrick).
  double interpolate(const Leaf& leaf, const Eigen::Vector3d& p) const;
  double interpolate_exact(const Leaf& leaf, const Eigen::Vector3d& p) const;

  /// Finds all octants that hold p, the one of `leaf` included. Returns their number.
  std::size_t holding(const Leaf& leaf, const Eigen::Vector3d& p, Octants& octants) const;

  /// Finds the octants of coarser leaves than `leaf` that touch the nodes of its cell around p. `join` gives their
  /// values to those nodes. Returns their number.
  std::size_t coarser_about(const Leaf& leaf, const Eigen::Vector3d& p, Octants& octants) const;

  /// Returns the leaves of the cells outside the brick at its faces, edges and corners. They include every octant of a
  /// coarser leaf that touches the brick, because such an octant is at least as large.
  std::array<Leaf, 26> leaves_about(std::uint32_t brick) const;

  /// True if the next `join` can make cells of the brick exact: no seam is near, and nothing was found against it.
  bool may_be_exact(std::uint32_t brick) const { return !refuses_[brick] && !facets_.empty(); }

  /// True if the surface turns about the cell that holds p (SurfaceFacets::turns), and few facets do it.
  bool turns_about(const Leaf& leaf, const Eigen::Vector3d& p) const;

  /// Returns the number of the brick's cell that holds p, x fastest: of those of the leaf's octant, in spite of
  /// rounding.
  int cell_of(const Leaf& leaf, const Eigen::Vector3d& p) const;

  /// Returns the cells that are to be exact, one bit each.
  std::uint64_t exact_cells(std::uint32_t brick) const { return exact_cells_[brick]; }

  /// Makes cells of the brick exact from the next `join` on, one bit each. Where the brick, or one that shares a node
  /// with such a cell, has too many facets or none that give its distances, it refuses instead.
  void make_exact(std::uint32_t brick, std::uint64_t cells);

  /// Makes no cell of the brick exact, nor of its octants, from the next `join` on.
  void refuse(std::uint32_t brick);

  /// Returns weights and sets of facets (facet_lists) of an exact brick: one with a node of a weight.
  const std::optional<format::ExactBrick>& exact_brick(std::uint32_t brick) const { return exact_[brick]; }

  /// Returns the facets that the tree was made with, and the sets that exact bricks name.
  FacetLists facet_lists() const { return {facets_.all(), sets_.sets(), sets_.numbers()}; }

  /// Adds the slope of the octants that are not halved, of the field that `round` makes with this slack. `enough` as in
  /// FieldSlope::add.
  void add_slope(std::uint32_t brick, double slack, double enough, FieldSlope& slope) const;

  /// Halves the `wanted` octants that are not halved yet: makes bricks of them with the nodes of `octants`.
  void halve(std::uint32_t brick, std::uint8_t wanted, const std::array<Brick, 8>& octants);

  /// Makes the field continuous, coarse to fine: a node that touches a coarser leaf takes that leaf's value and weight.
  void join();

  /// Makes the positions of these roots, and those up to two positions away, as they were at the start: nothing in them
  /// is halved, exact or refused. Their finer bricks keep their numbers, hold nothing and are whole in no octant.
  void forget_about(const std::vector<std::uint32_t>& roots);

  /// Counts a brick as changed in the next `join`, as if an octant of it had been halved.
  void touch(std::uint32_t brick) { touched_.push_back(root(brick)); }

  /// Returns the number of joins so far, and the number of the last one that may have changed something in a position:
  /// leaves, stored values or touched bricks, in the position itself or beside it.
  std::uint32_t joins() const { return joins_; }
  std::uint32_t changed_in(std::uint32_t root) const { return changed_in_[root]; }

  /// The same for all positions that a box meets [m].
  std::uint32_t changed_in(const Eigen::Vector3d& low, const Eigen::Vector3d& high) const;

  /// Adds `slack` [m] to all distances. Then clamps and rounds them as format::Brick requires, to the smallest quantum
  /// in which they fit. Call it once, after the last `join`. The field stays continuous.
  void round(double slack);

  /// Writes the rounded tree into the field from which it was made. Numbers the refinements as the format requires and
  /// bounds the clearances again.
  void write(DistanceGrid& field) const;

 private:
  struct Place {
    Units low;
    int level;
    std::uint32_t root;   ///< brick of the whole position
    std::uint8_t halved;  ///< octants, one bit each
  };
  struct Fine {
    Brick exact, stored;
    bool is_forgotten = false;
  };
  /// A node of one level's lattice.
  struct Node {
    Units at;
    int level;
  };

  bool is_forgotten(std::uint32_t brick) const {
    return places_[brick].level > 0 && fine_[brick - field_.bricks.size()].is_forgotten;
  }
  Leaf coarsest_about(std::uint32_t brick, const std::array<int, 3>& node, const std::array<Leaf, 26>& about) const;
  std::uint32_t root_at(const BrickPosition& position) const;
  void forget_contents(std::uint32_t brick);
  void mark_changed();
  void mark_changed_about(std::uint32_t root);
  void join_brick(std::uint32_t brick);
  void spread_exact_cells();
  void weigh();
  void deny(std::uint32_t brick);
  void weigh_brick(std::uint32_t brick, const std::unordered_set<std::uint64_t>& nodes);
  /// The facets of an exact brick's cells; none where a cell has no weight.
  using BrickFacets = std::array<CellFacets, format::kCellsPerBrick>;
  std::optional<BrickFacets> find_facets(std::uint32_t brick) const;
  bool has_new_cells(std::uint32_t brick) const;
  void set_facets(std::uint32_t brick, const BrickFacets& facets);
  std::unordered_set<std::uint64_t> nodes_of_weight_one(std::vector<char>& about_exact) const;
  template <class Visit>
  void visit_corners(const Units& at, const Leaf& leaf, const Visit& visit) const;
  template <class Visit>
  void visit_about(std::uint32_t root, const Visit& visit) const;
  std::uint64_t weighed_cells(std::uint32_t brick, const format::ExactBrick& exact) const;
  template <class Visit>
  void visit_outer_nodes_on_coarser(std::uint32_t brick, const Visit& visit) const;
  Eigen::Vector3d cell_center(std::uint32_t brick, int cell) const;
  static int cell_at(const Place& place, const Units& unit_cell);
  Units node_at(const Place& place, int node) const;
  static std::uint64_t key(const Node& node);
  int factor(const Node& node) const;
  void find_factors();
  void round_nodes(const Place& place, Brick& brick) const;
  template <class Values>
  double interpolate(const Place& place, const Values& nodes, const std::array<double, 3>& units) const;
  double blended(const Leaf& leaf, const Eigen::Vector3d& p, double interpolated) const;
  void write_exact(const std::vector<std::uint32_t>& brick_number, DistanceGrid& field) const;
  std::uint32_t& entry_of(std::uint32_t brick);
  bool is_looked_up(std::uint32_t brick) const;
  std::uint32_t write_entry(std::uint32_t entry, const std::vector<std::uint32_t>& number,
                            std::vector<format::Refined>& refined) const;

  const DistanceGrid& field_;
  Eigen::Vector3d origin_;
  double voxel_size_;
  BrickLattice lattice_;
  std::vector<std::uint32_t> index_;
  std::vector<format::Refined> refined_;  ///< with this tree's numbers of bricks and refinements
  std::vector<Place> places_;
  std::vector<Fine> fine_;                 ///< the bricks of halved octants
  std::vector<Brick> own_;                 ///< the positions' own bricks after rounding
  std::vector<std::uint32_t> touched_;     ///< roots, since the last join
  std::vector<std::uint32_t> changed_in_;  ///< number of the last join that changed something there, by root
  std::uint32_t joins_ = 0;
  std::uint32_t forgotten_ = 0;  ///< bricks
  double quantum_ = 0.0;         ///< 0: not rounded yet [m]
  /// By key(): power of two that divides a node's value, if it is not 0.
  std::unordered_map<std::uint64_t, int> factor_;
  const SurfaceFacets& facets_;
  std::vector<std::uint64_t> exact_cells_;                ///< by brick, one bit each
  std::size_t made_exact_ = 0;                            ///< bricks that had such a cell
  std::vector<bool> refuses_;                             ///< by brick
  std::vector<bool> passes_on_;                           ///< its octants refuse too, by brick
  std::vector<std::uint64_t> weighed_;                    ///< cells for which facets were found, by brick
  std::vector<std::optional<format::ExactBrick>> exact_;  ///< by brick; without cell_facets::kWhole
  FacetSets sets_;
};

}  // namespace godobject::scene_compiler
