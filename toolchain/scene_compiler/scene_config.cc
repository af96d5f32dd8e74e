#include "toolchain/scene_compiler/scene_config.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "godobject/scene.h"
#include "toolchain/command_line/solver_names.h"
#include "toolchain/files/stiffness.h"
#include "toolchain/files/toml_file.h"
#include "toolchain/files/toml_table.h"

namespace godobject::scene_compiler {
namespace {

using files::TomlTable;
using Range = TomlTable::Range;

constexpr Range kScale{1e-9, 1e9};
constexpr Range kVoxel{1e-8, 1e4};
constexpr Range kAccuracy{1e-9, 1e2};
constexpr Range kRatio{0.0, 10.0};
/// Of the accuracy: a voxel edge that is mostly too large, so that the first choice costs little time.
constexpr double kFirstVoxel = 40.0;
constexpr double kBetweenPoints = 20.0;  // of the accuracy: default of between_points where voxels follow the accuracy

SceneConfig::Mesh read_mesh(const TomlTable& table, const std::filesystem::path& folder) {
  SceneConfig::Mesh mesh;
  mesh.name = table.text("mesh", TomlTable::Example{"\"teapot.ply\""});
  mesh.file = folder / mesh.name;
  mesh.scale = table.number("scale", kScale, 1.0);
  const std::string surface = table.text("surface", "auto");
  if (surface == "solid") {
    mesh.surface = SurfaceKind::kSolid;
  } else if (surface == "shell") {
    mesh.surface = SurfaceKind::kShell;
  } else if (surface != "auto") {
    table.complain("surface", fmt::format("= \"{}\" is unknown; choose auto, solid or shell", surface));
  }
  return mesh;
}

std::uint32_t read_solver(const TomlTable& contact) {
  const std::string name = contact.text("solver", "contact");
  const std::optional<format::Solver> solver = command::solver_of(name);
  if (!solver) contact.complain("solver", fmt::format("= \"{}\" is unknown; choose contact, corrected or paper", name));
  return static_cast<std::uint32_t>(*solver);
}

/// Leaves out the solver `paper`, which reads normals at points of the moving surface.
void leave_out_paper(const TomlTable& contact, format::Settings& settings) {
  constexpr auto kPaper = static_cast<std::uint32_t>(format::Solver::kPaper);
  settings.solvers &= ~(1u << kPaper);
  if (settings.default_solver == kPaper) {
    contact.complain("solver",
                     "= \"paper\" needs points with normals, a ball has only its centre; choose contact or "
                     "corrected, or leave out moving.ball");
  }
}

void read_friction(const TomlTable& friction, format::Settings& settings) {
  friction.allow({"static", "kinetic", "viscous"});
  if (!friction.present()) return;
  settings.friction = 1;
  settings.friction_static = friction.number("static", kRatio, TomlTable::Example{"0.2"});
  settings.friction_kinetic =
      friction.number("kinetic", {0.0, settings.friction_static}, 0.9 * settings.friction_static);
  settings.friction_viscous = friction.number("viscous", {0.0, 1e6}, 0.0);
}

/// Reads the table [paper]. The defaults are the paper's: mu_r,s = 0.2, mu_r,k = 0.9 mu_r,s, mu_v = 0.01 mu_s.
void read_paper(const TomlTable& paper, format::Settings& settings) {
  paper.allow({"rotation_static", "rotation_kinetic", "viscous"});
  settings.paper_rotation_static = paper.number("rotation_static", kRatio, 0.2);
  settings.paper_rotation_kinetic =
      paper.number("rotation_kinetic", {0.0, settings.paper_rotation_static}, 0.9 * settings.paper_rotation_static);
  settings.paper_viscous = paper.number("viscous", kRatio, 0.002);
}

std::optional<format::Workspace> read_workspace(const TomlTable& table) {
  constexpr Range kPlace{-1e7, 1e7};
  table.allow({"low", "high"});
  if (!table.present()) return std::nullopt;
  const std::vector<double> low = table.numbers("low", 3, kPlace);
  const std::vector<double> high = table.numbers("high", 3, kPlace);
  format::Workspace workspace{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (low[axis] > high[axis]) {
      table.complain("high", fmt::format("lies below low along {}, {:g} < {:g}; swap these two numbers", "xyz"[axis],
                                         high[axis], low[axis]));
    }
    workspace.low[axis] = low[axis];
    workspace.high[axis] = high[axis];
  }
  return workspace;
}

}  // namespace

SceneConfig read_scene_config(const std::filesystem::path& file, const VoxelSizes& chosen) {
  const toml::table root = files::parse_toml_file(file);
  files::allow_tables(root, file, {"still", "moving", "contact", "friction", "paper", "coupling", "workspace"});
  const auto table = [&](const char* name) { return TomlTable(root, name, file); };
  const std::filesystem::path folder = file.parent_path();
  SceneConfig config;

  const TomlTable still = table("still");
  still.allow({"mesh", "scale", "voxel_size", "surface", "thickness", "field_tolerance", "accuracy"});
  config.still = read_mesh(still, folder);
  config.chooses_voxels = still.has("accuracy") && !still.has("voxel_size");
  if (config.chooses_voxels) {
    const double accuracy = still.number("accuracy", kAccuracy, TomlTable::Example{"1e-5"});
    config.voxel_size = chosen.still.value_or(kFirstVoxel * accuracy);
    if (still.has("thickness")) {  // no voxel edge is larger
      config.voxel_size = std::min(config.voxel_size, still.number("thickness", kVoxel, TomlTable::Example{"0.002"}));
    }
  } else {
    config.voxel_size = still.number("voxel_size", kVoxel, TomlTable::Example{"0.002"});
  }
  const double s = config.voxel_size;
  config.thickness = still.number("thickness", {s, 100.0 * s}, 2.0 * s);
  config.field_tolerance = still.number("field_tolerance", {1e-3, 1e3}, 0.05);
  if (still.has("accuracy")) {
    config.accuracy = still.number("accuracy", {1e-3 * s, s}, TomlTable::Example{"1e-5"});
    if (still.has("field_tolerance")) {
      still.complain("field_tolerance", "and accuracy say the same in different units; leave one of them out");
    }
  }

  const TomlTable moving = table("moving");
  moving.allow({"mesh", "scale", "points", "levels", "surface", "voxel_size", "ball"});
  config.moving = read_mesh(moving, folder);
  config.chooses_body_voxels = config.chooses_voxels && !moving.has("voxel_size");
  config.body_voxel_size =
      moving.number("voxel_size", kVoxel, config.chooses_body_voxels ? chosen.moving.value_or(s) : s);
  config.points = static_cast<std::uint32_t>(moving.whole_number("points", {1.0, format::kMaxPoints}, 5000));
  config.ball = moving.flag("ball", false);
  config.levels = static_cast<std::uint32_t>(moving.whole_number("levels", {1.0, format::kMaxLevels}, 7));

  format::Settings& settings = config.settings;
  const TomlTable contact = table("contact");
  contact.allow({"solver", "safety_distance", "margin", "edges", "both_directions", "between_points", "point_budget"});
  settings.default_solver = read_solver(contact);
  settings.solvers = (1u << format::kSolverCount) - 1;
  if (config.ball) leave_out_paper(contact, settings);
  settings.safety_distance = contact.number("safety_distance", {1e-6 * s, 64.0 * s}, 1.5 * s);
  settings.margin = contact.number("margin", {1e-6 * s, s}, std::min(0.01 * s, config.accuracy.value_or(s)));

  if (contact.has("edges")) config.edges = contact.flag("edges", true);
  config.both_directions = contact.flag("both_directions", true);
  const double between = config.chooses_voxels ? std::min(s, kBetweenPoints * *config.accuracy) : s;
  config.between_points = contact.number("between_points", {1e-3 * s, 64.0 * s}, between);

  settings.point_budget =
      static_cast<std::uint32_t>(contact.whole_number("point_budget", {0.0, format::kMaxPoints}, 0.0));

  read_friction(table("friction"), settings);
  read_paper(table("paper"), settings);

  const TomlTable coupling = table("coupling");
  coupling.allow({"stiffness", "damping", "rotational", "period"});
  settings.stiffness = coupling.number("stiffness", files::kStiffness, 2000.0);
  settings.damping = coupling.number("damping", {0.0, 1e6}, 20.0);
  settings.period = coupling.number("period", {format::kShortestPeriod, format::kLongestPeriod}, 1e-3);
  settings.coupling_translation = 1.0;  // the translational spring is k_D itself
  settings.coupling_rotation = coupling.number("rotational", {1e-15, 1e9}, 0.025);
  config.workspace = read_workspace(table("workspace"));
  return config;
}

}  // namespace godobject::scene_compiler
