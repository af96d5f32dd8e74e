#include "toolchain/report/assembly/section.h"

#include <cmath>

#include <Eigen/Geometry>

namespace godobject::report {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Returns the section with the plane through `at` that u and v span, as multiples of u and v.
std::vector<Segment> section(const scene_compiler::TriangleMesh& mesh, const Vector3d& at, const Vector3d& u,
                             const Vector3d& v) {
  const Vector3d normal = u.cross(v);
  std::vector<Segment> segments;
  for (const auto& triangle : mesh.triangles) {
    std::vector<Vector2d> ends;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3d from = mesh.vertices[triangle[i]] - at;
      const Vector3d to = mesh.vertices[triangle[(i + 1) % 3]] - at;
      const double before = from.dot(normal);
      const double after = to.dot(normal);
      if ((before > 0.0) == (after > 0.0)) continue;
      const Vector3d p = from + before / (before - after) * (to - from);
      ends.emplace_back(p.dot(u), p.dot(v));
    }
    if (ends.size() == 2) segments.push_back({ends[0], ends[1]});
  }
  return segments;
}

}  // namespace

std::vector<Segment> axial_section(const scene_compiler::TriangleMesh& mesh, double angle) {
  std::vector<Segment> segments =
      section(mesh, Vector3d::Zero(), {std::cos(angle), std::sin(angle), 0.0}, Vector3d::UnitZ());
  std::erase_if(segments, [](const Segment& segment) { return segment[0].x() <= 0.0 || segment[1].x() <= 0.0; });
  return segments;
}

std::vector<Segment> level_section(const scene_compiler::TriangleMesh& mesh, double z) {
  return section(mesh, z * Vector3d::UnitZ(), Vector3d::UnitX(), Vector3d::UnitY());
}

}  // namespace godobject::report
