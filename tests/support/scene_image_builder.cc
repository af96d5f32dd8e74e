#include "tests/support/scene_image_builder.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "godobject/status.h"

namespace godobject::test {
namespace {

using format::kBrickCells;
using format::kBrickNodes;
using format::SectionId;

constexpr double kHalfDiagonal = 0.8660254037844387;  // of a unit cube

std::size_t padded(std::size_t bytes) {
  return (bytes + format::kAlignment - 1) / format::kAlignment * format::kAlignment;
}

/// A brick before its values are rounded.
struct Brick {
  double value[format::kBrickValues];  ///< [m]
  int level;                           ///< number of halvings
  std::uint16_t exact;
};

/// The still body: grid, brick index, bricks.
struct StoredField {
  format::Grid grid{};
  std::vector<std::uint32_t> index;
  std::vector<Brick> bricks;
  std::vector<format::Refined> refined;
};

format::Grid frame_grid(const SceneDescription& description) {
  format::Grid grid{};
  grid.voxel_size = description.voxel_size;
  grid.band = description.band > 0.0 ? description.band : 4.0 * description.voxel_size;
  const double brick_edge = kBrickCells * grid.voxel_size;
  const double margin = grid.band + grid.voxel_size;
  for (int axis = 0; axis < 3; ++axis) {
    grid.surface_min[axis] = description.surface_min[axis];
    grid.surface_max[axis] = description.surface_max[axis];
    grid.origin[axis] = description.surface_min[axis] - margin;
    const double span = description.surface_max[axis] - description.surface_min[axis] + 2.0 * margin;
    grid.bricks[axis] = static_cast<std::int32_t>(std::ceil(span / brick_edge - 1e-9));
  }
  return grid;
}

/// Returns the distance at a node of `level`, rounded to a multiple of the quantum, or of 16 / 4^level quanta in a
/// refined field. A finer node that interpolates such values has a multiple of its own level's unit, so rounding keeps
/// the values that refinements share. Returns `distance` unchanged while the quantum is unknown.
double node_rounded(double distance, const SceneDescription& description, const format::Grid& grid, int level) {
  if (grid.quantum == 0.0) return distance;
  const double unit = std::ldexp(grid.quantum, description.refined ? format::kMaxRefinement - 2 * level : 0);
  return unit * std::round(distance / unit);
}

Brick sample_brick(const SceneDescription& description, const format::Grid& grid, const std::array<int, 3>& at) {
  Brick brick{};
  for (int z = 0, node = 0; z < kBrickNodes; ++z) {
    for (int y = 0; y < kBrickNodes; ++y) {
      for (int x = 0; x < kBrickNodes; ++x, ++node) {
        const Vector3 lattice(at[0] * kBrickCells + x, at[1] * kBrickCells + y, at[2] * kBrickCells + z);
        const Vector3 p_W = Vector3(grid.origin[0], grid.origin[1], grid.origin[2]) + grid.voxel_size * lattice;
        brick.value[node] = node_rounded(description.distance(p_W), description, grid, 0);
      }
    }
  }
  return brick;
}

/// Largest gradient norm in the brick, times the voxel size. The gradient is affine along each axis, so its norm is
/// largest in the corners of a cell, where it is made of the three edges that meet there.
double steepest(const Brick& brick) {
  constexpr int kStride[3] = {1, kBrickNodes, kBrickNodes * kBrickNodes};
  double steepest_squared = 0.0;
  for (int node = 0; node < format::kBrickValues; ++node) {
    for (int corner = 0; corner < 8; ++corner) {
      double norm_squared = 0.0;
      for (int axis = 0; axis < 3; ++axis) {
        const int position = node / kStride[axis] % kBrickNodes;
        const bool up = ((corner >> axis) & 1) != 0;
        if (position == (up ? kBrickNodes - 1 : 0)) {
          norm_squared = 0.0;
          break;
        }
        const int other = up ? node + kStride[axis] : node - kStride[axis];
        const double edge = brick.value[other] - brick.value[node];
        norm_squared += edge * edge;
      }
      steepest_squared = std::max(steepest_squared, norm_squared);
    }
  }
  return std::sqrt(steepest_squared);
}

/// Refines stored positions. Slow and simple: computes every node's value from its definition, at every level.
class Octants {
 public:
  Octants(const SceneDescription& description, StoredField& field) : description_(description), field_(field) {}

