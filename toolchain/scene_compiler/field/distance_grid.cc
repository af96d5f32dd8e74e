#include "toolchain/scene_compiler/field/distance_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include <fmt/format.h>

#include "toolchain/command_line/failure.h"
#include "toolchain/scene_compiler/field/brick_lattice.h"
#include "toolchain/scene_compiler/field/clearance_bounds.h"
#include "toolchain/scene_compiler/field/distance_probe.h"
#include "toolchain/scene_compiler/field/distance_transform.h"
#include "toolchain/scene_compiler/field/seam_map.h"
#include "toolchain/scene_compiler/mesh/triangle_geometry.h"

namespace godobject::scene_compiler {
namespace {

using Eigen::Vector3d;
using format::kBrickCells;
using format::kBrickNodes;

constexpr double kHalfBrickEdge = 0.5 * kBrickCells;                           // [voxels]
constexpr double kHalfBrickDiagonal = 0.5 * kBrickCells * 1.7320508075688774;  // [voxels]
/// Positions at least this many brick edges from those that may hold a surface need no distance from the mesh: the
/// bound that they get is at most two half diagonals of a brick smaller, a seventh (chosen).
constexpr double kFarSteps = 12.0;

/// The nodes that a brick position owns: all but those on its upper faces.
using Block = std::array<float, kBrickCells * kBrickCells * kBrickCells>;

/// The brick positions that may hold a surface.
class SurfacePositions {
 public:
  using Triangle = std::array<Vector3d, 3>;

  /// `origin`: the lower corner of position 0. `edge`: of a brick [m].
  SurfacePositions(const BrickLattice& bricks, const Vector3d& origin, double edge)
      : bricks_(bricks), origin_(origin), edge_(edge), holds_(bricks.count()) {}

  /// Adds the positions whose bricks the triangle may meet: it comes nearer to the centre than a corner does.
  void add(const Triangle& triangle) {
    constexpr double kRounding = 1e-6;  // of a brick's edge: a triangle in the face between two bricks is in both
    const auto& [a, b, c] = triangle;
    const Vector3d low = (a.cwiseMin(b).cwiseMin(c) - origin_) / edge_;
    const Vector3d high = (a.cwiseMax(b).cwiseMax(c) - origin_) / edge_;
    Range range;
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      range.begin[i] = std::max(0, static_cast<int>(std::floor(low[axis] - kRounding)));
      range.end[i] = std::min(bricks_.size[i], static_cast<int>(std::floor(high[axis] + kRounding)) + 1);
    }
    add(triangle, range);
  }

  const std::vector<bool>& positions() const { return holds_; }

 private:
  struct Range {
    BrickPosition begin, end;
  };

  void add(const Triangle& triangle, const Range& range) {
    std::size_t longest = 0;
    Vector3d low, high;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int length = range.end[axis] - range.begin[axis];
      if (length > range.end[longest] - range.begin[longest]) longest = axis;
      low[static_cast<int>(axis)] = range.begin[axis];
      high[static_cast<int>(axis)] = range.end[axis];
    }
    const Vector3d middle = origin_ + 0.5 * edge_ * (low + high);
    const double reach = 0.5 * edge_ * (high - low).norm() * (1.0 + 1e-6);
    const auto& [a, b, c] = triangle;
    if ((nearest_point_on_triangle(middle, a, b, c) - middle).norm() > reach) return;
    if (range.end[longest] - range.begin[longest] <= 1) {
      holds_[bricks_.number(range.begin)] = true;
      return;
    }
    Range below = range;
    Range above = range;
    below.end[longest] = above.begin[longest] = std::midpoint(range.begin[longest], range.end[longest]);
    add(triangle, below);
    add(triangle, above);
  }

  const BrickLattice& bricks_;
  Vector3d origin_;
  double edge_;
  std::vector<bool> holds_;
};

class GridBuilder {
 public:
  GridBuilder(const SolidSurface& surface, double voxel_size, double band);

  void classify(const parallel::Progress& progress);
  void evaluate(const parallel::Progress& progress);
  DistanceGrid assemble();

 private:
  static constexpr std::uint32_t kNone = ~0u;
  static constexpr std::int16_t kUncounted = std::numeric_limits<std::int16_t>::min();

