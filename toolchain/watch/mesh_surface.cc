#include "toolchain/watch/mesh_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace godobject::watch {
namespace {

constexpr std::uint32_t kLeaf = 4;

double squared_distance_to_box(const Vector3& low, const Vector3& high, const Vector3& p) {
  return (low - p).cwiseMax(p - high).cwiseMax(0.0).squaredNorm();
}

/// Tells whether the segment p + t d, 0 <= t <= 1, meets the box.
bool meets_box(const Vector3& low, const Vector3& high, const Vector3& p, const Vector3& d) {
  double begin = 0.0, end = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    if (d[axis] == 0.0) {
      if (p[axis] < low[axis] || p[axis] > high[axis]) return false;
      continue;
    }
    const double a = (low[axis] - p[axis]) / d[axis];
    const double b = (high[axis] - p[axis]) / d[axis];
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
  }
  return begin <= end;
}

}  // namespace

MeshSurface::MeshSurface(std::vector<Vector3> vertices, std::vector<Triangle> triangles)
    : vertices_(std::move(vertices)), triangles_(std::move(triangles)), vertex_normals_(vertices_.size()) {
  std::fill(vertex_normals_.begin(), vertex_normals_.end(), Vector3::Zero());
  std::map<std::pair<std::uint32_t, std::uint32_t>, Vector3> of_edge;
  const auto key = [](std::uint32_t a, std::uint32_t b) {
    return std::pair<std::uint32_t, std::uint32_t>(std::min(a, b), std::max(a, b));
  };
  for (const Triangle& t : triangles_) {
    const Vector3 &a = vertices_[t[0]], &b = vertices_[t[1]], &c = vertices_[t[2]];
    const Vector3 n = (b - a).cross(c - a).normalized();
    face_normals_.push_back(n);
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3& corner = vertices_[t[i]];
      const Vector3 u = (vertices_[t[(i + 1) % 3]] - corner).normalized();
      const Vector3 v = (vertices_[t[(i + 2) % 3]] - corner).normalized();
      vertex_normals_[t[i]] += std::acos(std::clamp(u.dot(v), -1.0, 1.0)) * n;
      auto [place, is_new] = of_edge.try_emplace(key(t[(i + 1) % 3], t[(i + 2) % 3]), Vector3::Zero());
      place->second += n;
    }
  }
  for (const Triangle& t : triangles_) {
    std::array<Vector3, 3> normals;
    for (std::size_t i = 0; i < 3; ++i) normals[i] = of_edge.at(key(t[(i + 1) % 3], t[(i + 2) % 3]));
    edge_normals_.push_back(normals);
  }
  order_.resize(triangles_.size());
  std::iota(order_.begin(), order_.end(), 0u);
  boxes_.resize(1);
  build(0, 0, static_cast<std::uint32_t>(order_.size()));
}

void MeshSurface::build(std::uint32_t node, std::uint32_t first, std::uint32_t count) {
  if (boxes_.size() <= node) boxes_.resize(node + 1);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Box box{Vector3::Constant(kInfinity), Vector3::Constant(-kInfinity), first, count};
  for (std::uint32_t i = first; i < first + count; ++i) {
    for (const std::uint32_t v : triangles_[order_[i]]) {
      box.low = box.low.cwiseMin(vertices_[v]);
      box.high = box.high.cwiseMax(vertices_[v]);
    }
  }
  if (count > kLeaf) {
    box.count = 0;
    boxes_[node] = box;
    Eigen::Index axis = 0;
    (box.high - box.low).maxCoeff(&axis);
    const auto center = [&](std::uint32_t t) {
      double sum = 0.0;
      for (const std::uint32_t v : triangles_[t]) sum += vertices_[v][axis];
      return sum;
    };
    const std::uint32_t half = count / 2;
    const auto begin = order_.begin() + first;
    std::nth_element(begin, begin + half, begin + count,
                     [&](std::uint32_t a, std::uint32_t b) { return center(a) < center(b); });
    build(2 * node + 1, first, half);
    build(2 * node + 2, first + half, count - half);
    return;
  }
  boxes_[node] = box;
}

