#include "toolchain/scene_compiler/report_text.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "toolchain/scene_compiler/compile_phases.h"
#include "toolchain/scene_compiler/report_json.h"

namespace godobject::scene_compiler {
namespace {

std::string millimetres(double metres) { return fmt::format("{:.4g} mm", 1e3 * metres); }

std::string mesh_text(const char* role, const SceneConfig::Mesh& mesh, const MeshFindings& facts) {
  const MeshReport& r = facts.report;
  const auto shells =
      std::count_if(facts.components.begin(), facts.components.end(), [](const auto& c) { return c.shell; });
  const auto flipped =
      std::count_if(facts.components.begin(), facts.components.end(), [](const auto& c) { return c.inside_out; });
  const Eigen::Vector3d size = 1e3 * (r.high - r.low);
  std::string text =
      fmt::format("{:<8} {}: {} triangles, {:.4g} x {:.4g} x {:.4g} mm, {} component(s): {} solid, {} shell\n", role,
                  mesh.name, r.triangles, size.x(), size.y(), size.z(), facts.components.size(),
                  static_cast<std::ptrdiff_t>(facts.components.size()) - shells, shells);
  const auto note = [&text](std::uint64_t count, const char* what) {
    if (count > 0) text += fmt::format("         {} {}\n", count, what);
  };
  note(r.boundary_edges, "boundary edges: the mesh is open, the winding number decides its side");
  note(r.cuts_at_slits, "triangles cut where others' vertices lie on their edges, which closes slits");
  note(r.nonmanifold_edges, "edges of more than two triangles");
  note(r.turned_triangles, "triangles turned round: most of their neighbours have the other sense");
  note(r.misoriented_edges, "edges between triangles of opposite sense: the surface has only one side");
  note(r.polygons, "polygons cut into triangles");
  note(r.lines_and_points, "lines and points dropped");
  note(r.welded_vertices, "coincident vertices welded");
  note(r.degenerate_triangles, "degenerate triangles dropped");
  note(r.duplicate_triangles, "duplicate triangles dropped");
  note(r.folded_triangles, "triangles in folds without volume");
  note(r.unreferenced_vertices, "loose vertices dropped");
  note(static_cast<std::uint64_t>(flipped), "component(s) inside out, reversed");
  return text;
}

/// Returns the line on places thinner than a voxel. `loss` says what happens there.
std::string lost_text(const ThinPlaces& p, const char* loss, double voxel_size) {
  if (p.lost_area <= 0.0) return {};
  const Eigen::Vector3d& at = p.lost_patch > 0.0 ? p.lost_at : p.at;
  return fmt::format(
      "         thinner than one voxel: {:.3g} cm^2, {}; at ({:.4g}, {:.4g}, {:.4g}) m; largest patch between "
      "near-parallel faces {:.1f} voxel faces\n",
      1e4 * p.lost_area, loss, at.x(), at.y(), at.z(), p.lost_patch / (voxel_size * voxel_size));
}

std::string thin_text(const char* what, const ThinPlaces& p) {
  if (p.samples == 0) return fmt::format("{:<8} none thinner than two voxels\n", what);
  return fmt::format(
      "{:<8} thinner than two voxels over {:.3g} cm^2, down to {} at ({:.4g}, {:.4g}, {:.4g}) m; voxel_size = {:.2g} "
      "resolves them\n",
      what, 1e4 * p.area, millimetres(p.smallest), p.at.x(), p.at.y(), p.at.z(), p.voxel_needed);
}

const char* reason(Stopped stopped) {
  switch (stopped) {
    case Stopped::kReached: break;
    case Stopped::kPoints:
      return "the largest number of points is reached; increase moving.points or contact.between_points";
    case Stopped::kPlaces: return "the bodies are too large for places that dense; increase contact.between_points";
    case Stopped::kRounds: return "some places are not covered; increase moving.points or contact.between_points";
  }
  return "the moving body's field takes too much of it; decrease moving.voxel_size or increase contact.between_points";
}

/// Returns the note on left-out points.
std::string without(std::uint32_t left_out) {
  return left_out == 0 ? "" : fmt::format(", {} of these left out", left_out);
}

std::string points_text(const CompileReport& report) {
  if (report.ball) {
    const Ball& ball = *report.ball;
    return fmt::format(
        "ball     of {} radius, the mesh at most {} inside it; its centre is the only point, distances are reduced by "
        "the radius\n"
        "         it turns with the device: no torque arises at the centre{}\n",
        millimetres(ball.radius), millimetres(ball.deviation),
        report.config.settings.friction != 0 ? ", and none from friction, whose lever is the radius" : "");
  }
  const format::Body& body = report.points.body;
  const std::uint32_t requested = report.config.points;
  const std::uint32_t added = report.second.added_points;
  return fmt::format(
      "points   {} of the moving body in {} levels: {} requested, {} added where it is sharp or bends{}; median "
      "spacing "
      "{}, the surface is at most {} from a point\n",
      body.point_count, body.level_count, requested, added, without(requested + added - body.point_count),
      millimetres(report.points.spread.spacing), millimetres(report.points.spread.coverage));
}

std::string second_direction_text(const CompileReport& report) {
  const SecondDirection& second = report.second;
  if (report.ball) return {};
  if (!second.sought) return "between  the points: not checked; the still body has no features\n";
  const BetweenPoints& between = second.between;
  std::string text;
  if (second.features.point_count > 0) {
    text += fmt::format(
        "features {} points of the still body for the moving body's own field: {} at corners, {} on edges, {} on bent "
        "faces{}\n         that field has {} bricks, finer ones included, with voxels of {}\n",
        second.features.point_count, second.corners, second.on_edges, second.on_faces,
        without(second.found() - second.features.point_count), second.grid.brick_count,
        millimetres(second.grid.voxel_size));
  } else if (second.found() > 0) {
    text += fmt::format("features {} points of the still body, all left out\n", second.found());
  } else {
    text += "features none needed\n";
  }
  const double bound = between.bound + second.slack;
  if (std::isfinite(bound)) {
    text += fmt::format(
        "between  the points meshes{} may overlap by up to {} ({} wanted): {} from the moving surface, "
        "{} from the still one, {} from the moving body's field\n",
        report.edges.still > 0 ? "" : ", their edges too,", millimetres(bound),
        millimetres(report.config.between_points), millimetres(between.moving_fall), millimetres(between.still_fall),
        millimetres(second.slack));
  } else {
    text += "between  the points no bound is known\n";
  }
  if (bound > report.config.between_points) text += fmt::format("         not reached: {}\n", reason(between.stopped));
  return text;
}

std::string edges_text(const CompileReport& report) {
  const EdgeFindings& edges = report.edges;
  if (report.ball) return {};
  if (edges.too_many > 0) {
    return fmt::format(
        "edges    left out: one body has {} sharp edges, more than {}, so edges may cross between the points; with "
        "contact.edges = true none cross, but a cycle may take some milliseconds, and the god object may lag\n",
        edges.too_many, kMostEdgesByDefault);
  }
  if (!edges.sought && !report.config.edges.value_or(true))
    return "edges    left out: they may cross between the points; contact.edges = true prevents that\n";
  if (!edges.sought) return "edges    left out: only the solver contact reads them\n";
  if (edges.still == 0) return "edges    none against each other: a body has no sharp edge\n";
  std::string text = fmt::format("edges    {} sharp edges of the still body against {} of the moving one\n",
                                 edges.still, edges.moving);
  if (edges.left_out > 0) {
    text += fmt::format("         the {} least sharp ones of a body with more than {} are left out\n", edges.left_out,
                        format::kMaxSharpEdges);
  }
  return text;
}

std::string field_text(const CompileReport& report) {
  const format::Grid& g = report.field.grid;
  const std::uint64_t finer = report.field.refinement.finer;
  std::string text = fmt::format(
      "field    {} x {} x {} voxels of {}{}, distances stored up to {} from the surface (the band): {} of {} positions "
      "stored as bricks of {} x {} x {} voxels; {} finer bricks in addition\n"
      "         rounded to multiples of {}, half of that in bricks halved once, a quarter in those halved twice, ...\n",
      g.bricks[0] * format::kBrickCells, g.bricks[1] * format::kBrickCells, g.bricks[2] * format::kBrickCells,
      millimetres(g.voxel_size), report.config.chooses_voxels ? ", chosen for the accuracy" : "", millimetres(g.band),
      g.brick_count - finer, report.field.brick_positions, format::kBrickCells, format::kBrickCells,
      format::kBrickCells, finer, millimetres(g.quantum));
  if (report.field.seams.cells > 0) {
    text += fmt::format(
        "         seams in {} cells, where holes of the mesh leave the side undefined: the distance jumps by up to {}, "
        "at "
        "({:.4g}, {:.4g}, {:.4g}) m\n",
        report.field.seams.cells, millimetres(report.field.seams.largest_jump), report.field.seams.at.x(),
        report.field.seams.at.y(), report.field.seams.at.z());
  }
  return text;
}

std::string error_text(const CompileReport& report) {
  const FieldError& e = report.check.field_error;
  const ErrorNorms& near = e.near;
  return fmt::format(
      "error    of the stored distance against the mesh at {} random points of the band: rms {}, largest {}\n"
      "         floor of trilinear interpolation, these voxels without finer bricks: rms {}, largest {}\n"
      "         points on the wrong side by more than 0.1 voxel: {}, of the floor {}\n"
      "         at {} points nearer than half a voxel to the surface, off seams: rms {} (floor {}), largest {} (floor "
      "{})\n",
      e.points, millimetres(e.rms), millimetres(e.largest), millimetres(e.floor_rms), millimetres(e.floor_largest),
      e.sign_errors, e.floor_sign_errors, near.points, millimetres(near.rms), millimetres(near.floor_rms),
      millimetres(near.largest), millimetres(near.floor_largest));
}

/// Returns what is known of the stored surfaces: the wanted accuracy holds at all points of the meshes that were
/// checked.
std::string surfaces_text(const SceneConfig& config) {
  if (!config.accuracy) return "the field is within its tolerance near the surface";
  return fmt::format("the stored surfaces lie within {} of the meshes'", millimetres(*config.accuracy));
}

std::string refinement_text(const CompileReport& report) {
  double seconds = 0.0;
  for (const auto& [phase, time] : report.seconds) seconds += phase == kRefinementPhase ? time : 0.0;
  std::string text = fmt::format("finer    bricks by number of halvings, 0, 1, 2, ...: {}; {:.1f} KiB, {:.2f} s\n",
                                 fmt::join(report.field.refinement.bricks, ", "),
                                 static_cast<double>(report.field.refinement.bytes()) / 1024.0, seconds);
  if (report.field.refinement.exact > 0) {
    text += fmt::format("         {} bricks about edges, corners and narrow places are exact, with {} facets\n",
                        report.field.refinement.exact, report.field.refinement.facets);
  }
  if (report.config.accuracy) text += fmt::format("         {}\n", surfaces_text(report.config));
  const auto look_up_text = [](double time) {
    return time > 0.0 ? fmt::format("{:.0f} ns", time) : std::string("(none)");
  };
  text += fmt::format("         a look-up takes {} in whole bricks, {} in finer ones\n",
                      look_up_text(report.check.look_up.unrefined), look_up_text(report.check.look_up.refined));
  return text;
}

/// Returns the line on the code that a build for this scene alone leaves out.
std::string code_text(const CompileReport& report) {
  std::vector<std::string> parts;
  double total = 0.0;
  const Json left_out = left_out_code_json(report.check.traits);
  for (const Json& item : left_out) {
    const double saved = item["bytes_saved"].get<double>() / 1024.0;
    if (saved <= 0.0) continue;  // this build leaves it out itself
    total += saved;
    parts.push_back(fmt::format("{} {:.1f} KiB", item["what"].get<std::string>(), saved));
  }
  if (parts.empty()) return {};
  return fmt::format("code     left out by a build with this scene's --traits: {}; {:.1f} KiB in all\n",
                     fmt::join(parts, ", "), total);
}

/// Returns a table of the left-out data. Times appear only if they were measured.
std::string left_out_text(const CompileReport& report) {
  const Json left_out = full_report_json(report)["left_out"];
  std::string text = fmt::format("left out {:<64}{:>10}{:>12}{:>18}\n", "", "count", "bytes", "ns a cycle");
  for (const Json& item : left_out) {
    const auto cell = [&item](const char* key, const char* form) {
      const bool known = item.contains(key) && !item[key].is_null();
      return known ? fmt::format(fmt::runtime(form), item[key].get<double>()) : std::string("-");
    };
    const std::string time = cell("nanoseconds_saved", "{:.1f}");
    const std::string scatter = time == "-" ? "" : " +- " + cell("nanoseconds_uncertainty", "{:.1f}");
    // may be negative: a small sparse grid can take more than a dense one
    text += fmt::format("         {:<64}{:>10}{:>12}{:>18}\n", item["what"].get<std::string>(), cell("count", "{:.0f}"),
                        cell("bytes_saved", "{:.0f}"), time + scatter);
  }
  if (report.cycle_ns) {
    text += fmt::format(
        "         processor times along a short motion in contact on this machine; a cycle with all data takes {:.0f} "
        "ns\n",
        *report.cycle_ns);
  }
  return text;
}

/// Returns the limit on walls or gaps; empty if there is none.
std::string thin_limit(const ThinPlaces& places, const char* what, const char* loss) {
  if (places.lost_area > 0.0) return fmt::format("{} thinner than a voxel, {}", what, loss);
  return places.samples > 0 ? fmt::format("{} thinner than two voxels", what) : std::string();
}

/// Returns the limits on what the parts of a body are taken for: those whose winding number is far from a sheet's, 0,
/// and from a solid's, 1/2.
std::vector<std::string> doubtful_parts(const char* body, const SceneConfig::Mesh& mesh, const MeshFindings& facts) {
  constexpr double kSheet = 0.1;
  constexpr double kSolid = 0.4;
  std::vector<std::string> found;
  if (mesh.surface != SurfaceKind::kAuto) return found;
  for (const SolidSurface::Component& part : facts.components) {
    const double winding = std::abs(part.winding);
    if (winding <= kSheet || winding >= kSolid) continue;
    found.push_back(fmt::format(
        "a part of the {} mesh with {} triangles is taken as a {}, which is doubtful (winding number {:.2f}; 0 for a "
        "sheet, 0.5 for a solid): set {}.surface, or repair the mesh",
        body, part.triangles, part.shell ? "shell" : "solid", part.winding, body));
  }
  return found;
}

/// Returns the properties of the image that miss the scene's settings.
std::vector<std::string> limits(const CompileReport& report) {
  const SceneConfig& config = report.config;
  const ErrorNorms& near = report.check.field_error.near;
  const double s = report.field.grid.voxel_size;
  const SurfaceTolerance tolerance = config.surface_tolerance(s);
  const SurfaceError& worst = report.field.refinement.worst;
  std::vector<std::string> found = doubtful_parts("still", config.still, report.still);
  for (std::string& part : doubtful_parts("moving", config.moving, report.moving)) found.push_back(std::move(part));
  if (worst.in_tolerances > 1.0) {
    const bool sinks = worst.error > 0.0;
    found.push_back(fmt::format("the stored surface lies {} {} the mesh at ({:.4g}, {:.4g}, {:.4g}) m ({} wanted)",
                                millimetres(std::abs(worst.error)), sinks ? "inside" : "outside", worst.at.x(),
                                worst.at.y(), worst.at.z(), millimetres(sinks ? tolerance.inside : tolerance.outside)));
  }
  const double off = kHeldOff * tolerance.inside;
  if (near.largest > off) {
    found.push_back(fmt::format("the field is up to {:.2f} voxels off near the surface ({:.2f} wanted)",
                                near.largest / s, off / s));
  }
  found.push_back(thin_limit(report.thin.walls, "walls", "which bodies may pass"));
  found.push_back(thin_limit(report.thin.gaps, "gaps", "which may be closed"));
  for (const auto& [seams, body] : {std::pair(report.field.seams, "still"), std::pair(report.second.seams, "moving")}) {
    if (seams.cells == 0) continue;
    found.push_back(
        fmt::format("the {0} mesh is open, distances jump at its holes: close it, or set {0}.surface", body));
  }
  const SecondDirection& second = report.second;
  const double bound = second.between.bound + second.slack;
  if (report.ball) {
    if (config.settings.friction != 0) found.push_back("friction cannot turn a ball that is rendered by its centre");
  } else if (!second.sought) {
    found.push_back("the depth between the points is not bounded");
  } else if (bound > config.between_points) {
    found.push_back(std::isfinite(bound) ? fmt::format("between the points meshes may overlap by up to {} ({} wanted)",
                                                       millimetres(bound), millimetres(config.between_points))
                                         : std::string("no bound is known between the points"));
  }
  if (report.edges.too_many > 0) {
    found.push_back(fmt::format("sharp edges may cross, because one body has {}, more than {}", report.edges.too_many,
                                kMostEdgesByDefault));
  }
  if (report.edges.left_out > 0) {
    found.push_back(fmt::format("{} sharp edges are left out of edge against edge", report.edges.left_out));
  }
  std::erase(found, "");
  return found;
}

}  // namespace

std::string verdict_text(const CompileReport& report) {
  const std::vector<std::string> found = limits(report);
  if (!found.empty()) return fmt::format("ready, with limits: {}", fmt::join(found, "; "));
  if (report.ball) return "ready: the field is within its tolerance near the surface at the ball's radius";
  return fmt::format(
      "ready: {}, no wall or gap is too thin; between the points meshes{} may overlap by up to {} and the field's "
      "error{}",
      surfaces_text(report.config), report.edges.still > 0 ? "" : ", their edges too,",
      millimetres(report.second.between.bound + report.second.slack),
      report.edges.still > 0 ? ", but no sharp edges cross" : "");
}

std::string report_text(const CompileReport& report) {
  const double voxel_size = report.field.grid.voxel_size;
  std::string text = mesh_text("still", report.config.still, report.still);
  text += mesh_text("moving", report.config.moving, report.moving);
  text += report.ball ? "" : thin_text("walls", report.thin.walls);
  text += lost_text(report.thin.walls, "the field cannot hold them, bodies may pass there", voxel_size);
  if (report.thin.walls.lost_area > 0.0) text += fmt::format("         a wall is {}\n", kRefusalRule);
  text += report.ball ? "" : thin_text("gaps", report.thin.gaps);
  text += lost_text(report.thin.gaps, "the field cannot hold them, they may be closed", voxel_size);
  text += field_text(report);
  text += error_text(report);
  text += refinement_text(report);
  text += points_text(report);
  text += second_direction_text(report);
  text += edges_text(report);
  text += left_out_text(report);
  text += code_text(report);
  double total = 0.0;
  for (const auto& [phase, time] : report.seconds) total += time;
  text += fmt::format("image    {:.1f} KiB, {:.2f} s\n", static_cast<double>(report.image_bytes) / 1024.0, total);
  return text + verdict_text(report) + "\n";
}

}  // namespace godobject::scene_compiler
