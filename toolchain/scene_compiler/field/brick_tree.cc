#include "toolchain/scene_compiler/field/brick_tree.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/scene/facets.h"
#include "toolchain/parallel/parallel.h"
#include "toolchain/scene_compiler/field/cell_edges.h"
#include "toolchain/scene_compiler/field/clearance_bounds.h"
#include "toolchain/scene_compiler/field/exact_bricks.h"

namespace godobject::scene_compiler {
namespace {

using Eigen::Vector3d;
using format::kBrickCells;
using format::kBrickNodes;
using format::kBrickValues;

constexpr int kPositionUnits = BrickTree::kUnits * kBrickCells;

int brick_units(int level) { return kPositionUnits >> level; }
int cell_units(int level) { return BrickTree::kUnits >> level; }

constexpr std::size_t kItself = 13;  // of a cell's 27 neighbours

int position_of(int unit) { return unit >= 0 ? unit / kPositionUnits : -1; }

/// Returns the octant of a brick of `level` that contains the unit cell.
std::uint8_t octant_at(const BrickTree::Units& unit_cell, int level) {
  const int half = brick_units(level + 1);
  unsigned octant = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) octant |= static_cast<unsigned>(unit_cell[axis] / half & 1) << axis;
  return static_cast<std::uint8_t>(octant);
}

bool is_coarse(std::uint32_t child) { return (child & format::index_entry::kCoarse) != 0; }

unsigned octant_of(int cell) {
  return octant_of_cell(cell % kBrickCells, cell / kBrickCells % kBrickCells, cell / (kBrickCells * kBrickCells));
}

/// Returns the cells of octants, one bit each.
std::uint64_t cells_of_octants(std::uint8_t octants) {
  std::uint64_t cells = 0;
  for (int cell = 0; cell < format::kCellsPerBrick; ++cell) {
    if ((octants >> octant_of(cell) & 1) != 0) cells |= std::uint64_t{1} << cell;
  }
  return cells;
}

std::array<int, 3> steps_of_node(int node) {
  return {node % kBrickNodes, node / kBrickNodes % kBrickNodes, node / (kBrickNodes * kBrickNodes)};
}

/// Returns the cells of a brick that share a node, one bit each.
std::uint64_t cells_about(int node) {
  static const auto kTable = [] {
    std::array<std::uint64_t, kBrickValues> table{};
    for (int i = 0; i < kBrickValues; ++i) {
      for (int corner = 0; corner < 8; ++corner) {
        int number = 0;
        bool within = true;
        for (std::size_t axis = 3; axis-- > 0;) {
          const int cell = steps_of_node(i)[axis] - (corner >> axis & 1);
          within = within && cell >= 0 && cell < kBrickCells;
          number = kBrickCells * number + cell;
        }
        if (within) table[static_cast<std::size_t>(i)] |= std::uint64_t{1} << number;
      }
    }
    return table;
  }();
  return kTable[static_cast<std::size_t>(node)];
}

/// Finishes the words of a brick's cells. Cells that have a weight but are not looked up get the first set of the
/// others.
format::ExactBrick with_words(format::ExactBrick exact) {
  std::uint64_t weighed = 0;
  std::uint64_t not_whole = 0;
  for (int i = 0; i < kBrickValues; ++i) {
    if (exact.weight[i] != 0) weighed |= cells_about(i);
    if (exact.weight[i] != format::kOneWeight) not_whole |= cells_about(i);
  }
  const auto first = std::find_if(std::begin(exact.cell), std::end(exact.cell), [](auto word) { return word != 0; });
  const std::uint32_t any = *first;
  for (int cell = 0; cell < format::kCellsPerBrick; ++cell) {
    const std::uint32_t set = exact.cell[cell] != 0 ? exact.cell[cell] : any;
    const std::uint32_t whole = (not_whole >> cell & 1) == 0 ? format::cell_facets::kWhole : 0;
    exact.cell[cell] = (weighed >> cell & 1) != 0 ? set | whole : 0;
  }
  return exact;
}

/// Appends the octant if it is not among `octants` yet.
void add(const BrickTree::Octant& octant, BrickTree::Octants& octants, std::size_t& count) {
  const auto end = octants.begin() + static_cast<std::ptrdiff_t>(count);
  if (std::find(octants.begin(), end, octant) == end) octants[count++] = octant;
}

}  // namespace

BrickTree::BrickTree(const DistanceGrid& field, const SurfaceFacets& facets)
    : field_(field),
      origin_(field.grid.origin[0], field.grid.origin[1], field.grid.origin[2]),
      voxel_size_(field.grid.voxel_size),
      lattice_{{field.grid.bricks[0], field.grid.bricks[1], field.grid.bricks[2]}},
      index_(field.index),
      places_(field.bricks.size()),
      changed_in_(field.bricks.size()),
      facets_(facets),
      exact_cells_(field.bricks.size()),
      refuses_(field.beside_seam),
      passes_on_(field.bricks.size()),
      weighed_(field.bricks.size()),
      exact_(field.bricks.size()) {
  refuses_.resize(field.bricks.size());
  for (std::size_t i = 0; i < index_.size(); ++i) {
    if ((index_[i] & format::index_entry::kFar) != 0) continue;
    const std::uint32_t brick = index_[i] & format::index_entry::kNumber;
    const BrickPosition p = lattice_.position(i);
    places_[brick] = {{kPositionUnits * p[0], kPositionUnits * p[1], kPositionUnits * p[2]}, 0, brick, 0};
  }
}

