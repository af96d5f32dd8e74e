#include "toolchain/scene_compiler/mesh/triangle_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>

#include "toolchain/scene_compiler/mesh/box.h"

namespace godobject::scene_compiler {
namespace {

using Eigen::Vector3d;

constexpr std::uint32_t kLeafTriangles = 4;  // chosen
constexpr std::uint32_t kMostUneven = 16;
/// Depth of the stack of open nodes. Each split leaves more than 1 / kMostUneven of the triangles on either side. So
/// 2^26 triangles, twice kMaxTriangles, need at most ln(2^26 / kLeafTriangles) / ln(16 / 15) = 258 levels.
constexpr std::size_t kStack = 288;
constexpr double kNotReached = std::numeric_limits<double>::infinity();

/// Half of the area of a box; 0 for an empty one.
double half_area(const Box& box) noexcept {
  const Vector3d e = (box.high - box.low).cwiseMax(0.0);
  return e.x() * e.y() + e.y() * e.z() + e.z() * e.x();
}

Box box_of(const TriangleTree::Triangle& t) noexcept {
  Box box;
  box.add(t.a);
  box.add(t.b);
  box.add(t.c);
  return box;
}

/// True if the ray is inside the box for some t in the range.
bool ray_meets_box(const Vector3d& origin, const Vector3d& inverse, const Vector3d& low, const Vector3d& high,
                   double t_min, double t_max) noexcept {
  for (int axis = 0; axis < 3; ++axis) {
    const double t0 = (low[axis] - origin[axis]) * inverse[axis];
    const double t1 = (high[axis] - origin[axis]) * inverse[axis];
    if (std::isnan(t0) || std::isnan(t1)) continue;  // 0 * infinity: the ray lies in a plane of the box
    t_min = std::max(t_min, std::min(t0, t1));
    t_max = std::min(t_max, std::max(t0, t1));
  }
  return t_min <= t_max * (1.0 + 1e-12);
}

bool ray_meets_triangle(const Vector3d& origin, const Vector3d& direction, const TriangleTree::Triangle& triangle,
                        double& t) noexcept {
  const Vector3d e1 = triangle.b - triangle.a;
  const Vector3d e2 = triangle.c - triangle.a;
  const Vector3d h = direction.cross(e2);
  const double determinant = e1.dot(h);
  if (determinant == 0.0) return false;
  const Vector3d from_a = origin - triangle.a;
  const double u = from_a.dot(h) / determinant;
  const Vector3d q = from_a.cross(e1);
  const double v = direction.dot(q) / determinant;
  constexpr double kBesideEdge = 1e-9;  // so that a ray through an edge meets at least one of its two triangles
  if (u < -kBesideEdge || v < -kBesideEdge || u + v > 1.0 + kBesideEdge) return false;
  t = e2.dot(q) / determinant;
  return true;
}

/// A way to cross a triangle; kUnsureSide if rounding might decide.
enum class Crossing { kNone, kInwards, kOutwards, kUnsureSide };

Crossing crossing(const Vector3d& from, const Vector3d& to, const TriangleTree::Triangle& triangle) noexcept {
  constexpr double kMargin = 1e-9;          // of the step and of the triangle
  constexpr double kRounding = 1e-15;       // of lengths, several roundings
  constexpr double kThinnestTurned = 1e-5;  // height over length: rounding may turn the normals of thinner triangles
  const Vector3d e1 = triangle.b - triangle.a;
  const Vector3d e2 = triangle.c - triangle.a;
  const Vector3d normal = e1.cross(e2);
  const double norm = normal.norm();
  const double longest = std::sqrt(std::max({e1.squaredNorm(), e2.squaredNorm(), (e2 - e1).squaredNorm()}));
  if (!(norm > kThinnestTurned * longest * longest)) return Crossing::kUnsureSide;
  const double height = norm / longest;
  const double step = (to - from).norm();
  const double reach = (from - triangle.a).norm() + step + longest;
  const double off_plane =
      kRounding * reach * longest / height;  // a distance: rounding moves points across the plane by less
  const double begin = normal.dot(from - triangle.a) / norm;
  const double end = normal.dot(to - triangle.a) / norm;
  const double least = kMargin * step + off_plane;
  if (begin > least && end > least) return Crossing::kNone;
  if (begin < -least && end < -least) return Crossing::kNone;
  if (std::abs(begin) <= least || std::abs(end) <= least) return Crossing::kUnsureSide;
  const Vector3d in_plane = from + begin / (begin - end) * (to - from) - triangle.a;
  const double u = in_plane.cross(e2).dot(normal) / (norm * norm);
  const double v = e1.cross(in_plane).dot(normal) / (norm * norm);
  const double inmost = std::min({u, v, 1.0 - u - v});
  const double margin =
      kMargin + (2.0 * off_plane * step / std::abs(begin - end) + kRounding * reach) * longest / (height * height);
  if (inmost < -margin) return Crossing::kNone;
  if (inmost <= margin) return Crossing::kUnsureSide;
  return begin > 0.0 ? Crossing::kInwards : Crossing::kOutwards;
}

}  // namespace

TriangleTree::TriangleTree(std::vector<Triangle> triangles) : triangles_(std::move(triangles)) {
  if (triangles_.empty()) return;
  std::vector<Vector3d> centroids;
  centroids.reserve(triangles_.size());
  for (const Triangle& t : triangles_) centroids.push_back((t.a + t.b + t.c) / 3.0);
  nodes_.reserve(triangles_.size());
  build(0, static_cast<std::uint32_t>(triangles_.size()), centroids);
  set_dipoles();
}

std::uint32_t TriangleTree::build(std::uint32_t begin, std::uint32_t end, std::vector<Vector3d>& centroids) {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  Box box;
  for (std::uint32_t i = begin; i < end; ++i) box.add(box_of(triangles_[i]));
  nodes_.push_back({box, begin, end - begin, index + 1});
  if (end - begin <= kLeafTriangles) return index;
  const std::uint32_t middle = split(begin, end, centroids);
  build(begin, middle, centroids);
  const std::uint32_t right = build(middle, end, centroids);
  nodes_[index].right = right;
  nodes_[index].count = 0;
  nodes_[index].after = static_cast<std::uint32_t>(nodes_.size());
  return index;
}

/// Splits triangles begin .. end by the binned surface-area heuristic, or else at the median of their centroids, along
/// the longest axis of the box around the centroids. Returns the first triangle of the second part.
std::uint32_t TriangleTree::split(std::uint32_t begin, std::uint32_t end, std::vector<Vector3d>& centroids) {
  const Box spread = Box::around(std::span(centroids).subspan(begin, end - begin));
  int axis = 0;
  (spread.high - spread.low).maxCoeff(&axis);
  const std::uint32_t middle = split_by_bins(begin, end, {axis, spread.low[axis], spread.high[axis]}, centroids);
  return middle != begin ? middle : split_at_median(begin, end, axis, centroids);
}

/// Returns `begin` if the bins cannot separate the triangles, or only so unevenly that the tree might grow deep.
std::uint32_t TriangleTree::split_by_bins(std::uint32_t begin, std::uint32_t end, const Extent& extent,
                                          std::vector<Vector3d>& centroids) {
  constexpr int kBins = 16;
  const double scale = kBins / (extent.high - extent.low) * (1.0 - 1e-12);
  if (!(extent.high > extent.low) || !std::isfinite(scale)) return begin;
  const auto bin_of = [&](std::uint32_t i) {
    return std::clamp(static_cast<int>((centroids[i][extent.axis] - extent.low) * scale), 0, kBins - 1);
  };
  std::array<Box, kBins> boxes;
  std::array<std::uint32_t, kBins> counts{};
  for (std::uint32_t i = begin; i < end; ++i) {
    const auto bin = static_cast<std::size_t>(bin_of(i));
    boxes[bin].add(box_of(triangles_[i]));
    ++counts[bin];
  }
  std::array<double, kBins> right_cost{};
  Box right;
  std::uint32_t right_count = 0;
  for (std::size_t bin = kBins - 1; bin > 0; --bin) {
    right.add(boxes[bin]);
    right_count += counts[bin];
    right_cost[bin] = half_area(right) * right_count;
  }
  Box left;
  std::uint32_t left_count = 0;
  double best = kNotReached;
  int best_bin = -1;
  const std::uint32_t smallest = (end - begin) / kMostUneven;
  for (std::size_t bin = 0; bin + 1 < kBins; ++bin) {
    left.add(boxes[bin]);
    left_count += counts[bin];
    const double cost = half_area(left) * left_count + right_cost[bin + 1];
    const bool balanced = left_count > smallest && end - begin - left_count > smallest;
    if (balanced && cost < best) {
      best = cost;
      best_bin = static_cast<int>(bin);
    }
  }
  std::uint32_t middle = begin;
  for (std::uint32_t i = begin; i < end && best_bin >= 0; ++i) {
    if (bin_of(i) > best_bin) continue;
    std::swap(triangles_[i], triangles_[middle]);
    std::swap(centroids[i], centroids[middle++]);
  }
  return middle;
}

std::uint32_t TriangleTree::split_at_median(std::uint32_t begin, std::uint32_t end, int axis,
                                            std::vector<Vector3d>& centroids) {
  std::vector<std::uint32_t> order(end - begin);
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = begin + i;
  const std::size_t half = order.size() / 2;
  std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(half), order.end(),
                   [&](std::uint32_t i, std::uint32_t j) {
                     return centroids[i][axis] != centroids[j][axis] ? centroids[i][axis] < centroids[j][axis] : i < j;
                   });
  std::vector<Triangle> triangles;
  std::vector<Vector3d> moved;
  for (const std::uint32_t i : order) {
    triangles.push_back(triangles_[i]);
    moved.push_back(centroids[i]);
  }
  std::copy(triangles.begin(), triangles.end(), triangles_.begin() + begin);
  std::copy(moved.begin(), moved.end(), centroids.begin() + begin);
  return begin + static_cast<std::uint32_t>(half);
}

