#include "toolchain/scene_compiler/field/field_check.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <random>

#include <fmt/format.h>

#include "toolchain/command_line/failure.h"
#include "toolchain/scene_compiler/field/brick_lattice.h"
#include "toolchain/scene_compiler/field/distance_probe.h"

namespace godobject::scene_compiler {
namespace {

using Eigen::Vector3d;
using format::kBrickCells;
using format::kBrickNodes;

/// [voxels] of a point that counts as on the wrong side; nearer ones are a matter of resolution.
constexpr double kSignSlack = 0.1;
constexpr double kNear = 0.5;        // [voxels] of a point that counts as near the surface
constexpr double kNodeError = 1e-5;  // [m] of a node; the error of an image in metres and single precision up to 100 m
constexpr double kNodeErrorInVoxels = 1e-3;  // of a node; smaller than kNodeError for voxels below a centimetre
constexpr double kSingleRounding = 0x1p-24;  // relative
constexpr double kOnSeam = 1e-6;             // at |w - 1/2| below it rounding decides the sign

/// A point in a stored position, with its cell among the position's own nodes.
struct CellPlace {
  std::uint32_t entry;       // of the brick index
  Vector3d position;         // first node of the position
  std::array<int, 3> cell;   // within the position
  std::array<double, 3> at;  // within the cell, 0 .. 1
  Vector3d low;              // first node of the cell
  Vector3d point;
};

class Places {
 public:
  explicit Places(const DistanceGrid& grid) : grid_(grid) {
    lattice_.size = {grid.grid.bricks[0], grid.grid.bricks[1], grid.grid.bricks[2]};
    for (std::size_t i = 0; i < grid.index.size(); ++i) {
      if ((grid.index[i] & format::index_entry::kFar) == 0) stored_.push_back(i);
    }
  }

  bool empty() const { return stored_.empty(); }

  CellPlace draw(std::mt19937_64& random) const {
    const auto unit = [&random] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    const std::size_t position = stored_[random() % stored_.size()];
    const BrickPosition p = lattice_.position(position);
    CellPlace place;
    place.entry = grid_.index[position];
    const double s = grid_.grid.voxel_size;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      place.cell[axis] = static_cast<int>(random() % kBrickCells);
      place.at[axis] = unit();
      const auto k = static_cast<Eigen::Index>(axis);
      place.position[k] = grid_.grid.origin[axis] + s * kBrickCells * p[axis];
      place.low[k] = place.position[k] + s * place.cell[axis];
      place.point[k] = place.low[k] + s * place.at[axis];
    }
    return place;
  }

 private:
  const DistanceGrid& grid_;
  BrickLattice lattice_;
  std::vector<std::size_t> stored_;
};

struct PointError {
  double exact, stored, floor, node, node_excess;

