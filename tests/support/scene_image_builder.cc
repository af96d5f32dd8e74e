#include "tests/support/scene_image_builder.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "core/status.h"

namespace godobject::test {
namespace {

using format::kBrickCells;
using format::kBrickNodes;
using format::SectionId;

constexpr double kHalfDiagonal = 0.8660254037844387;  // of a unit cube

std::size_t padded(std::size_t bytes) {
  return (bytes + format::kAlignment - 1) / format::kAlignment * format::kAlignment;
}

/// The still body: grid, brick index, bricks.
struct StoredField {
  format::Grid grid{};
  std::vector<std::uint32_t> index;
  std::vector<format::Brick> bricks;
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

format::Brick sample_brick(const SceneDescription& description, const format::Grid& grid,
                           const std::array<int, 3>& at) {
  format::Brick brick{};
  brick.seam_clearance = FLT_MAX;
  for (int z = 0, node = 0; z < kBrickNodes; ++z) {
    for (int y = 0; y < kBrickNodes; ++y) {
      for (int x = 0; x < kBrickNodes; ++x, ++node) {
        const Vector3 lattice(at[0] * kBrickCells + x, at[1] * kBrickCells + y, at[2] * kBrickCells + z);
        const Vector3 p_W = Vector3(grid.origin[0], grid.origin[1], grid.origin[2]) + grid.voxel_size * lattice;
        brick.value[node] = static_cast<float>(description.distance(p_W));
      }
    }
  }
  return brick;
}

/// Largest gradient norm in the brick, times the voxel size. The gradient is affine along each axis, so its norm is
/// largest in the corners of a cell, where it is made of the three edges that meet there.
double steepest(const format::Brick& brick) {
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
        const double edge = static_cast<double>(brick.value[other]) - static_cast<double>(brick.value[node]);
        norm_squared += edge * edge;
      }
      steepest_squared = std::max(steepest_squared, norm_squared);
    }
  }
  return std::sqrt(steepest_squared);
}

StoredField store_field(const SceneDescription& description) {
  StoredField field;
  field.grid = frame_grid(description);
  format::Grid& grid = field.grid;
  double steepest_edge = 0.0;
  for (int z = 0; z < grid.bricks[2]; ++z) {
    for (int y = 0; y < grid.bricks[1]; ++y) {
      for (int x = 0; x < grid.bricks[0]; ++x) {
        const format::Brick brick = sample_brick(description, grid, {x, y, z});
        const auto [low, high] = std::minmax_element(std::begin(brick.value), std::end(brick.value));
        const double lowest = static_cast<double>(*low);
        const double highest = static_cast<double>(*high);
        if (lowest < grid.band && highest > -grid.band) {
          field.index.push_back(static_cast<std::uint32_t>(field.bricks.size()));
          field.bricks.push_back(brick);
          steepest_edge = std::max(steepest_edge, steepest(brick));
          continue;
        }
        // from the nearest node to any point of the brick, then from the exact distance to the interpolated one
        const double clearance = lowest - 2.0 * kHalfDiagonal * grid.voxel_size;
        field.index.push_back(
            format::index_entry::encode_far(highest < 0.0, static_cast<float>(std::max(0.0, clearance))));
      }
    }
  }
  grid.lipschitz =
      steepest_edge / grid.voxel_size * (1.0 + 1e-6);  // single precision differences are taken again later
  grid.lipschitz_seam = grid.lipschitz;
  grid.brick_count = static_cast<std::uint32_t>(field.bricks.size());
  return field;
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

struct Part {
  SectionId id;
  std::vector<std::byte> bytes;
};

template <class T>
Part part(SectionId id, std::span<const T> items) {
  const auto bytes = std::as_bytes(items);
  return {id, {bytes.begin(), bytes.end()}};
}

SceneImage assemble(const std::vector<Part>& parts) {
  format::Header header{};
  std::memcpy(header.magic, format::kMagic, sizeof(header.magic));
  header.byte_order = format::kByteOrder;
  header.version = format::kVersion;
  header.section_count = static_cast<std::uint32_t>(parts.size());
  header.header_bytes = static_cast<std::uint32_t>(padded(sizeof(header) + parts.size() * sizeof(format::Section)));
  header.total_bytes = header.header_bytes;
  for (const Part& part : parts) header.total_bytes += padded(part.bytes.size());

  SceneImage image(header.total_bytes);
  std::byte* const begin = image.bytes().data();
  std::memcpy(begin, &header, sizeof(header));
  std::uint64_t offset = header.header_bytes;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const format::Section section{parts[i].id, 0, offset, parts[i].bytes.size(), 0};
    std::memcpy(begin + sizeof(header) + i * sizeof(section), &section, sizeof(section));
    std::copy(parts[i].bytes.begin(), parts[i].bytes.end(), begin + offset);
    offset += padded(section.bytes);
  }
  seal(image);
  return image;
}

}  // namespace

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

  std::vector<Part> parts;
  parts.push_back(part(SectionId::kSettings, std::span(&settings, 1)));
  parts.push_back(part(SectionId::kGrid, std::span(&field.grid, 1)));
  parts.push_back(part(SectionId::kBrickIndex, std::span(field.index)));
  parts.push_back(part(SectionId::kBricks, std::span(field.bricks)));
  parts.push_back(part(SectionId::kBody, std::span(&stored.body, 1)));
  parts.push_back(part(SectionId::kPoints, std::span(points)));
  if (!description.normals.empty()) {
    const std::vector<float> normals = by_axis(description.normals, stored.order);
    parts.push_back(part(SectionId::kNormals, std::span(normals)));
  }
  parts.push_back(part(SectionId::kNodes, std::span(stored.nodes)));
  parts.push_back(
      part(SectionId::kProvenance, std::span(description.provenance.data(), description.provenance.size())));
  return assemble(parts);
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

Scene open_scene(const SceneImage& image) {
  Scene scene;
  const Status status = Scene::open(image.bytes(), scene);
  if (status != Status::kOk) throw std::runtime_error(std::string("the image does not open: ") + describe(status));
  return scene;
}

}  // namespace godobject::test
