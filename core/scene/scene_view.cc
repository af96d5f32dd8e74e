#include "core/scene/scene_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

namespace godobject {
namespace {

#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
constexpr bool kLooksAtChecksums = false;  // a fuzzer cannot guess checksums, and must reach the code after them
#else
constexpr bool kLooksAtChecksums = true;
#endif

using format::SectionId;

/// The sections of one image, by id; empty if absent.
struct Sections {
  std::array<std::span<const std::byte>, format::kMaxSections> of{};

  std::span<const std::byte> operator[](SectionId id) const noexcept { return of[static_cast<std::size_t>(id)]; }
};

template <class T>
bool read_one(std::span<const std::byte> bytes, T& value) noexcept {
  if (bytes.size() != sizeof(T)) return false;
  std::memcpy(&value, bytes.data(), sizeof(T));
  return true;
}

bool in_range(double value, double low, double high) noexcept { return value >= low && value <= high; }

bool all_finite(const float* values, std::size_t count, float limit) noexcept {
  bool fine = true;
  for (std::size_t i = 0; i < count; ++i) fine &= std::fabs(values[i]) <= limit;  // false for NaN
  return fine;
}

Status read_header(std::span<const std::byte> image, format::Header& header) noexcept {
  if (image.size() < sizeof(format::Header)) return Status::kImageTruncated;
  std::memcpy(&header, image.data(), sizeof(header));
  if (std::memcmp(header.magic, format::kMagic, sizeof(header.magic)) != 0) return Status::kImageForeign;
  if (header.byte_order != format::kByteOrder) return Status::kImageForeign;
  if (header.version != format::kVersion) return Status::kImageVersion;
  if (header.total_bytes != image.size()) return Status::kImageTruncated;
  if (header.section_count == 0 || header.section_count >= format::kMaxSections) return Status::kImageLayout;
  const std::size_t table_end = sizeof(format::Header) + header.section_count * sizeof(format::Section);
  const std::size_t expected = (table_end + format::kAlignment - 1) / format::kAlignment * format::kAlignment;
  if (header.header_bytes != expected) return Status::kImageLayout;
  if (image.size() < expected) return Status::kImageTruncated;

  format::Header cleared = header;
  cleared.checksum = 0;
  std::array<std::byte, sizeof(format::Header)> head{};
  std::memcpy(head.data(), &cleared, sizeof(cleared));
  const std::uint64_t sum = format::checksum(image.data() + sizeof(format::Header), expected - sizeof(format::Header),
                                             format::checksum(head.data(), head.size()));
  if (kLooksAtChecksums && sum != header.checksum) return Status::kImageChecksum;
  for (const std::uint64_t word : header.reserved) {
    if (word != 0) return Status::kImageLayout;
  }
  return Status::kOk;
}

Status read_sections(std::span<const std::byte> image, const format::Header& header, Sections& sections) noexcept {
  std::uint64_t next = header.header_bytes;
  for (std::uint32_t i = 0; i < header.section_count; ++i) {
    format::Section section{};
    std::memcpy(&section, image.data() + sizeof(format::Header) + i * sizeof(format::Section), sizeof(section));
    const auto id = static_cast<std::size_t>(section.id);
    if (id == 0 || id >= format::kMaxSections || section.reserved != 0) return Status::kImageLayout;
    if (sections.of[id].data() != nullptr) return Status::kImageLayout;
    if (section.offset != next) return Status::kImageLayout;
    if (section.bytes > image.size() - section.offset) return Status::kImageLayout;
    const std::uint64_t padded = (section.bytes + format::kAlignment - 1) / format::kAlignment * format::kAlignment;
    if (padded > image.size() - section.offset) return Status::kImageLayout;
    if (kLooksAtChecksums && format::checksum(image.data() + section.offset, padded) != section.checksum) {
      return Status::kImageChecksum;
    }
    sections.of[id] = image.subspan(section.offset, section.bytes);
    next = section.offset + padded;
  }
  return next == image.size() ? Status::kOk : Status::kImageLayout;
}

constexpr double kLargestSetting = 1e9;  // of settings; chosen, beyond all gains and lengths of devices

bool valid_settings(const format::Settings& s) noexcept {
  return s.default_solver < format::kSolverCount && s.solvers < (1u << format::kSolverCount) &&
         ((s.solvers >> s.default_solver) & 1u) != 0 && s.friction <= 1 &&
         in_range(s.safety_distance, 1e-12, kLargestSetting) && in_range(s.margin, 1e-12, kLargestSetting) &&
         valid_gains(s) && in_range(s.coupling_translation, 1e-12, kLargestSetting) &&
         in_range(s.friction_static, 0.0, 10.0) && in_range(s.friction_kinetic, 0.0, s.friction_static) &&
         in_range(s.friction_viscous, 0.0, kLargestSetting) && in_range(s.paper_rotation_static, 0.0, 10.0) &&
         in_range(s.paper_rotation_kinetic, 0.0, s.paper_rotation_static) && in_range(s.paper_viscous, 0.0, 10.0) &&
         valid_period(s.period);
}

bool valid_grid(const format::Grid& g) noexcept {
  constexpr double kLarge = 1e7;
  if (!in_range(g.voxel_size, 1e-9, 1e6) || !in_range(g.band, g.voxel_size, 1e6 * g.voxel_size)) return false;
  // at least 1: an exact distance field falls by a metre per metre somewhere; at most 1e6: a seam jumps by many bands
  // before rounding the slope of a brick is at most 2; nodes of the finest cells may then differ by the rounding of
  // coarse ones
  constexpr double kRoundingSlope =
      2.0 * format::kMostRoundedOff * format::kLargestQuantum * (1 << format::kMaxRefinement);
  if (!in_range(g.lipschitz, 0.0, 2.0 + kRoundingSlope) || !in_range(g.lipschitz_seam, g.lipschitz, 1e6)) return false;
  if (!in_range(g.clearance_slope, 1.0, 1e6) || !in_range(g.outside_loss, 0.0, kLarge)) return false;
  if (!in_range(g.facet_offset, -kLarge, kLarge)) return false;
  if (!in_range(g.quantum, 1e-15, format::kLargestQuantum * g.voxel_size)) return false;
  for (int axis = 0; axis < 3; ++axis) {
    if (g.bricks[axis] < 1 || g.bricks[axis] > format::kMaxBricksPerAxis) return false;
    const double low = g.origin[axis];
    const double high = low + g.voxel_size * format::kBrickCells * g.bricks[axis];
    if (!in_range(low, -kLarge, kLarge)) return false;
    if (!in_range(g.surface_min[axis], low, high) || !in_range(g.surface_max[axis], g.surface_min[axis], high))
      return false;
  }
  return true;
}

bool valid_clearances(std::span<const std::uint32_t> index) noexcept {
  for (const std::uint32_t entry : index) {
    if ((entry & format::index_entry::kFar) != 0 && !(format::index_entry::far_clearance(entry) <= 1e8f)) return false;
  }
  return true;
}

/// Tells whether the brick that an entry or a refinement refers to exists and agrees about being exact.
bool valid_brick_name(std::uint32_t number, bool exact, std::span<const format::Brick> bricks) noexcept {
  return number < bricks.size() && exact == (bricks[number].exact != 0);
}

/// Tells whether a refinement refers to its own nodes if and only if they are read.
bool valid_own_nodes(const format::Refined& refined, bool of_position, std::span<const format::Brick> bricks) noexcept {
  std::uint32_t coarse = 0;  // coarse children, which must all agree about being exact
  bool any = false;
  for (const std::uint32_t child : refined.child) {
    if ((child & format::index_entry::kFar) == 0) continue;
    if ((child & ~format::index_entry::kExact) != format::index_entry::kCoarse || (any && child != coarse))
      return false;
    any = true;
    coarse = child;
  }
  if (!any && !of_position) return refined.brick == format::kNoBrick;
  return valid_brick_name(refined.brick, (coarse & format::index_entry::kExact) != 0, bricks);
}

/// Walks all refinements in the order that the format prescribes, and expects each at the next number. So every
/// refinement is reached once, none is shared or contains itself, and the length of the walk is bounded by index and
/// refinements. It must refer to as many bricks as there are.
bool valid_entries(std::span<const std::uint32_t> index, std::span<const format::Brick> bricks,
                   std::span<const format::Refined> refined) noexcept {
  struct Open {
    const format::Refined* refined;
    std::size_t next_child;
  };
  constexpr std::size_t kOctants = std::size(format::Refined{}.child);
  std::array<Open, format::kMaxRefinement> open{};
  std::size_t next = 0;
  std::size_t named = 0;
  for (const std::uint32_t position : index) {
    std::uint32_t entry = position;
    std::size_t depth = 0;
    while (true) {
      // a position that is far, or a coarse octant: valid_clearances and valid_own_nodes have checked it
      const bool stored = (entry & format::index_entry::kFar) == 0;
      if (stored) {
        if ((entry & format::index_entry::kInside) != 0) return false;
        const std::uint32_t number = entry & format::index_entry::kNumber;
        if ((entry & format::index_entry::kRefined) == 0) {
          ++named;
          if (!valid_brick_name(number, (entry & format::index_entry::kExact) != 0, bricks)) return false;
        } else {
          if (number != next || next >= refined.size() || depth == open.size()) return false;
          if ((entry & format::index_entry::kExact) != 0 || !valid_own_nodes(refined[next], depth == 0, bricks))
            return false;
          if (refined[next].brick != format::kNoBrick) ++named;
          open[depth++] = {&refined[next++], 0};
        }
      }
      while (depth > 0 && open[depth - 1].next_child == kOctants) --depth;
      if (depth == 0) break;
      Open& parent = open[depth - 1];
      entry = parent.refined->child[parent.next_child++];
    }
  }
  return next == refined.size() && named == bricks.size();
}

bool valid_bricks(std::span<const format::Brick> bricks, std::size_t exact_count) noexcept {
  for (const format::Brick& brick : bricks) {
    if (brick.exact > exact_count) return false;
  }
  return true;
}

/// Returns the least and the largest weight of a cell's nodes.
std::pair<std::uint16_t, std::uint16_t> range_of_weights(const format::ExactBrick& brick, int cell) noexcept {
  constexpr int kCells = format::kBrickCells;
  constexpr int kNodes = format::kBrickNodes;
  const int low = cell % kCells + kNodes * (cell / kCells % kCells + kNodes * (cell / (kCells * kCells)));
  std::pair<std::uint16_t, std::uint16_t> range{format::kOneWeight, std::uint16_t{0}};
  for (int corner = 0; corner < 8; ++corner) {
    const std::uint16_t weight =
        brick.weight[low + (corner & 1) + kNodes * ((corner >> 1 & 1) + kNodes * (corner >> 2))];
    range = {std::min(range.first, weight), std::max(range.second, weight)};
  }
  return range;
}

bool valid_exact_bricks(std::span<const format::ExactBrick> bricks, std::size_t set_count) noexcept {
  for (const format::ExactBrick& brick : bricks) {
    for (const std::uint16_t weight : brick.weight) {
      if (weight > format::kOneWeight) return false;
    }
    for (const std::uint16_t word : brick.reserved) {
      if (word != 0) return false;
    }
    for (int number = 0; number < format::kCellsPerBrick; ++number) {
      const std::uint32_t word = brick.cell[number];
      const auto [least, most] = range_of_weights(brick, number);
      const std::uint32_t whole = least == format::kOneWeight ? format::cell_facets::kWhole : 0;
      const std::uint32_t set = word & format::cell_facets::kSet;
      if ((word & format::cell_facets::kWhole) != whole || (set == 0) != (most == 0) || set > set_count) return false;
    }
  }
  return true;
}

bool ascends(std::span<const std::uint32_t> numbers) noexcept {
  for (std::size_t i = 1; i < numbers.size(); ++i) {
    if (numbers[i] <= numbers[i - 1]) return false;
  }
  return true;
}

bool valid_facet_sets(const FacetLists& lists) noexcept {
  for (const std::uint32_t number : lists.numbers) {
    if (number >= lists.facets.size()) return false;
  }
  for (const format::FacetSet& set : lists.sets) {
    if (set.count < 1 || set.count > format::kMostFacets || set.plane_count > set.count) return false;
    if (set.first > lists.numbers.size() || set.count > lists.numbers.size() - set.first) return false;
    const auto numbers = lists.numbers.subspan(set.first, set.count);
    if (!ascends(numbers.first(set.plane_count)) || !ascends(numbers.subspan(set.plane_count))) return false;
  }
  return true;
}

bool valid_facets(std::span<const format::Facet> facets) noexcept {
  constexpr double kUnitWithin = 1e-9;
  constexpr float kSingleWithin = 1e-5f;  // rounding to single precision
  constexpr double kFarthest = 1e7;
  const auto unit = [](const float(&v)[3]) {
    const float squared = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    return squared >= 1.0f - kSingleWithin && squared <= 1.0f + kSingleWithin;
  };
  for (const format::Facet& facet : facets) {
    for (int i = 0; i < 4; ++i) {
      const double n[3] = {facet.plane[0][i], facet.plane[1][i], facet.plane[2][i]};
      if (!in_range(n[0] * n[0] + n[1] * n[1] + n[2] * n[2], 1.0 - kUnitWithin, 1.0 + kUnitWithin)) return false;
      if (!in_range(facet.plane[3][i], -2.0 * kFarthest, 2.0 * kFarthest)) return false;
    }
    for (int k = 0; k < 3; ++k) {
      for (const double x : facet.vertex[k]) {
        if (!in_range(x, -kFarthest, kFarthest)) return false;
      }
      if (!unit(facet.edge_normal[k]) || !unit(facet.vertex_normal[k])) return false;
      const double(&from)[3] = facet.vertex[k];
      const double(&to)[3] = facet.vertex[(k + 1) % 3];
      if (from[0] == to[0] && from[1] == to[1] && from[2] == to[2]) return false;
    }
  }
  return true;
}

bool valid_body(const format::Body& b) noexcept {
  double norm_squared = 0.0;
  for (const double q : b.rotation_MB) norm_squared += q * q;
  if (!in_range(norm_squared, 1.0 - 1e-6, 1.0 + 1e-6)) return false;
  for (const double t : b.translation_MB) {
    if (!in_range(t, -1e7, 1e7)) return false;
  }
  if (!in_range(b.inertia[0], 0.0, 1e12) || !in_range(b.inertia[1], b.inertia[0], 1e12) ||
      !in_range(b.inertia[2], b.inertia[1], 1e12)) {
    return false;
  }
  for (const double c : b.sphere_center) {
    if (!in_range(c, -1e6, 1e6)) return false;
  }
  return in_range(b.sphere_radius, 1e-12, 1e6) && in_range(b.volume, 0.0, 1e18) && b.inertia_from_points <= 1;
}

/// Tells whether the sphere contains all points: the bound on a body's displacement requires it.
bool contains(const BoundingSphere& sphere, const Pointshell& shell) noexcept {
  for (std::size_t i = 0; i < shell.size; ++i) {
    if (!((shell.point(i) - sphere.center).norm() <= sphere.radius)) return false;
  }
  return true;
}

/// The numbers of points, nodes and levels of a tree, and the reach of its points.
struct TreeSize {
  std::uint32_t point_count;
  std::uint32_t node_count;
  std::uint32_t level_count;
  double radius;

