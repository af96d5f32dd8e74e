#include "toolchain/figures/plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include "toolchain/command_line/failure.h"
#include "toolchain/files/text_file.h"
#include "toolchain/files/toml_file.h"

namespace godobject::figures {
namespace {

using command::ExitCode;
using command::Failure;

[[noreturn]] void refuse(const std::filesystem::path& file, const toml::node& where, std::string_view what) {
  throw Failure(ExitCode::kBadConfig, fmt::format("{}:{}: {}", file.string(), where.source().begin.line, what));
}

/// A table [[KIND]] of a plan.
struct Source {
  const std::filesystem::path& file;
  const toml::table& table;
  const char* kind;  // scene, run or study

  /// Throws Failure (kBadConfig) with the key and its place, that of `node`.
  [[noreturn]] void refuse(std::string_view key, std::string_view what, const toml::node& node) const {
    figures::refuse(file, node, fmt::format("{}.{}: {}", kind, key, what));
  }
  [[noreturn]] void refuse(std::string_view key, std::string_view what) const { refuse(key, what, table); }

  std::string text(std::string_view key) const {
    const auto value = table[key].value<std::string>();
    if (!table.contains(key)) refuse(key, fmt::format("is missing; write {} = \"...\"", key));
    if (!value || value->empty()) refuse(key, "must be a text in quotes");
    return *value;
  }

  /// Refuses keys that are not among `known`.
  void check_keys(std::span<const std::string_view> known) const {
    for (const auto& [key, node] : table) {
      if (std::find(known.begin(), known.end(), key.str()) == known.end())
        refuse(key.str(), fmt::format("unknown key; known are {}", fmt::join(known, ", ")), node);
    }
  }
};

std::vector<Marker> markers_of(const Source& source) {
  std::vector<Marker> markers;
  if (!source.table.contains("markers")) return markers;
  const toml::table* times = source.table["markers"].as_table();
  if (times == nullptr) source.refuse("markers", "must be a table { NAME = seconds, ... }");
  for (const auto& [name, node] : *times) {
    const std::optional<double> t = node.value<double>();
    if (!t) source.refuse(fmt::format("markers.{}", name.str()), "must be a time [s]", node);
    markers.push_back({std::string(name.str()), *t});
  }
  return markers;
}

std::optional<Barrier> barrier_of(const Source& source) {
  if (!source.table.contains("barrier")) return std::nullopt;
  std::array<double, 6> numbers{};
  const toml::array* array = source.table["barrier"].as_array();
  bool good = array != nullptr && array->size() == numbers.size();
  for (std::size_t i = 0; good && i < numbers.size(); ++i) {
    const std::optional<double> number = (*array)[i].value<double>();
    good = number && std::isfinite(*number);
    if (good) numbers[i] = *number;
  }
  const Vector3 normal(numbers[3], numbers[4], numbers[5]);
  if (!good || !(normal.norm() > 1e-9))
    source.refuse("barrier", "must be [x, y, z, nx, ny, nz], a point [m] and a normal");
  return Barrier{.point = Vector3(numbers[0], numbers[1], numbers[2]), .normal = normal.normalized()};
}

ScenePlan scene_plan(const Source& source, std::span<const std::string_view> keys) {
  source.check_keys(keys);
  return {.name = source.text("name"),
          .image = source.text("image"),
          .title = source.text("title"),
          .text = source.text("text"),
          .markers = markers_of(source),
          .barrier = barrier_of(source)};
}

StudyPlan study_plan(const Source& source) {
  static constexpr std::array<std::string_view, 3> kKeys = {"name", "title", "text"};
  source.check_keys(kKeys);
  return {.name = source.text("name"), .title = source.text("title"), .text = source.text("text")};
}

/// Returns the tables [[KIND]] of a plan.
std::vector<Source> tables(const std::filesystem::path& file, const toml::table& root, const char* kind) {
  const toml::array* array = root[kind].as_array();
  if (array == nullptr || !array->is_homogeneous<toml::table>())
    refuse(file, root, fmt::format("{0}: must be tables, each begun by [[{0}]]", kind));
  std::vector<Source> sources;
  for (const toml::node& node : *array) sources.push_back({file, *node.as_table(), kind});
  return sources;
}

}  // namespace

Plan read_plan(const std::filesystem::path& file) {
  static constexpr std::array<std::string_view, 7> kKeys = {"name",    "image",   "title", "text",
                                                            "markers", "barrier", "device"};
  const toml::table root = files::parse_toml(files::read_text(file), file.string());
  for (const auto& [key, node] : root) {
    if (key != "scene" && key != "run" && key != "study")
      refuse(file, node, fmt::format("{}: unknown; known are [[scene]], [[run]] and [[study]]", key.str()));
  }
  Plan plan;
  for (const Source& source : tables(file, root, "scene"))
    plan.scenes.push_back(scene_plan(source, std::span(kKeys).first(6)));
  if (root.contains("run")) {
    for (const Source& source : tables(file, root, "run"))
      plan.runs.push_back({scene_plan(source, kKeys), file.parent_path() / source.text("device")});
  }
  if (root.contains("study")) {
    for (const Source& source : tables(file, root, "study")) plan.studies.push_back(study_plan(source));
  }
  return plan;
}

}  // namespace godobject::figures
