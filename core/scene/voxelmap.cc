#include "core/scene/voxelmap.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "core/scene/facets.h"

namespace godobject {
namespace {

using format::kBrickCells;
using format::kBrickNodes;

constexpr int kStrideY = kBrickNodes;
constexpr int kStrideZ = kBrickNodes * kBrickNodes;

constexpr std::size_t kMost = std::numeric_limits<std::int32_t>::max();

}  // namespace

Voxelmap::Voxelmap(const format::Grid& grid, std::span<const std::uint32_t> index,
                   std::span<const format::Brick> bricks, std::span<const format::Refined> refined,
                   std::span<const format::ExactBrick> exact, const FacetLists& facets) noexcept
    : index_(index.data()),
      bricks_(bricks.data()),
      refined_(refined.data()),
      exact_(exact.data()),
      facets_(facets),
      origin_(grid.origin[0], grid.origin[1], grid.origin[2]),
      surface_min_(grid.surface_min[0], grid.surface_min[1], grid.surface_min[2]),
      surface_max_(grid.surface_max[0], grid.surface_max[1], grid.surface_max[2]),
      voxel_size_(grid.voxel_size),
      per_voxel_(1.0 / grid.voxel_size),
      band_(grid.band),
      quantum_(grid.quantum),
      quantum_per_voxel_(grid.quantum / grid.voxel_size),
      near_band_(std::min(grid.band - format::kMostRoundedOff * grid.quantum, kBrickCells * grid.voxel_size)),
      lipschitz_(std::max(1.0, grid.lipschitz_seam)),
      clearance_slope_(grid.clearance_slope),
      assured_clearance_(near_band_ / lipschitz_),
      outside_off_(kFieldError * voxel_size_ + grid.outside_loss),
      facet_offset_(grid.facet_offset),
      in_batches_(!bricks.empty() && index.size() < kMost &&
                  bricks.size() < kMost / (sizeof(format::Brick) / sizeof(std::int16_t)) &&
                  refined.size() < kMost / (sizeof(format::Refined) / sizeof(std::uint32_t))),
      cells_(kBrickCells * Vector3(grid.bricks[0], grid.bricks[1], grid.bricks[2])),
      stride_y_(grid.bricks[0]),
      stride_z_(std::ptrdiff_t{grid.bricks[0]} * grid.bricks[1]) {}

bool Voxelmap::locate(const Vector3& p_W, Cell& cell) const noexcept {
  const Vector3 node = (p_W - origin_) * per_voxel_;
  // written so that NaN falls outside
  const bool within = node.x() >= 0.0 && node.y() >= 0.0 && node.z() >= 0.0 && node.x() < cells_.x() &&
                      node.y() < cells_.y() && node.z() < cells_.z();
  if (!within) return false;
  const int ix = static_cast<int>(node.x());
  const int iy = static_cast<int>(node.y());
  const int iz = static_cast<int>(node.z());
  cell.fx = static_cast<float>(node.x() - ix);
  cell.fy = static_cast<float>(node.y() - iy);
  cell.fz = static_cast<float>(node.z() - iz);
  // shifts, not divisions: no coordinate is negative, which the compiler does not know
  constexpr int kShift = std::countr_zero(static_cast<unsigned>(kBrickCells));
  static_assert(1 << kShift == kBrickCells);
  cell.x = ix & (kBrickCells - 1);
  cell.y = iy & (kBrickCells - 1);
  cell.z = iz & (kBrickCells - 1);
  cell.entry = index_[(ix >> kShift) + stride_y_ * (iy >> kShift) + stride_z_ * (iz >> kShift)];
  return true;
}

/// Descends from a refined position through its octants to the unrefined cell that contains the point. Returns that
/// cell's edge [voxels].
double Voxelmap::descend(Cell& cell) const noexcept {
  constexpr int kHalf = kBrickCells / 2;
  std::array<double, 3> at = {cell.x + static_cast<double>(cell.fx), cell.y + static_cast<double>(cell.fy),
                              cell.z + static_cast<double>(cell.fz)};  // cells of the brick; halving is exact
  double cell_edge = 1.0;
  for (int level = 0; level < format::kMaxRefinement && (cell.entry & format::index_entry::kRefined) != 0; ++level) {
    const format::Refined& refined = refined_[cell.entry & format::index_entry::kNumber];
    unsigned octant = 0;
    for (unsigned axis = 0; axis < 3; ++axis) octant |= (at[axis] >= kHalf ? 1u : 0u) << axis;
    const std::uint32_t child = refined.child[octant];
    if ((child & format::index_entry::kCoarse) != 0) {
      cell.entry = refined.brick | (child & format::index_entry::kExact);
      break;
    }
    for (unsigned axis = 0; axis < 3; ++axis) at[axis] = 2.0 * (at[axis] - ((octant >> axis & 1u) != 0 ? kHalf : 0));
    cell.entry = child;
    cell_edge *= 0.5;
  }
  // rounding to float may have moved the point onto the brick's upper face
  cell.x = std::min(static_cast<int>(at[0]), kBrickCells - 1);
  cell.y = std::min(static_cast<int>(at[1]), kBrickCells - 1);
  cell.z = std::min(static_cast<int>(at[2]), kBrickCells - 1);
  cell.fx = static_cast<float>(at[0] - cell.x);
  cell.fy = static_cast<float>(at[1] - cell.y);
  cell.fz = static_cast<float>(at[2] - cell.z);
  return cell_edge;
}

/// Returns the brick with the own nodes of a position that is not far.
const format::Brick& Voxelmap::unrefined(std::uint32_t entry) const noexcept {
  const std::uint32_t number = entry & format::index_entry::kNumber;
  return bricks_[(entry & format::index_entry::kRefined) != 0 ? refined_[number].brick : number];
}

/// Returns the clearance of a point in a far position, which follows from that of the position's centre [m].
double Voxelmap::far_clearance(const Cell& cell) const noexcept {
  constexpr double kCenter = 0.5 * kBrickCells;
  const Vector3 from_center(cell.x + static_cast<double>(cell.fx) - kCenter,
                            cell.y + static_cast<double>(cell.fy) - kCenter,
                            cell.z + static_cast<double>(cell.fz) - kCenter);
  return static_cast<double>(format::index_entry::far_clearance(cell.entry)) - voxel_size_ * from_center.norm();
}

double Voxelmap::distance_to_box(const Vector3& p_W) const noexcept {
  return (surface_min_ - p_W).cwiseMax(p_W - surface_max_).cwiseMax(0.0).norm();
}

/// Returns the clearance of a point outside the grid [m]. The stored distance differs from the exact one by at most
/// kFieldError voxels.
double Voxelmap::outside_clearance(const Vector3& p_W) const noexcept { return distance_to_box(p_W) - outside_off_; }

namespace {

template <class Number>
detail::Trilinear trilinear(const Number* nodes, float fx, float fy, float fz) noexcept {
  const auto value = [nodes](int node) { return static_cast<float>(nodes[node]); };
  const auto step = [nodes](int node) { return static_cast<float>(nodes[node + 1] - nodes[node]); };
  const float d00 = step(0);
  const float d10 = step(kStrideY);
  const float d01 = step(kStrideZ);
  const float d11 = step(kStrideZ + kStrideY);
  const float x00 = value(0) + fx * d00;
  const float x10 = value(kStrideY) + fx * d10;
  const float x01 = value(kStrideZ) + fx * d01;
  const float x11 = value(kStrideZ + kStrideY) + fx * d11;
  const float y0 = x00 + fy * (x10 - x00);
  const float y1 = x01 + fy * (x11 - x01);
  const float d0 = d00 + fy * (d10 - d00);
  const float d1 = d01 + fy * (d11 - d01);
  return {y0 + fz * (y1 - y0), {d0 + fz * (d1 - d0), (x10 - x00) + fz * ((x11 - x01) - (x10 - x00)), y1 - y0}};
}

Vector3 vector(const float (&v)[3]) noexcept {
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

}  // namespace

/// Blends the interpolated field at p with the distance to the facets of its cell (format::ExactBrick).
void Voxelmap::blend(const CellOfFacets& cell, const Vector3& p, ValueAndGradient& field) const noexcept {
  const bool whole = (cell.word & format::cell_facets::kWhole) != 0;
  if (!whole && cell.weight.value <= 0.0f) return;
  ValueAndGradient facets = facet_distance(facets_, (cell.word & format::cell_facets::kSet) - 1, p);
  facets.value += facet_offset_;
  if (whole) {
    field = facets;
    return;
  }
  constexpr double kUnit = 1.0 / format::kOneWeight;
  const double weight = kUnit * static_cast<double>(cell.weight.value);
  const double apart = facets.value - field.value;
  field.value += weight * apart;
  field.gradient += weight * (facets.gradient - field.gradient) +
                    apart * kUnit * per_voxel_ / static_cast<double>(cell.edge) * vector(cell.weight.gradient);
}

/// Returns the sample of a stored value, with the bound of the gradient of its brick.
FieldSample Voxelmap::sample_of(const ValueAndGradient& field, double lipschitz) const noexcept {
  FieldSample sample;
  sample.distance = band_;
  // A straight path as long as a brick's edge stays in the positions around this one, or it leaves the stored bricks
  // and enters them again at a value of at least the band, rounded.
  if (field.value > 0.0) sample.clearance = std::min(field.value, near_band_) / lipschitz;
  if (!(std::fabs(field.value) < band_)) {
    if (field.value < 0.0) sample.distance = -band_;
    return sample;
  }
  sample.distance = field.value;
  sample.gradient = field.gradient;
  sample.known = true;
  return sample;
}

/// Blends the lanes with facets, which are points of the batch from `first` on.
void Voxelmap::blend_lanes(const detail::LanesWithFacets& lanes, SampleBatch& batch,
                           std::uint32_t first) const noexcept {
  const auto& [x, y, z] = lanes.weight_gradient;
  for (std::uint32_t left = lanes.bits; left != 0; left &= left - 1) {
    const auto lane = static_cast<std::uint32_t>(std::countr_zero(left));
    const std::uint32_t i = first + lane;
    if (i >= batch.count) return;
    const CellOfFacets cell{lanes.word[lane], lanes.cell_edge[lane], {lanes.weight[lane], {x[lane], y[lane], z[lane]}}};
    const Vector3 p_field = stored_position(batch, i);
    ValueAndGradient field{batch.distance[i], {batch.gradient_x[i], batch.gradient_y[i], batch.gradient_z[i]}};
    blend(cell, p_field, field);
    store_sample(p_field, sample_of(field, static_cast<double>(lanes.lipschitz[lane])), batch, i);
  }
}

FieldSample Voxelmap::sample(const Vector3& p_W) const noexcept {
  FieldSample sample;
  sample.distance = band_;
  // Where nothing is stored the clearance is positive: every path from there to the surface enters the stored bricks at
  // a value of at least the band.
  Cell cell;
  if (!locate(p_W, cell)) {
    sample.clearance = std::max(assured_clearance_, outside_clearance(p_W));
    return sample;
  }
  if (cell.entry & format::index_entry::kFar) {
    if (cell.entry & format::index_entry::kInside) {
      sample.distance = -band_;
    } else {
      sample.clearance = std::max(assured_clearance_, far_clearance(cell));
    }
    return sample;
  }
  double cell_edge = 1.0;
  if (cell.entry & format::index_entry::kRefined) cell_edge = descend(cell);
  const format::Brick& brick = bricks_[cell.entry & format::index_entry::kNumber];
  const int node = cell.x + kStrideY * cell.y + kStrideZ * cell.z;
  const detail::Trilinear interpolated = trilinear(brick.value + node, cell.fx, cell.fy, cell.fz);
  ValueAndGradient field{quantum_ * cell_edge * static_cast<double>(interpolated.value),
                         quantum_per_voxel_ * vector(interpolated.gradient)};
  if (cell.entry & format::index_entry::kExact) {
    const format::ExactBrick& exact = exact_[brick.exact - 1];
    const std::uint32_t word = exact.cell[cell.x + kBrickCells * (cell.y + kBrickCells * cell.z)];
    if (word != 0) {
      CellOfFacets of_facets{word, static_cast<float>(cell_edge), {}};
      if ((word & format::cell_facets::kWhole) == 0) {
        of_facets.weight = trilinear(exact.weight + node, cell.fx, cell.fy, cell.fz);
      }
      blend(of_facets, p_W, field);
    }
  }
  return sample_of(field, static_cast<double>(format::decode_lipschitz(brick.lipschitz)));
}

LayerSample Voxelmap::layer(const Vector3& p_W) const noexcept {
  LayerSample sample;
  const int deepest = static_cast<int>(band_ * per_voxel_ + 0.5);
  sample.layer = -deepest;
  Cell cell;
  if (!locate(p_W, cell)) return sample;
  // the nearest node is a corner of the cell, so it is stored wherever the cell is
  const int ox = cell.fx >= 0.5f ? 1 : 0;
  const int oy = cell.fy >= 0.5f ? 1 : 0;
  const int oz = cell.fz >= 0.5f ? 1 : 0;
  sample.to_center = voxel_size_ * Vector3(static_cast<double>(static_cast<float>(ox) - cell.fx),
                                           static_cast<double>(static_cast<float>(oy) - cell.fy),
                                           static_cast<double>(static_cast<float>(oz) - cell.fz));
  if (cell.entry & format::index_entry::kFar) {
    if (cell.entry & format::index_entry::kInside) sample.layer = deepest;
    return sample;
  }
  const int node = cell.x + ox + kStrideY * (cell.y + oy) + kStrideZ * (cell.z + oz);
  const double layers = -static_cast<double>(unrefined(cell.entry).value[node]) * quantum_per_voxel_;
  sample.layer = static_cast<int>(
      std::clamp(std::floor(layers + 0.5), -static_cast<double>(deepest), static_cast<double>(deepest)));
  return sample;
}

double Voxelmap::lower_bound(const Vector3& center_W, double radius) const noexcept {
  constexpr double kNoBound = -std::numeric_limits<double>::infinity();
  // spheres and distances come in single precision: a sphere may be this much too small, a distance this much off
  constexpr double kRadiusRounding = 2e-6;  // of the radius
  constexpr double kRounding = 1e-5;        // voxels
  radius += kRadiusRounding * radius + kRounding * voxel_size_;
  double bound = kNoBound;
  Cell cell;
  if (!locate(center_W, cell)) {
    bound = distance_to_box(center_W) - kFieldError * voxel_size_ - radius;
  } else if (cell.entry & format::index_entry::kFar) {
    if (cell.entry & format::index_entry::kInside) return kNoBound;
    bound = far_clearance(cell) - radius;
  } else {
    // Along the segment from the centre to a point of the ball the stored field falls by at most the Lipschitz constant
    // per metre while the segment stays in stored bricks. If the segment leaves them, outside, it enters them again at
    // a value of at least the band. The brick's own constant holds over a length of one brick.
    const bool about = radius <= kBrickCells * voxel_size_;
    const double lipschitz =
        about ? static_cast<double>(format::decode_lipschitz(unrefined(cell.entry).lipschitz)) : lipschitz_;
    bound = sample(center_W).distance - lipschitz * radius;
  }
  // A ball that may reach the surface may also reach through a seam into the solid; then there is no bound.
  return bound >= 0.0 ? bound : kNoBound;
}

}  // namespace godobject