  /// Refines all stored positions. Returns the largest gradient of the octants.
  double store() {
    for (std::size_t i = 0; i < field_.index.size(); ++i) {
      if ((field_.index[i] & format::index_entry::kFar) != 0) continue;
      const auto nx = static_cast<std::size_t>(field_.grid.bricks[0]);
      const auto ny = static_cast<std::size_t>(field_.grid.bricks[1]);
      const Vector3 at(static_cast<double>(i % nx), static_cast<double>(i / nx % ny), static_cast<double>(i / nx / ny));
      field_.index[i] = store(origin() + brick_edge(0) * at, 0, field_.index[i]);
    }
    return slope_;
  }

 private:
  Vector3 origin() const { return Vector3(field_.grid.origin[0], field_.grid.origin[1], field_.grid.origin[2]); }
  double cell_edge(int level) const { return field_.grid.voxel_size / (1 << level); }
  double brick_edge(int level) const { return kBrickCells * cell_edge(level); }

  bool is_refined(const Vector3& low, int level) const {
    const double edge = brick_edge(level);
    return level < format::kMaxRefinement && description_.refined(low + Vector3::Constant(0.5 * edge), edge);
  }

  /// Returns true if the octant whose lowest corner is `low` stays coarse.
  bool is_coarse(const Vector3& low, int level) const {
    const double edge = brick_edge(level);
    return description_.coarse && description_.coarse(low + Vector3::Constant(0.5 * edge), edge);
  }

  std::uint32_t add_brick(const Vector3& low, int level) {
    field_.bricks.push_back(brick(low, level));
    slope_ = std::max(slope_, steepest(field_.bricks.back()) / cell_edge(level));
    return static_cast<std::uint32_t>(field_.bricks.size() - 1);
  }

  /// Stores a brick or its octants. Returns its index entry. `own`: number of a position's brick; kNoBrick for octants.
  std::uint32_t store(const Vector3& low, int level, std::uint32_t own) {
    if (!is_refined(low, level)) return own != format::kNoBrick ? own : add_brick(low, level);
    const std::size_t number = field_.refined.size();
    field_.refined.push_back({own, {}});
    for (int octant = 0; octant < 8; ++octant) {
      const Vector3 corner = low + brick_edge(level + 1) * Vector3(octant & 1, octant >> 1 & 1, octant >> 2);
      std::uint32_t child = format::index_entry::kCoarse;
      if (!is_coarse(corner, level + 1)) {
        child = store(corner, level + 1, format::kNoBrick);
      } else if (field_.refined[number].brick == format::kNoBrick) {
        field_.refined[number].brick = add_brick(low, level);
      }
      field_.refined[number].child[octant] = child;
    }
    return format::index_entry::kRefined | static_cast<std::uint32_t>(number);
  }

  Brick brick(const Vector3& low, int level) const {
    Brick brick{};
    brick.level = level;
    for (int i = 0; i < format::kBrickValues; ++i) {
      const Vector3 node(i % kBrickNodes, i / kBrickNodes % kBrickNodes, i / kBrickNodes / kBrickNodes);
      brick.value[i] = node_value(low + cell_edge(level) * node, level);
    }
    return brick;
  }

  /// Returns the number of halvings of the brick around p; -1 if no brick is stored there.
  int level_at(const Vector3& p) const {
    Vector3 low = ((p - origin()) / brick_edge(0)).array().floor();
    for (int axis = 0; axis < 3; ++axis) {
      if (low[axis] < 0.0 || low[axis] >= field_.grid.bricks[axis]) return -1;
    }
    const double position = low[0] + field_.grid.bricks[0] * (low[1] + field_.grid.bricks[1] * low[2]);
    if ((field_.index[static_cast<std::size_t>(position)] & format::index_entry::kFar) != 0) return -1;
    low = origin() + brick_edge(0) * low;
    int level = 0;
    while (is_refined(low, level)) {
      for (int axis = 0; axis < 3; ++axis) {
        if (p[axis] >= low[axis] + brick_edge(level + 1)) low[axis] += brick_edge(level + 1);
      }
      if (is_coarse(low, level + 1)) break;
      ++level;
    }
    return level;
  }

