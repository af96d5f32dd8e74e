#include "toolchain/precision/mesh_overlap.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <queue>
#include <utility>

#include <Eigen/Geometry>

#include "toolchain/precision/body_surface.h"
#include "toolchain/scene_compiler/field/distance_probe.h"
#include "toolchain/scene_compiler/mesh/triangle_geometry.h"

namespace godobject::precision {

using Eigen::Vector3d;

/// Searches the deepest point of one mesh in the other body: best first, in parts of the mesh whose depth is bounded.
///
/// The depth changes by at most a metre per metre. Within a solid it is at most the distance from any one of its
/// triangles, which is convex, so a part is nowhere deeper than the largest of these distances at its corners. A part
/// that begins outside and intersects no triangle is outside.
class DeepestPoint {
 public:
  DeepestPoint(const MeshOverlap::Body& of, const MeshOverlap::Body& in, const Pose& X, double tolerance)
      : of_(of),
        in_(in),
        probe_(in.surface),
        rotation_(X.rotation.toRotationMatrix()),
        translation_(X.translation),
        tolerance_(tolerance) {}

  double find() {
    constexpr int kMostParts = 100'000;  // never met
    if (!of_.triangles.empty()) add_node(0);
    for (int i = 0; i < kMostParts && !queue_.empty() && may_matter(queue_.top().bound); ++i) {
      const Part part = queue_.top();
      queue_.pop();
      part.node == kTriangle ? halve(part.corners) : open(part.node);
    }
    return deepest_;
  }

 private:
  static constexpr std::uint32_t kTriangle = ~0u;

  struct Part {
    double bound;        // of the depth
    std::uint32_t node;  // or kTriangle
    Corners corners;     // of a triangle, in the frame of the body that it is in

    bool operator<(const Part& other) const { return bound < other.bound; }
  };

  bool may_matter(double bound) const { return bound > deepest_ + std::max(tolerance_, 0.01 * deepest_); }
  Vector3d moved(const Vector3d& p) const { return rotation_ * p + translation_; }

  double depth_at(const Vector3d& p) {
    const double depth = -probe_.signed_distance(p);
    deepest_ = std::max(deepest_, depth);
    return depth;
  }

  void add_node(std::uint32_t index) {
    const TriangleBoxes::Node& node = of_.triangles.node(index);
    if (node.right == 0) {
      const Corners& corners = of_.triangles.triangle(node.first);
      return add({moved(corners[0]), moved(corners[1]), moved(corners[2])});
    }
    // no point of the mesh need be at the centre, so its depth counts only as a bound
    const double center = -probe_.signed_distance(moved(0.5 * (node.low + node.high)));
    const double bound = center + 0.5 * (node.high - node.low).norm();
    if (may_matter(bound)) queue_.push({bound, index, {}});
  }

  void open(std::uint32_t index) {
    add_node(index + 1);
    add_node(of_.triangles.node(index).right);
  }

  void add(const Corners& t) {
    const Vector3d center = (t[0] + t[1] + t[2]) / 3.0;
    const double depth = depth_at(center);
    double radius = 0.0;
    for (const Vector3d& corner : t) radius = std::max(radius, (corner - center).norm());
    if (!may_matter(depth + radius)) return;
    const double bound = std::min(depth + radius, farthest_from(in_.surface.closest(center).triangle, t));
    if (!may_matter(bound)) return;
    if (depth < 0.0 && !in_.has_shells && !in_.triangles.any_intersects(t)) return;
    for (const Vector3d& corner : t) depth_at(corner);
    queue_.push({bound, kTriangle, t});
  }

  /// Returns the largest distance of a corner from a triangle of the body, if it is a solid.
  double farthest_from(std::uint32_t triangle, const Corners& corners) const {
    if (in_.has_shells) return std::numeric_limits<double>::infinity();
    const scene_compiler::TriangleMesh& mesh = in_.surface.mesh();
    const auto& t = mesh.triangles[triangle];
    double farthest = 0.0;
    for (const Vector3d& p : corners) {
      const Vector3d nearest =
          scene_compiler::nearest_point_on_triangle(p, mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]);
      farthest = std::max(farthest, (p - nearest).norm());
    }
    return farthest;
  }

  void halve(const Corners& t) {
    std::size_t longest = 0;  // edge from this corner to the next
    for (std::size_t i = 1; i < 3; ++i) {
      if ((t[i] - t[(i + 1) % 3]).squaredNorm() > (t[longest] - t[(longest + 1) % 3]).squaredNorm()) longest = i;
    }
    const Vector3d& a = t[longest];
    const Vector3d& b = t[(longest + 1) % 3];
    const Vector3d& c = t[(longest + 2) % 3];
    const Vector3d middle = 0.5 * (a + b);
    add({a, middle, c});
    add({middle, b, c});
  }

  const MeshOverlap::Body& of_;
  const MeshOverlap::Body& in_;
  scene_compiler::DistanceProbe probe_;
  Matrix3 rotation_;
  Vector3d translation_;
  double tolerance_;
  double deepest_ = 0.0;
  std::priority_queue<Part> queue_;
};

MeshOverlap::Body::Body(scene_compiler::SolidSurface of) : surface(std::move(of)), triangles(surface.mesh()) {
  for (const auto& component : surface.components()) has_shells |= component.shell;
}

MeshOverlap::MeshOverlap(const scene_compiler::SceneConfig& config)
    : MeshOverlap(read_surface(config.still, config.thickness), read_surface(config.moving, config.thickness),
                  1e-3 * config.voxel_size) {}

MeshOverlap::MeshOverlap(scene_compiler::SolidSurface still, scene_compiler::SolidSurface moving, double tolerance)
    : still_(std::move(still)), moving_(std::move(moving)), tolerance_(tolerance) {}

double MeshOverlap::depth(const Pose& H_WM) const {
  return std::max(DeepestPoint(moving_, still_, H_WM, tolerance_).find(),
                  DeepestPoint(still_, moving_, H_WM.inverse(), tolerance_).find());
}

}  // namespace godobject::precision