  bool valid() const noexcept {
    // with a node there is a point
    return in_range(radius, 1e-12, 1e6) && point_count <= format::kMaxPoints && node_count >= 1 &&
           node_count <= 2 * point_count && level_count >= 1 && level_count <= format::kMaxLevels;
  }
};

/// A parent whose children are being read.
struct OpenNode {
  std::uint32_t skip;        // end of its subtree
  std::uint32_t point_end;   // end of its points
  std::uint32_t next_point;  // the next child must begin here
};

/// The numbers of a node by itself, at index i and depth `depth`.
bool valid_node(const format::Node& node, std::uint32_t i, std::uint32_t depth) noexcept {
  if (!(node.radius >= 0.0f && node.radius <= 1e7f) || !all_finite(node.center, 3, 1e7f)) return false;
  if (node.level != depth || node.point_count == 0) return false;
  return node.skip > i && node.leaf == (node.skip == i + 1 ? 1 : 0);
}

/// Adds a child to its parent: it lies within the parent's subtree, and continues the parent's points.
bool add_child(const format::Node& node, OpenNode& parent) noexcept {
  if (node.skip > parent.skip || node.first_point != parent.next_point) return false;
  if (node.point_count > parent.point_end - parent.next_point) return false;
  parent.next_point += node.point_count;
  return true;
}

/// Structure of the tree: pre-order, depth bounded by level_count, children partition their parent's points in order.
bool valid_nodes(std::span<const format::Node> nodes, const TreeSize& size) noexcept {
  std::array<OpenNode, std::max(format::kMaxLevels, format::kMaxSharpEdgeLevels) + 1> open{};
  std::uint32_t depth = 0;
  const auto count = static_cast<std::uint32_t>(nodes.size());
  if (nodes[0].skip != count || nodes[0].first_point != 0 || nodes[0].point_count != size.point_count) return false;
  // closes the parents whose subtree ends at node i; false: a parent's points are not all in its children
  const auto close_parents = [&open, &depth](std::uint32_t i) {
    while (depth > 0 && open[depth - 1].skip == i) {
      --depth;
      if (open[depth].next_point != open[depth].point_end) return false;
    }
    return true;
  };
  for (std::uint32_t i = 0; i < count; ++i) {
    const format::Node& node = nodes[i];
    if (!close_parents(i) || depth >= size.level_count || !valid_node(node, i, depth)) return false;
    // the root's subtree ends at the last node, and a child's not after its parent's: every other node has a parent
    if (i > 0 && !add_child(node, open[depth - 1])) return false;
    if (node.leaf == 0) open[depth++] = {node.skip, node.first_point + node.point_count, node.first_point};
  }
  return close_parents(count);
}

bool valid_points(const Pointshell& shell, double radius) noexcept {
  constexpr double kSlack = 1.0 + 1e-6;  // single precision; Voxelmap::lower_bound allows for it
  for (std::size_t i = 0; i < shell.size; ++i) {
    if (!(shell.point(i).norm() <= radius * kSlack)) return false;
    if (shell.normal_x != nullptr && !in_range(shell.normal(i).squaredNorm(), 0.998, 1.002)) return false;
  }
  // the search may skip a subtree only if its sphere contains all its points
  for (const format::Node& node : shell.nodes) {
    const Vector3 center(static_cast<double>(node.center[0]), static_cast<double>(node.center[1]),
                         static_cast<double>(node.center[2]));
    const double reach = static_cast<double>(node.radius);
    for (std::uint32_t i = node.first_point; i < node.first_point + node.point_count; ++i) {
      if (!((shell.point(i) - center).norm() <= reach * kSlack)) return false;
    }
  }
  return true;
}

template <class T>
std::span<const T> as_array(std::span<const std::byte> bytes) noexcept {
  // sections begin at multiples of kAlignment of an aligned image; T is trivial
  return {reinterpret_cast<const T*>(bytes.data()), bytes.size() / sizeof(T)};
}

/// Sets pointers into `values`, which is float x[n], y[n], z[n].
void set_axes(std::span<const std::byte> values, std::size_t n, const float*& x, const float*& y,
              const float*& z) noexcept {
  x = as_array<float>(values).data();
  y = x + n;
  z = y + n;
}

/// The sections that make up one voxelmap.
struct MapSections {
  SectionId grid, index, bricks, refined, exact, facets, facet_sets, facet_numbers;
};

Status open_map(const Sections& sections, const MapSections& ids, format::Grid& grid, Voxelmap& map) noexcept {
  if (!read_one(sections[ids.grid], grid)) return Status::kImageLayout;
  if (!valid_grid(grid)) return Status::kImageValue;
  const std::uint64_t positions = static_cast<std::uint64_t>(grid.bricks[0]) *
                                  static_cast<std::uint64_t>(grid.bricks[1]) *
                                  static_cast<std::uint64_t>(grid.bricks[2]);
  const auto index = as_array<std::uint32_t>(sections[ids.index]);
  const auto bricks = as_array<format::Brick>(sections[ids.bricks]);
  const auto refined = as_array<format::Refined>(sections[ids.refined]);
  if (sections[ids.index].size() != positions * sizeof(std::uint32_t)) return Status::kImageLayout;
  if (sections[ids.bricks].size() != grid.brick_count * sizeof(format::Brick)) return Status::kImageLayout;
  const FacetLists facets{as_array<format::Facet>(sections[ids.facets]),
                          as_array<format::FacetSet>(sections[ids.facet_sets]),
                          as_array<std::uint32_t>(sections[ids.facet_numbers])};
  const auto exact = as_array<format::ExactBrick>(sections[ids.exact]);
  if (sections[ids.refined].size() != refined.size_bytes()) return Status::kImageLayout;
  if (sections[ids.facets].size() != facets.facets.size_bytes()) return Status::kImageLayout;
  if (sections[ids.facet_sets].size() != facets.sets.size_bytes()) return Status::kImageLayout;
  if (sections[ids.facet_numbers].size() != facets.numbers.size_bytes()) return Status::kImageLayout;
  if (sections[ids.exact].size() != exact.size_bytes()) return Status::kImageLayout;
  if (!valid_clearances(index) || !valid_bricks(bricks, exact.size()) || !valid_entries(index, bricks, refined) ||
      !valid_exact_bricks(exact, facets.sets.size()) || !valid_facet_sets(facets) || !valid_facets(facets.facets)) {
    return Status::kImageValue;
  }
  map = Voxelmap(grid, index, bricks, refined, exact, facets);
  return Status::kOk;
}

/// Sample or feature points with their sphere tree; `normals` may be absent.
Status open_shell(std::span<const std::byte> points, std::span<const std::byte> normals,
                  std::span<const std::byte> nodes, const TreeSize& size, Pointshell& shell) noexcept {
  if (!size.valid()) return Status::kImageValue;
  const std::size_t axes_bytes = std::size_t{3} * sizeof(float) * size.point_count;
  if (points.size() != axes_bytes || nodes.size() != size.node_count * sizeof(format::Node))
    return Status::kImageLayout;
  if (normals.data() != nullptr && normals.size() != axes_bytes) return Status::kImageLayout;
  shell.size = size.point_count;
  set_axes(points, shell.size, shell.x, shell.y, shell.z);
  if (normals.data() != nullptr) set_axes(normals, shell.size, shell.normal_x, shell.normal_y, shell.normal_z);
  shell.nodes = as_array<format::Node>(nodes);
  return valid_nodes(shell.nodes, size) && valid_points(shell, size.radius) ? Status::kOk : Status::kImageValue;
}

/// Feature points and the moving body's voxelmap: both or neither.
Status open_features(const Sections& sections, SceneView& scene) noexcept {
  const auto bytes = sections[SectionId::kFeatures];
  const bool map = sections[SectionId::kBodyGrid].data() != nullptr;
  if (bytes.data() == nullptr) return map ? Status::kImageLayout : Status::kOk;
  format::Features features{};
  format::Grid grid{};
  if (!read_one(bytes, features)) return Status::kImageLayout;
  for (const double x : features.origin) {
    if (!in_range(x, -1e7, 1e7)) return Status::kImageValue;
  }
  if (features.reserved != 0) return Status::kImageValue;
  const Status status =
      open_shell(sections[SectionId::kFeaturePoints], {}, sections[SectionId::kFeatureNodes],
                 {features.point_count, features.node_count, features.level_count, features.radius}, scene.features);
  if (status != Status::kOk) return status;
  scene.features_origin = Vector3(features.origin[0], features.origin[1], features.origin[2]);
  return open_map(
      sections,
      {SectionId::kBodyGrid, SectionId::kBodyBrickIndex, SectionId::kBodyBricks, SectionId::kBodyRefined,
       SectionId::kBodyExactBricks, SectionId::kBodyFacets, SectionId::kBodyFacetSets, SectionId::kBodyFacetNumbers},
      grid, scene.body_map);
}

bool valid_sharp_edges(std::span<const format::SharpEdge> edges) noexcept {
  for (const format::SharpEdge& edge : edges) {
    for (const auto& end : edge.end) {
      for (const double x : end) {
        if (!in_range(x, -1e7, 1e7)) return false;
      }
    }
    for (const auto& normal : edge.normal) {
      if (!all_finite(normal, 3, 1.001f)) return false;
    }
    if (!(edge.radius >= 0.0f && edge.radius <= 1e6f) || edge.reserved != 0) return false;
  }
  return true;
}

/// Tells whether each node's sphere contains its edges: the search skips branches by their spheres.
bool contain_edges(const SharpEdges& sharp) noexcept {
  for (const format::Node& node : sharp.nodes) {
    const BoundingSphere sphere = sphere_of(node);
    for (std::uint32_t i = node.first_point; i < node.first_point + node.point_count; ++i) {
      const format::SharpEdge& edge = sharp.edges[i];
      for (int k = 0; k < 2; ++k) {
        const double far = (edge_end(edge, k) - sphere.center).norm() + static_cast<double>(edge.radius);
        if (!(far <= sphere.radius)) return false;
      }
    }
  }
  return true;
}

/// Reads the sharp edges of one body.
Status open_sharp_edges(std::span<const std::byte> edges, std::span<const std::byte> nodes,
                        SharpEdges& sharp) noexcept {
  sharp.edges = as_array<format::SharpEdge>(edges);
  sharp.nodes = as_array<format::Node>(nodes);
  if (edges.size() != sharp.edges.size_bytes() || nodes.size() != sharp.nodes.size_bytes()) {
    return Status::kImageLayout;
  }
  if (sharp.edges.empty() || sharp.nodes.empty()) return Status::kImageLayout;
  if (sharp.edges.size() > format::kMaxSharpEdges || sharp.nodes.size() > 2 * sharp.edges.size()) {
    return Status::kImageLayout;
  }
  const TreeSize size{static_cast<std::uint32_t>(sharp.edges.size()), static_cast<std::uint32_t>(sharp.nodes.size()),
                      format::kMaxSharpEdgeLevels, 1.0};
  return valid_sharp_edges(sharp.edges) && valid_nodes(sharp.nodes, size) && contain_edges(sharp) ? Status::kOk
                                                                                                  : Status::kImageValue;
}

/// Tells whether the sphere contains all edges: the bound on a body's displacement requires it.
bool contains(const BoundingSphere& sphere, const SharpEdges& sharp) noexcept {
  for (const format::SharpEdge& edge : sharp.edges) {
    for (int k = 0; k < 2; ++k) {
      if (!((edge_end(edge, k) - sphere.center).norm() <= sphere.radius)) return false;
    }
  }
  return true;
}

/// Reads the sharp edges of both bodies: both or neither.
Status open_edges(const Sections& sections, SceneView& scene) noexcept {
  bool any = false;
  for (const SectionId id : {SectionId::kSharpEdges, SectionId::kSharpEdgeNodes, SectionId::kBodySharpEdges,
                             SectionId::kBodySharpEdgeNodes}) {
    any |= sections[id].data() != nullptr;
  }
  if (!any) return Status::kOk;
  Status status = open_sharp_edges(sections[SectionId::kSharpEdges], sections[SectionId::kSharpEdgeNodes], scene.edges);
  if (status != Status::kOk) return status;
  status = open_sharp_edges(sections[SectionId::kBodySharpEdges], sections[SectionId::kBodySharpEdgeNodes],
                            scene.body_edges);
  if (status != Status::kOk) return status;
  return contains(sphere_of(scene.body), scene.body_edges) ? Status::kOk : Status::kImageValue;
}

/// Reads the workspace; `box` stays unlimited if the image has none.
Status open_workspace(const Sections& sections, WorkspaceBox& box) noexcept {
  const auto bytes = sections[SectionId::kWorkspace];
  if (bytes.data() == nullptr) return Status::kOk;
  format::Workspace workspace{};
  if (!read_one(bytes, workspace)) return Status::kImageLayout;
  for (int axis = 0; axis < 3; ++axis) {
    if (!in_range(workspace.low[axis], -1e7, 1e7) || !in_range(workspace.high[axis], workspace.low[axis], 1e7))
      return Status::kImageValue;
    box.low[axis] = workspace.low[axis];
    box.high[axis] = workspace.high[axis];
  }
  box.limited = true;
  return Status::kOk;
}

}  // namespace

bool valid_gains(const format::Settings& settings) noexcept {
  return in_range(settings.stiffness, 1e-12, kLargestSetting) && in_range(settings.damping, 0.0, kLargestSetting) &&
         in_range(settings.coupling_rotation, 1e-18, kLargestSetting);
}

bool valid_period(double period) noexcept { return in_range(period, format::kShortestPeriod, format::kLongestPeriod); }

Status SceneView::open(std::span<const std::byte> image, SceneView& scene) noexcept {
  if (reinterpret_cast<std::uintptr_t>(image.data()) % format::kAlignment != 0) return Status::kImageLayout;
  format::Header header{};
  Status status = read_header(image, header);
  if (status != Status::kOk) return status;
  Sections sections;
  status = read_sections(image, header, sections);
  if (status != Status::kOk) return status;

  SceneView opened;
  const format::Body& body = opened.body;
  if (!read_one(sections[SectionId::kSettings], opened.settings)) return Status::kImageLayout;
  if (!read_one(sections[SectionId::kBody], opened.body)) return Status::kImageLayout;
  if (!valid_settings(opened.settings) || !valid_body(body)) return Status::kImageValue;

  status = open_map(sections,
                    {SectionId::kGrid, SectionId::kBrickIndex, SectionId::kBricks, SectionId::kRefined,
                     SectionId::kExactBricks, SectionId::kFacets, SectionId::kFacetSets, SectionId::kFacetNumbers},
                    opened.grid, opened.voxelmap);
  if (status != Status::kOk) return status;
  // contacts begin at the safety distance: there the field must be known
  if (opened.grid.band < opened.settings.safety_distance) return Status::kImageValue;

  status = open_workspace(sections, opened.workspace);
  if (status != Status::kOk) return status;
  const auto normals = sections[SectionId::kNormals];
  if (normals.data() == nullptr && opened.holds(format::Solver::kPaper)) return Status::kImageLayout;
  status = open_shell(sections[SectionId::kPoints], normals, sections[SectionId::kNodes],
                      {body.point_count, body.node_count, body.level_count, body.radius}, opened.pointshell);
  if (status != Status::kOk) return status;
  if (!contains(sphere_of(body), opened.pointshell)) return Status::kImageValue;
  status = open_features(sections, opened);
  if (status != Status::kOk) return status;
  status = open_edges(sections, opened);
  if (status != Status::kOk) return status;

  opened.H_MB.rotation =
      Quaternion(body.rotation_MB[0], body.rotation_MB[1], body.rotation_MB[2], body.rotation_MB[3]).normalized();
  opened.H_MB.translation = Vector3(body.translation_MB[0], body.translation_MB[1], body.translation_MB[2]);
  opened.provenance = sections[SectionId::kProvenance];
  scene = opened;
  return Status::kOk;
}

}  // namespace godobject
