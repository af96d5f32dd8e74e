#include "toolchain/viewer/camera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "toolchain/scene_compiler/mesh/triangle_tree.h"

namespace godobject::viewer {
namespace {

using scene_compiler::TriangleMesh;
using scene_compiler::TriangleTree;

TriangleTree tree_of(const TriangleMesh& mesh, const Pose& pose) {
  std::vector<TriangleTree::Triangle> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    triangles.push_back({pose * mesh.vertices[t[0]], pose * mesh.vertices[t[1]], pose * mesh.vertices[t[2]],
                         static_cast<std::uint32_t>(triangles.size())});
  }
  return TriangleTree(std::move(triangles));
}

/// Returns the centre of the bounding box.
Vector3 middle(const std::vector<Vector3>& points) {
  Vector3 low = points.front();
  Vector3 high = low;
  for (const Vector3& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return 0.5 * (low + high);
}

double furthest(const std::vector<Vector3>& points, const Vector3& from) {
  double radius = 0.0;
  for (const Vector3& p : points) radius = std::max(radius, (p - from).norm());
  return radius;
}

/// A mesh with its pose in W and its tree.
struct PlacedMesh {
  const TriangleMesh& mesh;
  const Pose& pose;
  const TriangleTree& tree;
};

/// Returns the vertex of either mesh that is nearest to the surface of the other one. Both are tested, because the
/// touching vertex may belong to either mesh.
Vector3 nearest_place(const PlacedMesh& a, const PlacedMesh& b) {
  Vector3 place = a.pose.translation;
  TriangleTree::Nearest nearest{std::numeric_limits<double>::infinity(), Vector3::Zero(), 0};
  for (const auto& [from, to] : {std::pair(&a, &b), {&b, &a}}) {
    for (const Vector3& vertex : from->mesh.vertices) {
      const Vector3 p = from->pose * vertex;
      if (to->tree.nearest(p, nearest.squared_distance, nearest)) place = p;
    }
  }
  return place;
}

/// Returns the unit vector from the target to the eye.
Vector3 toward_eye(const ViewDirection& direction, int up_axis) {
  Vector3 v;
  v[up_axis] = std::sin(direction.elevation);
  v[(up_axis + 1) % 3] = std::cos(direction.elevation) * std::cos(direction.azimuth);
  v[(up_axis + 2) % 3] = std::cos(direction.elevation) * std::sin(direction.azimuth);
  return v;
}

/// Returns the share of points at the distance `spread` around `place` with a free line of sight to the eye.
double visible_share(const Vector3& place, double spread, const Vector3& to_eye, const TriangleTree& still,
                     const TriangleTree& moving) {
  constexpr int kRays = 24;
  constexpr double kGoldenAngle = 2.399963229728653;
  int free = 0;
  for (int i = 0; i < kRays; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / kRays;
    const double r = std::sqrt(1.0 - z * z);
    const Vector3 from = place + spread * Vector3(r * std::cos(kGoldenAngle * i), r * std::sin(kGoldenAngle * i), z);
    TriangleTree::RayHit hit{};
    constexpr double kFar = std::numeric_limits<double>::infinity();
    if (!still.first_hit(from, to_eye, 0.0, kFar, hit) && !moving.first_hit(from, to_eye, 0.0, kFar, hit)) ++free;
  }
  return static_cast<double>(free) / kRays;
}

struct Subject {
  Vector3 place;       ///< place of nearest approach
  Vector3 separation;  ///< unit, from the device to the god object; if they agree, from the place to the body
  double size;
};

Vector3 choose_direction(const Subject& subject, int up_axis, const TriangleTree& still, const TriangleTree& moving) {
  constexpr int kAround = 72;
  constexpr double kDegree = std::numbers::pi / 180.0;
  constexpr double kSpreads[] = {0.05, 0.15, 0.3};  // the surroundings count too, because the place may lie in a hole
  Vector3 best = Vector3::UnitX();
  double best_score = -1.0;
  for (const double elevation : {12.0 * kDegree, 25.0 * kDegree, 40.0 * kDegree}) {
    for (int i = 0; i < kAround; ++i) {
      const Vector3 v = toward_eye({2.0 * std::numbers::pi * i / kAround, elevation}, up_axis);
      const double sideways = 1.0 - std::abs(v.dot(subject.separation));
      double score = 0.5 * sideways;
      for (const double spread : kSpreads)
        score += visible_share(subject.place, spread * subject.size, v, still, moving);
      if (score > best_score + 1e-9) {
        best_score = score;
        best = v;
      }
    }
  }
  return best;
}

}  // namespace

Camera make_camera(const View& view) {
  std::vector<Vector3> shown;
  for (const Placement& placement : view.placements) {
    for (const Vector3& vertex : view.moving.vertices) {
      shown.push_back(placement.H_WS * vertex);
      shown.push_back(placement.H_WD * vertex);
    }
  }
  const Placement& first = view.placements.front();
  const Pose H_WW;
  const TriangleTree still = tree_of(view.still, H_WW);
  const TriangleTree moving = tree_of(view.moving, first.H_WS);
  const Vector3 place = nearest_place({view.moving, first.H_WS, moving}, {view.still, H_WW, still});
  shown.push_back(place);
  const Vector3 center = middle(shown);

  Camera camera;
  camera.target = center + 0.25 * (place - center);
  const double radius = furthest(shown, camera.target);

  Vector3 to_eye;
  if (view.direction) {
    to_eye = toward_eye(*view.direction, view.up_axis);
  } else {
    const Vector3 apart = first.H_WS.translation - first.H_WD.translation;
    const bool differ = apart.norm() > 1e-3 * radius;
    const Subject subject{place, differ ? apart.normalized() : (center - place).stableNormalized(), radius};
    to_eye = choose_direction(subject, view.up_axis, still, moving);
  }

  constexpr double kRoom = 1.03;
  camera.forward = -to_eye;
  camera.right = camera.forward.cross(Vector3::Unit(view.up_axis)).stableNormalized();
  if (camera.right.squaredNorm() < 0.5) camera.right = Vector3::Unit((view.up_axis + 1) % 3);  // straight from above
  camera.up = camera.right.cross(camera.forward);
  camera.eye = camera.target + to_eye * (kRoom * radius / (view.zoom * std::sin(kHalfView)));
  return camera;
}

}  // namespace godobject::viewer
