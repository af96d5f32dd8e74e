#include "tests/support/slow_field.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "core/scene/facets.h"

namespace godobject::test {
namespace {

constexpr double kFieldError = 0.8660254037844387 + 8.0 * 0.01;  // half a cell's diagonal and rounding [voxels]

Vector3 vector(const double (&v)[3]) { return {v[0], v[1], v[2]}; }

/// Fills in random refinements in the order of the walk.
class RandomEntries {
 public:
  RandomEntries(const RandomField& of, FieldParts& parts, Random& random) : of_(of), parts_(parts), random_(random) {}

  std::uint32_t position(const Vector3& low) {
    if (of_.far && random_.integer(0, 3) == 0) {
      const auto clearance = static_cast<float>(random_.between(0.0, 40.0) * of_.voxel_size);
      return format::index_entry::encode_far(random_.integer(0, 2) == 0, clearance);
    }
    return stored(low, 0);
  }

 private:
  bool one_of(int count) { return random_.integer(1, count) == 1; }

  std::uint32_t stored(const Vector3& low, int level) {
    const bool halves = of_.refined && level < format::kMaxRefinement && one_of(level == 0 ? 2 : 4);
    if (!halves) return brick(low, level);
    const auto number = static_cast<std::uint32_t>(parts_.refined.size());
    parts_.refined.push_back({format::kNoBrick, {}});
    std::array<bool, 8> coarse{};
    for (bool& c : coarse) c = one_of(4);
    const bool any_coarse = std::find(coarse.begin(), coarse.end(), true) != coarse.end();
    std::uint32_t own = format::kNoBrick;
    if (level == 0 || any_coarse) own = brick(low, level, any_coarse);
    parts_.refined[number].brick = own & format::index_entry::kNumber;
    if (own == format::kNoBrick) parts_.refined[number].brick = own;
    for (unsigned octant = 0; octant < 8; ++octant) {
      const Vector3 side(octant & 1, octant >> 1 & 1, octant >> 2);
      const double half = 0.5 * format::kBrickCells / (1 << level);
      const std::uint32_t child = coarse[octant] ? format::index_entry::kCoarse | (own & format::index_entry::kExact)
                                                 : stored(low + half * side, level + 1);
      parts_.refined[number].child[octant] = child;
    }
    return format::index_entry::kRefined | number;
  }

  /// Adds a brick whose lowest corner is `low` [voxels]. Returns its entry.
  std::uint32_t brick(const Vector3& low, int level, bool may_be_exact = true) {
    const auto number = static_cast<std::uint32_t>(parts_.bricks.size());
    format::Brick& brick = parts_.bricks.emplace_back();
    const double offset = random_.between(-2.0, 2.0);
    const double unit = std::ldexp(parts_.grid.quantum, -level);
    const Vector3 slope = random_.direction();
    for (int i = 0; i < format::kBrickValues; ++i) {
      const Vector3 node = Vector3(i % 5, i / 5 % 5, i / 25) / (1 << level);
      const double voxels = offset + slope.dot(node - Vector3::Constant(2.0 / (1 << level))) +
                            std::ldexp(random_.between(-of_.noise, of_.noise), -level);
      brick.value[i] = static_cast<std::int16_t>(std::lround(voxels * of_.voxel_size / unit));
    }
    brick.lipschitz = static_cast<std::uint16_t>(random_.integer(0, 6000));
    brick.deviation = static_cast<std::uint16_t>(random_.integer(0, 40));
    if (!of_.exact || !may_be_exact || !one_of(3)) return number;
    add_exact(low, level);
    brick.exact = static_cast<std::uint16_t>(parts_.exact.size());
    return number | format::index_entry::kExact;
  }

