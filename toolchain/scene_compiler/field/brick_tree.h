#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "toolchain/scene_compiler/field/brick_lattice.h"
#include "toolchain/scene_compiler/field/distance_grid.h"
#include "toolchain/scene_compiler/field/field_slope.h"

namespace godobject::scene_compiler {

/// The bricks of a field while octants of them are halved. Bricks are numbered: first those of the field, then octants
/// in the order in which they were made. Octants that are not halved are looked up in the brick's own nodes: it stays
/// a leaf there. Places are counted in cells of the finest level ("units") from the lattice's origin.
class BrickTree {
 public:
  static constexpr std::uint32_t kNone = ~0u;
  static constexpr int kUnits = 1 << format::kMaxRefinement;  ///< along a voxel

  static constexpr std::size_t kMostAbout = 27;  ///< octants that touch a cell of the finest leaf about it

  using Units = std::array<int, 3>;

  /// One octant of a brick.
  struct Octant {
    std::uint32_t brick;
    std::uint8_t number;

    bool operator==(const Octant&) const = default;
    std::uint8_t bit() const { return static_cast<std::uint8_t>(1u << number); }
  };

  /// Where a cell is looked up: a brick, in an octant that is not halved; kNone at a position that is not stored.
  struct Leaf {
    std::uint32_t brick = kNone;
    int level = 0;
    std::uint8_t octant = 0;

    Octant where() const { return {brick, octant}; }
  };

  using Octants = std::array<Octant, kMostAbout>;

  /// `field`, which must have no refinement yet, must outlive the tree and keep still until `write`; so must `edges`,
  /// of the same surface.
  BrickTree(const DistanceGrid& field, const std::vector<format::Edge>& edges);

  std::uint32_t brick_count() const { return static_cast<std::uint32_t>(places_.size()); }
  int level(std::uint32_t brick) const { return places_[brick].level; }
  std::uint32_t root(std::uint32_t brick) const { return places_[brick].root; }
  /// Octants that are not halved.
  std::uint8_t whole(std::uint32_t brick) const { return static_cast<std::uint8_t>(~places_[brick].halved); }
  Eigen::Vector3d low(std::uint32_t brick) const;
  /// Its lowest node in units, and its level.
  std::array<int, 4> place(std::uint32_t brick) const {
    const Place& p = places_[brick];
    return {p.low[0], p.low[1], p.low[2], p.level};
  }
  double cell_edge(int level) const { return voxel_size_ / (1 << level); }

  /// Its nodes as they are, and as `join` made them.
  const Brick& exact(std::uint32_t brick) const;
  const Brick& stored(std::uint32_t brick) const;

  Units unit_cell(const Eigen::Vector3d& p) const;
  Leaf find(const Units& unit_cell) const;

  /// The field at p [m], which `leaf` holds: with the stored and with the exact nodes.
  double interpolate(const Leaf& leaf, const Eigen::Vector3d& p) const;
  double interpolate_exact(const Leaf& leaf, const Eigen::Vector3d& p) const;

  /// All octants that hold p, that of `leaf` among them. Returns how many.
  std::size_t holding(const Leaf& leaf, const Eigen::Vector3d& p, Octants& octants) const;

  /// Octants of coarser leaves than `leaf` that the nodes of its cell around p touch: `join` lets those nodes carry
  /// their values.
  std::size_t coarser_about(const Leaf& leaf, const Eigen::Vector3d& p, Octants& octants) const;

  /// Where the cells at the faces, edges and corners of a brick are looked up, outside of it: every octant of a coarser
  /// leaf that touches the brick is one, since it is as large or larger.
  std::array<Leaf, 26> leaves_about(std::uint32_t brick) const;

  /// Numbers of the edges of which some w > 0 may be in the brick.
  const std::vector<std::uint32_t>& edges_of(std::uint32_t brick) const { return edges_of_[brick]; }

  /// Adds the octants that are not halved of a brick, which names one edge at most.
  void add_slope(std::uint32_t brick, FieldSlope& slope) const;

  /// Makes bricks of those of `wanted` that are not halved yet, with the nodes of `octants`.
  void halve(std::uint32_t brick, std::uint8_t wanted, const std::array<Brick, 8>& octants);

  /// Makes the field continuous: nodes that touch something coarser take its value. Coarse to fine.
  void join();

  /// Adds `slack` [m] to all distances, clamps and rounds them as format::Brick says, to the smallest quantum in which
  /// they fit. To be called once, at the end: what `join` made stays continuous.
  void round(double slack);

  /// Into the field that the tree was made of, once it is rounded; refinements numbered as the format wants them,
  /// clearances anew.
  void write(DistanceGrid& field) const;

 private:
  struct Place {
    Units low;
    int level;
    std::uint32_t root;   ///< brick of the whole position
    std::uint8_t halved;  ///< octants
  };
  struct Fine {
    Brick exact, stored;
  };
  /// A node of one level's lattice.
  struct Node {
    Units at;
    int level;
  };

  Leaf coarsest_about(const Units& node, std::uint32_t root) const;
  void find_edges(std::uint32_t brick, const std::vector<std::uint32_t>& among);
  void join_brick(std::uint32_t brick);
  template <class Visit>
  void visit_outer_nodes_on_coarser(std::uint32_t brick, const Visit& visit) const;
  Units node_at(const Place& place, int node) const;
  static std::uint64_t key(const Node& node);
  int factor(const Node& node) const;
  void find_factors();
  void round_nodes(const Place& place, Brick& brick) const;
  double interpolate(const Place& place, const Brick& brick, const std::array<double, 3>& units) const;
  double with_edges(std::uint32_t brick, const Eigen::Vector3d& p, double interpolated) const;
  void write_edges(const std::vector<std::uint32_t>& brick_number, DistanceGrid& field) const;
  std::uint32_t& entry_of(std::uint32_t brick);
  bool is_looked_up(std::uint32_t brick) const;
  std::uint32_t write_entry(std::uint32_t entry, const std::vector<std::uint32_t>& number,
                            std::vector<format::Refined>& refined) const;

  const DistanceGrid& field_;
  Eigen::Vector3d origin_;
  double voxel_size_;
  BrickLattice lattice_;
  std::vector<std::uint32_t> index_;
  std::vector<format::Refined> refined_;  ///< with the numbers of bricks and refinements here
  std::vector<Place> places_;
  std::vector<Fine> fine_;                         ///< of the octants
  std::vector<Brick> own_;                         ///< of the positions, once they are rounded
  double quantum_ = 0.0;                           ///< 0: not rounded yet [m]
  std::unordered_map<std::uint64_t, int> factor_;  ///< by key(): powers of two that divide a node, where it is not 0
  const std::vector<format::Edge>& edges_;
  std::vector<std::vector<std::uint32_t>> edges_of_;  ///< by brick
};

}  // namespace godobject::scene_compiler