  /// Returns the exact distance, or the interpolation of a coarser brick if one touches the node.
  double node_value(const Vector3& node, int level) const {
    Vector3 beside = node;
    int coarsest = level;
    for (int corner = 0; corner < 8; ++corner) {
      const Vector3 side(2 * (corner & 1) - 1, 2 * (corner >> 1 & 1) - 1, 2 * (corner >> 2) - 1);
      const Vector3 near = node + 0.25 * cell_edge(format::kMaxRefinement) * side;
      const int found = std::max(0, level_at(near));
      if (found >= coarsest) continue;
      coarsest = found;
      beside = near;
    }
    if (coarsest == level) return node_rounded(description_.distance(node), description_, field_.grid, level);
    const double edge = cell_edge(coarsest);
    const Vector3 cell = ((beside - origin()) / edge).array().floor();
    const Vector3 at = ((node - origin()) / edge - cell).cwiseMax(0.0).cwiseMin(1.0);
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
      const Vector3 up(corner & 1, corner >> 1 & 1, corner >> 2);
      const double weight = (up.array() * at.array() + (1.0 - up.array()) * (1.0 - at.array())).prod();
      if (weight > 1e-9) sum += weight * node_value(origin() + edge * (cell + up), coarsest);
    }
    return sum;
  }