  /// Adds an exact brick: random weights, and for each cell some of the facets of a crooked tetrahedron near the brick.
  void add_exact(const Vector3& low, int level) {
    const double s = of_.voxel_size;
    const double edge = 4.0 / (1 << level);
    Vector3 vertex[4], vertex_normal[4], edge_normal[4][4];
    const Vector3 middle = low + edge * (Vector3::Constant(0.5) + 0.3 * random_.direction());
    for (int i = 0; i < 4; ++i) {
      vertex[i] = vector(parts_.grid.origin) + s * (middle + edge * random_.direction());
      vertex_normal[i] = random_.direction();
      for (int k = 0; k < i; ++k) edge_normal[i][k] = edge_normal[k][i] = random_.direction();
    }
    const auto store = [](const Vector3& v, auto& to) {
      for (int axis = 0; axis < 3; ++axis) to[axis] = static_cast<std::remove_reference_t<decltype(to[0])>>(v[axis]);
    };
    const auto first = static_cast<std::uint32_t>(parts_.facets.size());
    for (int face = 0; face < 4; ++face) {
      format::Facet& facet = parts_.facets.emplace_back();
      const int corner[3] = {(face + 1) % 4, (face + 2) % 4, (face + 3) % 4};
      for (int k = 0; k < 3; ++k) {
        store(vertex[corner[k]], facet.vertex[k]);
        store(vertex_normal[corner[k]], facet.vertex_normal[k]);
        store(edge_normal[corner[k]][corner[(k + 1) % 3]], facet.edge_normal[k]);
      }
      set_planes(facet,
                 (vertex[corner[1]] - vertex[corner[0]]).cross(vertex[corner[2]] - vertex[corner[0]]).normalized());
    }
    format::ExactBrick& exact = parts_.exact.emplace_back();
    for (std::uint16_t& weight : exact.weight) {
      weight = static_cast<std::uint16_t>(one_of(2) ? random_.integer(0, 1) << 14 : random_.integer(0, 1 << 14));
    }
    // half of the bricks have a corner without weights, whose cells lack facets; half have whole cells
    const int last_whole = one_of(2) ? 2 : -1;
    const int first_weightless =
        one_of(2) ? format::kBrickNodes : static_cast<int>(random_.integer(1, format::kBrickCells - 1));
    for (int node = 0; node < format::kBrickValues; ++node) {
      const int steps[3] = {node % format::kBrickNodes, node / format::kBrickNodes % format::kBrickNodes,
                            node / (format::kBrickNodes * format::kBrickNodes)};
      if (steps[0] <= last_whole) exact.weight[node] = format::kOneWeight;
      if (std::min({steps[0], steps[1], steps[2]}) >= first_weightless) exact.weight[node] = 0;
    }
    for (int number = 0; number < format::kCellsPerBrick; ++number) exact.cell[number] = word(exact, number, first);
  }

  /// Returns the word of a cell, with a new set of some of four facets if it has a weight. Two of three sets have a
  /// first part.
  std::uint32_t word(const format::ExactBrick& exact, int number, std::uint32_t first_facet) {
    bool weighed = false;
    bool whole = true;
    for (int corner = 0; corner < 8; ++corner) {
      const int node = number % 4 + corner % 2 + 5 * (number / 4 % 4 + corner / 2 % 2 + 5 * (number / 16 + corner / 4));
      weighed = weighed || exact.weight[node] > 0;
      whole = whole && exact.weight[node] == 1 << 14;
    }
    if (!weighed) return 0;
    std::vector<std::uint32_t> part[2];
    const bool has_planes = !one_of(3);
    for (std::uint32_t face = 0; face < 4; ++face) {
      if (face < 3 && one_of(2)) continue;
      part[has_planes && one_of(2) ? 0 : 1].push_back(first_facet + face);
    }
    parts_.facet_sets.push_back({static_cast<std::uint32_t>(parts_.facet_numbers.size()),
                                 static_cast<std::uint16_t>(part[0].size() + part[1].size()),
                                 static_cast<std::uint16_t>(part[0].size())});
    for (const auto& numbers : part) {
      parts_.facet_numbers.insert(parts_.facet_numbers.end(), numbers.begin(), numbers.end());
    }
    return static_cast<std::uint32_t>(parts_.facet_sets.size()) | (whole ? 1u << 31 : 0u);
  }

