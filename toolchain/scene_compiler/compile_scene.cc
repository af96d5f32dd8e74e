#include "toolchain/scene_compiler/compile_scene.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <iterator>
#include <span>
#include <stdexcept>
#include <type_traits>

#include <fmt/format.h>

#include "toolchain/command_line/failure.h"
#include "toolchain/files/atomic_file.h"
#include "toolchain/scene_compiler/compile_report.h"
#include "toolchain/scene_compiler/image/build_traits.h"
#include "toolchain/scene_compiler/image/scene_parts.h"
#include "toolchain/scene_compiler/mesh/outer_surface.h"
#include "toolchain/scene_compiler/points/second_direction.h"
#include "toolchain/scene_compiler/points/still_features.h"
#include "toolchain/scene_compiler/trimming/leaving_out.h"
#include "toolchain/scene_compiler/trimming/unneeded_data.h"

namespace godobject::scene_compiler {
namespace {

constexpr std::uint64_t kCheckedPoints = 20000;

/// Runs the phases, with progress and their times.
class Phases {
 public:
  Phases(const CompileRequest& request, CompileReport& report) : request_(request), report_(report) {}

  template <class Work>
  auto run(const char* name, Work&& work) {
    const auto begin = std::chrono::steady_clock::now();
    const Progress progress = [this, name](double done) {
      if (request_.progress) request_.progress(name, done);
    };
    progress(0.0);
    const auto end = [&] {
      const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
      report_.seconds.emplace_back(name, time.count());
    };
    if constexpr (std::is_void_v<decltype(work(progress))>) {
      work(progress);
      end();
    } else {
      auto result = work(progress);
      end();
      return result;
    }
  }