  Vector3d node(const BrickPosition& brick, double x, double y, double z) const {
    return origin_ +
           voxel_size_ * Vector3d(kBrickCells * brick[0] + x, kBrickCells * brick[1] + y, kBrickCells * brick[2] + z);
  }
  Vector3d middle(const BrickPosition& brick) const {
    constexpr double kMiddle = 0.5 * kBrickCells;
    return node(brick, kMiddle, kMiddle, kMiddle);
  }
  double search_radius() const { return (kHalfBrickDiagonal * voxel_size_ + band_) * (1.0 + 1e-6); }
  std::vector<bool> bound_far_positions();
  template <class Visit>
  void take_region(std::size_t first, std::vector<bool>& left, const Visit& visit) const;
  bool is_boundary(const BrickPosition& p) const;
  void require_free_boundary(bool inside, const BrickPosition& p) const;
  std::vector<std::size_t> first_bricks() const;
  void add_blocks(const std::vector<std::size_t>& bricks, const parallel::Progress& progress);
  void fill(Block& block, const BrickPosition& position) const;
  float value(const BrickPosition& brick, int x, int y, int z) const;
  bool face_disagrees(const BrickPosition& brick, const BrickPosition& step, bool inside) const;
  bool is_stored(const BrickPosition& brick) const;
  Brick brick(const BrickPosition& position) const;

  const SolidSurface& surface_;
  double voxel_size_;
  double band_;
  Vector3d low_ = Vector3d::Constant(std::numeric_limits<double>::infinity());  // bounding box of the surface
  Vector3d high_ = -low_;
  Vector3d origin_ = Vector3d::Zero();
  BrickLattice bricks_;
  std::vector<float> center_;          // signed distance at each brick's centre; of far ones a bound of it
  std::vector<std::int16_t> winding_;  // winding number there, or kUncounted
  std::vector<bool> evaluated_;        // all nodes are known
  BrickLattice block_lattice_;         // one more than bricks_ on each axis, for the outer nodes
  std::vector<std::uint32_t> block_of_;
  std::vector<Block> blocks_;
};

GridBuilder::GridBuilder(const SolidSurface& surface, double voxel_size, double band)
    : surface_(surface), voxel_size_(voxel_size), band_(band) {
  const TriangleMesh& mesh = surface.mesh();
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const bool shell = surface.components()[surface.component_of_triangle()[i]].shell;
    const Vector3d thickened = Vector3d::Constant(surface.dilation() + (shell ? 0.5 * surface.thickness() : 0.0));
    for (const std::uint32_t v : mesh.triangles[i]) {
      low_ = low_.cwiseMin(mesh.vertices[v] - thickened);
      high_ = high_.cwiseMax(mesh.vertices[v] + thickened);
    }
  }
  const double edge = kBrickCells * voxel_size;
  // The odd part moves the nodes of an aligned mesh off the band's edge, where rounding would decide.
  const double margin = band + edge + 0.15 * voxel_size;
  origin_ = low_.array() - margin;
  std::uint64_t positions = 1;
  double largest = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double needed = std::ceil((high_[axis] + margin - origin_[axis]) / edge - 1e-6);
    largest = std::max(largest, needed);
    if (needed > format::kMaxBricksPerAxis) break;
    bricks_.size[static_cast<std::size_t>(axis)] = static_cast<int>(needed);
    positions *= static_cast<std::uint64_t>(needed);
  }
  if (largest > format::kMaxBricksPerAxis || positions > kMaxBrickPositions) {
    const double coarser = largest > format::kMaxBricksPerAxis
                               ? largest / format::kMaxBricksPerAxis
                               : std::cbrt(static_cast<double>(positions) / static_cast<double>(kMaxBrickPositions));
    throw command::Failure(command::ExitCode::kBadData,
                           fmt::format("the still mesh of {:.4g} m is too large for a voxel_size of {:g} m; "
                                       "take at least {:.2g} m, or check `scale`",
                                       (high_ - low_).maxCoeff(), voxel_size, 1.1 * coarser * voxel_size));
  }
  block_lattice_.size = moved(bricks_.size, {1, 1, 1});
}

