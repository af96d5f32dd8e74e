#include "toolchain/viewer/scene_bodies.h"

#include <fstream>
#include <iterator>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "toolchain/scene_compiler/mesh_import.h"
#include "toolchain/command/failure.h"

namespace godobject::viewer {
namespace {

using command::ExitCode;
using command::Failure;

toml::table parse(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) throw Failure(ExitCode::kNoInput, fmt::format("{}: cannot be read; check the path", file.string()));
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  try {
    return toml::parse(text, file.string());
  } catch (const toml::parse_error& error) {
    throw Failure(ExitCode::kBadData, fmt::format("{}:{}: not TOML: {}", file.string(), error.source().begin.line, error.description()));
  }
}

scene_compiler::TriangleMesh import(const toml::table& scene, const std::filesystem::path& file, std::string_view body) {
  const auto mesh = scene[body]["mesh"].value<std::string>();
  if (!mesh) throw Failure(ExitCode::kBadConfig, fmt::format("{}: {}.mesh: must name a mesh file", file.string(), body));
  const auto scale = scene[body]["scale"].value<double>();
  if (!scale || !(*scale > 0.0)) throw Failure(ExitCode::kBadConfig, fmt::format("{}: {}.scale: must be a positive number [m]", file.string(), body));
  scene_compiler::MeshReport report;
  return scene_compiler::import_mesh(file.parent_path() / *mesh, *scale, report);
}

}  // namespace

SceneBodies read_scene_bodies(const std::filesystem::path& scene_file) {
  const toml::table scene = parse(scene_file);
  return {.still = import(scene, scene_file, "still"), .moving = import(scene, scene_file, "moving")};
}

}  // namespace godobject::viewer