  void add_node(const SolidSurface& surface, const format::Grid& grid, const Vector3d& at, double unclamped,
                float stored_value) {
    const auto value = static_cast<double>(stored_value);
    const double most = grid.band + format::kKeptBeyondBand * grid.voxel_size;
    const double exact_value = std::clamp(unclamped, -most, most);
    const bool undecided = value * exact_value < 0.0 && std::abs(surface.winding_number(at) - 0.5) < kOnSeam;
    const double off = undecided ? std::abs(std::abs(value) - std::abs(exact_value)) : std::abs(value - exact_value);
    node = std::max(node, off);
    node_excess = std::max(node_excess, off - kSingleRounding * std::abs(exact_value));
  }
};

bool is_refined(std::uint32_t entry) { return (entry & format::index_entry::kRefined) != 0; }

std::uint32_t own_brick(const DistanceGrid& grid, std::uint32_t entry) {
  const std::uint32_t number = entry & format::index_entry::kNumber;
  return is_refined(entry) ? grid.refined[number].brick : number;
}

/// Adds the nodes of the octant that contains the point, without those on the octant's faces, which may not be exact.
void add_octant_nodes(const SolidSurface& surface, const DistanceGrid& grid, const CellPlace& place,
                      DistanceProbe& probe, PointError& error) {
  std::uint32_t entry = place.entry;
  Vector3d low = place.position;
  double edge = grid.grid.voxel_size;
  while (is_refined(entry)) {
    const format::Refined& refined = grid.refined[entry & format::index_entry::kNumber];
    const double half = 0.5 * kBrickCells * edge;
    Vector3d side = Vector3d::Zero();
    for (int axis = 0; axis < 3; ++axis) side[axis] = place.point[axis] < low[axis] + half ? 0.0 : 1.0;
    const std::uint32_t child = refined.child[static_cast<std::size_t>(side.x() + 2.0 * side.y() + 4.0 * side.z())];
    if ((child & format::index_entry::kCoarse) != 0) {
      entry = refined.brick;
      break;
    }
    entry = child;
    low += half * side;
    edge *= 0.5;
  }
  const Vector3d cell = ((place.point - low) / edge).array().floor().max(0.0).min(kBrickCells - 1.0);
  for (int step = 0; step < 8; ++step) {
    const int corner = step ^ (step >> 1);
    const Vector3d node = cell + Vector3d(corner & 1, corner >> 1 & 1, corner >> 2);
    if (node.minCoeff() < 0.5 || node.maxCoeff() > kBrickCells - 0.5) continue;
    const auto index = static_cast<std::size_t>(node.x() + kBrickNodes * (node.y() + kBrickNodes * node.z()));
    const Vector3d at = low + edge * node;
    error.add_node(surface, grid.grid, at, probe.signed_distance(at),
                   grid.bricks[entry & format::index_entry::kNumber].value[index]);
  }
}

PointError measure(const SolidSurface& surface, const DistanceGrid& grid, const Voxelmap& field,
                   const CellPlace& place) {
  DistanceProbe probe(surface);
  PointError error{};
  error.exact = probe.signed_distance(place.point);
  error.stored = field.sample(place.point).distance;
  const Brick& own = grid.bricks[own_brick(grid, place.entry)];
  const double s = grid.grid.voxel_size;
  for (int step = 0; step < 8; ++step) {
    const int corner = step ^ (step >> 1);  // Gray code: one edge at a time
    const std::array<int, 3> offset = {corner & 1, corner >> 1 & 1, corner >> 2};
    const Vector3d node = place.low + s * Vector3d(offset[0], offset[1], offset[2]);
    double weight = 1.0;
    for (std::size_t axis = 0; axis < 3; ++axis) weight *= offset[axis] == 1 ? place.at[axis] : 1.0 - place.at[axis];
    const double exact = probe.signed_distance(node);
    error.floor += weight * exact;
    const int index = place.cell[0] + offset[0] +
                      kBrickNodes * (place.cell[1] + offset[1] + kBrickNodes * (place.cell[2] + offset[2]));
    error.add_node(surface, grid.grid, node, exact, own.value[index]);
  }
  if (is_refined(place.entry)) add_octant_nodes(surface, grid, place, probe, error);
  return error;
}

ErrorNorms near_norms(const std::vector<PointError>& errors, const std::vector<CellPlace>& places,
                      const DistanceGrid& grid) {
  ErrorNorms norms;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const bool on_seam = grid.beside_seam[own_brick(grid, places[i].entry)];
    if (on_seam || std::abs(errors[i].exact) >= kNear * grid.grid.voxel_size) continue;
    const double error = std::abs(errors[i].stored - errors[i].exact);
    const double floor = std::abs(errors[i].floor - errors[i].exact);
    ++norms.points;
    norms.rms += error * error;
    norms.floor_rms += floor * floor;
    norms.largest = std::max(norms.largest, error);
    norms.floor_largest = std::max(norms.floor_largest, floor);
  }
  const double count = std::max(1.0, static_cast<double>(norms.points));
  norms.rms = std::sqrt(norms.rms / count);
  norms.floor_rms = std::sqrt(norms.floor_rms / count);
  return norms;
}

}  // namespace