double BrickTree::blended(const Leaf& leaf, const Vector3d& p, double interpolated) const {
  if (!exact_[leaf.brick]) return interpolated;
  const format::ExactBrick& exact = *exact_[leaf.brick];
  const std::uint32_t word = exact.cell[cell_of(leaf, p)];
  if (word == 0) return interpolated;
  const Vector3d units = (p - origin_) * (kUnits / voxel_size_);
  const double weight =
      interpolate(places_[leaf.brick], exact.weight, {units[0], units[1], units[2]}) / format::kOneWeight;
  if (weight <= 0.0) return interpolated;
  return interpolated + weight * (facet_distance(facet_lists(), word - 1, p).value - interpolated);
}

void BrickTree::add_slope(std::uint32_t brick, double slack, double enough, FieldSlope& slope) const {
  if (!exact_[brick]) return slope.add(stored(brick), whole(brick));
  Brick smaller = stored(brick);
  for (float& value : smaller.value) value += static_cast<float>(slack);
  slope.add(smaller, whole(brick), *exact_[brick], facet_lists(), slack, low(brick), enough);
}

bool BrickTree::turns_about(const Leaf& leaf, const Vector3d& p) const {
  const double edge = cell_edge(leaf.level);
  const auto near = facets_.near(cell_center(leaf.brick, cell_of(leaf, p)), 0.5 * edge);
  return near && facets_.turns(*near);
}

int BrickTree::cell_of(const Leaf& leaf, const Vector3d& p) const {
  constexpr int kHalf = kBrickCells / 2;
  const Vector3d cells = (p - low(leaf.brick)) / cell_edge(leaf.level);
  int number = 0;
  for (int axis = 2; axis >= 0; --axis) {
    const int first = kHalf * (leaf.octant >> axis & 1);
    number = kBrickCells * number + std::clamp(static_cast<int>(cells[axis]), first, first + kHalf - 1);
  }
  return number;
}

Vector3d BrickTree::cell_center(std::uint32_t brick, int cell) const {
  const Vector3d at(cell % kBrickCells, cell / kBrickCells % kBrickCells, cell / (kBrickCells * kBrickCells));
  return low(brick) + cell_edge(level(brick)) * (at + Vector3d::Constant(0.5));
}

void BrickTree::make_exact(std::uint32_t brick, std::uint64_t cells) {
  // of the bricks that an image can name, because those that share a node with one of these become exact too
  constexpr std::size_t kMost = format::kLargestUnsigned / 4;
  if (refuses_[brick] || (exact_cells_[brick] | cells) == exact_cells_[brick]) return;
  if (exact_cells_[brick] == 0 && ++made_exact_ > kMost) return refuse(brick);
  exact_cells_[brick] |= cells;
  touch(brick);
}

void BrickTree::refuse(std::uint32_t brick) {
  refuses_[brick] = true;
  passes_on_[brick] = true;
  exact_cells_[brick] = 0;
  touch(brick);
}

Vector3d BrickTree::low(std::uint32_t brick) const {
  const Units& low = places_[brick].low;
  return origin_ + voxel_size_ / kUnits * Vector3d(low[0], low[1], low[2]);
}

const Brick& BrickTree::exact(std::uint32_t brick) const {
  return brick < field_.bricks.size() ? field_.bricks[brick] : fine_[brick - field_.bricks.size()].exact;
}

const Brick& BrickTree::stored(std::uint32_t brick) const {
  if (brick >= field_.bricks.size()) return fine_[brick - field_.bricks.size()].stored;
  return own_.empty() ? field_.bricks[brick] : own_[brick];
}

BrickTree::Units BrickTree::unit_cell(const Vector3d& p) const {
  const Vector3d units = (p - origin_) * (kUnits / voxel_size_);
  return {static_cast<int>(std::floor(units[0])), static_cast<int>(std::floor(units[1])),
          static_cast<int>(std::floor(units[2]))};
}

BrickTree::Leaf BrickTree::find(const Units& unit_cell) const {
  const BrickPosition position = {position_of(unit_cell[0]), position_of(unit_cell[1]), position_of(unit_cell[2])};
  if (!lattice_.contains(position)) return {};
  std::uint32_t entry = index_[lattice_.number(position)];
  if ((entry & format::index_entry::kFar) != 0) return {};
  int level = 0;
  while ((entry & format::index_entry::kRefined) != 0) {
    const format::Refined& refined = refined_[entry & format::index_entry::kNumber];
    const std::uint8_t octant = octant_at(unit_cell, level);
    if (is_coarse(refined.child[octant])) return {refined.brick, level, octant};
    entry = refined.child[octant];
    ++level;
  }
  return {entry & format::index_entry::kNumber, level, octant_at(unit_cell, level)};
}

