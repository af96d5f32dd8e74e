#include "toolchain/scene_compiler/image/image_json.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "toolchain/scene_compiler/image/build_traits.h"

namespace godobject::scene_compiler {
namespace {

Json array_json(const double (&v)[3]) { return {v[0], v[1], v[2]}; }

}  // namespace

const char* section_name(format::SectionId id) {
  static constexpr std::array kNames = {"settings",
                                        "grid",
                                        "brick_index",
                                        "bricks",
                                        "body",
                                        "points",
                                        "normals",
                                        "nodes",
                                        "provenance",
                                        "refined",
                                        "body_grid",
                                        "body_brick_index",
                                        "body_bricks",
                                        "body_refined",
                                        "features",
                                        "feature_points",
                                        "feature_nodes",
                                        "facets",
                                        "body_facets",
                                        "workspace",
                                        "sharp_edges",
                                        "sharp_edge_nodes",
                                        "body_sharp_edges",
                                        "body_sharp_edge_nodes",
                                        "exact_bricks",
                                        "body_exact_bricks",
                                        "facet_sets",
                                        "body_facet_sets",
                                        "facet_numbers",
                                        "body_facet_numbers"};
  const std::size_t number = static_cast<std::uint32_t>(id) - 1u;  // they are numbered from 1
  return number < kNames.size() ? kNames[number] : "unknown";
}

Json vector_json(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Json settings_json(const format::Settings& s) {
  Json solvers = Json::array();
  for (std::uint32_t i = 0; i < format::kSolverCount; ++i) {
    if ((s.solvers >> i & 1u) != 0) solvers.push_back(format::kSolverNames[i]);
  }
  Json json = {{"solver", format::kSolverNames[s.default_solver]},
               {"solvers_held", solvers},
               {"safety_distance", s.safety_distance},
               {"point_budget", s.point_budget},
               {"margin", s.margin},
               {"stiffness", s.stiffness},
               {"damping", s.damping},
               {"period", s.period},
               {"coupling_translation", s.coupling_translation},
               {"coupling_rotational", s.coupling_rotation},
               {"friction", nullptr},
               {"paper",
                {{"rotation_static", s.paper_rotation_static},
                 {"rotation_kinetic", s.paper_rotation_kinetic},
                 {"viscous", s.paper_viscous}}}};
  if (s.friction != 0) {
    json["friction"] = {
        {"static", s.friction_static}, {"kinetic", s.friction_kinetic}, {"viscous", s.friction_viscous}};
  }
  return json;
}

Json workspace_json(const std::optional<format::Workspace>& workspace) {
  if (!workspace) return nullptr;
  return {{"low", array_json(workspace->low)}, {"high", array_json(workspace->high)}};
}

Json traits_json(const SceneTraits& traits) {
  return {{"paper", traits.paper},       {"corrected", traits.corrected}, {"contact", traits.contact},
          {"friction", traits.friction}, {"features", traits.features},   {"edges", traits.edges},
          {"points", traits.points}};
}

Json grid_json(const format::Grid& g) {
  return {{"voxel_size", g.voxel_size},
          {"band", g.band},
          {"origin", array_json(g.origin)},
          {"bricks", {g.bricks[0], g.bricks[1], g.bricks[2]}},
          {"voxels",
           {g.bricks[0] * format::kBrickCells, g.bricks[1] * format::kBrickCells, g.bricks[2] * format::kBrickCells}},
          {"bricks_stored", g.brick_count},
          {"quantum", g.quantum},
          {"surface_low", array_json(g.surface_min)},
          {"surface_high", array_json(g.surface_max)},
          {"lipschitz", g.lipschitz},
          {"lipschitz_with_seams", g.lipschitz_seam},
          {"outside_loss", g.outside_loss}};
}

Json body_json(const format::Body& b) {
  return {{"points", b.point_count},
          {"levels", b.level_count},
          {"nodes", b.node_count},
          {"center_of_mass", array_json(b.translation_MB)},
          {"principal_axes_wxyz", {b.rotation_MB[0], b.rotation_MB[1], b.rotation_MB[2], b.rotation_MB[3]}},
          {"inertia_per_mass", array_json(b.inertia)},
          {"inertia_from_points", b.inertia_from_points != 0},
          {"radius", b.radius},
          {"sphere", {{"center", array_json(b.sphere_center)}, {"radius", b.sphere_radius}}},
          {"volume", b.volume}};
}

Json inspect_json(const files::SceneImage& image) {
  const SceneView& scene = image.scene;
  format::Header header{};
  std::copy_n(image.bytes.span().data(), sizeof(header), reinterpret_cast<std::byte*>(&header));
  Json sections;
  for (std::uint32_t i = 0; i < header.section_count; ++i) {
    format::Section section{};
    std::copy_n(image.bytes.span().data() + sizeof(header) + i * sizeof(section), sizeof(section),
                reinterpret_cast<std::byte*>(&section));
    sections[section_name(section.id)] = {{"offset", section.offset}, {"bytes", section.bytes}};
  }
  const std::string text(reinterpret_cast<const char*>(scene.provenance.data()), scene.provenance.size());
  const Json provenance = Json::parse(text, nullptr, false);
  Json workspace;
  if (scene.workspace.limited)
    workspace = {{"low", vector_json(scene.workspace.low)}, {"high", vector_json(scene.workspace.high)}};
  return {{"version", header.version},
          {"bytes", header.total_bytes},
          {"settings", settings_json(scene.settings)},
          {"workspace", workspace},
          {"grid", grid_json(scene.grid)},
          {"body", body_json(scene.body)},
          {"sections", sections},
          {"build_traits", traits_json(traits_of(scene))},
          {"provenance", provenance.is_discarded() ? Json(nullptr) : provenance}};
}

}  // namespace godobject::scene_compiler