/// Gives the positions far from all triangles a lower bound of the distance, with its sign, in place of the distance:
/// that from the nearest position that may hold a surface. Where all solids are sealed the sign is one for each region
/// of far positions, since the way from one to the next meets no triangle. Returns these positions; none if the solids
/// are not sealed.
///
/// In the middle of a ball all triangles are equally near, and a search for the nearest one visits them all.
std::vector<bool> GridBuilder::bound_far_positions() {
  std::vector<bool> is_far(bricks_.count());
  if (!surface_.is_only_sealed_solids()) return is_far;
  SurfacePositions surface(bricks_, origin_, kBrickCells * voxel_size_);
  const TriangleMesh& mesh = surface_.mesh();
  for (const auto& t : mesh.triangles) surface.add({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
  center_ = squared_distance_transform(bricks_, surface.positions());
  const double far_steps = std::max(kFarSteps, search_radius() / (kBrickCells * voxel_size_) + 2.0);
  for (std::size_t i = 0; i < center_.size(); ++i) {
    const double steps = std::sqrt(static_cast<double>(center_[i])) * (1.0 - 1e-6);
    is_far[i] = steps >= far_steps;
    center_[i] = static_cast<float>((kBrickCells * steps - kHalfBrickDiagonal) * voxel_size_);
  }
  std::vector<bool> without_sign = is_far;
  for (std::size_t i = 0; i < is_far.size(); ++i) {
    if (!without_sign[i]) continue;
    const bool inside = surface_.winding_number(middle(bricks_.position(i))) > 0.5;
    take_region(i, without_sign, [&](std::size_t position) {
      if (inside) center_[position] = -center_[position];
      winding_[position] = kUncounted;
    });
  }
  return is_far;
}

/// Calls visit(position) for the positions of `left` that are connected with position `first`, and takes them out of
/// `left`. Row by row, so that few rows wait at a time.
template <class Visit>
void GridBuilder::take_region(std::size_t first, std::vector<bool>& left, const Visit& visit) const {
  const auto length = static_cast<std::size_t>(bricks_.size[0]);
  std::vector<std::size_t> waiting = {first};  // one position of each row's piece
  while (!waiting.empty()) {
    const std::size_t seed = waiting.back();
    waiting.pop_back();
    if (!left[seed]) continue;
    const std::size_t row = seed - seed % length;
    std::size_t begin = seed;
    std::size_t end = seed + 1;
    while (begin > row && left[begin - 1]) --begin;
    while (end < row + length && left[end]) ++end;
    for (std::size_t i = begin; i < end; ++i) {
      left[i] = false;
      visit(i);
    }
    const BrickPosition at = bricks_.position(begin);
    for (const BrickPosition& step : kFaceSteps) {
      const BrickPosition q = moved(at, step);
      if (step[0] != 0 || !bricks_.contains(q)) continue;
      const std::size_t beside = bricks_.number(q);
      for (std::size_t k = 0; k < end - begin; ++k) {
        if (left[beside + k] && (k == 0 || !left[beside + k - 1])) waiting.push_back(beside + k);
      }
    }
  }
}

void GridBuilder::classify(const parallel::Progress& progress) {
  center_.resize(bricks_.count());
  winding_.resize(bricks_.count());
  const std::vector<bool> is_far = bound_far_positions();
  const auto rows = static_cast<std::size_t>(bricks_.size[1]) * static_cast<std::size_t>(bricks_.size[2]);
  const auto row_length = static_cast<std::size_t>(bricks_.size[0]);
  parallel::for_each_index(
      rows,
      [&](std::size_t row) {
        DistanceProbe probe(surface_);
        for (std::size_t i = row * row_length; i < (row + 1) * row_length; ++i) {
          if (is_far[i]) continue;
          center_[i] = static_cast<float>(probe.signed_distance(middle(bricks_.position(i))));
          winding_[i] = probe.winding().value_or(kUncounted);
        }
      },
      progress);
}

bool GridBuilder::is_boundary(const BrickPosition& p) const {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (p[axis] == 0 || p[axis] == bricks_.size[axis] - 1) return true;
  }
  return false;
}

/// Refuses an inside position at the boundary, because space outside the grid is free.
void GridBuilder::require_free_boundary(bool inside, const BrickPosition& p) const {
  if (inside && is_boundary(p)) {
    throw command::Failure(command::ExitCode::kBadData,
                           "the still mesh encloses space far outside its own bounds (winding number above 1/2 there); "
                           "repair its orientation or holes, or set surface = \"shell\"");
  }
}

/// Returns the bricks that may contain a node within the band, and far ones beside a far one of the other sign, between
/// which the sign jumps.
std::vector<std::size_t> GridBuilder::first_bricks() const {
  std::vector<std::size_t> first;
  for (std::size_t i = 0; i < center_.size(); ++i) {
    const BrickPosition p = bricks_.position(i);
    bool wanted = std::abs(static_cast<double>(center_[i])) <= search_radius();
    if (!wanted) require_free_boundary(center_[i] < 0.0f, p);
    for (const BrickPosition& step : kFaceSteps) {
      const BrickPosition q = moved(p, step);
      wanted = wanted || (bricks_.contains(q) && (center_[bricks_.number(q)] < 0.0f) != (center_[i] < 0.0f));
    }
    if (wanted) first.push_back(i);
  }
  return first;
}

void GridBuilder::evaluate(const parallel::Progress& progress) {
  evaluated_.assign(bricks_.count(), false);
  block_of_.assign(block_lattice_.count(), kNone);
  std::vector<std::size_t> front = first_bricks();
  if (front.size() > kMaxBricks) {
    const double coarser = std::sqrt(static_cast<double>(front.size()) / static_cast<double>(kMaxBricks));
    throw command::Failure(
        command::ExitCode::kBadData,
        fmt::format("a voxel_size of {:g} m needs {} bricks, more than the limit of {}; take at least {:.2g} m",
                    voxel_size_, front.size(), kMaxBricks, 1.1 * coarser * voxel_size_));
  }
  for (const std::size_t i : front) evaluated_[i] = true;
  while (!front.empty()) {
    add_blocks(front, progress);
    std::vector<std::size_t> next;
    for (const std::size_t i : front) {
      const BrickPosition p = bricks_.position(i);
      for (const BrickPosition& step : kFaceSteps) {
        const BrickPosition q = moved(p, step);
        if (!bricks_.contains(q)) continue;
        const std::size_t neighbour = bricks_.number(q);
        if (evaluated_[neighbour] || !face_disagrees(p, step, center_[neighbour] < 0.0f)) continue;
        evaluated_[neighbour] = true;
        next.push_back(neighbour);
      }
    }
    front = std::move(next);
  }
}

void GridBuilder::add_blocks(const std::vector<std::size_t>& bricks, const parallel::Progress& progress) {
  std::vector<std::size_t> added;
  for (const std::size_t i : bricks) {
    for (int corner = 0; corner < 8; ++corner) {
      const std::size_t block =
          block_lattice_.number(moved(bricks_.position(i), {corner & 1, corner >> 1 & 1, corner >> 2}));
      if (block_of_[block] != kNone) continue;
      block_of_[block] = static_cast<std::uint32_t>(blocks_.size() + added.size());
      added.push_back(block);
    }
  }
  const std::size_t before = blocks_.size();
  blocks_.resize(before + added.size());
  parallel::for_each_index(
      added.size(), [&](std::size_t i) { fill(blocks_[before + i], block_lattice_.position(added[i])); }, progress);
}

void GridBuilder::fill(Block& block, const BrickPosition& position) const {
  DistanceProbe probe(surface_);
  if (bricks_.contains(position)) {
    const std::size_t i = bricks_.number(position);
    if (winding_[i] != kUncounted) probe.start(middle(position), center_[i], winding_[i]);
  }
  for (int z = 0; z < kBrickCells; ++z) {
    for (int row = 0; row < kBrickCells; ++row) {
      const int y = z % 2 == 0 ? row : kBrickCells - 1 - row;  // back and forth, so that each step is one voxel
      for (int column = 0; column < kBrickCells; ++column) {
        const int x = row % 2 == 0 ? column : kBrickCells - 1 - column;
        block[static_cast<std::size_t>(x + kBrickCells * (y + kBrickCells * z))] =
            static_cast<float>(probe.signed_distance(node(position, x, y, z)));
      }
    }
  }
}

float GridBuilder::value(const BrickPosition& brick, int x, int y, int z) const {
  const BrickPosition owner = moved(brick, {x / kBrickCells, y / kBrickCells, z / kBrickCells});
  const int local = x % kBrickCells + kBrickCells * (y % kBrickCells + kBrickCells * (z % kBrickCells));
  return blocks_[block_of_[block_lattice_.number(owner)]][static_cast<std::size_t>(local)];
}

/// True if a node on the face that `brick` shares with its neighbour at `step` has another sign than the neighbour.
bool GridBuilder::face_disagrees(const BrickPosition& brick, const BrickPosition& step, bool inside) const {
  const auto range = [&](std::size_t axis) {
    const int low = step[axis] > 0 ? kBrickCells : 0;
    const int high = step[axis] < 0 ? 0 : kBrickCells;
    return std::array<int, 2>{low, high};
  };
  const auto [x0, x1] = range(0);
  const auto [y0, y1] = range(1);
  const auto [z0, z1] = range(2);
  for (int z = z0; z <= z1; ++z) {
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        if ((value(brick, x, y, z) < 0.0f) != inside) return true;
      }
    }
  }
  return false;
}

