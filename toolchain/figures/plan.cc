#include "toolchain/figures/plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include "firmware/command/failure.h"
#include "firmware/command/input_file.h"

namespace godobject::figures {
namespace {

using command::ExitCode;
using command::Failure;

[[noreturn]] void refuse(const std::filesystem::path& file, const toml::node& where, std::string_view what) {
  throw Failure(ExitCode::kBadConfig, fmt::format("{}:{}: {}", file.string(), where.source().begin.line, what));
}

toml::table parse(const std::filesystem::path& file) {
  command::require_input(file);
  std::ifstream stream(file);
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  try {
    return toml::parse(text, file.string());
  } catch (const toml::parse_error& error) {
    throw Failure(ExitCode::kBadData,
                  fmt::format("{}:{}: not TOML: {}", file.string(), error.source().begin.line, error.description()));
  }
}

std::string text_of(const std::filesystem::path& file, const toml::table& table, std::string_view key) {
  const auto value = table[key].value<std::string>();
  if (!table.contains(key)) refuse(file, table, fmt::format("scene.{0}: is missing; write {0} = \"...\"", key));
  if (!value || value->empty()) refuse(file, table, fmt::format("scene.{}: must be a text in quotes", key));
  return *value;
}

std::vector<Marker> markers_of(const std::filesystem::path& file, const toml::table& table) {
  std::vector<Marker> markers;
  if (!table.contains("markers")) return markers;
  const toml::table* times = table["markers"].as_table();
  if (times == nullptr) refuse(file, table, "scene.markers: must be a table { NAME = seconds, ... }");
  for (const auto& [name, node] : *times) {
    const std::optional<double> t = node.value<double>();
    if (!t) refuse(file, node, fmt::format("scene.markers.{}: must be a time [s]", name.str()));
    markers.push_back({std::string(name.str()), *t});
  }
  return markers;
}

std::optional<Barrier> barrier_of(const std::filesystem::path& file, const toml::table& table) {
  if (!table.contains("barrier")) return std::nullopt;
  std::array<double, 6> numbers{};
  const toml::array* array = table["barrier"].as_array();
  bool good = array != nullptr && array->size() == numbers.size();
  for (std::size_t i = 0; good && i < numbers.size(); ++i) {
    const std::optional<double> number = (*array)[i].value<double>();
    good = number && std::isfinite(*number);
    if (good) numbers[i] = *number;
  }
  const Vector3 normal(numbers[3], numbers[4], numbers[5]);
  if (!good || !(normal.norm() > 1e-9))
    refuse(file, table, "scene.barrier: must be [x, y, z, nx, ny, nz], a point [m] and a normal");
  return Barrier{.point = Vector3(numbers[0], numbers[1], numbers[2]), .normal = normal.normalized()};
}

ScenePlan scene_plan(const std::filesystem::path& file, const toml::table& table) {
  constexpr std::array<std::string_view, 6> kKeys = {"name", "image", "title", "text", "markers", "barrier"};
  for (const auto& [key, node] : table) {
    if (std::find(kKeys.begin(), kKeys.end(), key.str()) == kKeys.end()) {
      refuse(file, node, fmt::format("scene.{}: unknown key; known are {}", key.str(), fmt::join(kKeys, ", ")));
    }
  }
  return {.name = text_of(file, table, "name"),
          .image = text_of(file, table, "image"),
          .title = text_of(file, table, "title"),
          .text = text_of(file, table, "text"),
          .markers = markers_of(file, table),
          .barrier = barrier_of(file, table)};
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