void TriangleTree::set_dipoles() {
  dipoles_.resize(nodes_.size());
  std::vector<double> areas(nodes_.size());
  for (std::size_t n = nodes_.size(); n-- > 0;) {  // children follow their parent
    const Node& node = nodes_[n];
    Dipole& dipole = dipoles_[n];
    Vector3d weighted = Vector3d::Zero();
    dipole.area.setZero();
    if (node.count > 0) {
      for (std::uint32_t i = node.right; i < node.right + node.count; ++i) {
        const Triangle& t = triangles_[i];
        const Vector3d area = 0.5 * (t.b - t.a).cross(t.c - t.a);
        dipole.area += area;
        areas[n] += area.norm();
        weighted += area.norm() * ((t.a + t.b + t.c) / 3.0);
      }
    } else {
      for (const std::size_t child : {n + 1, static_cast<std::size_t>(node.right)}) {
        dipole.area += dipoles_[child].area;
        areas[n] += areas[child];
        weighted += areas[child] * dipoles_[child].center;
      }
    }
    dipole.center = areas[n] > 0.0 ? Vector3d(weighted / areas[n]) : Vector3d(0.5 * (node.box.low + node.box.high));
    dipole.radius = (node.box.high - dipole.center).cwiseMax(dipole.center - node.box.low).norm();
  }
}