  const RandomField& of_;
  FieldParts& parts_;
  Random& random_;
};

}  // namespace

FieldParts random_field(const RandomField& of, Random& random) {
  FieldParts parts;
  format::Grid& grid = parts.grid;
  grid.voxel_size = of.voxel_size;
  grid.band = 3.0 * of.voxel_size;
  grid.quantum = 0x1p-9 * of.voxel_size;
  grid.lipschitz = 1.5, grid.lipschitz_seam = 1.75, grid.clearance_slope = 1.25,
  grid.outside_loss = 0.5 * of.voxel_size;
  for (int axis = 0; axis < 3; ++axis) {
    grid.bricks[axis] = of.bricks[static_cast<std::size_t>(axis)];
    grid.origin[axis] = of.voxel_size * random.integer(-5, 5);
    grid.surface_min[axis] = grid.origin[axis] + of.voxel_size * random.between(1.0, 2.0);
    grid.surface_max[axis] = grid.origin[axis] + of.voxel_size * (4.0 * grid.bricks[axis] - random.between(1.0, 2.0));
  }
  if (of.exact) grid.facet_offset = random.between(-0.2, 0.2) * of.voxel_size;
  RandomEntries entries(of, parts, random);
  for (int z = 0; z < of.bricks[2]; ++z) {
    for (int y = 0; y < of.bricks[1]; ++y) {
      for (int x = 0; x < of.bricks[0]; ++x) parts.index.push_back(entries.position(4.0 * Vector3(x, y, z)));
    }
  }
  grid.brick_count = static_cast<std::uint32_t>(parts.bricks.size());
  return parts;
}

void renumber_bricks(FieldParts& parts) {
  const auto last = static_cast<std::uint32_t>(parts.bricks.size() - 1);
  const auto renumber = [last](std::uint32_t& entry) {
    if ((entry >> 31) == 1 || (entry >> 29) == 1) return;
    entry = (entry & ~format::index_entry::kNumber) + (last - (entry & format::index_entry::kNumber));
  };
  for (std::uint32_t& entry : parts.index) renumber(entry);
  for (format::Refined& refined : parts.refined) {
    renumber(refined.brick);
    for (std::uint32_t& child : refined.child) renumber(child);
  }
  std::reverse(parts.bricks.begin(), parts.bricks.end());
}

double slow_lipschitz(std::uint16_t code) { return std::ldexp(1.0 + (code % 4096) / 4096.0, code / 4096); }

double SlowField::near_band() const {
  return std::min(parts_.grid.band - 8.0 * parts_.grid.quantum, 4.0 * parts_.grid.voxel_size);
}
double SlowField::assured() const { return near_band() / std::max(1.0, parts_.grid.lipschitz_seam); }

const format::Brick& SlowField::own(std::uint32_t entry) const {
  const std::uint32_t number = entry % (1u << 28);
  return parts_.bricks[(entry >> 29) == 1 ? parts_.refined[number].brick : number];
}

SlowField::Place SlowField::place(const Vector3& p) const {
  const format::Grid& grid = parts_.grid;
  Place place;
  int position[3];
  for (int axis = 0; axis < 3; ++axis) {
    const double voxels = (p[axis] - grid.origin[axis]) / grid.voxel_size;
    const double low = std::floor(voxels / 4.0);
    if (!(low >= 0.0 && low < grid.bricks[axis])) return place;
    position[axis] = static_cast<int>(low);
    place.in_position[axis] = voxels - 4.0 * low;
  }
  place.in_grid = true;
  const int number = (position[2] * grid.bricks[1] + position[1]) * grid.bricks[0] + position[0];
  place.position = parts_.index[static_cast<std::size_t>(number)];
  place.stored = place.position < (1u << 31);
  if (!place.stored) return place;
  std::uint32_t entry = place.position;
  Vector3 low = Vector3::Zero();
  double edge = 4.0;  // of the brick [voxels]
  while ((entry >> 29) == 1) {
    const format::Refined& refined = parts_.refined[entry % (1u << 28)];
    Vector3 upper = low;
    unsigned octant = 0;
    for (unsigned axis = 0; axis < 3; ++axis) {
      if (place.in_position[axis] < low[axis] + 0.5 * edge) continue;
      octant += 1u << axis;
      upper[axis] += 0.5 * edge;
    }
    const std::uint32_t child = refined.child[octant];
    if (child >= (1u << 31)) {
      entry = refined.brick + (child - (1u << 31));
      break;
    }
    entry = child;
    low = upper;
    edge *= 0.5;
    ++place.level;
  }
  place.exact = (entry >> 28) == 1;
  place.brick = &parts_.bricks[entry % (1u << 28)];
  for (int axis = 0; axis < 3; ++axis) {
    const double cells = (place.in_position[axis] - low[axis]) / (0.25 * edge);
    place.cell[static_cast<std::size_t>(axis)] = std::min(3, static_cast<int>(std::floor(cells)));
    place.at[axis] = cells - place.cell[static_cast<std::size_t>(axis)];
  }
  return place;
}

double SlowField::quanta(const Place& place, const Vector3& at) const {
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const int up[3] = {corner % 2, corner / 2 % 2, corner / 4};
    double weight = std::ldexp(1.0, -place.level);
    for (int axis = 0; axis < 3; ++axis) weight *= up[axis] == 1 ? at[axis] : 1.0 - at[axis];
    const int node = place.cell[0] + up[0] + 5 * (place.cell[1] + up[1] + 5 * (place.cell[2] + up[2]));
    sum += weight * place.brick->value[node];
  }
  return sum;
}

