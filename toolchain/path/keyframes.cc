#include "toolchain/path/keyframes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <numbers>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include "toolchain/command_line/failure.h"
#include "toolchain/files/input_file.h"

namespace godobject::path {
namespace {

using command::ExitCode;
using command::Failure;

constexpr double kDegree = std::numbers::pi / 180.0;

/// One table of the file: knows its place for messages.
class Table {
 public:
  Table(const toml::table& table, std::string_view name, std::string_view title)
      : table_(table), name_(name), title_(title) {}

  [[noreturn]] void refuse(std::string_view key, std::string_view what) const {
    const toml::node* node = table_.get(key);
    const auto line = (node != nullptr ? node->source() : table_.source()).begin.line;
    throw Failure(ExitCode::kBadConfig, fmt::format("{}:{}: {}{}: {}", name_, line, title_, key, what));
  }

  void allow_only(std::initializer_list<std::string_view> keys) const {
    for (const auto& [key, node] : table_) {
      if (std::find(keys.begin(), keys.end(), key.str()) == keys.end())
        refuse(key.str(), fmt::format("unknown key; known here: {}", fmt::join(keys, ", ")));
    }
  }

  bool has(std::string_view key) const { return table_.contains(key); }

  double number(std::string_view key) const {
    const std::optional<double> value = table_[key].value<double>();
    if (!value)
      refuse(key, has(key) ? std::string("must be a number") : fmt::format("is missing; write {} = NUMBER", key));
    if (!std::isfinite(*value)) refuse(key, "must be finite");
    return *value;
  }

  double number_or(std::string_view key, double fallback) const { return has(key) ? number(key) : fallback; }

  template <std::size_t kSize>
  std::array<double, kSize> numbers(std::string_view key) const {
    const toml::array* array = table_[key].as_array();
    if (array == nullptr || array->size() != kSize) {
      refuse(key, has(key) ? fmt::format("must be {} numbers in brackets", kSize)
                           : fmt::format("is missing; write {} = [{} numbers]", key, kSize));
    }
    std::array<double, kSize> values{};
    for (std::size_t i = 0; i < kSize; ++i) {
      const std::optional<double> value = (*array)[i].value<double>();
      if (!value || !std::isfinite(*value)) refuse(key, fmt::format("must be {} finite numbers", kSize));
      values[i] = *value;
    }
    return values;
  }

  Vector3 vector(std::string_view key) const { return Vector3(numbers<3>(key).data()); }
  Vector3 vector_or_zero(std::string_view key) const { return has(key) ? vector(key) : Vector3::Zero(); }

 private:
  const toml::table& table_;
  std::string_view name_;
  std::string_view title_;
};

/// From `quaternion` (w, x, y, z) or `axis_angle` (x, y, z, degrees); neither means as the mesh is.
Quaternion rotation(const Table& table) {
  if (table.has("quaternion") && table.has("axis_angle"))
    table.refuse("axis_angle", "give this or quaternion, not both");
  if (table.has("quaternion")) {
    const auto q = table.numbers<4>("quaternion");
    const Quaternion rotation(q[0], q[1], q[2], q[3]);
    if (std::abs(rotation.norm() - 1.0) > 1e-3) table.refuse("quaternion", "must be of unit length within 1e-3");
    return rotation.normalized();
  }
  if (table.has("axis_angle")) {
    const auto a = table.numbers<4>("axis_angle");
    const Vector3 axis(a[0], a[1], a[2]);
    if (axis.norm() < 1e-9) table.refuse("axis_angle", "the axis must not be zero");
    return exp_rotation(a[3] * kDegree * axis.normalized());
  }
  return Quaternion::Identity();
}

Keyframe keyframe(const Table& table) {
  table.allow_only({"t", "position", "quaternion", "axis_angle"});
  return {.t = table.number("t"), .position = table.vector("position"), .rotation = rotation(table)};
}

Oscillation oscillation(const Table& table) {
  table.allow_only({"from", "to", "frequency", "phase_deg", "fade", "translation", "rotation_deg"});
  Oscillation wave;
  wave.from = table.number("from");
  wave.to = table.number("to");
  wave.frequency = table.number("frequency");
  wave.phase = kDegree * table.number_or("phase_deg", 0.0);
  wave.fade = table.number_or("fade", 0.1);
  wave.translation = table.vector_or_zero("translation");
  wave.rotation = kDegree * table.vector_or_zero("rotation_deg");
  if (wave.to <= wave.from) table.refuse("to", "must be later than `from`");
  if (wave.frequency <= 0.0) table.refuse("frequency", "must be positive [Hz]");
  if (wave.fade <= 0.0 || 2.0 * wave.fade > wave.to - wave.from) {
    table.refuse("fade", "must be positive and at most half of the time from `from` to `to` [s]");
  }
  return wave;
}

/// Calls take(Table) for each [[key]] of the file.
template <class Take>
void each_table(const toml::table& file, std::string_view name, std::string_view key, const Take& take) {
  const Table whole(file, name, "");
  if (!whole.has(key)) return;
  const toml::array* array = file[key].as_array();
  if (array == nullptr || !array->is_homogeneous<toml::table>())
    whole.refuse(key, fmt::format("must be tables, each begun by [[{}]]", key));
  for (const toml::node& node : *array) take(Table(*node.as_table(), name, fmt::format("{}.", key)));
}

toml::table parse(std::string_view text, std::string_view name) {
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    throw Failure(ExitCode::kBadConfig,
                  fmt::format("{}:{}: not TOML: {}", name, error.source().begin.line, error.description()));
  }
}

}  // namespace

Keyframes parse_keyframes(std::string_view text, std::string_view name) {
  const toml::table file = parse(text, name);
  const Table whole(file, name, "");
  whole.allow_only({"pivot", "keyframe", "oscillation"});
  Keyframes motion;
  motion.pivot = whole.vector_or_zero("pivot");
  each_table(file, name, "keyframe", [&](const Table& table) {
    const Keyframe next = keyframe(table);
    if (!motion.keyframes.empty() && next.t <= motion.keyframes.back().t)
      table.refuse("t", "must be later than that of the keyframe before");
    motion.keyframes.push_back(next);
  });
  if (motion.keyframes.size() < 2) whole.refuse("keyframe", "two or more tables [[keyframe]] are needed");
  each_table(file, name, "oscillation", [&](const Table& table) { motion.oscillations.push_back(oscillation(table)); });
  return motion;
}

Keyframes read_keyframes(const std::filesystem::path& file) {
  command::require_input(file);
  std::ifstream stream(file);
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  return parse_keyframes(text, file.string());
}

}  // namespace godobject::path