/// Ericson, Real-Time Collision Detection, 5.1.5; the regions tell which feature's normal holds.
MeshSurface::Nearest MeshSurface::nearest_of(std::uint32_t triangle, const Vector3& p) const {
  const Triangle& t = triangles_[triangle];
  const Vector3 &a = vertices_[t[0]], &b = vertices_[t[1]], &c = vertices_[t[2]];
  const auto at = [&](const Vector3& point, const Vector3& normal) {
    return Nearest{point, &normal, (p - point).squaredNorm()};
  };
  const Vector3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0.0 && d2 <= 0.0) return at(a, vertex_normals_[t[0]]);
  const Vector3 bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0.0 && d4 <= d3) return at(b, vertex_normals_[t[1]]);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return at(a + d1 / (d1 - d3) * ab, edge_normals_[triangle][2]);
  const Vector3 cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0.0 && d5 <= d6) return at(c, vertex_normals_[t[2]]);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return at(a + d2 / (d2 - d6) * ac, edge_normals_[triangle][1]);
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
    return at(b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b), edge_normals_[triangle][0]);
  }
  const double sum = va + vb + vc;
  return at(a + vb / sum * ab + vc / sum * ac, face_normals_[triangle]);
}

MeshSurface::Nearest MeshSurface::nearest(const Vector3& p, double within) const {
  struct Open {
    std::uint32_t node;
    double squared;  ///< distance of its box
  };
  const auto open = [&](std::uint32_t node) {
    return Open{node, squared_distance_to_box(boxes_[node].low, boxes_[node].high, p)};
  };
  Nearest best;
  best.squared = within;
  constexpr int kDeepest = 64;
  Open stack[kDeepest];
  int depth = 0;
  stack[depth++] = open(0);
  while (depth > 0) {
    const Open next = stack[--depth];
    if (next.squared >= best.squared) continue;
    const Box& box = boxes_[next.node];
    if (box.count > 0) {
      for (std::uint32_t i = box.first; i < box.first + box.count; ++i) {
        const Nearest here = nearest_of(order_[i], p);
        if (here.squared < best.squared) best = here;
      }
      continue;
    }
    Open near = open(2 * next.node + 1);
    Open far = open(2 * next.node + 2);
    if (!(near.squared < far.squared)) std::swap(near, far);
    if (far.squared < best.squared) stack[depth++] = far;
    if (near.squared < best.squared) stack[depth++] = near;
  }
  return best;
}

double MeshSurface::signed_distance(const Nearest& near, const Vector3& p) {
  const double distance = std::sqrt(near.squared);
  return near.normal != nullptr && (p - near.point).dot(*near.normal) < 0.0 ? -distance : distance;
}

double MeshSurface::distance(const Vector3& p) const { return signed_distance(nearest(p), p); }

double MeshSurface::distance_within(const Vector3& p, double most) const {
  constexpr double kRounding = 1e-9;
  const double farther = (1.0 + kRounding) * most + kRounding * p.norm();
  const Nearest near = nearest(p, farther * farther);
  return near.squared < farther * farther ? signed_distance(near, p) : distance(p);  // `most` was wrong
}

Vector3 MeshSurface::gradient(const Vector3& p) const {
  const Nearest near = nearest(p);
  if (near.normal == nullptr) return Vector3::Zero();  // no triangle is at a finite distance
  const Vector3 away = p - near.point;
  const double length = away.norm();
  if (!(length > 0.0)) return near.normal->normalized();
  return away.dot(*near.normal) < 0.0 ? Vector3(-away / length) : Vector3(away / length);
}

bool MeshSurface::triangle_meets(std::uint32_t triangle, const Vector3& p0, const Vector3& d) const {
  const Triangle& t = triangles_[triangle];
  const Vector3& a = vertices_[t[0]];
  const Vector3 e1 = vertices_[t[1]] - a, e2 = vertices_[t[2]] - a;
  const Vector3 h = d.cross(e2);
  const double det = e1.dot(h);
  if (det == 0.0) return false;
  const Vector3 s = p0 - a;
  const double u = s.dot(h) / det;
  if (u < 0.0 || u > 1.0) return false;
  const Vector3 q = s.cross(e1);
  const double v = d.dot(q) / det;
  if (v < 0.0 || u + v > 1.0) return false;
  const double along = e2.dot(q) / det;
  return along >= 0.0 && along <= 1.0;
}

bool MeshSurface::meets(const Vector3& p0, const Vector3& p1) const {
  const Vector3 d = p1 - p0;
  constexpr int kDeepest = 64;
  std::uint32_t stack[kDeepest];
  int depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const std::uint32_t node = stack[--depth];
    const Box& box = boxes_[node];
    if (!meets_box(box.low, box.high, p0, d)) continue;
    if (box.count == 0) {
      stack[depth++] = 2 * node + 1;
      stack[depth++] = 2 * node + 2;
      continue;
    }
    for (std::uint32_t i = box.first; i < box.first + box.count; ++i) {
      if (triangle_meets(order_[i], p0, d)) return true;
    }
  }
  return false;
}

}  // namespace godobject::watch
