#include "toolchain/watch/stored_field.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace godobject::watch {
namespace {

using format::kBrickCells;
using format::kBrickNodes;

/// The bytes of a section; empty if the image has none.
std::span<const std::byte> section_bytes(std::span<const std::byte> image, format::SectionId id) {
  format::Header header;
  std::memcpy(&header, image.data(), sizeof(header));
  for (std::uint32_t i = 0; i < header.section_count; ++i) {
    format::Section section;
    std::memcpy(&section, image.data() + sizeof(header) + i * sizeof(section), sizeof(section));
    if (section.id == id) return image.subspan(section.offset, section.bytes);
  }
  return {};
}

template <class T>
std::span<const T> section_of(std::span<const std::byte> image, format::SectionId id) {
  const auto bytes = section_bytes(image, id);
  return {reinterpret_cast<const T*>(bytes.data()), bytes.size() / sizeof(T)};
}

double node(const format::Brick& brick, int x, int y, int z) {
  return brick.value[x + kBrickNodes * (y + kBrickNodes * z)];
}

Vector3 vector(const double (&v)[3]) { return {v[0], v[1], v[2]}; }

}  // namespace

StoredField::StoredField(std::span<const std::byte> image, const FieldSections& sections)
    : index_(section_of<std::uint32_t>(image, sections.index)),
      bricks_(section_of<format::Brick>(image, sections.bricks)),
      refined_(section_of<format::Refined>(image, sections.refined)),
      edges_(section_of<format::Edge>(image, sections.edges)) {
  const auto grid = section_bytes(image, sections.grid);
  if (grid.size() != sizeof(grid_)) throw std::runtime_error("the scene image has no such field");
  std::memcpy(&grid_, grid.data(), sizeof(grid_));
  lipschitz_ = steepest();
}

/// The trilinear field is nowhere steeper than the root of the sum of its largest differences along x, y and z in a
/// cell. An edge adds the gradients of its wedge and of its weight, which falls from 1 to 0 over half of its radius
/// while wedge and interpolation differ by less than that radius.
double StoredField::steepest() const {
  double most = 1.0;
  for (const format::Brick& brick : bricks_) {
    double d[3] = {0.0, 0.0, 0.0};
    for (int z = 0; z < kBrickNodes; ++z) {
      for (int y = 0; y < kBrickNodes; ++y) {
        for (int x = 0; x < kBrickNodes; ++x) {
          const double here = node(brick, x, y, z);
          if (x + 1 < kBrickNodes) d[0] = std::max(d[0], std::fabs(node(brick, x + 1, y, z) - here));
          if (y + 1 < kBrickNodes) d[1] = std::max(d[1], std::fabs(node(brick, x, y + 1, z) - here));
          if (z + 1 < kBrickNodes) d[2] = std::max(d[2], std::fabs(node(brick, x, y, z + 1) - here));
        }
      }
    }
    // quantum over cell edge is the same at every refinement: both are halved together
    const double slope = std::hypot(d[0], d[1], d[2]) * grid_.quantum / grid_.voxel_size;
    most = std::max(most, brick.edge != 0 ? slope + 3.0 : slope);
  }
  return most;
}

StoredField::Place StoredField::descend(std::uint32_t entry, Vector3 at) const {
  Place place;
  place.unit = grid_.quantum;
  place.cell = grid_.voxel_size;
  while ((entry & format::index_entry::kRefined) != 0) {
    const format::Refined& refined = refined_[entry & format::index_entry::kNumber];
    constexpr double kHalf = 0.5 * kBrickCells;
    unsigned octant = 0;
    for (int axis = 0; axis < 3; ++axis) octant |= (at[axis] >= kHalf ? 1u : 0u) << axis;
    const std::uint32_t child = refined.child[octant];
    if ((child & format::index_entry::kCoarse) != 0) {
      entry = refined.brick | (child & format::index_entry::kEdged);
      break;
    }
    for (int axis = 0; axis < 3; ++axis) at[axis] = 2.0 * (at[axis] - ((octant >> axis & 1u) != 0 ? kHalf : 0.0));
    place.unit *= 0.5;
    place.cell *= 0.5;
    entry = child;
  }
  place.brick = &bricks_[entry & format::index_entry::kNumber];
  place.has_edge = (entry & format::index_entry::kEdged) != 0;
  place.at = at;
  return place;
}

