#include "toolchain/scene_compiler/field/brick_tree.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/scene/edge.h"
#include "toolchain/parallel/parallel.h"
#include "toolchain/scene_compiler/field/clearance_bounds.h"
#include "toolchain/scene_compiler/field/straight_edges.h"

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

/// Appends the octant if it is not among `octants` yet.
void add(const BrickTree::Octant& octant, BrickTree::Octants& octants, std::size_t& count) {
  const auto end = octants.begin() + static_cast<std::ptrdiff_t>(count);
  if (std::find(octants.begin(), end, octant) == end) octants[count++] = octant;
}

}  // namespace

BrickTree::BrickTree(const DistanceGrid& field, const std::vector<format::Edge>& edges)
    : field_(field),
      origin_(field.grid.origin[0], field.grid.origin[1], field.grid.origin[2]),
      voxel_size_(field.grid.voxel_size),
      lattice_{{field.grid.bricks[0], field.grid.bricks[1], field.grid.bricks[2]}},
      index_(field.index),
      places_(field.bricks.size()),
      changed_in_(field.bricks.size()),
      edges_(edges),
      edges_of_(field.bricks.size()) {
  for (std::size_t i = 0; i < index_.size(); ++i) {
    if ((index_[i] & format::index_entry::kFar) != 0) continue;
    const std::uint32_t brick = index_[i] & format::index_entry::kNumber;
    const BrickPosition p = lattice_.position(i);
    places_[brick] = {{kPositionUnits * p[0], kPositionUnits * p[1], kPositionUnits * p[2]}, 0, brick, 0};
  }
  const double position_edge = kBrickCells * voxel_size_;
  for (std::uint32_t e = 0; e < edges_.size(); ++e) {
    const Eigen::Map<const Vector3d> point(edges_[e].point);
    const Eigen::Map<const Vector3d> along(edges_[e].along);
    const Vector3d from = point + edges_[e].begin * along;
    const Vector3d to = point + edges_[e].end * along;
    BrickPosition low{};
    BrickPosition high{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<Eigen::Index>(axis);
      const auto position = [&](double x) { return static_cast<int>(std::floor((x - origin_[k]) / position_edge)); };
      low[axis] = std::max(position(std::min(from[k], to[k]) - edges_[e].radius), 0);
      high[axis] = std::min(position(std::max(from[k], to[k]) + edges_[e].radius), lattice_.size[axis] - 1);
    }
    for (int z = low[2]; z <= high[2]; ++z) {
      for (int y = low[1]; y <= high[1]; ++y) {
        for (int x = low[0]; x <= high[0]; ++x) {
          const std::uint32_t entry = index_[lattice_.number({x, y, z})];
          if ((entry & format::index_entry::kFar) == 0) find_edges(entry & format::index_entry::kNumber, {e});
        }
      }
    }
  }
}

/// Adds the edges of `among` whose tube may meet the brick.
void BrickTree::find_edges(std::uint32_t brick, const std::vector<std::uint32_t>& among) {
  const double half = 0.5 * kBrickCells * cell_edge(level(brick));
  const Vector3d center = low(brick) + Vector3d::Constant(half);
  for (const std::uint32_t e : among) {
    if (reaches(edges_[e], center, half)) edges_of_[brick].push_back(e);
  }
}

double BrickTree::with_edges(std::uint32_t brick, const Vector3d& p, double interpolated) const {
  for (const std::uint32_t e : edges_of_[brick]) {
    interpolated += edge_weight(edges_[e], p).value * (wedge_distance(edges_[e], p).value - interpolated);
  }
  return interpolated;
}