  const SceneDescription& description_;
  StoredField& field_;
  double slope_ = 0.0;
};

void make_exact(StoredField& field) {
  const auto name = [&field](std::uint32_t& entry) {
    if ((entry & (format::index_entry::kFar | format::index_entry::kRefined)) != 0) return;
    field.bricks[entry & format::index_entry::kNumber].exact = 1;
    entry |= format::index_entry::kExact;
  };
  for (std::uint32_t& entry : field.index) name(entry);
  for (format::Refined& refined : field.refined) {
    for (std::uint32_t& entry : refined.child) {
      name(entry);
      if (entry != format::index_entry::kCoarse) continue;
      field.bricks[refined.brick].exact = 1;
      entry |= format::index_entry::kExact;
    }
  }
}

/// The least of 1, 2, 5, 10, 20, ... pm, um, ... in which all nodes fit: round distances stay exact.
double round_quantum(const StoredField& field) {
  constexpr int kRoundedUp = 136;  // node_rounded: half of 16 coarse quanta, 16 of the finest each, and its own
  double largest = 0.0;
  for (const Brick& brick : field.bricks) {
    for (const double value : brick.value) largest = std::max(largest, std::ldexp(std::fabs(value), brick.level));
  }
  for (double per_metre = 1e12;; per_metre /= 10.0) {
    for (const double step : {1.0, 2.0, 5.0}) {
      if (largest <= (format::kLargestValue - kRoundedUp) * (step / per_metre)) return step / per_metre;
    }
  }
}

std::vector<format::Brick> rounded_bricks(const SceneDescription& description, const StoredField& field) {
  std::vector<format::Brick> bricks;
  for (const Brick& brick : field.bricks) {
    format::Brick& rounded = bricks.emplace_back();
    const double quantum = std::ldexp(field.grid.quantum, -brick.level);
    for (int i = 0; i < format::kBrickValues; ++i) {
      rounded.value[i] = static_cast<std::int16_t>(std::lround(brick.value[i] / quantum));
    }
    rounded.lipschitz = format::encode_lipschitz(static_cast<float>(field.grid.clearance_slope));
    if (description.refined || description.facet) {
      // two interpolations of one distance, each within half a voxel's diagonal of it
      rounded.deviation = static_cast<std::uint16_t>(std::ceil(1.76 * field.grid.voxel_size / field.grid.quantum));
    }
    rounded.exact = brick.exact;
  }
  return bricks;
}

/// Stores the still body's field. `quantum` 0: the quantum is not known yet, and nothing is rounded.
StoredField store_field(const SceneDescription& description, double quantum) {
  StoredField field;
  field.grid = frame_grid(description);
  format::Grid& grid = field.grid;
  grid.quantum = quantum;
  const double most_off = (description.refined ? format::kMostRoundedOff : 0.5) * quantum;
  for (int z = 0; z < grid.bricks[2]; ++z) {
    for (int y = 0; y < grid.bricks[1]; ++y) {
      for (int x = 0; x < grid.bricks[0]; ++x) {
        const Brick brick = sample_brick(description, grid, {x, y, z});
        const auto [low, high] = std::minmax_element(std::begin(brick.value), std::end(brick.value));
        const bool near = *low < grid.band;
        if (near && *high > -grid.band) {
          field.index.push_back(static_cast<std::uint32_t>(field.bricks.size()));
          field.bricks.push_back(brick);
          continue;
        }
        // of the centre, which is a node; from the exact distance to the interpolated one
        const double of_center = brick.value[format::kBrickValues / 2];
        const double clearance = of_center - kHalfDiagonal * grid.voxel_size - 2.0 * most_off;
        field.index.push_back(
            format::index_entry::encode_far(*high < 0.0, static_cast<float>(std::max(0.0, clearance))));
      }
    }
  }
  double slope = 0.0;
  for (const Brick& brick : field.bricks) slope = std::max(slope, steepest(brick) / grid.voxel_size);
  if (description.refined) slope = std::max(slope, Octants(description, field).store());
  if (description.facet) make_exact(field);
  // single precision differences are taken again later; bricks say the same
  grid.lipschitz = static_cast<double>(static_cast<float>(slope * (1.0 + 1e-6)));
  const auto largest = std::max(1.0f, static_cast<float>(grid.lipschitz));
  grid.clearance_slope = static_cast<double>(format::decode_lipschitz(format::encode_lipschitz(largest)));
  grid.lipschitz_seam = grid.clearance_slope;
  grid.outside_loss = 0.0;
  grid.brick_count = static_cast<std::uint32_t>(field.bricks.size());
  return field;
}

StoredField store_field(const SceneDescription& description) {
  return store_field(description, round_quantum(store_field(description, 0.0)));
}

/// The moving body: points in tree order, and the tree.
struct StoredBody {
  format::Body body{};
  std::vector<std::size_t> order;  ///< of the description's points
  std::vector<format::Node> nodes;
};

Vector3 rounded(const Vector3& p) { return p.cast<float>().cast<double>(); }

void add_subtree(const SceneDescription& description, std::size_t first, std::size_t last, std::uint32_t level,
                 StoredBody& stored) {
  Vector3 low = Vector3::Constant(std::numeric_limits<double>::infinity());
  Vector3 high = -low;
  for (std::size_t i = first; i < last; ++i) {
    low = low.cwiseMin(rounded(description.points[stored.order[i]]));
    high = high.cwiseMax(rounded(description.points[stored.order[i]]));
  }
  const Vector3 center = rounded(0.5 * (low + high));
  double radius = 0.0;
  for (std::size_t i = first; i < last; ++i) {
    radius = std::max(radius, (rounded(description.points[stored.order[i]]) - center).norm());
  }
  format::Node node{};
  for (int axis = 0; axis < 3; ++axis) node.center[axis] = static_cast<float>(center[axis]);
  node.radius = std::nextafter(static_cast<float>(radius), FLT_MAX);
  node.first_point = static_cast<std::uint32_t>(first);
  node.point_count = static_cast<std::uint32_t>(last - first);
  node.level = static_cast<std::uint16_t>(level);
  node.leaf = level + 1 == stored.body.level_count ? 1 : 0;
  const std::size_t own = stored.nodes.size();
  stored.nodes.push_back(node);
  if (node.leaf == 0) {
    int axis = 0;
    (high - low).maxCoeff(&axis);
    const auto begin = stored.order.begin();
    const std::size_t middle = (first + last) / 2;
    std::nth_element(begin + static_cast<std::ptrdiff_t>(first), begin + static_cast<std::ptrdiff_t>(middle),
                     begin + static_cast<std::ptrdiff_t>(last), [&](std::size_t a, std::size_t b) {
                       return description.points[a][axis] < description.points[b][axis];
                     });
    add_subtree(description, first, middle, level + 1, stored);
    add_subtree(description, middle, last, level + 1, stored);
  }
  stored.nodes[own].skip = static_cast<std::uint32_t>(stored.nodes.size());
}

StoredBody store_body(const SceneDescription& description) {
  StoredBody stored;
  format::Body& body = stored.body;
  const std::size_t n = description.points.size();
  body.point_count = static_cast<std::uint32_t>(n);
  body.level_count = description.level_count;
  if (body.level_count == 0) {
    body.level_count = 1;
    while (n >> body.level_count >= 8) ++body.level_count;
  }
  stored.order.resize(n);
  std::iota(stored.order.begin(), stored.order.end(), std::size_t{0});
  add_subtree(description, 0, n, 0, stored);
  body.node_count = static_cast<std::uint32_t>(stored.nodes.size());

  for (const Vector3& p : description.points) body.radius = std::max(body.radius, rounded(p).norm());
  const BoundingSphere sphere = sphere_of(stored.nodes[0]);
  std::copy_n(sphere.center.data(), 3, body.sphere_center);
  body.sphere_radius = std::max(1e-9, sphere.radius);
  const Quaternion& q = description.H_MB.rotation;
  const double rotation[4] = {q.w(), q.x(), q.y(), q.z()};
  std::copy(std::begin(rotation), std::end(rotation), std::begin(body.rotation_MB));
  std::copy_n(description.H_MB.translation.data(), 3, std::begin(body.translation_MB));
  std::copy(description.inertia.begin(), description.inertia.end(), std::begin(body.inertia));
  if (body.inertia[2] == 0.0)
    std::fill(std::begin(body.inertia), std::end(body.inertia), 0.4 * body.radius * body.radius);
  body.volume = 0.0;
  body.inertia_from_points = 1;
  return stored;
}

format::Settings complete_settings(const SceneDescription& description) {
  format::Settings settings = description.settings;
  const auto default_to = [](double& value, double fallback) {
    if (value == 0.0) value = fallback;
  };
  default_to(settings.safety_distance, 1.5 * description.voxel_size);
  default_to(settings.margin, 0.01 * description.voxel_size);
  default_to(settings.stiffness, 2000.0);
  default_to(settings.period, 1e-3);
  default_to(settings.coupling_translation, 1.0);
  default_to(settings.coupling_rotation, 0.025);
  if (settings.solvers == 0) {
    settings.solvers = (1u << format::kSolverCount) - 1u;
    if (description.normals.empty()) settings.solvers &= ~(1u << static_cast<std::uint32_t>(format::Solver::kPaper));
    settings.default_solver = static_cast<std::uint32_t>(format::Solver::kCorrected);
  }
  return settings;
}

std::vector<float> by_axis(const std::vector<Vector3>& vectors, const std::vector<std::size_t>& order) {
  std::vector<float> values;
  for (int axis = 0; axis < 3; ++axis) {
    for (const std::size_t i : order) values.push_back(static_cast<float>(vectors[i][axis]));
  }
  return values;
}

template <class T>
ImageSection section(SectionId id, std::span<const T> items) {
  const auto bytes = std::as_bytes(items);
  return {id, {bytes.begin(), bytes.end()}};
}

}  // namespace