template <class Values>
double BrickTree::interpolate(const Place& place, const Values& nodes, const std::array<double, 3>& units) const {
  const auto* corner = std::begin(nodes);
  std::array<double, 3> at{};
  constexpr std::array<int, 3> kStride = {1, kBrickNodes, kBrickNodes * kBrickNodes};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double cells = (units[axis] - place.low[axis]) / cell_units(place.level);
    const int cell = std::clamp(static_cast<int>(cells), 0, kBrickCells - 1);
    at[axis] = cells - cell;
    corner += kStride[axis] * cell;
  }
  double sum = 0.0;
  for (int c = 0; c < 8; ++c) {
    const double weight = ((c & 1) != 0 ? at[0] : 1.0 - at[0]) * ((c & 2) != 0 ? at[1] : 1.0 - at[1]) *
                          ((c & 4) != 0 ? at[2] : 1.0 - at[2]);
    sum +=
        weight * static_cast<double>(corner[kStride[0] * (c & 1) + kStride[1] * (c >> 1 & 1) + kStride[2] * (c >> 2)]);
  }
  return sum;
}

double BrickTree::interpolate(const Leaf& leaf, const Vector3d& p) const {
  const Vector3d units = (p - origin_) * (kUnits / voxel_size_);
  return blended(leaf, p, interpolate(places_[leaf.brick], stored(leaf.brick).value, {units[0], units[1], units[2]}));
}

double BrickTree::interpolate_exact(const Leaf& leaf, const Vector3d& p) const {
  const Vector3d units = (p - origin_) * (kUnits / voxel_size_);
  return blended(leaf, p, interpolate(places_[leaf.brick], exact(leaf.brick).value, {units[0], units[1], units[2]}));
}

std::size_t BrickTree::holding(const Leaf& leaf, const Vector3d& p, Octants& octants) const {
  constexpr double kTouching = 1e-6;  // [cells]
  std::size_t count = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3d side((corner & 1) != 0 ? 1.0 : -1.0, (corner & 2) != 0 ? 1.0 : -1.0, (corner & 4) != 0 ? 1.0 : -1.0);
    const Leaf about = find(unit_cell(p + kTouching * cell_edge(leaf.level) * side));
    if (about.brick != kNone) add(about.where(), octants, count);
  }
  return count;
}

std::size_t BrickTree::coarser_about(const Leaf& leaf, const Vector3d& p, Octants& octants) const {
  const Units unit = unit_cell(p);
  const int edge = cell_units(leaf.level);
  std::size_t count = 0;
  for (int neighbour = 0; neighbour < 27; ++neighbour) {
    const std::array<int, 3> step = {neighbour % 3 - 1, neighbour / 3 % 3 - 1, neighbour / 9 - 1};
    Units cell{};
    for (std::size_t axis = 0; axis < 3; ++axis) cell[axis] = unit[axis] + edge * step[axis];
    const Leaf about = find(cell);
    if (about.brick != kNone && about.level < leaf.level) add(about.where(), octants, count);
  }
  return count;
}

std::array<BrickTree::Leaf, 26> BrickTree::leaves_about(std::uint32_t brick) const {
  const Place& place = places_[brick];
  std::array<Leaf, 26> leaves;
  std::size_t count = 0;
  for (int neighbour = 0; neighbour < 27; ++neighbour) {
    if (neighbour == static_cast<int>(kItself)) continue;
    const std::array<int, 3> step = {neighbour % 3 - 1, neighbour / 3 % 3 - 1, neighbour / 9 - 1};
    Units cell = place.low;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (step[axis] != 0) cell[axis] += step[axis] > 0 ? brick_units(place.level) : -1;
    }
    leaves[count++] = find(cell);
  }
  return leaves;
}

std::uint32_t& BrickTree::entry_of(std::uint32_t brick) {
  const Place& place = places_[brick];
  std::uint32_t* entry = &index_[lattice_.number(
      {place.low[0] / kPositionUnits, place.low[1] / kPositionUnits, place.low[2] / kPositionUnits})];
  for (int level = 0; level < place.level; ++level) {
    entry = &refined_[*entry & format::index_entry::kNumber].child[octant_at(place.low, level)];
  }
  return *entry;
}