bool TriangleTree::nearest(const Vector3d& p, double bound_squared, Nearest& nearest) const noexcept {
  return nearest_of(
      p, bound_squared, [](std::uint32_t) { return true; }, nearest);
}

bool TriangleTree::nearest(const Vector3d& p, double bound_squared, const std::function<bool(std::uint32_t)>& counts,
                           Nearest& nearest) const {
  return nearest_of(p, bound_squared, counts, nearest);
}

template <class Counts>
bool TriangleTree::nearest_of(const Vector3d& p, double bound_squared, const Counts& counts, Nearest& nearest) const {
  if (nodes_.empty()) return false;
  struct Open {
    std::uint32_t node;
    double squared_distance;
  };
  std::array<Open, kStack> stack;
  std::size_t depth = 0;
  double best = bound_squared;
  bool found = false;
  stack[depth++] = {0, nodes_[0].box.squared_distance(p)};
  while (depth > 0) {
    const Open open = stack[--depth];
    if (open.squared_distance >= best) continue;
    const Node& node = nodes_[open.node];
    if (node.count > 0) {
      for (std::uint32_t i = node.right; i < node.right + node.count; ++i) {
        const Triangle& t = triangles_[i];
        const Vector3d q = nearest_point_on_triangle(p, t.a, t.b, t.c);
        const double squared = (q - p).squaredNorm();
        if (squared < best && counts(t.id)) {
          best = squared;
          found = true;
          nearest = {squared, q, t.id};
        }
      }
      continue;
    }
    Open near{open.node + 1, 0.0};
    Open far{node.right, 0.0};
    near.squared_distance = nodes_[near.node].box.squared_distance(p);
    far.squared_distance = nodes_[far.node].box.squared_distance(p);
    if (far.squared_distance < near.squared_distance) std::swap(near, far);
    if (far.squared_distance < best) stack[depth++] = far;
    if (near.squared_distance < best) stack[depth++] = near;
  }
  return found;
}