SceneImage assemble_image(const std::vector<ImageSection>& sections) {
  format::Header header{};
  std::memcpy(header.magic, format::kMagic, sizeof(header.magic));
  header.byte_order = format::kByteOrder;
  header.version = format::kVersion;
  header.section_count = static_cast<std::uint32_t>(sections.size());
  header.header_bytes = static_cast<std::uint32_t>(padded(sizeof(header) + sections.size() * sizeof(format::Section)));
  header.total_bytes = header.header_bytes;
  for (const ImageSection& section : sections) header.total_bytes += padded(section.bytes.size());

  SceneImage image(header.total_bytes);
  std::byte* const begin = image.bytes().data();
  std::memcpy(begin, &header, sizeof(header));
  std::uint64_t offset = header.header_bytes;
  for (std::size_t i = 0; i < sections.size(); ++i) {
    const format::Section section{sections[i].id, 0, offset, sections[i].bytes.size(), 0};
    std::memcpy(begin + sizeof(header) + i * sizeof(section), &section, sizeof(section));
    std::copy(sections[i].bytes.begin(), sections[i].bytes.end(), begin + offset);
    offset += padded(section.bytes);
  }
  seal(image);
  return image;
}

SceneImage build_scene_image(const SceneDescription& description) {
  if (!description.distance) throw std::invalid_argument("SceneDescription::distance is empty: give a function");
  if (description.points.empty()) throw std::invalid_argument("SceneDescription::points is empty: give one at least");
  if (!description.normals.empty() && description.normals.size() != description.points.size()) {
    throw std::invalid_argument("SceneDescription::normals: give none, or one a point");
  }
  const StoredField field = store_field(description);
  const StoredBody stored = store_body(description);
  const format::Settings settings = complete_settings(description);
  const std::vector<float> points = by_axis(description.points, stored.order);

  std::vector<ImageSection> sections;
  sections.push_back(section(SectionId::kSettings, std::span(&settings, 1)));
  if (description.workspace) sections.push_back(section(SectionId::kWorkspace, std::span(&*description.workspace, 1)));
  sections.push_back(section(SectionId::kGrid, std::span(&field.grid, 1)));
  sections.push_back(section(SectionId::kBrickIndex, std::span(field.index)));
  const std::vector<format::Brick> bricks = rounded_bricks(description, field);
  sections.push_back(section(SectionId::kBricks, std::span(bricks)));
  if (!field.refined.empty()) sections.push_back(section(SectionId::kRefined, std::span(field.refined)));
  format::ExactBrick exact{};
  std::fill(std::begin(exact.weight), std::end(exact.weight), std::uint16_t{format::kOneWeight / 2});
  std::fill(std::begin(exact.cell), std::end(exact.cell), std::uint32_t{1});
  const format::FacetSet facet_set{0, 1, 0};
  const std::uint32_t facet_number = 0;
  if (description.facet) {
    sections.push_back(section(SectionId::kFacets, std::span(&*description.facet, 1)));
    sections.push_back(section(SectionId::kExactBricks, std::span<const format::ExactBrick>(&exact, 1)));
    sections.push_back(section(SectionId::kFacetSets, std::span(&facet_set, 1)));
    sections.push_back(section(SectionId::kFacetNumbers, std::span(&facet_number, 1)));
  }
  sections.push_back(section(SectionId::kBody, std::span(&stored.body, 1)));
  sections.push_back(section(SectionId::kPoints, std::span(points)));
  if (!description.normals.empty()) {
    const std::vector<float> normals = by_axis(description.normals, stored.order);
    sections.push_back(section(SectionId::kNormals, std::span(normals)));
  }
  sections.push_back(section(SectionId::kNodes, std::span(stored.nodes)));
  sections.push_back(
      section(SectionId::kProvenance, std::span(description.provenance.data(), description.provenance.size())));
  return assemble_image(sections);
}

std::span<std::byte> section_bytes(SceneImage& image, SectionId id) {
  std::byte* const begin = image.bytes().data();
  const auto& header = *reinterpret_cast<const format::Header*>(begin);
  const auto* sections = reinterpret_cast<const format::Section*>(begin + sizeof(format::Header));
  for (const format::Section& section : std::span(sections, header.section_count)) {
    if (section.id == id) return image.bytes().subspan(section.offset, section.bytes);
  }
  return {};
}

void seal(SceneImage& image) {
  std::byte* const begin = image.bytes().data();
  auto& header = *reinterpret_cast<format::Header*>(begin);
  auto* sections = reinterpret_cast<format::Section*>(begin + sizeof(format::Header));
  for (format::Section& section : std::span(sections, header.section_count)) {
    section.checksum = format::checksum(begin + section.offset, padded(section.bytes));
  }
  header.checksum = 0;
  header.checksum = format::checksum(begin, header.header_bytes);
}

SceneView open_scene(const SceneImage& image) {
  SceneView scene;
  const Status status = SceneView::open(image.bytes(), scene);
  if (status != Status::kOk) throw std::runtime_error(std::string("the image does not open: ") + describe(status));
  return scene;
}

}  // namespace godobject::test
