#include "toolchain/scene_compiler/field/clearance_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "toolchain/parallel/parallel.h"
#include "toolchain/scene_compiler/field/distance_transform.h"
#include "toolchain/scene_compiler/field/field_slope.h"

namespace godobject::scene_compiler {
namespace {

using Eigen::Vector3d;
using format::kBrickCells;
namespace index_entry = format::index_entry;

/// Factor by which the Lipschitz constant may change from one position to the next. Measured: of 1.25, 1.5 and 2 it
/// takes the fewest instructions with an ear and a foot of the bunny on the teapot.
constexpr double kClearanceSlope = 1.5;

/// Facts about the leaves of one position.
struct PositionFacts {
  double smooth = 0.0;     ///< slope off seams
  double seamed = 0.0;     ///< slope with seams
  double deviation = 0.0;  ///< from the position's own nodes [m]
};

/// A position: its own nodes, and the place of the lowest one [m].
struct Position {
  const Brick& own;
  Vector3d low;
};

/// Returns the interpolated value at `at` [cells of the position].
double interpolated(const Brick& brick, const Vector3d& at) {
  const Vector3d cell = at.array().floor().max(0.0).min(kBrickCells - 1.0);
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3d side(corner & 1, corner >> 1 & 1, corner >> 2);
    const Vector3d node = cell + side;
    const Vector3d share = Vector3d::Ones() - (at - node).cwiseAbs();
    sum += share.prod() * static_cast<double>(brick.value[static_cast<int>(
                              node.x() + format::kBrickNodes * (node.y() + format::kBrickNodes * node.z()))]);
  }
  return sum;
}

class ClearanceBounds {
 public:
  explicit ClearanceBounds(DistanceGrid& field)
      : field_(field),
        lattice_{{field.grid.bricks[0], field.grid.bricks[1], field.grid.bricks[2]}},
        origin_(field.grid.origin[0], field.grid.origin[1], field.grid.origin[2]),
        steepest_(lattice_.count(), 1.0) {}

  void run() {
    measure();
    // first the largest slope around each position; then limit its change from one position to the next
    steepest_ = largest_about();
    spread();
    for (double& steepest : steepest_) steepest = static_cast<double>(as_stored(steepest));
    for (std::size_t i = 0; i < lattice_.count(); ++i) {
      if (is_stored(i)) set_lipschitz(field_.index[i], static_cast<float>(steepest_[i]));
    }
    field_.grid.clearance_slope = kClearanceSlope;
    field_.grid.outside_loss = outside_loss();
    write_far();
  }

 private:
  bool is_stored(std::size_t i) const { return (field_.index[i] & index_entry::kFar) == 0; }

  void measure() {
    for (Brick& brick : field_.bricks) brick.deviation = 0.0f;
    std::vector<PositionFacts> facts(lattice_.count());
    parallel::for_each_index(facts.size(), [&](std::size_t i) {
      if (!is_stored(i)) return;
      const double s = field_.grid.voxel_size;
      const BrickPosition p = lattice_.position(i);
      const Position position{field_.bricks[own(i)], origin_ + kBrickCells * s * Vector3d(p[0], p[1], p[2])};
      add_leaves(field_.index[i], position, position.low, s, facts[i]);
    });
    double smooth = 0.0;
    double seamed = 0.0;
    for (std::size_t i = 0; i < facts.size(); ++i) {
      smooth = std::max(smooth, facts[i].smooth);
      seamed = std::max(seamed, facts[i].seamed);
      steepest_[i] = std::max(1.0, facts[i].seamed);
      if (is_stored(i)) field_.bricks[own(i)].deviation = rounded_up(facts[i].deviation);
    }
    field_.grid.lipschitz = static_cast<double>(rounded_up(smooth));
    field_.grid.lipschitz_seam = static_cast<double>(as_stored(std::max(1.0, seamed)));  // no brick has more
  }

  /// Returns the brick of a stored position's own nodes.
  std::uint32_t own(std::size_t i) const {
    const std::uint32_t number = field_.index[i] & index_entry::kNumber;
    return (field_.index[i] & index_entry::kRefined) != 0 ? field_.refined[number].brick : number;
  }

  static float rounded_up(double value) {
    return value == 0.0 ? 0.0f
                        : std::nextafter(static_cast<float>(value * (1.0 + 1e-6)), std::numeric_limits<float>::max());
  }

