#include "tests/support/slow_field.h"

#include <algorithm>
#include <cmath>

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
      const std::uint32_t child = coarse[octant] ? format::index_entry::kCoarse | (own & format::index_entry::kEdged)
                                                 : stored(low + half * side, level + 1);
      parts_.refined[number].child[octant] = child;
    }
    return format::index_entry::kRefined | number;
  }

  /// Adds a brick whose lowest corner is `low` [voxels]. Returns its entry.
  std::uint32_t brick(const Vector3& low, int level, bool may_have_edge = true) {
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
    if (of_.edge_count == 0 || !may_have_edge || !one_of(3)) return number;
    brick.edge = static_cast<std::uint16_t>(random_.integer(1, of_.edge_count));
    set_edge(parts_.edges[brick.edge - 1u], low + Vector3::Constant(2.0 / (1 << level)));
    return number | format::index_entry::kEdged;
  }

  /// Leads an edge near a point of the grid [voxels], so that its weights matter there.
  void set_edge(format::Edge& edge, const Vector3& near) {
    if (edge.ramp != 0.0) return;
    const double s = of_.voxel_size;
    const Matrix3 turn = exp_rotation(random_.between(0.0, 3.0) * random_.direction()).toRotationMatrix();
    const double angle = random_.between(0.5, 2.6);
    const auto store = [&turn](const Vector3& v, double* to) {
      const Vector3 turned = turn * v;
      std::copy_n(turned.data(), 3, to);
    };
    store(Vector3::UnitZ(), edge.along);
    store(Vector3::UnitX(), edge.normal[0]);
    store(-Vector3::UnitY(), edge.face[0]);
    const Vector3 face(-std::sin(angle), -std::cos(angle), 0.0);
    store(face, edge.face[1]);
    store({face.y(), -face.x(), 0.0}, edge.normal[1]);
    const Vector3 point = vector(parts_.grid.origin) + s * (near + 0.3 * random_.direction());
    std::copy_n(point.data(), 3, edge.point);
    edge.side = one_of(2) ? 1.0 : -1.0;
    edge.offset = random_.between(-0.2, 0.2) * s;
    edge.begin = -4.0 * s, edge.end = 5.0 * s, edge.ramp = 1.5 * s;
    edge.radius = 3.0 * s, edge.end_radius = 1.0 * s, edge.slope = 0.6;
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
  parts.edges.resize(static_cast<std::size_t>(of.edge_count));
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
  place.edged = (entry >> 28) == 1;
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

double SlowField::stored(const Place& place, const Vector3& p) const {
  const double interpolated = parts_.grid.quantum * quanta(place, place.at);
  if (!place.edged) return interpolated;
  const format::Edge& edge = edge_of(place);
  const Vector3 from = p - vector(edge.point);
  const double t = vector(edge.along).dot(from);
  const Vector3 across = from - t * vector(edge.along);
  const double to_end = std::min(t - edge.begin, edge.end - t);
  const double radius = std::min(edge.radius, edge.end_radius + edge.slope * to_end);
  const double weight = std::clamp(std::min(2.0 * (1.0 - across.norm() / radius), to_end / edge.ramp), 0.0, 1.0);
  bool inside = true;
  double nearest = across.norm();
  for (int i = 0; i < 2; ++i) {
    const double along = std::max(0.0, vector(edge.face[i]).dot(across));
    nearest = std::min(nearest, (across - along * vector(edge.face[i])).norm());
    inside = inside && vector(edge.normal[i]).dot(across) <= 0.0;
  }
  // inside, the planes' distances bound the wedge; there the nearest point is on a face, as an angle is below 180
  // degrees
  if (inside) nearest = std::min(-vector(edge.normal[0]).dot(across), -vector(edge.normal[1]).dot(across));
  const double wedge = edge.side * (inside ? -nearest : nearest) + edge.offset;
  return (1.0 - weight) * interpolated + weight * wedge;
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
