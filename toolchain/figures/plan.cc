#include "toolchain/figures/plan.h"

#include <fstream>
#include <iterator>
#include <optional>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "toolchain/command/failure.h"

namespace godobject::figures {
namespace {

using command::ExitCode;
using command::Failure;

[[noreturn]] void refuse(const std::filesystem::path& file, const toml::node& where, std::string_view what) {
  throw Failure(ExitCode::kBadConfig, fmt::format("{}:{}: {}", file.string(), where.source().begin.line, what));
}

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

std::string text_of(const std::filesystem::path& file, const toml::table& table, std::string_view key) {
  const auto value = table[key].value<std::string>();
  if (!value || value->empty()) refuse(file, table, fmt::format("scene.{}: must be a text", key));
  return *value;
}

ScenePlan scene_plan(const std::filesystem::path& file, const toml::table& table) {
  for (const auto& [key, node] : table) {
    if (key != "name" && key != "image" && key != "title" && key != "text" && key != "markers") {
      refuse(file, node, fmt::format("scene.{}: unknown key; name, image, title, text and markers are known", key.str()));
    }
  }
  ScenePlan plan{.name = text_of(file, table, "name"), .image = text_of(file, table, "image"), .title = text_of(file, table, "title"),
                 .text = text_of(file, table, "text"), .markers = {}};
  if (!table.contains("markers")) return plan;
  const toml::table* markers = table["markers"].as_table();
  if (markers == nullptr) refuse(file, table, "scene.markers: must be a table { NAME = seconds, ... }");
  for (const auto& [name, node] : *markers) {
    const std::optional<double> t = node.value<double>();
    if (!t) refuse(file, node, fmt::format("scene.markers.{}: must be a time [s]", name.str()));
    plan.markers.push_back({std::string(name.str()), *t});
  }
  return plan;
}

}  // namespace

std::vector<ScenePlan> read_plan(const std::filesystem::path& file) {
  const toml::table root = parse(file);
  const toml::array* scenes = root["scene"].as_array();
  if (root.size() != 1 || scenes == nullptr || !scenes->is_homogeneous<toml::table>()) {
    refuse(file, root, "scene: must be tables, each begun by [[scene]], and nothing else");
  }
  std::vector<ScenePlan> plans;
  for (const toml::node& node : *scenes) plans.push_back(scene_plan(file, *node.as_table()));
  return plans;
}

}  // namespace godobject::figures