Vector3 SlowField::slope(const Place& place) const {
  Vector3 slope;
  for (int axis = 0; axis < 3; ++axis) {  // linear along an axis: the difference of its two faces
    Vector3 low = place.at, high = place.at;
    low[axis] = 0.0;
    high[axis] = 1.0;
    slope[axis] = (quanta(place, high) - quanta(place, low)) *
                  std::ldexp(parts_.grid.quantum / parts_.grid.voxel_size, place.level);
  }
  return slope;
}

double SlowField::weight(const Place& place) const {
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const int up[3] = {corner % 2, corner / 2 % 2, corner / 4};
    double share = 1.0;
    for (int axis = 0; axis < 3; ++axis) share *= up[axis] == 1 ? place.at[axis] : 1.0 - place.at[axis];
    const int node = place.cell[0] + up[0] + 5 * (place.cell[1] + up[1] + 5 * (place.cell[2] + up[2]));
    sum += share * exact_of(place).weight[node] / 16384.0;
  }
  return sum;
}

const format::FacetSet* SlowField::facets_of(const Place& place) const {
  if (!place.exact) return nullptr;
  const std::uint32_t word = exact_of(place).cell[place.cell[0] + 4 * (place.cell[1] + 4 * place.cell[2])];
  return word == 0 ? nullptr : &parts_.facet_sets[word % (1u << 31) - 1];
}

bool SlowField::is_whole(const Place& place) const {
  return exact_of(place).cell[place.cell[0] + 4 * (place.cell[1] + 4 * place.cell[2])] >> 31 == 1;
}

double SlowField::least_height(const format::FacetSet& set, const Vector3& p) const {
  double least = HUGE_VAL;
  for (std::uint32_t i = 0; i < set.plane_count; ++i) {
    const format::Facet& facet = parts_.facets[parts_.facet_numbers[set.first + i]];
    const Vector3 up(facet.plane[0][0], facet.plane[1][0], facet.plane[2][0]);
    least = std::min(least, up.dot(p - vector(facet.vertex[0])));
  }
  return least;
}

/// The nearest place of each facet by a search: along an edge, or on the plane if that lies in the triangle.
double SlowField::facet_distance(const Place& place, const Vector3& p) const {
  const format::FacetSet& set = *facets_of(place);
  const double height = least_height(set, p);
  if (set.plane_count > 0 && height >= 0.0) return height;
  double nearest = HUGE_VAL;
  Vector3 away = Vector3::Zero(), normal = Vector3::Zero();
  const auto compare = [&](const Vector3& q, const Vector3& n) {
    if ((p - q).norm() >= nearest) return;
    nearest = (p - q).norm();
    away = p - q;
    normal = n;
  };
  const auto single = [](const float(&v)[3]) {
    return Vector3(static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2]));
  };
  for (std::uint32_t i = 0; i < set.count; ++i) {
    const format::Facet& facet = parts_.facets[parts_.facet_numbers[set.first + i]];
    const Vector3 a = vector(facet.vertex[0]), b = vector(facet.vertex[1]), c = vector(facet.vertex[2]);
    const Vector3 up(facet.plane[0][0], facet.plane[1][0], facet.plane[2][0]);
    Matrix3 frame;  // p = a + x (b - a) + y (c - a) + z up
    frame << b - a, c - a, up;
    const Vector3 at = frame.inverse() * (p - a);
    if (at.x() >= 0.0 && at.y() >= 0.0 && at.x() + at.y() <= 1.0) compare(p - at.z() * up, up);
    for (int k = 0; k < 3; ++k) {
      const Vector3 from = vector(facet.vertex[k]), to = vector(facet.vertex[(k + 1) % 3]);
      const double t = (p - from).dot(to - from) / (to - from).squaredNorm();
      compare(from, single(facet.vertex_normal[k]));
      if (t > 0.0 && t < 1.0) compare(from + t * (to - from), single(facet.edge_normal[k]));
    }
  }
  return away.dot(normal) >= 0.0 ? nearest : -nearest;
}

double SlowField::stored(const Place& place, const Vector3& p) const {
  const double interpolated = parts_.grid.quantum * quanta(place, place.at);
  if (facets_of(place) == nullptr) return interpolated;
  const double w = weight(place);
  return w == 0.0 ? interpolated : (1.0 - w) * interpolated + w * (facet_distance(place, p) + parts_.grid.facet_offset);
}

