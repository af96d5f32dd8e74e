#include "toolchain/scene_compiler/points/ball.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include "toolchain/command_line/failure.h"
#include "toolchain/parallel/parallel.h"
#include "toolchain/scene_compiler/points/bounding_sphere.h"
#include "toolchain/scene_compiler/points/sphere_tree.h"

namespace godobject::scene_compiler {
namespace {

using Eigen::Vector3d;

/// Of the bounding box's diagonal: the rounding of coordinates some metres off the origin.
constexpr double kFlatTriangle = 1e-5;
/// Of the diagonal: rounding of a face's corners against each other, some 6 units of 6e-8.
constexpr double kCornerRounding = 4e-7;

bool is_one_solid(const SolidSurface& surface) {
  return surface.components().size() == 1 && !surface.components().front().shell && surface.sealed();
}

/// The outward plane of a face, and the height above it that a vertex of a convex mesh may have.
struct FacePlane {
  Vector3d normal;
  double offset, allowed;
};

FacePlane plane_of(const SolidSurface& surface, std::size_t face, double diagonal) {
  const TriangleMesh& mesh = surface.mesh();
  const auto& t = mesh.triangles[face];
  const Vector3d& a = mesh.vertices[t[0]];
  const Vector3d ab = mesh.vertices[t[1]] - a;
  const Vector3d ac = mesh.vertices[t[2]] - a;
  const Vector3d area = ab.cross(ac) * (surface.components().front().inside_out ? -1.0 : 1.0);
  const double longest = std::max({ab.norm(), ac.norm(), (ac - ab).norm()});
  const Vector3d normal = area.normalized();
  const double height = area.norm() / longest;  // the smallest of the three
  return {normal, normal.dot(a), diagonal * (kFlatTriangle + kCornerRounding * diagonal / height)};
}

}  // namespace

std::optional<Ball> as_ball(const SolidSurface& surface) {
  if (!is_one_solid(surface)) return std::nullopt;
  const Sphere sphere = bounding_sphere(surface.mesh().vertices);
  const double nearest = surface.closest(sphere.center).distance;
  const Ball ball{sphere.center, sphere.radius, sphere.radius - nearest};
  if (ball.deviation > kBallTolerance * ball.radius) return std::nullopt;
  return ball;
}

bool is_convex(const SolidSurface& surface) {
  if (!is_one_solid(surface)) return false;
  const TriangleMesh& mesh = surface.mesh();
  const Sphere sphere = bounding_sphere(mesh.vertices);
  std::atomic<bool> convex = true;
  parallel::for_each_index(mesh.triangles.size(), [&](std::size_t face) {
    if (!convex.load(std::memory_order_relaxed)) return;
    const FacePlane plane = plane_of(surface, face, 2.0 * sphere.radius);
    for (const Vector3d& vertex : mesh.vertices) {
      if (plane.normal.dot(vertex) > plane.offset + plane.allowed) convex.store(false, std::memory_order_relaxed);
    }
  });
  return convex;
}

Ball require_ball(const SolidSurface& moving, const std::string& moving_name, const SolidSurface& still,
                  const std::string& still_name, double voxel_size) {
  const std::optional<Ball> ball = as_ball(moving);
  const auto refuse = [](const std::string& what) { throw command::Failure(command::ExitCode::kBadData, what); };
  if (!ball) {
    refuse(
        fmt::format("{}: is not a ball; a ball is one closed solid with all of its surface within {:g} % of a sphere; "
                    "repair the mesh, or leave out moving.ball",
                    moving_name, 100.0 * kBallTolerance));
  }
  if (ball->radius < voxel_size) {
    refuse(
        fmt::format("{}: a ball of {:.4g} m radius is smaller than a voxel of {:g} m; set still.voxel_size = {:.2g} "
                    "or smaller, or leave out moving.ball",
                    moving_name, ball->radius, voxel_size, 0.5 * ball->radius));
  }
  if (!is_convex(still)) {
    refuse(fmt::format(
        "{}: is not one closed convex solid; in a re-entrant edge the centre of a ball would touch only one of "
        "the walls; leave out moving.ball",
        still_name));
  }
  return *ball;
}

MovingBody make_ball_body(const Ball& ball) {
  const SphereTree tree = build_sphere_tree(std::vector<Eigen::Vector3f>{Eigen::Vector3f::Zero()}, {{0}});
  const double square = ball.radius * ball.radius;
  MovingBody moving;
  moving.points = {0.0f, 0.0f, 0.0f};
  moving.nodes = tree.nodes;
  format::Body& body = moving.body;
  body.rotation_MB[0] = 1.0;
  std::copy_n(ball.center.data(), 3, body.translation_MB);
  std::fill_n(body.inertia, 3, 0.4 * square);
  body.radius = kLeastPointRadius;
  body.sphere_radius = kLeastPointRadius;
  body.volume = 4.0 / 3.0 * std::numbers::pi * square * ball.radius;
  body.point_count = 1;
  body.node_count = static_cast<std::uint32_t>(moving.nodes.size());
  body.level_count = 1;
  return moving;
}

double ball_radius(const SceneView& scene) {
  const auto* const begin = reinterpret_cast<const char*>(scene.provenance.data());
  const auto told = nlohmann::json::parse(begin, begin + scene.provenance.size(), nullptr, false);
  const auto at = nlohmann::json::json_pointer("/ball/radius");
  return told.is_object() && told.contains(at) ? told[at].get<double>() : 0.0;
}

}  // namespace godobject::scene_compiler
