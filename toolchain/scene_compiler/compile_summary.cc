#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "toolchain/scene_compiler/compile_report.h"

namespace godobject::scene_compiler {
namespace {

std::string millimetres(double metres) { return fmt::format("{:.4g} mm", 1e3 * metres); }

std::string mesh_text(const char* role, const SceneConfig::Mesh& mesh, const MeshFacts& facts) {
  const MeshReport& r = facts.report;
  const auto shells =
      std::count_if(facts.components.begin(), facts.components.end(), [](const auto& c) { return c.shell; });
  const auto flipped =
      std::count_if(facts.components.begin(), facts.components.end(), [](const auto& c) { return c.inside_out; });
  const Eigen::Vector3d size = 1e3 * (r.high - r.low);
  std::string text =
      fmt::format("{:<7} {}: {} triangles, {:.1f} x {:.1f} x {:.1f} mm, {} component(s): {} solid, {} shell\n", role,
                  mesh.name, r.triangles, size.x(), size.y(), size.z(), facts.components.size(),
                  static_cast<std::ptrdiff_t>(facts.components.size()) - shells, shells);
  const auto note = [&text](std::uint64_t count, const char* what) {
    if (count > 0) text += fmt::format("        {} {}\n", count, what);
  };
  note(r.boundary_edges, "boundary edges: open, the side is told by the winding number");
  note(r.nonmanifold_edges, "edges of more than two triangles");
  note(r.misoriented_edges, "edges between triangles of opposite sense");
  note(r.polygons, "polygons cut into triangles");
  note(r.lines_and_points, "lines and points dropped");
  note(r.welded_vertices, "coincident vertices welded");
  note(r.degenerate_triangles, "degenerate triangles dropped");
  note(r.duplicate_triangles, "duplicate triangles dropped");
  note(r.folded_triangles, "triangles in folds without volume");
  note(r.unreferenced_vertices, "loose vertices dropped");
  note(static_cast<std::uint64_t>(flipped), "component(s) inside out, turned");
  return text;
}

/// What the field loses of it (walls) or closes (gaps).
std::string lost_text(const ThinPlaces& p, const char* loss, double voxel_size) {
  if (p.lost_area <= 0.0) return {};
  const Eigen::Vector3d& at = p.lost_patch > 0.0 ? p.lost_at : p.at;
  return fmt::format(
      "        of that thinner than one voxel, {}: {:.3g} cm^2, at ({:.4g}, {:.4g}, {:.4g}) m; largest patch between "
      "near-parallel faces {:.1f} voxel faces\n",
      loss, 1e4 * p.lost_area, at.x(), at.y(), at.z(), p.lost_patch / (voxel_size * voxel_size));
}

std::string thin_text(const char* what, const ThinPlaces& p) {
  if (p.samples == 0) return fmt::format("{:<7} none thinner than two voxels\n", what);
  return fmt::format(
      "{:<7} thinner than two voxels over {:.3g} cm^2, down to {} at ({:.4g}, {:.4g}, {:.4g}) m: would need voxel_size "
      "= {:.2g}\n",
      what, 1e4 * p.area, millimetres(p.smallest), p.at.x(), p.at.y(), p.at.z(), p.voxel_needed);
}

const char* reason(Stopped stopped) {
  switch (stopped) {
    case Stopped::kReached: break;
    case Stopped::kPoints:
      return "as many points as a body may have; set moving.points or contact.between_points higher";
    case Stopped::kPlaces: return "the bodies are too large to look at so closely; set contact.between_points higher";
    case Stopped::kRounds: return "places were left over; set moving.points or contact.between_points higher";
  }
  return "the field of the moving body takes too much; set moving.voxel_size lower, or contact.between_points higher";
}

std::string second_direction_text(const CompileReport& report) {
  const SecondDirection& second = report.second;
  if (!second.sought) return "between points of the moving body: not looked at, the still body gives no features\n";
  const BetweenPoints& between = second.between;
  std::string text =
      fmt::format("        {} of them added where the moving surface is sharp or bends\n", second.added_points);
  if (second.features.point_count > 0) {
    text += fmt::format(
        "features {} of the still body: {} corners, {} on edges, {} on bent faces; "
        "the moving body's field has {} bricks of {}\n",
        second.features.point_count, second.corners, second.on_edges, second.on_faces, second.grid.brick_count,
        millimetres(second.grid.voxel_size));
  } else {
    text += "features none needed\n";
  }
  const double bound = between.bound + second.slack;
  if (std::isfinite(bound)) {
    text += fmt::format("between points no deeper than {}: moving surface {}, still surface {}, field {}; wanted {}\n",
                        millimetres(bound), millimetres(between.moving_fall), millimetres(between.still_fall),
                        millimetres(second.slack), millimetres(report.config.between_points));
  } else {
    text += "between points no bound is known\n";
  }
  if (bound > report.config.between_points) text += fmt::format("        missed: {}\n", reason(between.stopped));
  return text;
}

std::string refinement_text(const CompileReport& report) {
  const ErrorNorms& near = report.field_error.near;
  std::string text = fmt::format(
      "edges   off seams, nearer than half a voxel: rms {} (unrefined {}), largest {} (unrefined {}), on {} points\n",
      millimetres(near.rms), millimetres(near.floor_rms), millimetres(near.largest), millimetres(near.floor_largest),
      near.points);
  double seconds = 0.0;
  for (const auto& [phase, time] : report.seconds) seconds += phase == kRefinementPhase ? time : 0.0;
  text += fmt::format("        bricks halved 0, 1, 2, ... times: {}; {:.1f} KiB and {:.2f} s for refinement\n",
                      fmt::join(report.refinement.bricks, ", "),
                      static_cast<double>(report.refinement.bytes()) / 1024.0, seconds);
  const auto look_up_text = [](double time) {
    return time > 0.0 ? fmt::format("{:.0f} ns", time) : std::string("(none)");
  };
  text += fmt::format("        a look-up takes {} in bricks that are not refined, {} in refined ones\n",
                      look_up_text(report.look_up.unrefined), look_up_text(report.look_up.refined));
  return text;
}

}  // namespace

std::string report_text(const CompileReport& report) {
  const format::Grid& g = report.grid;
  const FieldError& e = report.field_error;
  std::string text = mesh_text("still", report.config.still, report.still);
  text += mesh_text("moving", report.config.moving, report.moving);
  text += thin_text("walls", report.thin.walls);
  text += lost_text(report.thin.walls, "lost by the field", g.voxel_size);
  if (report.thin.walls.lost_area > 0.0) text += fmt::format("        a wall is {}\n", kRefusalRule);
  text += thin_text("gaps", report.thin.gaps);
  text += lost_text(report.thin.gaps, "closed by the field", g.voxel_size);
  text += fmt::format("field   {} x {} x {} voxels of {}, band {}, {} of {} bricks stored\n",
                      g.bricks[0] * format::kBrickCells, g.bricks[1] * format::kBrickCells,
                      g.bricks[2] * format::kBrickCells, millimetres(g.voxel_size), millimetres(g.band), g.brick_count,
                      report.brick_positions);
  if (report.seams.cells > 0) {
    text += fmt::format(
        "        seams in {} cells where holes leave the side open, largest jump {} at ({:.4g}, {:.4g}, {:.4g}) m\n",
        report.seams.cells, millimetres(report.seams.largest_jump), report.seams.at.x(), report.seams.at.y(),
        report.seams.at.z());
  }
  text += fmt::format(
      "error   rms {} (floor of trilinear interpolation {}), largest {} (floor {}), on {} points\n"
      "        points on the wrong side by more than 0.1 voxel: {}, the floor has {}\n",
      millimetres(e.rms), millimetres(e.floor_rms), millimetres(e.largest), millimetres(e.floor_largest), e.points,
      e.sign_errors, e.floor_sign_errors);
  text += refinement_text(report);
  text += fmt::format("points  {} in {} levels, spacing {}, surface at most {} from a point\n",
                      report.body.body.point_count, report.body.body.level_count, millimetres(report.body.spacing),
                      millimetres(report.body.coverage));
  text += second_direction_text(report);
  const Json left_out = report_json(report)["left_out"];
  for (const Json& item : left_out) {
    const double saved = item["bytes_saved"].get<double>();
    if (saved <= 0.0) continue;  // a small grid may take more than it saves: the JSON says so
    text += fmt::format("left out {}: {:.1f} KiB saved\n", item["what"].get<std::string>(), saved / 1024.0);
  }
  double total = 0.0;
  for (const auto& [phase, time] : report.seconds) total += time;
  text += fmt::format("image   {:.1f} KiB, {:.2f} s\n", static_cast<double>(report.image_bytes) / 1024.0, total);
  return text;
}

}  // namespace godobject::scene_compiler
