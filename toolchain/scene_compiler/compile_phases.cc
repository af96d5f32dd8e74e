#include "toolchain/scene_compiler/compile_phases.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "toolchain/command_line/failure.h"
#include "toolchain/scene_compiler/image/build_traits.h"
#include "toolchain/scene_compiler/mesh/box.h"
#include "toolchain/scene_compiler/mesh/outer_surface.h"
#include "toolchain/scene_compiler/mesh/voxel_too_large.h"
#include "toolchain/scene_compiler/points/second_direction.h"

namespace godobject::scene_compiler {
namespace {

constexpr std::uint64_t kCheckedPoints = 20000;  // chosen: errors of one point in a thousand appear some 20 times

SolidSurface read_body(const SceneConfig::Mesh& mesh, double thickness, MeshFindings& findings) {
  SolidSurface body(import_mesh(mesh.file, mesh.scale, findings.report), mesh.surface, thickness);
  findings.components = body.components();
  return body;
}

bool has_inside(const DistanceGrid& field) {
  return std::any_of(field.bricks.begin(), field.bricks.end(), [](const Brick& brick) {
    return *std::min_element(std::begin(brick.value), std::end(brick.value)) < 0.0f;
  });
}

/// Refuses a body without any node inside: it would be no obstacle.
void require_some_inside(const DistanceGrid& field, double size, const std::string& mesh_name) {
  if (has_inside(field)) return;
  throw command::Failure(
      command::ExitCode::kBadData,
      fmt::format("{}: no node of the grid is inside the mesh of {:.3g} m, which encloses nothing or is too small for "
                  "voxels of {:.3g} m; set surface = \"shell\", or a smaller voxel_size, or check scale",
                  mesh_name, size, field.grid.voxel_size));
}

/// Runs `work` on the moving mesh. Puts the name of the mesh before its errors.
template <class Work>
auto naming_moving_mesh(const SceneConfig& config, Work&& work) {
  try {
    return work();
  } catch (const command::Failure&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw command::Failure(command::ExitCode::kBadData,
                           fmt::format("{}: {}", config.moving.file.string(), error.what()));
  }
}

bool reads_contact(const CompileTarget& target) {
  return target.only_solver.value_or(format::Solver::kContact) == format::Solver::kContact;
}

/// True if the scene asks for the second direction and the solver of the image reads it.
bool wants_features(const CompileTarget& target) { return target.config.both_directions && reads_contact(target); }

/// True if the scene does not switch edge against edge off and the solver of the image reads it.
bool wants_edges(const CompileTarget& target) { return target.config.edges.value_or(true) && reads_contact(target); }

/// The sharp edges of both bodies, each in its mesh's frame.
struct EdgePhase {
  SharpEdgeTree still;
  SharpEdgeTree moving;
  std::uint32_t too_many = 0;  ///< as EdgeFindings::too_many
};

/// Returns the sharp edges of both bodies; none if one of them has none or too many, or if the target does not read
/// them.
EdgePhase find_edges(const CompileTarget& target, const SolidSurface& still, const OuterSurface& moving) {
  EdgePhase phase;
  if (!wants_edges(target)) return phase;
  phase.moving = make_sharp_edges(moving.body(), Eigen::Isometry3d::Identity());
  if (phase.moving.edges.empty()) return {};
  phase.still = make_sharp_edges(BodyMesh(still), Eigen::Isometry3d::Identity());
  if (phase.still.edges.empty()) return {};
  const std::size_t most = std::max(phase.still.edges.size(), phase.moving.edges.size());
  if (!target.config.edges && most > kMostEdgesByDefault) {
    return {.still = {}, .moving = {}, .too_many = static_cast<std::uint32_t>(most)};
  }
  return phase;
}

/// Returns the moving mesh in its body frame.
SolidSurface in_body_frame(const SolidSurface& moving, const format::Body& body, const SceneConfig& config) {
  const Eigen::Isometry3d X_BM = body_pose(body).inverse();
  TriangleMesh mesh = moving.mesh();
  for (Eigen::Vector3d& vertex : mesh.vertices) vertex = X_BM * vertex;
  return SolidSurface(std::move(mesh), config.moving.surface, config.thickness);
}

/// Returns the slack by which the moving body is smaller in its field [m]: as much as refinement may hold bodies off at
/// its edges. Otherwise an edge of the still body in the plane of a touching face would catch on that difference.
double slack_of(const SceneConfig& config) {
  return std::min(config.moving_tolerance().outside, 0.5 * config.body_voxel_size);
}

/// Throws VoxelTooLarge, or Failure (kBadData), with the cure if the scene wants an accuracy that the field does not
/// reach.
void require_accuracy(const SceneConfig& config, const RefinementReport& refined, const format::Grid& grid,
                      VoxelTooLarge::Body of) {
  if (!config.accuracy) return;
  const char* const body = of == VoxelTooLarge::Body::kStill ? "still" : "moving";
  constexpr double kRoundings = 8.0;  // quanta: nodes beside finer bricks are rounded to several
  if (*config.accuracy < kRoundings * grid.quantum) {
    throw command::Failure(
        command::ExitCode::kBadData,
        fmt::format("accuracy = {:g} is too small for distances in steps of {:.2g} m; take a smaller "
                    "{}.voxel_size or contact.safety_distance, or a larger accuracy",
                    *config.accuracy, grid.quantum, body));
  }
  if (refined.worst.in_tolerances <= 1.0) return;
  const Eigen::Vector3d& at = refined.worst.at;
  const double voxel_size = 0.9 * grid.voxel_size / refined.worst.in_tolerances;
  throw VoxelTooLarge(
      fmt::format(
          "{}.mesh: the stored surface would be {:.3g} m {} the mesh at ({:.4g}, {:.4g}, {:.4g}) m, and accuracy "
          "= {:g} allows less; bricks cannot be finer there. Take {}.voxel_size = {:.2g}, or close the mesh if "
          "it is open there, or take a larger accuracy",
          body, std::abs(refined.worst.error), refined.worst.error > 0.0 ? "inside" : "outside", at.x(), at.y(), at.z(),
          *config.accuracy, body, voxel_size),
      of, voxel_size);
}

struct FeaturePhase {
  StillFeatures features;
  SecondDirection second;
};

/// Chooses features of the still body, and adds points of the moving one to `sampling` where its own are too few.
FeaturePhase find_features(const SceneConfig& config, const SolidSurface& still, const OuterSurface& moving,
                           MovingSampling& sampling, const parallel::Progress& progress) {
  FeaturePhase phase;
  SecondDirection& second = phase.second;
  second.slack = slack_of(config);
  const double wanted = std::max(config.between_points - second.slack, 0.5 * config.between_points);
  const OuterSurface outer(still);
  const BothDirections both = see_both_directions(outer, moving, wanted, sampling, progress);
  phase.features = make_still_features(both.features, both.area);
  second.sought = true;
  second.between = both.between;
  second.added_points = both.added_points;
  second.corners = phase.features.corners;
  second.on_edges = phase.features.on_edges;
  second.on_faces = phase.features.on_faces;
  if (both.features.empty()) second.slack = 0.0;  // nothing is looked up in the field
  return phase;
}

DistanceGrid make_body_field(const SceneConfig& config, const SolidSurface& body, double slack,
                             const parallel::Progress& progress) {
  const double band = default_band(config.body_voxel_size, config.settings.safety_distance);
  DistanceGrid field = make_distance_grid(body, config.body_voxel_size, band, parallel::part_of(progress, 0.0, 0.5));
  const RefinementReport refined =
      refine(field, body, config.moving_tolerance(), parallel::part_of(progress, 0.5, 1.0), slack);
  require_accuracy(config, refined, field.grid, VoxelTooLarge::Body::kMoving);
  return field;
}

/// Throws Failure (kBadData) if the sizes of the meshes can only come from a wrong scale.
void require_like_sizes(const SceneConfig& config, const MeshReport& still, const MeshReport& moving) {
  constexpr double kMostTimes = 100.0;        // the other body
  constexpr double kLeastPartOfVoxel = 0.05;  // a body that small is a point of the field
  const double of_still = (still.high - still.low).maxCoeff();
  const double of_moving = (moving.high - moving.low).maxCoeff();
  const auto refuse = [](const std::string& text) { throw command::Failure(command::ExitCode::kBadData, text); };
  if (of_moving > kMostTimes * of_still) {
    refuse(
        fmt::format("the moving mesh of {:.3g} m is {:.0f} times as large as the still mesh of {:.3g} m; check "
                    "moving.scale and still.scale",
                    of_moving, of_moving / of_still, of_still));
  }
  if (of_moving < kLeastPartOfVoxel * config.voxel_size) {
    refuse(
        fmt::format("the moving mesh of {:.3g} m is far smaller than a voxel of {:.3g} m; check moving.scale and "
                    "still.voxel_size",
                    of_moving, config.voxel_size));
  }
}

}  // namespace

Bodies read_bodies(const SceneConfig& config, PhaseClock& clock) {
  MeshFindings still_findings;
  MeshFindings moving_findings;
  SolidSurface still =
      clock.run("still mesh", [&](const auto&) { return read_body(config.still, config.thickness, still_findings); });
  SolidSurface moving = clock.run(
      "moving mesh", [&](const auto&) { return read_body(config.moving, config.thickness, moving_findings); });
  require_like_sizes(config, still_findings.report, moving_findings.report);
  return {std::move(still), std::move(moving), std::move(still_findings), std::move(moving_findings)};
}

Obstacle make_obstacle(const SceneConfig& config, const Bodies& bodies, PhaseClock& clock) {
  const std::string still_name = config.still.file.string();
  Obstacle obstacle;
  if (config.ball) {
    obstacle.ball = clock.run("ball", [&](const auto&) {
      return require_ball(bodies.moving, config.moving.file.string(), bodies.still, still_name, config.voxel_size);
    });
    obstacle.dilated.emplace(bodies.still.mesh(), config.still.surface, config.thickness, obstacle.ball->radius);
  } else {
    obstacle.thin = clock.run("walls and gaps", [&](const auto& progress) {
      return find_thin_places(bodies.still, config.voxel_size, progress);
    });
    require_walls_that_last(obstacle.thin, config.voxel_size, still_name);
  }
  return obstacle;
}

FieldPhase make_field(const SceneConfig& config, const SolidSurface& obstacle, PhaseClock& clock) {
  const double band = default_band(config.voxel_size, config.settings.safety_distance);
  FieldPhase phase;
  phase.field = clock.run("distances", [&](const auto& progress) {
    return make_distance_grid(obstacle, config.voxel_size, band, progress);
  });
  require_some_inside(phase.field, Box::around(obstacle.mesh().vertices).longest(), config.still.file.string());
  phase.refinement = clock.run(kRefinementPhase, [&](const auto& progress) {
    return refine(phase.field, obstacle, config.surface_tolerance(config.voxel_size), progress);
  });
  require_accuracy(config, phase.refinement, phase.field.grid, VoxelTooLarge::Body::kStill);
  return phase;
}

PointPhase make_points(const CompileTarget& target, const Bodies& bodies, const std::optional<Ball>& ball,
                       PhaseClock& clock) {
  const SceneConfig& config = target.config;
  PointPhase phase;
  PointParts& parts = phase.parts;
  if (ball) {
    parts.body = make_ball_body(*ball);
    phase.spread.level_sizes = {1};
    return phase;
  }
  const OuterSurface outer(bodies.moving);
  MovingSampling sampling = clock.run("points", [&](const auto& progress) {
    return naming_moving_mesh(config,
                              [&] { return sample_moving_body(outer, config.points, config.levels, progress); });
  });
  if (wants_features(target)) {
    FeaturePhase found = clock.run("between points", [&](const auto& progress) {
      return find_features(config, bodies.still, outer, sampling, progress);
    });
    parts.features = std::move(found.features);
    phase.second = found.second;
  }
  EdgePhase edges = clock.run("edges", [&](const auto&) { return find_edges(target, bodies.still, outer); });
  parts.body = clock.run("body", [&](const auto&) {
    phase.spread = measure_spread(outer, sampling);
    return make_moving_body(outer, sampling, ends_of(edges.moving));
  });
  phase.edges = {.sought = wants_edges(target),
                 .still = static_cast<std::uint32_t>(edges.still.edges.size()),
                 .moving = static_cast<std::uint32_t>(edges.moving.edges.size()),
                 .left_out = edges.still.left_out + edges.moving.left_out,
                 .too_many = edges.too_many};
  if (!edges.still.edges.empty()) {
    parts.body_edges = make_sharp_edges(outer.body(), body_pose(parts.body.body).inverse());
    parts.edges = std::move(edges.still);
  }
  if (parts.features.points.empty()) return phase;
  parts.body_field = clock.run("body distances", [&](const auto& progress) {
    return make_body_field(config, in_body_frame(bodies.moving, parts.body.body, config), phase.second.slack, progress);
  });
  return phase;
}

SceneParts join_parts(const CompileTarget& target, DistanceGrid field, PointParts points) {
  SceneParts parts{.settings = target.config.settings,
                   .workspace = target.config.workspace,
                   .field = std::move(field),
                   .body = std::move(points.body),
                   .features = std::move(points.features),
                   .body_field = std::move(points.body_field),
                   .edges = std::move(points.edges),
                   .body_edges = std::move(points.body_edges)};
  if (target.only_solver) {
    parts.settings.solvers = 1u << static_cast<std::uint32_t>(*target.only_solver);
    parts.settings.default_solver = static_cast<std::uint32_t>(*target.only_solver);
  }
  return parts;
}

Trimmed trim(SceneParts parts, const CompileTarget& target, const Bodies& bodies, const SecondDirection& second,
             bool timed, PhaseClock& clock) {
  const SceneConfig& config = target.config;
  std::optional<double> deepest;
  if (second.sought && std::isfinite(second.between.bound)) {
    // plus one voxel for the errors of the fields
    deepest = second.between.bound + second.slack + std::max(config.voxel_size, config.body_voxel_size);
  }
  return clock.run("unneeded data", [&](const auto&) {
    return leave_out_unneeded(std::move(parts), {bodies.still, bodies.moving, config.ball, deepest, timed});
  });
}

CheckFindings check_image(const std::vector<SectionBytes>& sections, const DistanceGrid& field,
                          const SolidSurface& obstacle, const std::string& name, PhaseClock& clock) {
  CheckFindings findings = clock.run("check", [&](const auto& progress) {
    const files::SceneImage image(make_image(sections), name);
    CheckFindings found;
    found.traits = traits_of(image.scene);
    found.look_up = time_look_ups(field, image.scene.voxelmap);
    found.field_error = check_field(obstacle, field, image.scene.voxelmap, kCheckedPoints, progress);
    return found;
  });
  require_exact_nodes(findings.field_error, field.grid);
  return findings;
}

}  // namespace godobject::scene_compiler