void BrickTree::halve(std::uint32_t brick, std::uint8_t wanted, const std::array<Brick, 8>& octants) {
  if (places_[brick].halved == 0) {
    entry_of(brick) = format::index_entry::kRefined | static_cast<std::uint32_t>(refined_.size());
    format::Refined& whole = refined_.emplace_back();
    whole.brick = brick;
    std::fill(std::begin(whole.child), std::end(whole.child), format::index_entry::kCoarse);
  }
  format::Refined& refined = refined_[entry_of(brick) & format::index_entry::kNumber];
  for (std::size_t octant = 0; octant < 8; ++octant) {
    if ((wanted >> octant & 1) == 0 || !is_coarse(refined.child[octant])) continue;
    const Place& parent = places_[brick];
    Place place = {parent.low, parent.level + 1, parent.root, 0};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if ((octant >> axis & 1) != 0) place.low[axis] += brick_units(place.level);
    }
    refined.child[octant] = brick_count();
    places_.push_back(place);
    fine_.push_back({.exact = octants[octant], .stored = octants[octant]});
    exact_cells_.push_back(0);
    passes_on_.push_back(passes_on_[brick]);
    refuses_.push_back(passes_on_[brick] || (field_.beside_seam.size() > place.root && field_.beside_seam[place.root]));
    weighed_.push_back(0);
    exact_.emplace_back();
  }
  places_[brick].halved = static_cast<std::uint8_t>(places_[brick].halved | wanted);
  exact_cells_[brick] &= cells_of_octants(whole(brick));
  touch(brick);
}

void BrickTree::forget_about(const std::vector<std::uint32_t>& roots) {
  constexpr int kPositions = 2;  // a finer brick may have been wanted for the sake of one in the next position
  std::vector<char> forgotten(field_.bricks.size());
  for (const std::uint32_t root : roots) {
    const Units& low = places_[root].low;
    const BrickPosition own = {low[0] / kPositionUnits, low[1] / kPositionUnits, low[2] / kPositionUnits};
    for (int z = -kPositions; z <= kPositions; ++z) {
      for (int y = -kPositions; y <= kPositions; ++y) {
        for (int x = -kPositions; x <= kPositions; ++x) {
          const std::uint32_t about = root_at(moved(own, {x, y, z}));
          if (about != kNone) forgotten[about] = 1;
        }
      }
    }
  }
  for (std::uint32_t b = 0; b < brick_count(); ++b) {
    if (forgotten[places_[b].root] != 0) forget_contents(b);
  }
}

void BrickTree::forget_contents(std::uint32_t brick) {
  if (exact_cells_[brick] != 0) --made_exact_;
  exact_cells_[brick] = 0;
  passes_on_[brick] = false;
  weighed_[brick] = 0;
  exact_[brick].reset();
  Place& place = places_[brick];
  if (place.level > 0) {
    if (!is_forgotten(brick)) ++forgotten_;
    place.halved = 0xff;
    refuses_[brick] = false;
    fine_[brick - field_.bricks.size()] = {.exact = {}, .stored = {}, .is_forgotten = true};
    return;
  }
  entry_of(brick) = brick;
  place.halved = 0;
  refuses_[brick] = field_.beside_seam.size() > brick && field_.beside_seam[brick];
  touch(brick);
}

/// Returns the coarsest leaf that touches a node of a brick, if one is coarser than the brick. `about`: leaves_about
/// the brick. A coarser leaf beside the brick touches the whole face, edge or corner. A position that is not stored
/// counts as coarse, with the values of the root.
BrickTree::Leaf BrickTree::coarsest_about(std::uint32_t brick, const std::array<int, 3>& node,
                                          const std::array<Leaf, 26>& about) const {
  const Place& place = places_[brick];
  Leaf coarsest{kNone, place.level};
  for (std::size_t corner = 0; corner < 8; ++corner) {
    std::size_t neighbour = 0;  // 9 (z + 1) + 3 (y + 1) + x + 1
    for (std::size_t axis = 3; axis-- > 0;) {
      const bool above = (corner >> axis & 1) != 0;
      const bool beyond = node[axis] == (above ? kBrickCells : 0);
      neighbour = 3 * neighbour + (!beyond ? 1u : above ? 2u : 0u);
    }
    if (neighbour == kItself) continue;
    const Leaf& leaf = about[neighbour < kItself ? neighbour : neighbour - 1];
    if (leaf.brick == kNone) return {place.root, 0};
    if (leaf.level < coarsest.level) coarsest = leaf;
  }
  return coarsest;
}

BrickTree::Units BrickTree::node_at(const Place& place, int node) const {
  const std::array<int, 3> steps = {node % kBrickNodes, node / kBrickNodes % kBrickNodes,
                                    node / (kBrickNodes * kBrickNodes)};
  Units at{};
  for (std::size_t axis = 0; axis < 3; ++axis) at[axis] = place.low[axis] + cell_units(place.level) * steps[axis];
  return at;
}

/// Calls visit(node, at, leaf) for each node of a brick that touches something coarser. `leaf` is the coarsest.
template <class Visit>
void BrickTree::visit_outer_nodes_on_coarser(std::uint32_t brick, const Visit& visit) const {
  const Place& place = places_[brick];
  const std::array<Leaf, 26> about = leaves_about(brick);
  const auto coarser = [&place](const Leaf& leaf) { return leaf.brick == kNone || leaf.level < place.level; };
  if (std::none_of(about.begin(), about.end(), coarser)) return;
  for (int i = 0; i < kBrickValues; ++i) {
    const std::array<int, 3> node = {i % kBrickNodes, i / kBrickNodes % kBrickNodes, i / (kBrickNodes * kBrickNodes)};
    const bool outer = std::any_of(node.begin(), node.end(), [](int n) { return n % kBrickCells == 0; });
    if (!outer) continue;
    const Leaf leaf = coarsest_about(brick, node, about);
    if (leaf.level < place.level) visit(i, node_at(place, i), leaf);
  }
}