/// Trilinear: along x, then y, then z.
Slope StoredField::interpolate(const Place& place) {
  int cell[3];
  double f[3];
  for (int axis = 0; axis < 3; ++axis) {
    cell[axis] = std::clamp(static_cast<int>(place.at[axis]), 0, kBrickCells - 1);
    f[axis] = place.at[axis] - cell[axis];
  }
  Slope layer[2];
  for (int z = 0; z < 2; ++z) {
    double value[2], along_x[2];
    for (int y = 0; y < 2; ++y) {
      const double low = node(*place.brick, cell[0], cell[1] + y, cell[2] + z);
      along_x[y] = node(*place.brick, cell[0] + 1, cell[1] + y, cell[2] + z) - low;
      value[y] = low + f[0] * along_x[y];
    }
    layer[z].distance = value[0] + f[1] * (value[1] - value[0]);
    layer[z].gradient = Vector3(along_x[0] + f[1] * (along_x[1] - along_x[0]), value[1] - value[0], 0.0);
  }
  Slope slope;
  const double along_z = layer[1].distance - layer[0].distance;
  slope.distance = place.unit * (layer[0].distance + f[2] * along_z);
  slope.gradient = layer[0].gradient + f[2] * (layer[1].gradient - layer[0].gradient);
  slope.gradient.z() = along_z;
  slope.gradient *= place.unit / place.cell;
  return slope;
}

/// format::Edge's formula.
Slope StoredField::blend_with_edge(const format::Edge& edge, const Vector3& p, const Slope& interpolated) {
  const Vector3 from = p - vector(edge.point);
  const double t = vector(edge.along).dot(from);
  const double r = (from - t * vector(edge.along)).norm();
  const double to_end = std::min(t - edge.begin, edge.end - t);
  if (to_end <= 0.0) return interpolated;
  const double radius = std::min(edge.radius, edge.end_radius + edge.slope * to_end);
  const double weight = std::clamp(std::min(2.0 * (1.0 - r / radius), to_end / edge.ramp), 0.0, 1.0);
  if (weight == 0.0) return interpolated;

  // signed distance to the wedge: inside, the nearer plane; outside, the nearer half plane, which ends at the edge
  const double above[2] = {vector(edge.normal[0]).dot(from), vector(edge.normal[1]).dot(from)};
  double wedge = 0.0;
  Vector3 direction = Vector3::Zero();
  if (above[0] <= 0.0 && above[1] <= 0.0) {
    const int nearer = above[0] >= above[1] ? 0 : 1;
    wedge = above[nearer];
    direction = vector(edge.normal[nearer]);
  } else {
    double nearest = HUGE_VAL;
    for (int side = 0; side < 2; ++side) {
      const Vector3 in_face = std::max(0.0, vector(edge.face[side]).dot(from)) * vector(edge.face[side]);
      const Vector3 away = from - t * vector(edge.along) - in_face;
      if (away.norm() >= nearest) continue;
      nearest = away.norm();
      if (nearest > 0.0) direction = away / nearest;
    }
    wedge = nearest;
  }
  Slope value;
  value.distance = (1.0 - weight) * interpolated.distance + weight * (edge.side * wedge + edge.offset);
  // the weight's own gradient is left out: it multiplies the difference of wedge and interpolation, which is small
  value.gradient = (1.0 - weight) * interpolated.gradient + weight * edge.side * direction;
  return value;
}

Slope StoredField::slope(const Vector3& p) const {
  Slope value;
  value.distance = grid_.band;
  Vector3 at = (p - vector(grid_.origin)) / grid_.voxel_size;
  std::int64_t position[3];
  for (int axis = 0; axis < 3; ++axis) {
    const double brick = at[axis] / kBrickCells;
    if (!(brick >= 0.0) || !(brick < grid_.bricks[axis])) return value;
    position[axis] = static_cast<std::int64_t>(brick);
    at[axis] -= static_cast<double>(kBrickCells * position[axis]);
  }
  const std::int64_t number = position[0] + grid_.bricks[0] * (position[1] + grid_.bricks[1] * position[2]);
  const std::uint32_t entry = index_[static_cast<std::size_t>(number)];
  if ((entry & format::index_entry::kFar) != 0) {
    if ((entry & format::index_entry::kInside) != 0) value.distance = -grid_.band;
    return value;
  }
  const Place place = descend(entry, at);
  const Slope interpolated = interpolate(place);
  value = place.has_edge ? blend_with_edge(edges_[place.brick->edge - 1u], p, interpolated) : interpolated;
  if (std::fabs(value.distance) >= grid_.band) {
    value.distance = std::copysign(grid_.band, value.distance);
    value.gradient.setZero();
  }
  return value;
}

}  // namespace godobject::watch