  /// Returns Brick::lipschitz, rounded up to a value that the image can store.
  static float as_stored(double lipschitz) {
    const float rounded = rounded_up(lipschitz);
    if (rounded > format::kLargestLipschitz) return rounded;  // packed_bricks refuses it
    return format::decode_lipschitz(format::encode_lipschitz(rounded));
  }

  void add_leaves(std::uint32_t entry, const Position& position, const Vector3d& low, double cell_edge,
                  PositionFacts& facts) const {
    std::uint32_t number = entry & index_entry::kNumber;
    std::uint8_t octants = kAllOctants;
    if ((entry & index_entry::kRefined) != 0) {
      const format::Refined& refined = field_.refined[number];
      octants = 0;
      for (unsigned octant = 0; octant < 8; ++octant) {
        if ((refined.child[octant] & index_entry::kCoarse) != 0) {
          octants = static_cast<std::uint8_t>(octants | 1u << octant);
          continue;
        }
        const Vector3d side(octant & 1, octant >> 1 & 1, octant >> 2);
        add_leaves(refined.child[octant], position, low + 0.5 * kBrickCells * cell_edge * side, 0.5 * cell_edge, facts);
      }
      if (octants == 0) return;
      number = refined.brick;
    }
    double deviation = 0.0;
    FieldSlope of_leaf(cell_edge, 2.0 * format::kMostRoundedOff * field_.grid.quantum);
    const Brick& brick = field_.bricks[number];
    if (brick.exact == 0) {
      of_leaf.add(brick, octants);
    } else {
      const format::ExactBrick& exact = field_.exact[brick.exact - 1];
      deviation = of_leaf.add(brick, octants, exact, field_.facet_lists(), field_.grid.facet_offset, low);
    }
    // refined bricks have no seam: refinement leaves seams alone
    const bool halved = cell_edge < field_.grid.voxel_size;
    facts.smooth = std::max(facts.smooth, halved ? of_leaf.largest_with_seams() : of_leaf.largest());
    facts.seamed = std::max(facts.seamed, of_leaf.largest_with_seams());
    double off_own = 0.0;
    if (halved) {
      // trilinear in each of the leaf's cells, so largest at their nodes
      for_each_cell(brick, octants, [&](const CellEdges&, int x, int y, int z) {
        for (int corner = 0; corner < 8; ++corner) {
          const Vector3d at(x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2));
          const Vector3d cells = (low - position.low + cell_edge * at) / field_.grid.voxel_size;
          const auto node = static_cast<int>(at.x() + format::kBrickNodes * (at.y() + format::kBrickNodes * at.z()));
          off_own =
              std::max(off_own, std::abs(static_cast<double>(brick.value[node]) - interpolated(position.own, cells)));
        }
      });
    }
    facts.deviation = std::max(facts.deviation, off_own + deviation);
  }