void BrickTree::add_slope(std::uint32_t brick, FieldSlope& slope) const {
  if (edges_of_[brick].empty()) {
    slope.add(stored(brick), whole(brick));
  } else {
    slope.add(stored(brick), whole(brick), edges_[edges_of_[brick].front()], low(brick));
  }
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

double BrickTree::interpolate(const Place& place, const Brick& brick, const std::array<double, 3>& units) const {
  const float* corner = brick.value;
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
  return with_edges(leaf.brick, p,
                    interpolate(places_[leaf.brick], stored(leaf.brick), {units[0], units[1], units[2]}));
}

double BrickTree::interpolate_exact(const Leaf& leaf, const Vector3d& p) const {
  const Vector3d units = (p - origin_) * (kUnits / voxel_size_);
  return with_edges(leaf.brick, p, interpolate(places_[leaf.brick], exact(leaf.brick), {units[0], units[1], units[2]}));
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
    fine_.push_back({octants[octant], octants[octant]});
    edges_of_.emplace_back();
    find_edges(brick_count() - 1, edges_of_[brick]);
  }
  places_[brick].halved = static_cast<std::uint8_t>(places_[brick].halved | wanted);
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
        interpolate(places_[leaf.brick], stored(leaf.brick),
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
  for (const std::uint32_t root : touched_) {
    const Units& low = places_[root].low;
    for (int neighbour = 0; neighbour < 27; ++neighbour) {
      const BrickPosition step = {neighbour % 3 - 1, neighbour / 3 % 3 - 1, neighbour / 9 - 1};
      const BrickPosition own = {low[0] / kPositionUnits, low[1] / kPositionUnits, low[2] / kPositionUnits};
      const std::uint32_t about = root_at(moved(own, step));
      if (about != kNone) changed_in_[about] = joins_;
    }
  }
  touched_.clear();
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
  mark_changed();
  const bool all = quantum_ > 0.0;  // rounding changes every position
  for (int level = 1; level <= format::kMaxRefinement; ++level) {
    std::vector<std::uint32_t> bricks;
    for (std::uint32_t b = 0; b < brick_count(); ++b) {
      if (places_[b].level == level && (all || changed_in_[places_[b].root] == joins_)) bricks.push_back(b);
    }
    parallel::for_each_index(bricks.size(), [&](std::size_t i) { join_brick(bricks[i]); });
  }
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
        const int edge = cell_units(leaf.level);
        const Units& low = places_[leaf.brick].low;
        for (unsigned corner = 0; corner < 8; ++corner) {
          Node node = {at, leaf.level};
          for (std::size_t axis = 0; axis < 3; ++axis) {
            const int beyond = (at[axis] - low[axis]) % edge;
            node.at[axis] += (corner >> axis & 1) != 0 && beyond != 0 ? edge - beyond : -beyond;
          }
          int& most = factor_[key(node)];
          most = std::max(most, power);
        }
      });
    }
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
  const auto edged = [this](std::uint32_t brick) {
    return edges_of_[brick].empty() ? 0u : format::index_entry::kEdged;
  };
  if ((entry & format::index_entry::kRefined) == 0) return number[entry] | edged(entry);
  const format::Refined& from = refined_[entry & format::index_entry::kNumber];
  const std::size_t own = refined.size();
  refined.push_back({is_looked_up(from.brick) ? number[from.brick] : format::kNoBrick, {}});
  for (std::size_t octant = 0; octant < 8; ++octant) {
    const std::uint32_t child = from.child[octant];
    const std::uint32_t written =
        is_coarse(child) ? format::index_entry::kCoarse | edged(from.brick) : write_entry(child, number, refined);
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
  write_edges(number, field);
  field.grid.brick_count = count;
  bound_clearances(field);
}

void BrickTree::write_edges(const std::vector<std::uint32_t>& brick_number, DistanceGrid& field) const {
  std::vector<std::uint32_t> number(edges_.size());  // 1 + the number in the field
  field.edges.clear();
  for (std::uint32_t b = 0; b < brick_count(); ++b) {
    if (brick_number[b] == format::kNoBrick) continue;
    Brick& brick = field.bricks[brick_number[b]];
    brick.edge = 0;
    if (whole(b) == 0 || edges_of_[b].empty()) continue;
    const std::uint32_t edge = edges_of_[b].front();
    if (number[edge] == 0) {
      field.edges.push_back(edges_[edge]);
      number[edge] = static_cast<std::uint32_t>(field.edges.size());
    }
    brick.edge = number[edge];
  }
}

}  // namespace godobject::scene_compiler