 private:
  const CompileRequest& request_;
  CompileReport& report_;
};

bool has_inside(const DistanceGrid& field) {
  return std::any_of(field.bricks.begin(), field.bricks.end(), [](const Brick& brick) {
    return *std::min_element(std::begin(brick.value), std::end(brick.value)) < 0.0f;
  });
}

/// A body that leaves no node inside would be no obstacle at all.
void require_some_inside(const DistanceGrid& field, const std::string& mesh_name) {
  if (has_inside(field)) return;
  throw command::Failure(
      command::ExitCode::kBadData,
      fmt::format("{}: no node of the grid lies inside of it: it encloses nothing, or is smaller than a voxel; "
                  "set surface = \"shell\", or a smaller voxel_size",
                  mesh_name));
}

/// `work` on the moving mesh; its errors get the mesh's name.
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

/// Whether the scene wants the second direction, and the image is for the solver that reads it.
bool wants_features(const CompileReport& report) {
  return report.config.both_directions && !report.ball &&
         report.only_solver.value_or(format::Solver::kContact) == format::Solver::kContact;
}

/// The moving mesh in its body frame.
SolidSurface in_body_frame(const SolidSurface& moving, const format::Body& body, const SceneConfig& config) {
  const Eigen::Isometry3d X_BM = body_pose(body).inverse();
  TriangleMesh mesh = moving.mesh();
  for (Eigen::Vector3d& vertex : mesh.vertices) vertex = X_BM * vertex;
  return SolidSurface(std::move(mesh), config.moving.surface, config.thickness);
}

/// The image is complete under a temporary name, read back and opened as the device does, before it gets its own.
void write_image(const command::AlignedBytes& image, const std::filesystem::path& file) {
  command::AtomicFile output(file);
  output.write(image.span());
  output.flush();
  const command::SceneImage read_back = command::SceneImage::read(output.temporary());
  if (std::memcmp(read_back.bytes.span().data(), image.span().data(), image.span().size()) != 0) {
    throw command::Failure(
        command::ExitCode::kIo,
        fmt::format("{}: what was read back is not what was written; check the disk", file.string()));
  }
  output.commit();
}

/// How much smaller the moving body is in its field, in voxels: what refinement may hold off at its edges (kHeldOff
/// tolerances). A still edge that lies in the plane of a face in contact would catch on that otherwise.
double slack_of(double field_tolerance) { return std::min(kHeldOff * field_tolerance, 0.5); }

/// A ball has no normals at its surface.
void require_held(const SceneConfig& config, std::optional<format::Solver> only_solver) {
  if (!only_solver || (config.settings.solvers >> static_cast<std::uint32_t>(*only_solver) & 1u) != 0) return;
  throw command::Failure(command::ExitCode::kBadConfig,
                         fmt::format("--only-solver {}: needs points with normals, a ball has its centre alone; take "
                                     "contact or corrected, or leave out moving.ball",
                                     format::kSolverNames[static_cast<std::size_t>(*only_solver)]));
}

/// Features of the still body, and more points of the moving one where its own are too few to do with them.
StillFeatures find_features(const SolidSurface& still, const OuterSurface& moving, MovingSampling& sampling,
                            CompileReport& report, const Progress& progress) {
  const SceneConfig& config = report.config;
  SecondDirection& second = report.second;
  second.slack = slack_of(config.field_tolerance) * config.body_voxel_size;
  const double wanted = std::max(config.between_points - second.slack, 0.5 * config.between_points);
  const OuterSurface outer(still);
  const BothDirections both = see_both_directions(outer, moving, wanted, sampling, progress);
  const StillFeatures features = make_still_features(both.features, both.area);
  second.sought = true;
  second.between = both.between;
  second.added_points = both.added_points;
  second.corners = features.corners;
  second.on_edges = features.on_edges;
  second.on_faces = features.on_faces;
  second.features = features.header;
  if (both.features.empty()) second.slack = 0.0;  // the field is not looked at
  return features;
}

/// The moving body by its points, and into `parts` what the second direction reads.
void sample_bodies(const SolidSurface& still, const SolidSurface& moving, Phases& phases, CompileReport& report,
                   SceneParts& parts) {
  const SceneConfig& config = report.config;
  const OuterSurface outer(moving);
  MovingSampling sampling = phases.run("points", [&](const Progress& p) {
    return naming_moving_mesh(config, [&] { return sample_moving_body(outer, config.points, config.levels, p); });
  });
  if (wants_features(report)) {
    parts.features = phases.run("between points",
                                [&](const Progress& p) { return find_features(still, outer, sampling, report, p); });
  }
  report.body = phases.run("body", [&](const Progress&) { return make_moving_body(outer, sampling); });
  if (parts.features.points.empty()) return;
  parts.body_field = phases.run("body distances", [&](const Progress& p) {
    const double body_band = default_band(config.body_voxel_size, config.settings.safety_distance);
    const SolidSurface body = in_body_frame(moving, report.body.body, config);
    DistanceGrid field = make_distance_grid(body, config.body_voxel_size, body_band, part_of(p, 0.0, 0.5));
    refine(field, body, config.field_tolerance * config.body_voxel_size, part_of(p, 0.5, 1.0), report.second.slack);
    return field;
  });
  report.second.grid = parts.body_field.grid;
}

}  // namespace

CompileReport compile_scene(const CompileRequest& request) {
  CompileReport report;
  Phases phases(request, report);
  report.only_solver = request.only_solver;
  report.choice = request.choice;
  report.config = request.config ? *request.config : read_scene_config(request.scene_file);
  const SceneConfig& config = report.config;
  require_held(config, request.only_solver);

  const auto open_mesh = [&](const SceneConfig::Mesh& mesh, MeshFacts& facts) {
    return SolidSurface(import_mesh(mesh.file, mesh.scale, facts.report), mesh.surface, config.thickness);
  };
  const SolidSurface still =
      phases.run("still mesh", [&](const Progress&) { return open_mesh(config.still, report.still); });
  report.still.components = still.components();
  const SolidSurface moving =
      phases.run("moving mesh", [&](const Progress&) { return open_mesh(config.moving, report.moving); });
  report.moving.components = moving.components();

  std::optional<SolidSurface> dilated;
  if (config.ball) {
    report.ball = phases.run("ball", [&](const Progress&) {
      return require_ball(moving, config.moving.file.string(), still, config.still.file.string(), config.voxel_size);
    });
    dilated.emplace(still.mesh(), config.still.surface, config.thickness, report.ball->radius);
  } else {
    report.thin =
        phases.run("walls and gaps", [&](const Progress& p) { return find_thin_places(still, config.voxel_size, p); });
    require_walls_that_last(report.thin, config.voxel_size, config.still.file.string());
  }
  const SolidSurface& met = dilated ? *dilated : still;

  const double band = default_band(config.voxel_size, config.settings.safety_distance);
  SceneParts parts;
  parts.field =
      phases.run("distances", [&](const Progress& p) { return make_distance_grid(met, config.voxel_size, band, p); });
  require_some_inside(parts.field, config.still.file.string());
  report.refinement = phases.run(kRefinementPhase, [&](const Progress& p) {
    return refine(parts.field, met, config.field_tolerance * config.voxel_size, p);
  });
  report.grid = parts.field.grid;
  report.seams = parts.field.seams;
  report.brick_positions = parts.field.index.size();
  if (report.ball) {
    report.body = make_ball_body(*report.ball);
  } else {
    sample_bodies(still, moving, phases, report, parts);
  }

  LeavingOut leaving_out([&] { return lay_out(report, parts); }, request.times_left_out);
  phases.run("unneeded data", [&](const Progress&) { leave_out_unneeded(still, moving, report, parts, leaving_out); });

  std::vector<SectionBytes> sections = lay_out(report, parts);
  for (const SectionBytes& section : sections) report.sections.emplace_back(section.id, section.bytes.size());
  report.field_error = phases.run("check", [&](const Progress& p) {
    const command::SceneImage image(make_image(sections), request.output.string());
    report.traits = traits_of(image.scene);
    report.look_up = time_look_ups(parts.field, image.scene.voxelmap);
    return check_field(met, parts.field, image.scene.voxelmap, kCheckedPoints, p);
  });
  require_exact_nodes(report.field_error, report.grid);
  if (request.times_left_out) {
    report.cycle_ns = phases.run("times", [&](const Progress& p) { return leaving_out.time(p); });
  }
  report.left_out = leaving_out.items();

  const std::string provenance = report_json(report).dump(1);
  const auto text = std::as_bytes(std::span(provenance));
  sections.push_back({format::SectionId::kProvenance, {text.begin(), text.end()}});
  report.image_bytes = phases.run("write", [&](const Progress&) {
    const command::AlignedBytes image = make_image(sections);
    write_image(image, request.output);
    return image.span().size();
  });
  return report;
}

}  // namespace godobject::scene_compiler
