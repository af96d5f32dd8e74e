#include "toolchain/report/extremes/compiled_world.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "toolchain/report/contact_quality/compiled_scene.h"
#include "toolchain/report/extremes/draw.h"
#include "toolchain/report/extremes/rig.h"

namespace godobject::report {
namespace {

constexpr double kFieldTolerance = 0.05;  // default of the scene file [voxels]
constexpr double kBallFacets = 0.0043;    // derived: 1 - cos^2(3.75 degrees), the depth of the facets' middles

double ball_radius(const Setup& setup) { return 0.9 * setup.scale * setup.body_scale; }

TriangleMesh body_mesh_of(const Setup& setup) {
  const double s = setup.scale * setup.body_scale;
  if (setup.body == "ball") return ball_mesh(ball_radius(setup), 8);
  if (setup.body == "center") return ball_mesh(ball_radius(setup), 24);
  if (setup.body == "ell") {
    return cell_solid({{{-0.4 * s, 0.1 * s, 0.8 * s}, {-0.4 * s, 0.1 * s, 0.8 * s}, {-0.25 * s, 0.25 * s}}},
                      [](int i, int j, int) { return i == 0 || j == 0; });
  }
  const Vector3 half = half_edges(setup);
  return box_mesh(-half, half);
}

TriangleMesh mesh_of(const Setup& setup) {
  const double s = setup.scale;
  Draw draw(setup.seed + 2);
  if (setup.world == "mesh-ball") return moved(ball_mesh(1.2 * s, 12), {Quaternion::Identity(), {0.0, 0.0, -1.2 * s}});
  if (setup.world == "mesh-turned") {
    const std::vector<TurnedCorner> profile = {{0.0, -2.0 * s},
                                               {draw.between(0.8, 1.6) * s, -2.0 * s},
                                               {draw.between(0.4, 0.8) * s, -draw.between(0.8, 1.4) * s},
                                               {draw.between(0.8, 1.6) * s, -draw.between(0.1, 0.5) * s},
                                               {0.0, 0.0}};
    return turned_solid(profile, 24);
  }
  if (setup.world == "mesh-plate")
    return box_mesh({-3.0 * s, -3.0 * s, -2.0 * setup.voxel * s}, {3.0 * s, 3.0 * s, 0.0});
  if (setup.world == "mesh-shell") return sheet_mesh(3.0 * s);
  if (setup.world == "mesh-cavity") {
    const Vector3 in = half_size_of_body(setup) + Vector3::Constant(std::max(0.02, setup.width - 1.0) * s);
    const Vector3 out = in + Vector3::Constant(0.6 * s);
    return cell_solid({{{-out.x(), -in.x(), in.x(), out.x()},
                        {-out.y(), -in.y(), in.y(), out.y()},
                        {-in.z() - out.z(), -2.0 * in.z(), 0.0}}},
                      [](int i, int j, int k) { return i != 1 || j != 1 || k != 1; });
  }
  return box_mesh({-1.6 * s, -1.4 * s, -1.2 * s}, {1.6 * s, 1.4 * s, 0.0});
}

watch::MeshSurface surface_of(const TriangleMesh& mesh, const Pose& H) {
  std::vector<Vector3> vertices;
  for (const Vector3& v : mesh.vertices) vertices.push_back(H * v);
  return {std::move(vertices), mesh.triangles};
}

}  // namespace

CompiledWorld::CompiledWorld(const Setup& setup, const std::filesystem::path& work)
    : still_mesh_(moved(mesh_of(setup), placement(setup))),
      body_mesh_(body_mesh_of(setup)),
      image_(compile(setup, work)) {
  const bool is_ball = setup.body == "center";
  const bool is_shell = setup.world == "mesh-shell";
  accuracy_ = watch::kDepthBetween * kFieldTolerance * setup.voxel * setup.scale;
  if (is_ball) accuracy_ += kBallFacets * ball_radius(setup);
  watched_.emplace(image_->bytes.span(), image_->scene);
  const double grown_by = is_ball ? ball_radius(setup) : is_shell ? setup.voxel * setup.scale : 0.0;
  still_surface_.emplace(surface_of(still_mesh_, {}), grown_by, is_shell);
  body_surface_.emplace(surface_of(body_mesh_, image_->scene.H_MB.inverse()));
}

watch::WatchedSession CompiledWorld::watched(const watch::SessionChoice& choice, double rounding) const {
  return watched_->session(choice, {&*still_surface_, accuracy_}, {&*body_surface_, accuracy_ + slack_}, rounding);
}

std::unique_ptr<files::SceneImage> CompiledWorld::compile(const Setup& setup, const std::filesystem::path& work) {
  const std::filesystem::path file = work / "body.ply";
  write_ply(body_mesh_, file);
  const auto report =
      compile_image("fuzz",
                    {.still = {.mesh = still_mesh_, .shell = setup.world == "mesh-shell"},
                     .body = file,
                     .ball = setup.body == "center",
                     .points = static_cast<std::uint32_t>(std::max(setup.points, 20)),
                     .edges = true,
                     .settings = {.voxel_size = setup.voxel * setup.scale,
                                  .safety_distance = setup.safety_distance(),
                                  .margin = setup.margin(),
                                  .stiffness = setup.stiffness,
                                  .coupling_rotation = setup.coupling_rotation * setup.scale * setup.scale,
                                  .friction_static = setup.friction_static,
                                  .friction_kinetic = setup.friction_kinetic}},
                    work);
  slack_ = report.second.slack;
  return std::make_unique<files::SceneImage>(files::SceneImage::read(work / "fuzz.scene"));
}

Vector3 half_size_of_body(const Setup& setup) {
  Vector3 half = Vector3::Zero();
  for (const Vector3& v : body_mesh_of(setup).vertices) half = half.cwiseMax(v.cwiseAbs());
  return half;
}

}  // namespace godobject::report
