#include "toolchain/scene_compiler/report_json.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "godobject/version.h"
#include "toolchain/scene_compiler/image/code_bytes.h"
#include "toolchain/scene_compiler/image/image_json.h"

namespace godobject::scene_compiler {
namespace {

Json mesh_json(const SceneConfig::Mesh& mesh, const MeshFindings& facts, double thickness) {
  const MeshReport& r = facts.report;
  Json components = Json::array();
  constexpr std::size_t kListed = 100;
  for (std::size_t i = 0; i < std::min(kListed, facts.components.size()); ++i) {
    const SolidSurface::Component& c = facts.components[i];
    components.push_back({{"kind", c.shell ? "shell" : "solid"},
                          {"triangles", c.triangles},
                          {"inside_out", c.inside_out},
                          {"surface_winding_number", c.winding}});
  }
  return {{"file", mesh.name},
          {"scale", mesh.scale},
          {"low", vector_json(r.low)},
          {"high", vector_json(r.high)},
          {"vertices", r.vertices},
          {"triangles", r.triangles},
          {"defects",
           {{"polygons_cut", r.polygons},
            {"lines_and_points_dropped", r.lines_and_points},
            {"vertices_welded", r.welded_vertices},
            {"degenerate_triangles_dropped", r.degenerate_triangles},
            {"duplicate_triangles_dropped", r.duplicate_triangles},
            {"folded_triangles", r.folded_triangles},
            {"unreferenced_vertices_dropped", r.unreferenced_vertices},
            {"cuts_at_slits", r.cuts_at_slits},
            {"boundary_edges", r.boundary_edges},
            {"nonmanifold_edges", r.nonmanifold_edges},
            {"triangles_turned", r.turned_triangles},
            {"misoriented_edges", r.misoriented_edges}}},
          {"watertight", r.boundary_edges == 0 && r.nonmanifold_edges == 0},
          {"orientation_consistent", r.misoriented_edges == 0},
          {"euler_number", r.euler},
          {"weld_tolerance", r.weld_tolerance},
          {"component_count", facts.components.size()},
          {"components", components},
          {"shell_thickness", thickness}};
}

/// Returns the JSON of walls or gaps. "at" is the middle of the thinnest place. "patch_at" is that of the thinnest one
/// in the largest patch between near-parallel faces.
Json thin_json(const ThinPlaces& places) {
  Json json = {{"found", places.samples > 0}};
  if (places.samples == 0) return json;
  json["smallest"] = places.smallest;
  json["at"] = vector_json(places.at);
  json["area"] = places.area;
  json["voxel_needed"] = places.voxel_needed;
  json["area_thinner_than_a_voxel"] = places.lost_area;
  json["largest_patch_thinner_than_a_voxel"] = places.lost_patch;
  if (places.lost_patch > 0.0) {
    json["patch_thickness"] = places.lost_thickness;
    json["patch_at"] = vector_json(places.lost_at);
  }
  return json;
}

Json error_json(const FieldError& e, double voxel_size) {
  return {{"points", e.points},
          {"rms", e.rms},
          {"floor_rms", e.floor_rms},
          {"rms_in_voxels", e.rms / voxel_size},
          {"largest", e.largest},
          {"floor_largest", e.floor_largest},
          {"sign_errors", e.sign_errors},
          {"floor_sign_errors", e.floor_sign_errors},
          {"largest_node_error", e.largest_node_error},
          {"largest_node_error_beyond_float_rounding", e.largest_node_excess}};
}

Json refinement_json(const CompileReport& report) {
  const ErrorNorms& near = report.check.field_error.near;
  const double s = report.field.grid.voxel_size;
  const SurfaceTolerance tolerance = report.config.surface_tolerance(s);
  const SurfaceError& worst = report.field.refinement.worst;
  return {{"tolerance_in_voxels", tolerance.inside / s},
          {"tolerance_outside_in_voxels", tolerance.outside / s},
          {"worst_beyond", {{"error", worst.error}, {"at", {worst.at.x(), worst.at.y(), worst.at.z()}}}},
          {"bricks_by_halvings", report.field.refinement.bricks},
          {"exact_bricks", report.field.refinement.exact},
          {"facets", report.field.refinement.facets},
          {"bytes", report.field.refinement.bytes()},
          {"nearer_than_half_a_voxel",
           {{"points", near.points},
            {"rms", near.rms},
            {"largest", near.largest},
            {"unrefined_rms", near.floor_rms},
            {"unrefined_largest", near.floor_largest}}}};
}

std::uint64_t section_bytes(const CompileReport& report, format::SectionId id) {
  for (const auto& [section, bytes] : report.sections) {
    if (section == id) return bytes;
  }
  return 0;
}

Json edges_json(const EdgeFindings& edges) {
  return {{"still", edges.still}, {"moving", edges.moving}, {"left_out", edges.left_out}};
}

Json second_direction_json(const CompileReport& report) {
  const SecondDirection& second = report.second;
  Json json = {{"sought", second.sought}};
  if (!second.sought) return json;
  std::uint64_t bytes = 0;
  for (const auto& [id, section] : report.sections) {
    if ((id >= format::SectionId::kBodyGrid && id <= format::SectionId::kFeatureNodes) ||
        id == format::SectionId::kBodyFacets || id == format::SectionId::kBodyExactBricks ||
        id == format::SectionId::kBodyFacetSets || id == format::SectionId::kBodyFacetNumbers) {
      bytes += section;
    }
  }
  json["bound"] = second.between.bound + second.slack;
  json["body_field_slack"] = second.slack;
  json["moving_fall"] = second.between.moving_fall;
  json["still_fall"] = second.between.still_fall;
  json["wanted"] = report.config.between_points;
  json["added_points"] = second.added_points;
  json["features"] = second.features.point_count;
  json["feature_corners"] = second.corners;
  json["features_on_edges"] = second.on_edges;
  json["features_on_faces"] = second.on_faces;
  json["bytes"] = bytes;
  if (second.features.point_count > 0) json["body_grid"] = grid_json(second.grid);
  return json;
}

Json ball_json(const std::optional<Ball>& ball) {
  if (!ball) return nullptr;
  return {{"center", vector_json(ball->center)}, {"radius", ball->radius}, {"deviation", ball->deviation}};
}

Json left_out_json(const CompileReport& report) {
  const format::Grid& g = report.field.grid;
  std::uint64_t nodes = 1;
  for (const std::int32_t bricks : g.bricks) nodes *= static_cast<std::uint64_t>(bricks) * format::kBrickCells + 1;
  const std::uint64_t dense = nodes * sizeof(float);
  const std::uint64_t sparse =
      section_bytes(report, format::SectionId::kBrickIndex) + section_bytes(report, format::SectionId::kBricks);
  Json list = Json::array();
  for (const LeftOut& item : report.left_out)
    list.push_back({{"what", item.what}, {"count", item.count}, {"bytes_saved", item.bytes}});
  list.push_back({{"what", "distances beyond the band"},
                  {"dense_bytes", dense},
                  {"stored_bytes", sparse},
                  {"bytes_saved", static_cast<std::int64_t>(dense) - static_cast<std::int64_t>(sparse)}});
  if (!report.ball && section_bytes(report, format::SectionId::kNormals) == 0) {
    list.push_back({{"what", "normals, which only the paper's solver reads"},
                    {"count", report.points.body.point_count},
                    {"bytes_saved", section_bytes(report, format::SectionId::kPoints)}});
  }
  if (report.config.settings.friction == 0) {
    list.push_back({{"what", "friction: the scene has no friction table"}, {"bytes_saved", 0}});
  }
  if (report.ball) {
    const std::uint64_t point = section_bytes(report, format::SectionId::kPoints);
    list.push_back({{"what", "points of the ball, which its centre stands for"},
                    {"count", report.config.points - 1},
                    {"bytes_saved", (report.config.points - 1) * point}});
    list.push_back({{"what", "facets: the surface at the ball's radius is round"}, {"bytes_saved", nullptr}});
  }
  if (report.second.features.point_count == 0) {
    const char* const why = report.ball                     ? "a ball meets a convex body where its centre is near"
                            : report.second.found() > 0     ? "all feature points are left out"
                            : report.second.sought          ? "no feature point is needed"
                            : report.config.both_directions ? "only contact reads it"
                                                            : "contact.both_directions = false";
    // Never made, so its size is unknown.
    list.push_back({{"what", std::string("the second direction: ") + why}, {"bytes_saved", nullptr}});
  }
  return list;
}

}  // namespace

Json report_json(const CompileReport& report) {
  const SceneConfig& config = report.config;
  Json settings = settings_json(config.settings);
  if (report.only_solver)
    settings["solvers_held"] = Json::array({format::kSolverNames[static_cast<std::size_t>(*report.only_solver)]});
  if (report.only_solver) settings["solver"] = format::kSolverNames[static_cast<std::size_t>(*report.only_solver)];
  Json sections;
  for (const auto& [id, bytes] : report.sections) sections[section_name(id)] = bytes;
  Json body = body_json(report.points.body);
  body["level_sizes"] = report.points.spread.level_sizes;
  body["point_spacing"] = report.points.spread.spacing;
  body["largest_distance_of_the_surface_from_a_point"] = report.points.spread.coverage;
  Json json = {{"compiler", "godobject-scenec " GODOBJECT_VERSION},
               {"settings", settings},
               {"workspace", workspace_json(config.workspace)},
               {"still", mesh_json(config.still, report.still, config.thickness)},
               {"moving", mesh_json(config.moving, report.moving, config.thickness)},
               {"walls", thin_json(report.thin.walls)},
               {"walls_rule", kRefusalRule},
               {"gaps", thin_json(report.thin.gaps)},
               {"wall_sample_spacing", report.thin.sample_spacing},
               {"grid", grid_json(report.field.grid)},
               {"seams",
                {{"cells", report.field.seams.cells},
                 {"largest_jump", report.field.seams.largest_jump},
                 {"at", vector_json(report.field.seams.at)}}},
               {"distance_error", error_json(report.check.field_error, report.field.grid.voxel_size)},
               {"refinement", refinement_json(report)},
               {"ball", ball_json(report.ball)},
               {"body", body},
               {"between_points", second_direction_json(report)},
               {"edges", edges_json(report.edges)},
               {"section_bytes", sections},
               {"build_traits", traits_json(report.check.traits)},
               {"left_out", left_out_json(report)}};
  if (!report.choice.is_null()) json["budget"] = report.choice;
  return json;
}

Json left_out_code_json(const SceneTraits& traits) {
  const CodeBytes& code = kCodeBytes;
  Json list = Json::array();
  const auto leave_out = [&list](const char* what, std::uint64_t bytes) {
    list.push_back({{"what", what}, {"bytes_saved", bytes}});
  };
  if (!traits.paper) leave_out("the solver paper", code.paper + code.paper_with_friction);
  if (!traits.corrected) leave_out("the solver corrected", code.corrected + code.corrected_with_friction);
  if (!traits.paper && !traits.corrected) leave_out("code shared by paper and corrected", code.closed_forms);
  if (!traits.contact) {
    leave_out("the solver contact", code.contact + code.contact_with_points + code.contact_with_edges +
                                        code.contact_with_friction + code.contact_features);
  } else {
    if (!traits.features) leave_out("the second direction", code.contact_features);
    if (!traits.edges) leave_out("edge against edge", code.contact_with_edges);
    if (!traits.points) leave_out("points other than a ball's centre", code.contact_with_points);
  }
  if (!traits.friction) {
    leave_out("friction", (traits.paper ? code.paper_with_friction : 0) +
                              (traits.corrected ? code.corrected_with_friction : 0) +
                              (traits.contact ? code.contact_with_friction : 0));
  }
  return list;
}

Json full_report_json(const CompileReport& report) {
  Json json = report_json(report);
  json["image_bytes"] = report.image_bytes;
  for (std::size_t i = 0; i < report.left_out.size(); ++i) {  // they are the first entries of the list
    const std::optional<Saving>& cycle = report.left_out[i].cycle;
    if (!cycle) continue;
    json["left_out"][i]["nanoseconds_saved"] = cycle->ns;
    json["left_out"][i]["nanoseconds_uncertainty"] = cycle->uncertainty;
  }
  if (report.cycle_ns) json["cycle_nanoseconds_with_all"] = *report.cycle_ns;
  Json seconds;
  double total = 0.0;
  for (const auto& [phase, time] : report.seconds) {
    seconds[phase] = time;
    total += time;
  }
  seconds["total"] = total;
  json["seconds"] = seconds;
  json["left_out_code"] = left_out_code_json(report.check.traits);
  json["look_up_nanoseconds"] = {{"unrefined", report.check.look_up.unrefined},
                                 {"refined", report.check.look_up.refined}};
  return json;
}

}  // namespace godobject::scene_compiler