void BrickTree::join_brick(std::uint32_t brick) {
  Fine& fine = fine_[brick - field_.bricks.size()];
  fine.stored = fine.exact;
  if (quantum_ > 0.0) round_nodes(places_[brick], fine.stored);
  visit_outer_nodes_on_coarser(brick, [&](int i, const Units& at, const Leaf& leaf) {
    fine.stored.value[i] = static_cast<float>(
        interpolate(places_[leaf.brick], stored(leaf.brick).value,
                    {static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])}));
  });
}

/// Returns kNone if the position is not stored.
std::uint32_t BrickTree::root_at(const BrickPosition& position) const {
  if (!lattice_.contains(position)) return kNone;
  const std::uint32_t entry = index_[lattice_.number(position)];
  if ((entry & format::index_entry::kFar) != 0) return kNone;
  const std::uint32_t number = entry & format::index_entry::kNumber;
  return (entry & format::index_entry::kRefined) != 0 ? refined_[number].brick : number;
}

/// Marks the touched positions and those about them. A value may come over several coarser leaves from another
/// position, but from less than a voxel away: half a voxel at the first of them, a quarter at the next.
void BrickTree::mark_changed() {
  ++joins_;
  for (const std::uint32_t root : touched_) mark_changed_about(root);
  touched_.clear();
}

void BrickTree::mark_changed_about(std::uint32_t root) {
  visit_about(root, [&](std::uint32_t about) { changed_in_[about] = joins_; });
}

/// Calls visit(brick) for the position of a root and those about it.
template <class Visit>
void BrickTree::visit_about(std::uint32_t root, const Visit& visit) const {
  const Units& low = places_[root].low;
  for (int neighbour = 0; neighbour < 27; ++neighbour) {
    const BrickPosition step = {neighbour % 3 - 1, neighbour / 3 % 3 - 1, neighbour / 9 - 1};
    const BrickPosition own = {low[0] / kPositionUnits, low[1] / kPositionUnits, low[2] / kPositionUnits};
    const std::uint32_t about = root_at(moved(own, step));
    if (about != kNone) visit(about);
  }
}

std::uint32_t BrickTree::changed_in(const Vector3d& low, const Vector3d& high) const {
  const Units first = unit_cell(low);
  const Units last = unit_cell(high);
  std::uint32_t latest = 0;
  for (int z = position_of(first[2]); z <= position_of(last[2]); ++z) {
    for (int y = position_of(first[1]); y <= position_of(last[1]); ++y) {
      for (int x = position_of(first[0]); x <= position_of(last[0]); ++x) {
        const std::uint32_t root = root_at({x, y, z});
        if (root != kNone) latest = std::max(latest, changed_in_[root]);
      }
    }
  }
  return latest;
}

void BrickTree::join() {
  spread_exact_cells();
  mark_changed();
  const bool all = quantum_ > 0.0;  // rounding changes every position
  for (int level = 1; level <= format::kMaxRefinement; ++level) {
    std::vector<std::uint32_t> bricks;
    for (std::uint32_t b = 0; b < brick_count(); ++b) {
      const bool changed = all || changed_in_[places_[b].root] == joins_;
      if (places_[b].level == level && changed && !is_forgotten(b)) bricks.push_back(b);
    }
    parallel::for_each_index(bricks.size(), [&](std::size_t i) { join_brick(bricks[i]); });
  }
  weigh();
}

/// A node of an exact cell that touches a coarser leaf takes its weight from there. So the leaf's cells about that node
/// must be exact too. Fine to coarse.
void BrickTree::spread_exact_cells() {
  std::vector<char> about_touched(field_.bricks.size());
  std::size_t marked = 0;
  const auto mark_touched = [&] {
    for (; marked < touched_.size(); ++marked) {
      visit_about(touched_[marked], [&](std::uint32_t about) { about_touched[about] = 1; });
    }
  };
  for (int level = format::kMaxRefinement; level > 0; --level) {
    mark_touched();
    for (std::uint32_t b = 0; b < brick_count(); ++b) {
      if (places_[b].level != level || exact_cells_[b] == 0 || about_touched[places_[b].root] == 0) continue;
      const std::uint64_t cells = exact_cells_[b];
      visit_outer_nodes_on_coarser(b, [&](int i, const Units& at, const Leaf&) {
        if ((cells & cells_about(i)) == 0) return;
        for (int corner = 0; corner < 8; ++corner) {
          Units cell = at;
          for (std::size_t axis = 0; axis < 3; ++axis) cell[axis] -= corner >> axis & 1;
          const Leaf leaf = find(cell);
          if (leaf.brick == kNone || leaf.level >= level) continue;
          make_exact(leaf.brick, std::uint64_t{1} << cell_at(places_[leaf.brick], cell));
        }
      });
    }
  }
}