double SlowField::distance_to_box(const Vector3& p) const {
  double squared = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double nearest = std::clamp(p[axis], parts_.grid.surface_min[axis], parts_.grid.surface_max[axis]);
    squared += (p[axis] - nearest) * (p[axis] - nearest);
  }
  return std::sqrt(squared);
}

double SlowField::far_clearance(const Place& place) const {
  const std::uint32_t code = place.position % (1u << 30);
  const double of_center = std::ldexp(1.0 + (code % (1u << 22)) * 0x1p-22, static_cast<int>(code >> 22) - 127);
  return of_center - parts_.grid.voxel_size * (place.in_position - Vector3::Constant(2.0)).norm();
}

FieldSample SlowField::sample(const Vector3& p) const {
  const format::Grid& grid = parts_.grid;
  FieldSample sample;
  sample.distance = grid.band;
  const Place at = place(p);
  if (!at.in_grid) {
    const double outside = distance_to_box(p) - kFieldError * grid.voxel_size - grid.outside_loss;
    sample.clearance = std::max(assured(), outside);
    return sample;
  }
  if (!at.stored) {
    const bool inside = (at.position >> 30) == 3;
    if (inside) sample.distance = -grid.band;
    sample.clearance = inside ? 0.0 : std::max(assured(), far_clearance(at));
    return sample;
  }
  const double distance = stored(at, p);
  sample.clearance = std::clamp(distance, 0.0, near_band()) / slow_lipschitz(at.brick->lipschitz);
  sample.known = std::fabs(distance) < grid.band;
  sample.distance = std::clamp(distance, -grid.band, grid.band);
  if (sample.known) sample.gradient = slope(at);
  return sample;
}

double SlowField::batch_clearance(const Vector3& p) const {
  const Place at = place(p);
  if (!at.in_grid || !at.stored) return sample(p).clearance;
  Place coarse = at;
  coarse.brick = &own(at.position);
  coarse.level = 0;
  for (int axis = 0; axis < 3; ++axis) {
    coarse.cell[static_cast<std::size_t>(axis)] = static_cast<int>(at.in_position[axis]);
    coarse.at[axis] = at.in_position[axis] - coarse.cell[static_cast<std::size_t>(axis)];
  }
  const double distance = parts_.grid.quantum * (quanta(coarse, coarse.at) - coarse.brick->deviation);
  return std::clamp(distance, 0.0, near_band()) / slow_lipschitz(coarse.brick->lipschitz);
}

LayerSample SlowField::layer(const Vector3& p) const {
  const format::Grid& grid = parts_.grid;
  LayerSample sample;
  const auto deepest = static_cast<int>(std::lround(grid.band / grid.voxel_size));
  sample.layer = -deepest;
  const Place at = place(p);
  if (!at.in_grid) return sample;
  int node[3];
  for (int axis = 0; axis < 3; ++axis) {
    node[axis] = static_cast<int>(std::floor(at.in_position[axis] + 0.5));
    sample.to_center[axis] = grid.voxel_size * (node[axis] - at.in_position[axis]);
  }
  if (!at.stored) {
    if ((at.position >> 30) == 3) sample.layer = deepest;
    return sample;
  }
  const double voxels = -own(at.position).value[node[0] + 5 * (node[1] + 5 * node[2])] * grid.quantum / grid.voxel_size;
  sample.layer = std::clamp(static_cast<int>(std::floor(voxels + 0.5)), -deepest, deepest);
  return sample;
}

double SlowField::lower_bound(const Vector3& center, double radius) const {
  const format::Grid& grid = parts_.grid;
  const double enlarged = radius * (1.0 + 2e-6) + 1e-5 * grid.voxel_size;
  const Place at = place(center);
  double bound = 0.0;
  if (!at.in_grid) {
    bound = distance_to_box(center) - kFieldError * grid.voxel_size - enlarged;
  } else if (!at.stored) {
    bound = (at.position >> 30) == 3 ? -1.0 : far_clearance(at) - enlarged;
  } else {
    const bool in_vicinity = enlarged <= 4.0 * grid.voxel_size;  // for which a brick's own bound holds
    const double steepest =
        in_vicinity ? slow_lipschitz(own(at.position).lipschitz) : std::max(1.0, grid.lipschitz_seam);
    bound = sample(center).distance - steepest * enlarged;
  }
  return bound >= 0.0 ? bound : -HUGE_VAL;
}

}  // namespace godobject::test