bool TriangleTree::first_hit(const Vector3d& origin, const Vector3d& direction, double t_min, double t_max,
                             RayHit& hit) const noexcept {
  if (nodes_.empty()) return false;
  const Vector3d inverse = direction.cwiseInverse();
  std::array<std::uint32_t, kStack> stack;
  std::size_t depth = 0;
  const Triangle* first = nullptr;
  stack[depth++] = 0;
  while (depth > 0) {
    const std::uint32_t index = stack[--depth];
    const Node& node = nodes_[index];
    if (!ray_meets_box(origin, inverse, node.box.low, node.box.high, t_min, t_max)) continue;
    if (node.count == 0) {
      stack[depth++] = node.right;
      stack[depth++] = index + 1;
      continue;
    }
    for (std::uint32_t i = node.right; i < node.right + node.count; ++i) {
      double t = 0.0;
      if (ray_meets_triangle(origin, direction, triangles_[i], t) && t > t_min && t < t_max) {
        t_max = t;
        first = &triangles_[i];
      }
    }
  }
  if (first == nullptr) return false;
  hit.t = t_max;
  hit.id = first->id;
  hit.normal = (first->b - first->a).cross(first->c - first->a).normalized();
  return true;
}

std::optional<int> TriangleTree::winding_change(const Vector3d& from, const Vector3d& to) const noexcept {
  constexpr double kWider = 1e-9;  // of the segment, so that boxes do not hide what is unsure
  const Vector3d direction = to - from;
  const Vector3d inverse = direction.cwiseInverse();
  const Vector3d wider = Vector3d::Constant(kWider * direction.norm());
  int change = 0;
  for (std::size_t n = 0; n < nodes_.size();) {
    const Node& node = nodes_[n];
    if (!ray_meets_box(from, inverse, node.box.low - wider, node.box.high + wider, -kWider, 1.0 + kWider)) {
      n = node.after;
      continue;
    }
    for (std::uint32_t i = node.right; i < node.right + node.count; ++i) {
      const Crossing found = crossing(from, to, triangles_[i]);
      if (found == Crossing::kUnsureSide) return {};
      if (found == Crossing::kInwards) ++change;
      if (found == Crossing::kOutwards) --change;
    }
    ++n;
  }
  return change;
}

double TriangleTree::winding_number(const Vector3d& p, double opening) const noexcept {
  if (nodes_.empty()) return 0.0;
  std::array<std::uint32_t, kStack> stack;
  std::size_t depth = 0;
  double far_sum = 0.0;
  SolidAngle near(p);
  stack[depth++] = 0;
  while (depth > 0) {
    const std::uint32_t index = stack[--depth];
    const Dipole& dipole = dipoles_[index];
    const Vector3d to_center = dipole.center - p;
    const double squared = to_center.squaredNorm();
    const double far = opening * dipole.radius;
    if (squared > far * far) {
      far_sum += dipole.area.dot(to_center) / (squared * std::sqrt(squared));
      continue;
    }
    const Node& node = nodes_[index];
    if (node.count == 0) {
      stack[depth++] = node.right;
      stack[depth++] = index + 1;
      continue;
    }
    for (std::uint32_t i = node.right; i < node.right + node.count; ++i) {
      near.add(triangles_[i].a, triangles_[i].b, triangles_[i].c);
    }
  }
  return (far_sum + near.sum()) / (4.0 * std::numbers::pi);
}

}  // namespace godobject::scene_compiler