/// Weighs the nodes of bricks that may have changed. A brick that refuses takes away the weights of the nodes that it
/// shares with others: then again.
void BrickTree::weigh() {
  for (bool settled = false; !settled;) {
    std::vector<char> about_exact(field_.bricks.size());
    const std::unordered_set<std::uint64_t> nodes = nodes_of_weight_one(about_exact);
    settled = true;
    for (int level = 0; level <= format::kMaxRefinement; ++level) {
      std::vector<std::uint32_t> bricks;
      for (std::uint32_t b = 0; b < brick_count(); ++b) {
        const std::uint32_t root = places_[b].root;
        const bool changed = places_[b].level == level && changed_in_[root] == joins_;
        if (changed && (about_exact[root] != 0 || exact_[b])) bricks.push_back(b);
      }
      std::vector<std::optional<BrickFacets>> facets(bricks.size());
      parallel::for_each_index(bricks.size(), [&](std::size_t i) {
        weigh_brick(bricks[i], nodes);
        if (has_new_cells(bricks[i])) facets[i] = find_facets(bricks[i]);
      });
      for (std::size_t i = 0; i < bricks.size(); ++i) {
        if (!has_new_cells(bricks[i])) continue;
        if (facets[i]) {
          set_facets(bricks[i], *facets[i]);
          continue;
        }
        // the weight of one that refuses already comes from a coarser leaf
        if (refuses_[bricks[i]]) {
          visit_outer_nodes_on_coarser(bricks[i], [&](int, const Units&, const Leaf& leaf) { deny(leaf.brick); });
        }
        deny(bricks[i]);
        settled = false;
      }
    }
  }
}

/// Makes a brick refuse while bricks are weighed.
void BrickTree::deny(std::uint32_t brick) {
  refuses_[brick] = true;
  exact_cells_[brick] = 0;
  mark_changed_about(places_[brick].root);
}

/// Returns the nodes of exact cells, by place, without those of bricks that refuse: all that changed positions have.
/// Marks the positions about exact cells in `about_exact`.
std::unordered_set<std::uint64_t> BrickTree::nodes_of_weight_one(std::vector<char>& about_exact) const {
  std::vector<char> about_changed(field_.bricks.size());
  for (std::uint32_t root = 0; root < about_changed.size(); ++root) {
    if (changed_in_[root] != joins_) continue;
    visit_about(root, [&](std::uint32_t about) { about_changed[about] = 1; });
  }
  std::unordered_set<std::uint64_t> nodes;
  const auto visit = [&](std::uint32_t brick, std::uint64_t cells, const auto& node) {
    for (int i = 0; i < kBrickValues; ++i) {
      if ((cells & cells_about(i)) != 0) node(key({node_at(places_[brick], i), 0}));
    }
  };
  for (std::uint32_t b = 0; b < brick_count(); ++b) {
    if (exact_cells_[b] == 0 || about_changed[places_[b].root] == 0) continue;
    visit(b, exact_cells_[b], [&](std::uint64_t place) { nodes.insert(place); });
    visit_about(places_[b].root, [&](std::uint32_t about) { about_exact[about] = 1; });
  }
  for (std::uint32_t b = 0; b < brick_count(); ++b) {
    if (!refuses_[b] || about_exact[places_[b].root] == 0) continue;
    // also those of coarser leaves that its outer nodes would take weights from
    visit_outer_nodes_on_coarser(b, [&](int, const Units& at, const Leaf& leaf) {
      visit_corners(at, leaf, [&](const Units& corner) { nodes.erase(key({corner, 0})); });
    });
    visit(b, cells_of_octants(whole(b)), [&](std::uint64_t place) { nodes.erase(place); });
  }
  return nodes;
}

/// `nodes`: those of weight 1, by key() at level 0.
void BrickTree::weigh_brick(std::uint32_t brick, const std::unordered_set<std::uint64_t>& nodes) {
  const Place& place = places_[brick];
  format::ExactBrick exact{};
  if (exact_[brick]) exact = *exact_[brick];
  for (int i = 0; i < kBrickValues; ++i) {
    exact.weight[i] = nodes.contains(key({node_at(place, i), 0})) ? format::kOneWeight : std::uint16_t{0};
  }
  visit_outer_nodes_on_coarser(brick, [&](int i, const Units& at, const Leaf& leaf) {
    exact.weight[i] = 0;
    if (!exact_[leaf.brick]) return;
    exact.weight[i] = static_cast<std::uint16_t>(
        std::lround(interpolate(places_[leaf.brick], exact_[leaf.brick]->weight,
                                {static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])})));
  });
  if (weighed_cells(brick, exact) != 0) {
    exact_[brick] = exact;
  } else {
    exact_[brick].reset();
    weighed_[brick] = 0;
  }
}