FieldError check_field(const SolidSurface& surface, const DistanceGrid& grid, const Voxelmap& field,
                       std::uint64_t points, const parallel::Progress& progress) {
  const Places places(grid);
  std::vector<CellPlace> drawn;
  std::mt19937_64 random(20160902);
  while (!places.empty() && drawn.size() < points) {
    const CellPlace place = places.draw(random);
    if (field.sample(place.point).known) drawn.push_back(place);
  }
  std::vector<PointError> errors(drawn.size());
  parallel::for_each_index(
      drawn.size(), [&](std::size_t i) { errors[i] = measure(surface, grid, field, drawn[i]); }, progress);

  FieldError total;
  total.points = errors.size();
  const double slack = kSignSlack * grid.grid.voxel_size;
  const auto wrong_side = [slack](double exact, double value) {
    return std::abs(exact) > slack && (exact < 0.0) != (value < 0.0);
  };
  for (const PointError& e : errors) {
    const double error = std::abs(e.stored - e.exact);
    const double floor = std::abs(e.floor - e.exact);
    total.rms += error * error;
    total.floor_rms += floor * floor;
    total.largest = std::max(total.largest, error);
    total.floor_largest = std::max(total.floor_largest, floor);
    total.sign_errors += wrong_side(e.exact, e.stored) ? 1u : 0u;
    total.floor_sign_errors += wrong_side(e.exact, e.floor) ? 1u : 0u;
    total.largest_node_error = std::max(total.largest_node_error, e.node);
    total.largest_node_excess = std::max(total.largest_node_excess, e.node_excess);
  }
  total.near = near_norms(errors, drawn, grid);
  const double count = std::max(1.0, static_cast<double>(errors.size()));
  total.rms = std::sqrt(total.rms / count);
  total.floor_rms = std::sqrt(total.floor_rms / count);
  return total;
}

LookUpTime time_look_ups(const DistanceGrid& grid, const Voxelmap& field) {
  constexpr int kPasses = 20;
  constexpr std::size_t kPoints = 5000;
  const Places places(grid);
  std::array<std::vector<Vector3d>, 2> points;  // unrefined, refined
  std::mt19937_64 random(20160903);
  for (std::size_t i = 0; !places.empty() && i < 100 * kPoints; ++i) {
    const CellPlace place = places.draw(random);
    auto& list = points[is_refined(place.entry) ? 1 : 0];
    if (list.size() < kPoints && field.sample(place.point).known) list.push_back(place.point);
  }
  std::array<double, 2> best{};
  for (std::size_t kind = 0; kind < 2; ++kind) {
    for (int round = 0; round < kPasses && !points[kind].empty(); ++round) {
      double sum = 0.0;
      const auto begin = std::chrono::steady_clock::now();
      for (const Vector3d& p : points[kind]) {
        const FieldSample sample = field.sample(p);
        sum += sample.distance + sample.gradient.x();
      }
      const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - begin;
      const double each = time.count() / static_cast<double>(points[kind].size());
      if (std::isfinite(sum) && (round == 0 || each < best[kind])) best[kind] = each;
    }
  }
  return {best[0], best[1]};
}

void require_exact_nodes(const FieldError& error, const format::Grid& grid) {
  const double allowed =
      std::min(kNodeError, kNodeErrorInVoxels * grid.voxel_size) + format::kMostRoundedOff * grid.quantum;
  if (error.largest_node_excess <= allowed) return;
  throw command::Failure(
      command::ExitCode::kInternal,
      fmt::format("a stored distance differs from the exact one by {:.3g} m; rounding allows {:.3g} m; please "
                  "report this scene",
                  error.largest_node_excess, allowed));
}

}  // namespace godobject::scene_compiler
