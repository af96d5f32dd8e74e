#include "toolchain/scene_compiler/mesh/surface_patches.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "toolchain/scene_compiler/mesh/mesh_normals.h"
#include "toolchain/scene_compiler/mesh/sharp_features.h"
#include "toolchain/scene_compiler/mesh/triangle_geometry.h"

namespace godobject::scene_compiler {
namespace {

using Eigen::Vector3d;

constexpr double kLeastAngle = 1e-6;  // flatter creases need no round [rad]

}  // namespace

SurfacePatches::SurfacePatches(const BodyMesh& body)
    : body_(body), corner_normals_(corner_normals(body.mesh, body.face_normals)) {
  add_triangles();
  add_rounds();
}

void SurfacePatches::add(const Patch& patch, double area) {
  if (!(area > 0.0)) return;
  cumulated_area_.push_back(this->area() + area);
  patches_.push_back(patch);
}

void SurfacePatches::add_triangles() {
  const TriangleMesh& mesh = body_.mesh;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& corners = mesh.triangles[t];
    const double area = triangle_area(mesh.vertices[corners[0]], mesh.vertices[corners[1]], mesh.vertices[corners[2]]);
    if (body_.in_shell[t]) {
      add({Patch::Kind::kShellFront, t}, area);
      add({Patch::Kind::kShellBack, t}, area);
    } else {
      add({Patch::Kind::kSolid, t}, area);
    }
  }
}

void SurfacePatches::add_rounds() {
  const TriangleMesh& mesh = body_.mesh;
  for (const MeshEdges::Edge& edge : body_.edges.all()) {
    const auto sides = body_.edges.sides(edge);
    if (!body_.in_shell[sides[0].triangle] || sides.size() > 2) continue;
    Vector3d outward = away_from_triangle(mesh, edge, sides[0]);
    double half_angle = 0.5 * std::numbers::pi;
    if (sides.size() == 2) {
      const Vector3d second = away_from_triangle(mesh, edge, sides[1]);
      half_angle = 0.5 * std::acos(std::clamp(-outward.dot(second), -1.0, 1.0));
      outward = (outward + second).stableNormalized();
    }
    if (half_angle < kLeastAngle || outward.squaredNorm() == 0.0) continue;
    const double length = (mesh.vertices[edge.high] - mesh.vertices[edge.low]).norm();
    add({Patch::Kind::kRound, static_cast<std::uint32_t>(rounds_.size())},
        length * body_.half_thickness * 2.0 * half_angle);
    rounds_.push_back({edge.low, edge.high, outward, half_angle});
  }
}

SurfaceSample SurfacePatches::draw(double at, double u, double v) const {
  const auto found = std::upper_bound(cumulated_area_.begin(), cumulated_area_.end(), at * area());
  const auto i = static_cast<std::size_t>(found - cumulated_area_.begin());
  return this->at(std::min(i, patches_.size() - 1), u, v);
}

SurfaceSample SurfacePatches::at(std::size_t piece, double u, double v) const {
  const Patch& patch = patches_[piece];
  return patch.kind == Patch::Kind::kRound ? draw_on_round(rounds_[patch.index], u, v) : draw_on_triangle(patch, u, v);
}

SurfaceSample SurfacePatches::draw_on_triangle(const Patch& patch, double u, double v) const {
  const auto& corners = body_.mesh.triangles[patch.index];
  const double root = std::sqrt(u);
  const std::array<double, 3> weights{1.0 - root, root * (1.0 - v), root * v};
  SurfaceSample sample{Vector3d::Zero(), Vector3d::Zero()};
  for (std::size_t k = 0; k < 3; ++k) {
    sample.point += weights[k] * body_.mesh.vertices[corners[k]];
    sample.inward -= weights[k] * corner_normals_[patch.index][k];
  }
  sample.inward.normalize();
  if (patch.kind == Patch::Kind::kSolid) return sample;
  sample.on_shell = true;
  const double side = patch.kind == Patch::Kind::kShellFront ? 1.0 : -1.0;
  sample.point += side * body_.half_thickness * body_.face_normals[patch.index];
  sample.inward *= side;
  return sample;
}

SurfaceSample SurfacePatches::draw_on_round(const Round& round, double u, double v) const {
  const Vector3d& low = body_.mesh.vertices[round.low];
  const Vector3d edge = body_.mesh.vertices[round.high] - low;
  const double angle = (2.0 * v - 1.0) * round.half_angle;
  const Vector3d across = edge.stableNormalized().cross(round.outward);
  const Vector3d outward = std::cos(angle) * round.outward + std::sin(angle) * across;
  SurfaceSample sample{low + u * edge + body_.half_thickness * outward, -outward};
  sample.on_shell = true;
  return sample;
}

}  // namespace godobject::scene_compiler