/// Returns the cells with a weight in octants that are not halved, one bit each.
std::uint64_t BrickTree::weighed_cells(std::uint32_t brick, const format::ExactBrick& exact) const {
  std::uint64_t cells = 0;
  for (int i = 0; i < kBrickValues; ++i) {
    if (exact.weight[i] != 0) cells |= cells_about(i);
  }
  return cells & cells_of_octants(whole(brick));
}

/// True if facets must be found for cells of the brick.
bool BrickTree::has_new_cells(std::uint32_t brick) const {
  return exact_[brick] && (refuses_[brick] || (weighed_cells(brick, *exact_[brick]) & ~weighed_[brick]) != 0);
}

/// Finds the facets of an exact brick and compares their distances with those of the nodes. None if they do not serve.
std::optional<BrickTree::BrickFacets> BrickTree::find_facets(std::uint32_t brick) const {
  // distances of nodes are floats
  constexpr double kRounding = 1e-4;  // of the cell's edge
  if (refuses_[brick]) return {};
  const std::uint64_t cells = weighed_cells(brick, *exact_[brick]);
  const double edge = cell_edge(level(brick));
  const double half_brick = 0.5 * kBrickCells * edge;
  const auto of_brick = facets_.about(low(brick) + Vector3d::Constant(half_brick), half_brick);
  BrickFacets facets;
  for (int cell = 0; cell < format::kCellsPerBrick; ++cell) {
    if ((cells >> cell & 1) == 0) continue;
    const Vector3d center = cell_center(brick, cell);
    auto near = facets_.near(center, 0.5 * edge, of_brick);
    if (!near) return {};
    const auto planes = facets_.convex_planes(center, 0.5 * edge, *near);
    std::erase_if(*near, [&](auto number) { return std::binary_search(planes.begin(), planes.end(), number); });
    near->insert(near->begin(), planes.begin(), planes.end());
    facets[static_cast<std::size_t>(cell)] = {std::move(*near), planes.size()};
  }
  for (int i = 0; i < kBrickValues; ++i) {
    const std::array<int, 3> node = steps_of_node(i);
    const Vector3d p = low(brick) + edge * Vector3d(node[0], node[1], node[2]);
    for (std::uint64_t about = cells & cells_about(i); about != 0; about &= about - 1) {
      const CellFacets& of_cell = facets[static_cast<std::size_t>(std::countr_zero(about))];
      const format::FacetSet set{0, static_cast<std::uint16_t>(of_cell.numbers.size()),
                                 static_cast<std::uint16_t>(of_cell.plane_count)};
      const FacetLists lists{facets_.all(), std::span(&set, 1), of_cell.numbers};
      const double distance = facet_distance(lists, 0, p).value;
      if (!(std::abs(distance - static_cast<double>(exact(brick).value[i])) <= kRounding * edge + facets_.flat()))
        return {};
    }
  }
  return facets;
}

void BrickTree::set_facets(std::uint32_t brick, const BrickFacets& facets) {
  for (std::size_t cell = 0; cell < facets.size(); ++cell) {
    exact_[brick]->cell[cell] = facets[cell].numbers.empty() ? 0 : 1 + sets_.number_of(facets[cell]);
  }
  weighed_[brick] = weighed_cells(brick, *exact_[brick]);
}

int BrickTree::cell_at(const Place& place, const Units& unit_cell) {
  int number = 0;
  for (std::size_t axis = 3; axis-- > 0;) {
    number = kBrickCells * number + (unit_cell[axis] - place.low[axis]) / cell_units(place.level);
  }
  return number;
}

std::uint64_t BrickTree::key(const Node& node) {
  constexpr int kBits = 20;
  static_assert(kPositionUnits * format::kMaxBricksPerAxis < 1 << kBits);
  std::uint64_t key = static_cast<std::uint64_t>(node.level);
  for (const int unit : node.at) key = key << kBits | static_cast<std::uint64_t>(unit);
  return key;
}

int BrickTree::factor(const Node& node) const {
  const auto found = factor_.find(key(node));
  return found == factor_.end() ? 0 : found->second;
}

/// A node k levels finer than the leaf that it touches has the value sum w c / 4^k of that leaf's corners c, with whole
/// weights w. In its own units, of which 2^k make one of the corner's units, that is sum w c / 2^k. So the corners must
/// be divisible by powers of two. Fine to coarse: a coarser leaf may touch one that is coarser yet.
void BrickTree::find_factors() {
  for (int level = format::kMaxRefinement; level > 0; --level) {
    for (std::uint32_t b = 0; b < brick_count(); ++b) {
      if (places_[b].level != level || whole(b) == 0) continue;
      visit_outer_nodes_on_coarser(b, [&](int, const Units& at, const Leaf& leaf) {
        const int power = level - leaf.level + factor({at, level});
        visit_corners(at, leaf, [&](const Units& corner) {
          int& most = factor_[key({corner, leaf.level})];
          most = std::max(most, power);
        });
      });
    }
  }
}

