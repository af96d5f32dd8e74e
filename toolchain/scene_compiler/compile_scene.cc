#include "toolchain/scene_compiler/compile_scene.h"

#include <algorithm>
#include <cstring>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "toolchain/command_line/failure.h"
#include "toolchain/files/atomic_file.h"
#include "toolchain/files/scene_image.h"
#include "toolchain/scene_compiler/compile_phases.h"
#include "toolchain/scene_compiler/mesh/mesh_import.h"
#include "toolchain/scene_compiler/mesh/voxel_too_large.h"
#include "toolchain/scene_compiler/report_json.h"

namespace godobject::scene_compiler {
namespace {

/// Refuses --only-solver paper for a ball: its one point has no normal.
void require_held(const SceneConfig& config, std::optional<format::Solver> only_solver) {
  if (!only_solver || (config.settings.solvers >> static_cast<std::uint32_t>(*only_solver) & 1u) != 0) return;
  throw command::Failure(
      command::ExitCode::kBadConfig,
      fmt::format("--only-solver {}: the solver needs points with normals, a ball has only its centre; choose "
                  "contact or corrected, or leave out moving.ball",
                  format::kSolverNames[static_cast<std::size_t>(*only_solver)]));
}

CompileTarget target_of(const CompileRequest& request, const VoxelSizes& chosen) {
  CompileTarget target{request.config ? *request.config : read_scene_config(request.scene_file, chosen),
                       request.only_solver};
  require_held(target.config, target.only_solver);
  return target;
}

/// Returns the refinement that remains after trimming.
RefinementReport trimmed_refinement(RefinementReport refinement, const LeftOutBricks& left_out) {
  refinement.refined -= left_out.refined;
  refinement.finer -= left_out.all_bricks - left_out.positions;
  refinement.exact -= left_out.exact;
  refinement.facets -= left_out.facets;
  refinement.sets -= left_out.sets;
  refinement.numbers -= left_out.numbers;
  for (std::size_t i = 0; i < left_out.bricks.size(); ++i) refinement.bricks[i] -= left_out.bricks[i];
  return refinement;
}

/// Returns the second direction that remains after trimming.
SecondDirection trimmed_second(SecondDirection second, const SceneParts& parts) {
  second.features = parts.features.header;
  second.grid = parts.body_field.grid;
  second.seams = parts.body_field.seams;
  return second;
}

/// Returns the items with the time that each of them saves.
std::vector<LeftOut> timed_items(std::vector<LeftOut> items, const std::optional<CycleTimes>& times) {
  if (!times) return items;
  for (std::size_t i = 0; i < items.size(); ++i) items[i].cycle = times->savings[i];
  return items;
}

std::optional<CycleTimes> time_trimming(const CompileRequest& request, const TrimmingSteps& steps, PhaseClock& clock) {
  if (!request.times_left_out) return {};
  return clock.run("times", [&](const auto& progress) { return steps.time(progress); });
}

/// Writes the image under a temporary name, reads it back, opens it as the device does and renames it. Returns its size
/// in bytes.
std::uint64_t write_image(const std::vector<SectionBytes>& sections, const std::filesystem::path& file) {
  const files::AlignedBytes image = make_image(sections);
  files::AtomicFile output(file);
  output.write(image.span());
  output.flush();
  const files::SceneImage read_back = files::SceneImage::read(output.temporary());
  if (std::memcmp(read_back.bytes.span().data(), image.span().data(), image.span().size()) != 0) {
    throw command::Failure(
        command::ExitCode::kIo,
        fmt::format("{}: the bytes read back differ from the bytes written; check the disk", file.string()));
  }
  output.commit();
  return image.span().size();
}

CompileReport::SectionSizes sizes_of(const std::vector<SectionBytes>& sections) {
  CompileReport::SectionSizes sizes;
  for (const SectionBytes& section : sections) sizes.emplace_back(section.id, section.bytes.size());
  return sizes;
}

SectionBytes provenance(const CompileReport& report) {
  const std::string json = report_json(report).dump(1);
  const auto text = std::as_bytes(std::span(json));
  return {format::SectionId::kProvenance, {text.begin(), text.end()}};
}

/// Returns the shortest edge of a body's bounding box, except an edge without length, which a flat sheet has [m].
double shortest_edge(const SceneConfig::Mesh& mesh) {
  constexpr double kFlat = 1e-6;  // of the longest
  MeshReport report;
  import_mesh(mesh.file, mesh.scale, report);
  const Eigen::Vector3d edges = report.high - report.low;
  double shortest = edges.maxCoeff();
  for (const double edge : edges) {
    if (edge > kFlat * edges.maxCoeff()) shortest = std::min(shortest, edge);
  }
  return shortest;
}

/// Returns the voxel edges to begin with: large ones, but small beside the bodies.
VoxelSizes first_choice(const SceneConfig& config) {
  constexpr double kVoxelsAcross = 4.0;
  const double shortest = std::min(shortest_edge(config.still), shortest_edge(config.moving));
  return {std::max(*config.accuracy, std::min(config.voxel_size, shortest / kVoxelsAcross)), {}};
}

/// Refuses settings in place of the file: their lengths have followed a first guess of the voxel edge.
void require_file(const CompileRequest& request) {
  if (!request.config) return;
  throw command::Failure(command::ExitCode::kBadConfig,
                         "a scene whose settings are changed needs still.voxel_size; compile it alone, and state the "
                         "edge that is chosen");
}

CompileReport compile(const CompileRequest& request, const CompileTarget& target) {
  PhaseClock clock(request.progress);
  const Bodies bodies = read_bodies(target.config, clock);
  const Obstacle obstacle = make_obstacle(target.config, bodies, clock);
  const SolidSurface& surface = obstacle.surface(bodies);
  FieldPhase field = make_field(target.config, surface, clock);
  PointPhase points = make_points(target, bodies, obstacle.ball, clock);
  SceneParts parts = join_parts(target, std::move(field.field), std::move(points.parts));
  const Trimmed trimmed = trim(std::move(parts), target, bodies, points.second, request.times_left_out, clock);
  std::vector<SectionBytes> sections = lay_out(trimmed.parts);
  const CheckFindings check = check_image(sections, trimmed.parts.field, surface, request.output.string(), clock);
  const std::optional<CycleTimes> times = time_trimming(request, trimmed.steps, clock);

  CompileReport report{.config = target.config,
                       .only_solver = target.only_solver,
                       .choice = request.choice,
                       .still = bodies.still_findings,
                       .moving = bodies.moving_findings,
                       .ball = obstacle.ball,
                       .thin = obstacle.thin,
                       .field = {trimmed.parts.field.grid, trimmed_refinement(field.refinement, trimmed.bricks),
                                 trimmed.parts.field.seams, trimmed.parts.field.index.size()},
                       .points = {trimmed.parts.body.body, points.spread},
                       .second = trimmed_second(points.second, trimmed.parts),
                       .edges = points.edges,
                       .check = check,
                       .left_out = timed_items(trimmed.steps.items(), times),
                       .cycle_ns = times ? std::optional(times->ns) : std::nullopt,
                       .sections = sizes_of(sections),
                       .image_bytes = 0,
                       .seconds = {}};
  sections.push_back(provenance(report));
  report.image_bytes = clock.run("write", [&](const auto&) { return write_image(sections, request.output); });
  report.seconds = clock.seconds();
  return report;
}

}  // namespace

CompileReport compile_scene(const CompileRequest& request) {
  constexpr int kMostTries = 8;  // two or three mostly: what a try misses tells the edge of the next
  CompileTarget target = target_of(request, {});
  if (!target.config.chooses_voxels) return compile(request, target);
  require_file(request);
  VoxelSizes chosen = first_choice(target.config);
  for (int tries = 1;; ++tries) {
    target = target_of(request, chosen);
    try {
      return compile(request, target);
    } catch (const VoxelTooLarge& failure) {
      const bool of_still = failure.body() == VoxelTooLarge::Body::kStill;
      const bool may_choose = of_still || target.config.chooses_body_voxels;
      if (tries == kMostTries || !may_choose || failure.voxel_size() < *target.config.accuracy) throw;
      (of_still ? chosen.still : chosen.moving) = failure.voxel_size();
    }
  }
}

}  // namespace godobject::scene_compiler
