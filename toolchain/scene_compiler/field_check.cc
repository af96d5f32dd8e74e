#include "toolchain/scene_compiler/field_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <fmt/format.h>

#include "toolchain/command/failure.h"
#include "toolchain/scene_compiler/brick_lattice.h"
#include "toolchain/scene_compiler/distance_probe.h"

namespace godobject::scene_compiler {
namespace {

using Eigen::Vector3d;
using format::kBrickCells;
using format::kBrickNodes;

constexpr double kSignSlack = 0.1;           // voxels
constexpr double kNodeError = 1e-5;          // [m]
constexpr double kNodeErrorInVoxels = 1e-3;  // what binds below a voxel of a centimetre
constexpr double kFloatRounding = 0x1p-24;   // of a value, relative
constexpr double kOnSeam = 1e-6;             // |w - 1/2| below it: which sign is right is decided by rounding

/// A point in a stored brick: cell and place within it.
struct Place {
  std::size_t brick;
  std::array<int, 3> cell;   // within the brick
  std::array<double, 3> at;  // within the cell, 0 .. 1
  Vector3d low;              // the cell's first node
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

  Place draw(std::mt19937_64& random) const {
    const auto unit = [&random] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    const std::size_t position = stored_[random() % stored_.size()];
    const BrickPosition p = lattice_.position(position);
    Place place;
    place.brick = grid_.index[position] & format::index_entry::kNumber;
    const double s = grid_.grid.voxel_size;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      place.cell[axis] = static_cast<int>(random() % kBrickCells);
      place.at[axis] = unit();
      const auto k = static_cast<Eigen::Index>(axis);
      place.low[k] = grid_.grid.origin[axis] + s * (kBrickCells * p[axis] + place.cell[axis]);
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
};

PointError measure(const SolidSurface& surface, const DistanceGrid& grid, const Voxelmap& field, const Place& place) {
  DistanceProbe probe(surface);
  PointError error{};
  error.exact = probe.signed_distance(place.point);
  error.stored = field.sample(place.point).distance;
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
    const auto stored = static_cast<double>(grid.bricks[place.brick].value[index]);
    const bool undecided = stored * exact < 0.0 && std::abs(surface.winding_number(node) - 0.5) < kOnSeam;
    const double off = undecided ? std::abs(std::abs(stored) - std::abs(exact)) : std::abs(stored - exact);
    error.node = std::max(error.node, off);
    error.node_excess = std::max(error.node_excess, off - kFloatRounding * std::abs(exact));
  }
  return error;
}

}  // namespace

FieldError check_field(const SolidSurface& surface, const DistanceGrid& grid, const Voxelmap& field,
                       std::uint64_t points, const Progress& progress) {
  const Places places(grid);
  std::vector<Place> drawn;
  std::mt19937_64 random(20160902);
  while (!places.empty() && drawn.size() < points) {
    const Place place = places.draw(random);
    if (field.sample(place.point).known) drawn.push_back(place);
  }
  std::vector<PointError> errors(drawn.size());
  parallel_for(
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
  const double count = std::max(1.0, static_cast<double>(errors.size()));
  total.rms = std::sqrt(total.rms / count);
  total.floor_rms = std::sqrt(total.floor_rms / count);
  return total;
}

void require_exact_nodes(const FieldError& error, double voxel_size) {
  const double allowed = std::min(kNodeError, kNodeErrorInVoxels * voxel_size);
  if (error.largest_node_excess <= allowed) return;
  throw command::Failure(command::ExitCode::kInternal,
                         fmt::format("a stored distance is {:.3g} m further off the exact one than its rounding, more "
                                     "than {:.3g} m; please report this scene",
                                     error.largest_node_excess, allowed));
}

}  // namespace godobject::scene_compiler
