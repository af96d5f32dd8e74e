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
      facet_sets_(section_of<format::FacetSet>(image, sections.facet_sets)),
      facet_numbers_(section_of<std::uint32_t>(image, sections.facet_numbers)),
      exact_(section_of<format::ExactBrick>(image, sections.exact)) {
  const auto grid = section_bytes(image, sections.grid);
  if (grid.size() != sizeof(grid_)) throw std::runtime_error("the scene image has no such field");
  std::memcpy(&grid_, grid.data(), sizeof(grid_));
  const auto facets = section_of<format::Facet>(image, sections.facets);
  facets_.reserve(facets.size());
  for (const format::Facet& facet : facets) facets_.push_back(measured(facet));
  lipschitz_ = steepest();
}

/// The trilinear field is nowhere steeper than the root of the sum of its largest differences along x, y and z in a
/// cell. In an exact brick the gradients of the distance to facets and of the weight add to that: the weight changes by
/// at most 1 along each edge of a cell, in which facets and interpolation differ by less than a cell.
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
    most = std::max(most, brick.exact != 0 ? slope + 3.0 : slope);
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
      entry = refined.brick | (child & format::index_entry::kExact);
      break;
    }
    for (int axis = 0; axis < 3; ++axis) at[axis] = 2.0 * (at[axis] - ((octant >> axis & 1u) != 0 ? kHalf : 0.0));
    place.unit *= 0.5;
    place.cell *= 0.5;
    entry = child;
  }
  place.brick = &bricks_[entry & format::index_entry::kNumber];
  place.is_exact = (entry & format::index_entry::kExact) != 0;
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

/// format::ExactBrick's formula.
Slope StoredField::blend(const Place& place, const Vector3& p, const Slope& interpolated) const {
  const format::ExactBrick& exact = exact_[place.brick->exact - 1u];
  double weight = 0.0;
  int in_brick = 0;
  for (int axis = 2; axis >= 0; --axis) {
    in_brick = kBrickCells * in_brick + std::clamp(static_cast<int>(place.at[axis]), 0, kBrickCells - 1);
  }
  for (int corner = 0; corner < 8; ++corner) {
    int number = 0, stride = 1;
    double share = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
      const int cell = std::clamp(static_cast<int>(place.at[axis]), 0, kBrickCells - 1);
      const int upper = corner >> axis & 1;
      number += stride * (cell + upper);
      stride *= kBrickNodes;
      share *= 1.0 - std::fabs(place.at[axis] - cell - upper);
    }
    weight += share * exact.weight[number] / format::kOneWeight;
  }
  if (weight <= 0.0) return interpolated;
  const std::uint32_t set = (exact.cell[in_brick] & format::cell_facets::kSet) - 1;
  const Slope facets = from_facets(facet_sets_[set], p);
  Slope value;
  value.distance = (1.0 - weight) * interpolated.distance + weight * (facets.distance + grid_.facet_offset);
  // the weight's own gradient is left out: it multiplies the difference of both distances, which is small
  value.gradient = (1.0 - weight) * interpolated.gradient + weight * facets.gradient;
  return value;
}

StoredField::Facet StoredField::measured(const format::Facet& facet) {
  const auto single = [](const float(&v)[3]) { return Vector3(v[0], v[1], v[2]); };
  Facet measured;
  measured.up = Vector3(facet.plane[0][0], facet.plane[1][0], facet.plane[2][0]);
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3 from = vector(facet.vertex[k]);
    const Vector3 edge = vector(facet.vertex[(k + 1) % 3]) - from;
    const Vector3 along = edge.normalized();
    measured.edges[k] = {from,
                         along,
                         edge.norm(),
                         measured.up.cross(along),
                         single(facet.edge_normal[k]),
                         single(facet.vertex_normal[k])};
  }
  return measured;
}

/// The distance to all facets of a set, by the places nearest to p: of a plane, of three edges, of three vertices.
Slope StoredField::from_facets(const format::FacetSet& set, const Vector3& p) const {
  double least = HUGE_VAL;  // squared
  Vector3 away = Vector3::Zero();
  const Vector3* normal = nullptr;
  const auto compare = [&](const Vector3& from_place, const Vector3& of_place) {
    const double squared = from_place.squaredNorm();
    if (squared >= least) return;
    least = squared;
    away = from_place;
    normal = &of_place;
  };
  for (const std::uint32_t number : facet_numbers_.subspan(set.first, set.count)) {
    const Facet& facet = facets_[number];
    bool above = true;
    for (const Edge& edge : facet.edges) {
      const Vector3 from_vertex = p - edge.from;
      const double t = edge.along.dot(from_vertex);
      above = above && edge.inward.dot(from_vertex) >= 0.0;
      compare(from_vertex, edge.vertex_normal);
      if (t > 0.0 && t < edge.length) compare(from_vertex - t * edge.along, edge.normal);
    }
    if (above) compare(facet.up.dot(p - facet.edges[0].from) * facet.up, facet.up);
  }
  Slope slope;
  const double distance = std::sqrt(least);
  const double side = normal == nullptr || away.dot(*normal) >= 0.0 ? 1.0 : -1.0;
  slope.distance = side * distance;
  if (distance > 1e-12) {
    slope.gradient = side / distance * away;
  } else if (normal != nullptr) {
    slope.gradient = normal->normalized();
  }
  return slope;
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
  value = place.is_exact ? blend(place, p, interpolated) : interpolated;
  if (std::fabs(value.distance) >= grid_.band) {
    value.distance = std::copysign(grid_.band, value.distance);
    value.gradient.setZero();
  }
  return value;
}

}  // namespace godobject::watch