bool GridBuilder::is_stored(const BrickPosition& position) const {
  const float first = value(position, 0, 0, 0);
  for (int z = 0; z < kBrickNodes; ++z) {
    for (int y = 0; y < kBrickNodes; ++y) {
      for (int x = 0; x < kBrickNodes; ++x) {
        const float v = value(position, x, y, z);
        if (std::abs(static_cast<double>(v)) < band_ || (v < 0.0f) != (first < 0.0f)) return true;
      }
    }
  }
  return false;
}

Brick GridBuilder::brick(const BrickPosition& position) const {
  Brick brick{};
  std::size_t i = 0;
  for (int z = 0; z < kBrickNodes; ++z) {
    for (int y = 0; y < kBrickNodes; ++y) {
      for (int x = 0; x < kBrickNodes; ++x) brick.value[i++] = value(position, x, y, z);
    }
  }
  return brick;
}

DistanceGrid GridBuilder::assemble() {
  DistanceGrid field;
  format::Grid& grid = field.grid;
  grid.voxel_size = voxel_size_;
  grid.band = band_;
  field.index.resize(bricks_.count());
  SeamMap seams(bricks_, origin_, voxel_size_);
  for (std::size_t i = 0; i < field.index.size(); ++i) {
    const BrickPosition p = bricks_.position(i);
    const bool stored = evaluated_[i] && is_stored(p);
    field.index[i] = stored ? static_cast<std::uint32_t>(field.bricks.size()) : format::index_entry::kFar;
    if (!stored) {
      // evaluated or not, all nodes have one sign: that of the centre unless the sign jumps within the position
      const bool inside = evaluated_[i] ? value(p, 0, 0, 0) < 0.0f : center_[i] < 0.0f;
      require_free_boundary(inside, p);
      if (inside) field.index[i] |= format::index_entry::kInside;
      continue;
    }
    field.bricks.push_back(brick(p));
    require_free_boundary(*std::min_element(field.bricks.back().value, std::end(field.bricks.back().value)) < 0.0f, p);
    seams.add(p, field.bricks.back());
  }
  seams.close();
  field.far_clearance.resize(field.index.size());
  field.beside_seam.resize(field.bricks.size());
  for (std::size_t i = 0; i < field.index.size(); ++i) {
    const std::uint32_t entry = field.index[i];
    const BrickPosition p = bricks_.position(i);
    if ((entry & format::index_entry::kFar) == 0) {
      field.beside_seam[entry] = seams.touches(p);
    } else if ((entry & format::index_entry::kInside) == 0) {
      const double to_surface = std::abs(static_cast<double>(center_[i])) * (1.0 - 1e-6);
      // a seam outside the position's box is half an edge farther from its centre
      const double to_seam = seams.clearance_of_bricks(p) + kHalfBrickEdge * voxel_size_;
      const double clearance = std::min(to_surface, to_seam) - kInterpolationError * voxel_size_;
      field.far_clearance[i] = std::max(0.0, clearance);
    }
  }
  const Vector3d low = low_.cwiseMin(seams.low());
  const Vector3d high = high_.cwiseMax(seams.high());
  for (int axis = 0; axis < 3; ++axis) {
    grid.origin[axis] = origin_[axis];
    grid.bricks[axis] = bricks_.size[static_cast<std::size_t>(axis)];
    // of seams too: behind one the distance may be negative outside the mesh's own box
    grid.surface_min[axis] = low[axis];
    grid.surface_max[axis] = high[axis];
  }
  grid.brick_count = static_cast<std::uint32_t>(field.bricks.size());
  field.seams = seams.report();
  bound_clearances(field);
  return field;
}

}  // namespace

double default_band(double voxel_size, double safety_distance) {
  return std::max(3.0 * voxel_size, safety_distance + 1.5 * voxel_size) + 0.25 * voxel_size;
}

DistanceGrid make_distance_grid(const SolidSurface& surface, double voxel_size, double band,
                                const parallel::Progress& progress) {
  constexpr double kClassifyShare = 0.25;  // of the time, roughly
  GridBuilder builder(surface, voxel_size, band);
  builder.classify([&](double done) {
    if (progress) progress(kClassifyShare * done);
  });
  builder.evaluate([&](double done) {
    if (progress) progress(kClassifyShare + (1.0 - kClassifyShare) * done);
  });
  return builder.assemble();
}

}  // namespace godobject::scene_compiler