/// Calls visit(node) for the corners of the leaf's cell, face or edge that holds a place.
template <class Visit>
void BrickTree::visit_corners(const Units& at, const Leaf& leaf, const Visit& visit) const {
  const int edge = cell_units(leaf.level);
  const Units& low = places_[leaf.brick].low;
  for (unsigned corner = 0; corner < 8; ++corner) {
    Units node = at;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int beyond = (at[axis] - low[axis]) % edge;
      node[axis] += (corner >> axis & 1) != 0 && beyond != 0 ? edge - beyond : -beyond;
    }
    visit(node);
  }
}

void BrickTree::round_nodes(const Place& place, Brick& brick) const {
  for (int i = 0; i < kBrickValues; ++i) {
    const double unit = std::ldexp(quantum_, factor({node_at(place, i), place.level}) - place.level);
    brick.value[i] = static_cast<float>(unit * std::round(static_cast<double>(brick.value[i]) / unit));
  }
}

void BrickTree::round(double slack) {
  // rounding moves a node by at most half a factor, and an interpolated one by as much in finer units
  constexpr int kFactor = 1 << format::kMaxRefinement;
  constexpr int kMostOff = kFactor / 2 * (kFactor + 1);
  const double most = field_.grid.band + format::kKeptBeyondBand * voxel_size_;
  const auto clamped = [&](float value) { return std::clamp(static_cast<double>(value) + slack, -most, most); };
  double largest = voxel_size_;
  for (std::uint32_t b = 0; b < brick_count(); ++b) {
    if (is_forgotten(b)) continue;
    for (const float value : stored(b).value)
      largest = std::max(largest, std::ldexp(std::abs(clamped(value)), level(b)));
  }
  quantum_ = largest / (format::kLargestValue - kMostOff);
  find_factors();
  const auto clamp_all = [&](Brick& brick) {
    for (float& value : brick.value) value = static_cast<float>(clamped(value));
  };
  std::vector<Brick> own = field_.bricks;
  parallel::for_each_index(own.size(), [&](std::size_t b) {
    clamp_all(own[b]);
    round_nodes(places_[b], own[b]);
  });
  own_ = std::move(own);
  for (Fine& fine : fine_) clamp_all(fine.exact);
  join();
}

/// A position's own nodes are always looked up.
bool BrickTree::is_looked_up(std::uint32_t brick) const { return brick < field_.bricks.size() || whole(brick) != 0; }

/// `number`: the number of each brick in the field.
std::uint32_t BrickTree::write_entry(std::uint32_t entry, const std::vector<std::uint32_t>& number,
                                     std::vector<format::Refined>& refined) const {
  const auto exact = [this](std::uint32_t brick) { return exact_[brick] ? format::index_entry::kExact : 0u; };
  if ((entry & format::index_entry::kRefined) == 0) return number[entry] | exact(entry);
  const format::Refined& from = refined_[entry & format::index_entry::kNumber];
  const std::size_t own = refined.size();
  refined.push_back({is_looked_up(from.brick) ? number[from.brick] : format::kNoBrick, {}});
  for (std::size_t octant = 0; octant < 8; ++octant) {
    const std::uint32_t child = from.child[octant];
    const std::uint32_t written =
        is_coarse(child) ? format::index_entry::kCoarse | exact(from.brick) : write_entry(child, number, refined);
    refined[own].child[octant] = written;
  }
  return format::index_entry::kRefined | static_cast<std::uint32_t>(own);
}

void BrickTree::write(DistanceGrid& field) const {
  std::vector<std::uint32_t> number(brick_count());
  std::uint32_t count = 0;
  for (std::uint32_t b = 0; b < brick_count(); ++b) number[b] = is_looked_up(b) ? count++ : format::kNoBrick;
  field.refined.clear();
  for (std::size_t i = 0; i < index_.size(); ++i) {
    if ((index_[i] & format::index_entry::kFar) == 0) field.index[i] = write_entry(index_[i], number, field.refined);
  }
  const std::size_t whole_positions = field.bricks.size();
  field.bricks = own_;
  field.grid.quantum = quantum_;
  field.bricks.reserve(count);
  for (std::size_t i = 0; i < fine_.size(); ++i) {
    if (number[whole_positions + i] != format::kNoBrick) field.bricks.push_back(fine_[i].stored);
  }
  write_exact(number, field);
  field.grid.brick_count = count;
  bound_clearances(field);
}

void BrickTree::write_exact(const std::vector<std::uint32_t>& brick_number, DistanceGrid& field) const {
  field.exact.clear();
  for (std::uint32_t b = 0; b < brick_count(); ++b) {
    if (brick_number[b] == format::kNoBrick) continue;
    Brick& brick = field.bricks[brick_number[b]];
    brick.exact = 0;
    if (!exact_[b]) continue;
    field.exact.push_back(with_words(*exact_[b]));
    brick.exact = static_cast<std::uint32_t>(field.exact.size());
  }
  field.facets = facets_.all();
  field.facet_sets = sets_.sets();
  field.facet_numbers = sets_.numbers();
  leave_out_unnamed(field);
}

}  // namespace godobject::scene_compiler
