#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "toolchain/scene_compiler/brick_lattice.h"
#include "toolchain/scene_compiler/distance_grid.h"
#include "toolchain/scene_compiler/field_slope.h"

namespace godobject::scene_compiler {

/// The bricks of a field while they are halved. Bricks are numbered: first those of the field, then octants in the
/// order in which they were made. Places are counted in cells of the finest level ("units") from the lattice's origin.
class BrickTree {
 public:
  static constexpr std::uint32_t kNone = ~0u;
  static constexpr int kUnits = 1 << format::kMaxRefinement;  ///< along a voxel

  static constexpr std::size_t kMostAbout = 27;  ///< leaves that touch a cell of the finest of them

  using Units = std::array<int, 3>;

  /// A brick that is not halved; kNone at a position that is not stored.
  struct Leaf {
    std::uint32_t brick = kNone;
    int level = 0;
  };

  /// `field`, which must have no refinement yet, must outlive the tree and keep still until `write`; so must `edges`,
  /// of the same surface.
  BrickTree(const DistanceGrid& field, const std::vector<format::Edge>& edges);

  std::uint32_t brick_count() const { return static_cast<std::uint32_t>(places_.size()); }
  int level(std::uint32_t brick) const { return places_[brick].level; }
  std::uint32_t root(std::uint32_t brick) const { return places_[brick].root; }
  bool is_leaf(std::uint32_t brick) const { return !places_[brick].halved; }
  Eigen::Vector3d low(std::uint32_t brick) const;
  /// Its lowest node in units, and its level.
  std::array<int, 4> place(std::uint32_t brick) const {
    const Place& p = places_[brick];
    return {p.low[0], p.low[1], p.low[2], p.level};
  }
  double cell_edge(int level) const { return voxel_size_ / (1 << level); }

  /// Its nodes as they are, and as `join` made them.
  const format::Brick& exact(std::uint32_t brick) const;
  const format::Brick& stored(std::uint32_t brick) const;

  Units unit_cell(const Eigen::Vector3d& p) const;
  Leaf find(const Units& unit_cell) const;

  /// The field at p [m], which `leaf` holds: with the stored and with the exact nodes.
  double interpolate(const Leaf& leaf, const Eigen::Vector3d& p) const;
  double interpolate_exact(const Leaf& leaf, const Eigen::Vector3d& p) const;

  /// All leaves that hold p, `leaf` among them. Returns how many.
  std::size_t holding(const Leaf& leaf, const Eigen::Vector3d& p, std::array<std::uint32_t, kMostAbout>& bricks) const;

  /// Leaves coarser than `leaf` that the nodes of its cell around p touch: `join` lets those nodes carry their values.
  std::size_t coarser_about(const Leaf& leaf, const Eigen::Vector3d& p,
                            std::array<std::uint32_t, kMostAbout>& bricks) const;

  /// The leaves at the eight corners about a brick, outside of it: every leaf coarser than it that touches it is one.
  std::array<Leaf, 8> leaves_about(std::uint32_t brick) const;

  /// Numbers of the edges of which some w > 0 may be in the brick.
  const std::vector<std::uint32_t>& edges_of(std::uint32_t brick) const { return edges_of_[brick]; }

  /// Adds the leaf, which names one edge at most.
  void add_slope(std::uint32_t brick, FieldSlope& slope) const;

  void halve(std::uint32_t brick, const std::array<format::Brick, 8>& octants);

  /// Makes the field continuous: nodes that touch something coarser take its value. Coarse to fine.
  void join();

  /// Into the field that the tree was made of; refinements numbered as the format wants them, clearances anew.
  void write(DistanceGrid& field) const;

 private:
  struct Place {
    Units low;
    int level;
    std::uint32_t root;  ///< brick of the whole position
    bool halved;
  };
  struct Fine {
    format::Brick exact, stored;
  };

  Leaf coarsest_about(const Units& node, std::uint32_t root) const;
  void find_edges(std::uint32_t brick, const std::vector<std::uint32_t>& among);
  void join_brick(std::uint32_t brick);
  double interpolate(const Place& place, const format::Brick& brick, const std::array<double, 3>& units) const;
  double with_edges(std::uint32_t brick, const Eigen::Vector3d& p, double interpolated) const;
  void write_edges(DistanceGrid& field) const;
  std::uint32_t& entry_of(std::uint32_t brick);
  std::uint32_t write_entry(std::uint32_t entry, std::vector<format::Refined>& refined) const;

  const DistanceGrid& field_;
  Eigen::Vector3d origin_;
  double voxel_size_;
  BrickLattice lattice_;
  std::vector<std::uint32_t> index_;
  std::vector<format::Refined> refined_;
  std::vector<Place> places_;
  std::vector<Fine> fine_;  ///< of the octants
  const std::vector<format::Edge>& edges_;
  std::vector<std::vector<std::uint32_t>> edges_of_;  ///< by brick
};

}  // namespace godobject::scene_compiler
