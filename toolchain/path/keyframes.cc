#include "toolchain/path/keyframes.h"

#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "toolchain/command_line/failure.h"
#include "toolchain/files/input_file.h"
#include "toolchain/files/toml_table.h"

namespace godobject::path {
namespace {

using command::ExitCode;
using command::Failure;
using files::TomlTable;

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

toml::table parse(std::string_view text, std::string_view name) {
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    throw Failure(ExitCode::kBadConfig, fmt::format("{}:{}: not TOML: {}; correct the line", name,
                                                    error.source().begin.line, error.description()));
  }
}

}  // namespace

Keyframes parse_keyframes(std::string_view text, std::string_view name) {
  const toml::table file = parse(text, name);
  const std::string file_name(name);
  const TomlTable top = TomlTable::top(file, file_name);
  top.allow({"pivot", "keyframe", "oscillation"});
  Keyframes motion;
  motion.pivot = vector_or_zero(top, "pivot");
  for (const TomlTable& table : TomlTable::each(file, "keyframe", file_name)) {
    const Keyframe next = keyframe(table);
    if (!motion.keyframes.empty() && next.t <= motion.keyframes.back().t)
      table.complain("t", "must be later than the time of the keyframe before it");
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
  files::require_input(file);
  std::ifstream stream(file);
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  return parse_keyframes(text, file.string());
}

}  // namespace godobject::path
