#include "toolchain/path/keyframes.h"

#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "core/scene/format.h"
#include "toolchain/files/text_file.h"
#include "toolchain/files/toml_file.h"
#include "toolchain/files/toml_table.h"

namespace godobject::path {
namespace {

using files::TomlTable;

constexpr double kLongest = 4000.0;  // duration [s]; a replay reads the rows of 4194 s
constexpr double kDegree = std::numbers::pi / 180.0;

Vector3 vector(const TomlTable& table, std::string_view key) {
  return Vector3(table.numbers(key, 3, TomlTable::kFinite).data());
}

Vector3 vector_or_zero(const TomlTable& table, std::string_view key) {
  return table.has(key) ? vector(table, key) : Vector3::Zero();
}

/// Returns the rotation from `quaternion` (w, x, y, z) or `axis_angle` (x, y, z, degrees); without either the identity.
Quaternion rotation(const TomlTable& table) {
  if (table.has("quaternion") && table.has("axis_angle"))
    table.complain("axis_angle", "and quaternion exclude each other; give one of them");
  if (table.has("quaternion")) {
    const auto q = table.numbers("quaternion", 4, TomlTable::kFinite);
    const Quaternion rotation(q[0], q[1], q[2], q[3]);
    if (std::abs(rotation.norm() - 1.0) > 1e-3) table.complain("quaternion", "must be of unit length within 1e-3");
    return rotation.normalized();
  }
  if (table.has("axis_angle")) {
    const auto a = table.numbers("axis_angle", 4, TomlTable::kFinite);
    const Vector3 axis(a[0], a[1], a[2]);
    if (axis.norm() < 1e-9) table.complain("axis_angle", "must have an axis other than zero");
    return exp_rotation(a[3] * kDegree * axis.normalized());
  }
  return Quaternion::Identity();
}

Keyframe keyframe(const TomlTable& table) {
  table.allow({"t", "position", "quaternion", "axis_angle"});
  return {
      .t = table.number("t", TomlTable::kFinite), .position = vector(table, "position"), .rotation = rotation(table)};
}

Oscillation oscillation(const TomlTable& table) {
  table.allow({"from", "to", "frequency", "phase_deg", "fade", "translation", "rotation_deg"});
  Oscillation wave;
  wave.from = table.number("from", TomlTable::kFinite);
  wave.to = table.number("to", TomlTable::kFinite);
  wave.frequency = table.number("frequency", TomlTable::kFinite);
  wave.phase = kDegree * table.number("phase_deg", TomlTable::kFinite, 0.0);
  wave.fade = table.number("fade", TomlTable::kFinite, 0.1);
  wave.translation = vector_or_zero(table, "translation");
  wave.rotation = kDegree * vector_or_zero(table, "rotation_deg");
  if (wave.to <= wave.from) table.complain("to", "must be later than `from`");
  if (wave.frequency <= 0.0) table.complain("frequency", "must be positive [Hz]");
  if (wave.fade <= 0.0 || 2.0 * wave.fade > wave.to - wave.from) {
    table.complain("fade", "must be positive and at most half of the time from `from` to `to` [s]");
  }
  return wave;
}

}  // namespace

Keyframes parse_keyframes(std::string_view text, std::string_view name) {
  const toml::table file = files::parse_toml(text, name);
  const std::string file_name(name);
  const TomlTable top = TomlTable::top(file, file_name);
  top.allow({"pivot", "keyframe", "oscillation", "period"});
  Keyframes motion;
  motion.period = top.number("period", {format::kShortestPeriod, format::kLongestPeriod}, motion.period);
  motion.pivot = vector_or_zero(top, "pivot");
  for (const TomlTable& table : TomlTable::each(file, "keyframe", file_name)) {
    const Keyframe next = keyframe(table);
    if (!motion.keyframes.empty() && next.t <= motion.keyframes.back().t)
      table.complain("t", "must be later than the time of the keyframe before it");
    if (!motion.keyframes.empty() && !(next.t - motion.keyframes.front().t <= kLongest))
      table.complain("t", fmt::format("must be at most {:g} s after the first keyframe; split the motion", kLongest));
    motion.keyframes.push_back(next);
  }
  if (motion.keyframes.size() < 2)
    top.complain("keyframe", "must occur twice or more: write a table [[keyframe]] for each place of rest");
  for (const TomlTable& table : TomlTable::each(file, "oscillation", file_name)) {
    motion.oscillations.push_back(oscillation(table));
  }
  return motion;
}

Keyframes read_keyframes(const std::filesystem::path& file) {
  return parse_keyframes(files::read_text(file), file.string());
}

}  // namespace godobject::path