  template <class Visit>
  void visit_about(const BrickPosition& p, const Visit& visit) const {
    for (int z = -1; z <= 1; ++z) {
      for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
          const BrickPosition q = moved(p, {x, y, z});
          if (lattice_.contains(q)) visit(lattice_.number(q));
        }
      }
    }
  }

  std::vector<double> largest_about() const {
    std::vector<double> largest(steepest_.size());
    parallel::for_each_index(largest.size(), [&](std::size_t i) {
      double most = 1.0;
      visit_about(lattice_.position(i), [&](std::size_t j) { most = std::max(most, steepest_[j]); });
      largest[i] = most;
    });
    return largest;
  }

  /// Limits the change of the slope by one forward and one backward pass, which is exact for steps to the 26
  /// neighbours.
  void spread() {
    constexpr double kStep = kClearanceSlope * (1.0 - 1e-3);  // smaller, because slopes are stored rounded up
    const auto take = [&](std::size_t i, bool forward) {
      visit_about(lattice_.position(i), [&](std::size_t j) {
        if (forward ? j < i : j > i) steepest_[i] = std::max(steepest_[i], steepest_[j] / kStep);
      });
    };
    for (std::size_t i = 0; i < steepest_.size(); ++i) take(i, true);
    for (std::size_t i = steepest_.size(); i-- > 0;) take(i, false);
  }

  void set_lipschitz(std::uint32_t entry, float lipschitz) {
    const std::uint32_t number = entry & index_entry::kNumber;
    if ((entry & index_entry::kRefined) == 0) {
      field_.bricks[number].lipschitz = lipschitz;
      return;
    }
    const format::Refined& refined = field_.refined[number];
    if (refined.brick != format::kNoBrick) field_.bricks[refined.brick].lipschitz = lipschitz;
    for (const std::uint32_t child : refined.child) {
      if ((child & index_entry::kCoarse) == 0) set_lipschitz(child, lipschitz);
    }
  }

  /// Returns the least distance of each position's centre to the bricks of `set` [m]. `set` must not be empty.
  std::vector<double> gaps(const std::vector<bool>& set) const {
    std::vector<bool> touching(set.size());
    for (std::size_t i = 0; i < set.size(); ++i) {
      if (set[i]) visit_about(lattice_.position(i), [&](std::size_t j) { touching[j] = true; });
    }
    const std::vector<float> squared = squared_distance_transform(lattice_, touching);
    std::vector<double> gap(set.size());
    for (std::size_t i = 0; i < gap.size(); ++i) {
      const double brick_to_brick = kBrickCells * std::sqrt(static_cast<double>(squared[i])) * (1.0 - 1e-6);
      // the centre of a brick outside the set is half an edge farther away
      gap[i] = field_.grid.voxel_size * (brick_to_brick + (set[i] ? 0.0 : 0.5 * kBrickCells));
    }
    return gap;
  }

  /// A far entry E must hold for x at any t from the position's centre (format::index_entry). With C the bound of the
  /// field, l the Lipschitz constant at x and k the slope:
  ///         (C - t) / l >= (E - t) / k.
  /// If l <= k, E = C holds. Otherwise E <= C k / l + t (1 - k / l), which is least at the smallest t, the distance g
  /// of such bricks:
  ///         E = C - (1 - k / l) (C - g)   if g < C,
  /// for l from k up in steps.
  void write_far() {
    constexpr double kStep = 1.5;
    std::vector<double> known = field_.far_clearance;
    for (double& free : known) free = std::max(0.0, free - format::kMostRoundedOff * field_.grid.quantum);
    std::vector<double> clearance = known;
    for (double above = kClearanceSlope;; above *= kStep) {
      std::vector<bool> steep(lattice_.count());
      for (std::size_t i = 0; i < steep.size(); ++i) steep[i] = is_stored(i) && steepest_[i] > above;
      if (std::none_of(steep.begin(), steep.end(), [](bool b) { return b; })) break;
      const std::vector<double> gap = gaps(steep);
      for (std::size_t i = 0; i < steep.size(); ++i) {
        const double free = known[i];
        clearance[i] =
            std::min(clearance[i], free - (1.0 - kClearanceSlope / (kStep * above)) * std::max(0.0, free - gap[i]));
      }
    }
    for (std::size_t i = 0; i < lattice_.count(); ++i) {
      if (is_stored(i) || (field_.index[i] & index_entry::kInside) != 0) continue;
      field_.index[i] = index_entry::encode_far(false, static_cast<float>(clearance[i] * (1.0 - 1e-6)));
    }
  }

  /// Returns the loss of clearance outside the grid. At D from the surface's box, a brick that extends out of that box
  /// by b is at least D - b away. There the entry E of write_far is at least
  ///         C - (1 - k / l) b.
  /// So the loss is the largest one of any brick steeper than the slope.
  double outside_loss() const {
    double most = 0.0;
    for (std::size_t i = 0; i < lattice_.count(); ++i) {
      if (!is_stored(i) || !(steepest_[i] > kClearanceSlope)) continue;
      const BrickPosition p = lattice_.position(i);
      double squared = 0.0;
      for (int axis = 0; axis < 3; ++axis) {
        const double edge = kBrickCells * field_.grid.voxel_size;
        const double low = origin_[axis] + edge * p[static_cast<std::size_t>(axis)];
        const double out =
            std::max({field_.grid.surface_min[axis] - low, low + edge - field_.grid.surface_max[axis], 0.0});
        squared += out * out;
      }
      most = std::max(most, (1.0 - kClearanceSlope / steepest_[i]) * std::sqrt(squared));
    }
    return most * (1.0 + 1e-6);
  }

  DistanceGrid& field_;
  BrickLattice lattice_;
  Vector3d origin_;
  std::vector<double> steepest_;  ///< of each position, at least 1
};

}  // namespace

void bound_clearances(DistanceGrid& field) { ClearanceBounds(field).run(); }

}  // namespace godobject::scene_compiler
