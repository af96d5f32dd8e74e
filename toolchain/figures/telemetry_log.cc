#include "toolchain/figures/telemetry_log.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include <fmt/format.h>

#include "toolchain/command_line/failure.h"
#include "toolchain/files/csv_lines.h"
#include "toolchain/files/csv_table.h"

namespace godobject::figures {
namespace {

using files::CsvLines;

void split(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  for (;;) {
    const std::size_t comma = line.find(',');
    fields.push_back(files::trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return;
    line.remove_prefix(comma + 1);
  }
}

Pose pose_of(const double* v) { return {Quaternion(v[3], v[4], v[5], v[6]), Vector3(v[0], v[1], v[2])}; }

constexpr std::array<std::string_view, 25> kNumbers = {
    "t_s",   "fault", "share", "contacts", "depth_m", "fx_N", "fy_N", "fz_N", "tx_Nm",
    "ty_Nm", "tz_Nm", "dpx_m", "dpy_m",    "dpz_m",   "dqw",  "dqx",  "dqy",  "dqz",
    "gpx_m", "gpy_m", "gpz_m", "gqw",      "gqx",     "gqy",  "gqz"};

}  // namespace

TelemetryColumns::TelemetryColumns(std::string_view header) {
  std::vector<std::string_view> fields;
  split(header, fields);
  names_.assign(fields.begin(), fields.end());
  for (const std::string_view name : kNumbers) numbers_.push_back(place(name));
  mode_ = place("mode");
  outcome_ = place("outcome");
  for (std::size_t joint = 1; joint == 1 || has(fmt::format("torque{}_Nm", joint)); ++joint) {
    torques_.push_back(place(fmt::format("torque{}_Nm", joint)));
    add_if_there(fmt::format("q{}_rad", joint), positions_);
    add_if_there(fmt::format("qd{}_rad_s", joint), velocities_);
  }
  add_if_there("late_us", late_);
  add_if_there("compute_us", compute_);
  add_if_there("absorbed_J", absorbed_);
  for (const char* const name : {"wqw", "wqx", "wqy", "wqz"}) add_if_there(name, turn_);
}

TelemetryRow TelemetryColumns::row(std::string_view line) const {
  std::vector<std::string_view> fields;
  split(line, fields);
  if (fields.size() != names_.size())
    throw MalformedTelemetry(
        fmt::format("has {} fields, not {}; make it again with godobject-controller", fields.size(), names_.size()));
  const auto number = [&](std::size_t place) {
    double value = 0.0;
    if (!files::read_number(fields[place], value) || !std::isfinite(value))
      throw MalformedTelemetry(fmt::format("{} is \"{}\", no finite number", names_[place], fields[place]));
    return value;
  };
  const auto numbers = [&](const std::vector<std::size_t>& places) {
    std::vector<double> values;
    values.reserve(places.size());
    for (const std::size_t place : places) values.push_back(number(place));
    return values;
  };
  const std::vector<double> v = numbers(numbers_);
  TelemetryRow row;
  row.cycle.t = v[0];
  row.fault = static_cast<int>(v[1]);
  row.share = v[2];
  row.cycle.contacts = v[3];
  row.cycle.depth = v[4];
  row.cycle.wrench = {Vector3(v[5], v[6], v[7]), Vector3(v[8], v[9], v[10])};
  row.cycle.H_WD = pose_of(&v[11]);
  row.cycle.H_WS = pose_of(&v[18]);
  row.cycle.status = fields[outcome_];
  row.mode = fields[mode_];
  const auto one = [&](const std::vector<std::size_t>& place) {
    return place.empty() ? std::numeric_limits<double>::quiet_NaN() : number(place.front());
  };
  row.late = 1e-6 * one(late_);
  row.compute = 1e-6 * one(compute_);
  row.absorbed = one(absorbed_);
  if (const std::vector<double> turn = numbers(turn_); turn.size() == 4) {
    row.R_WR = Quaternion(turn[0], turn[1], turn[2], turn[3]);
  }
  row.position = numbers(positions_);
  row.velocity = numbers(velocities_);
  row.torque = numbers(torques_);
  return row;
}

ReplayRow TelemetryRow::cycle_in_scene() const {
  ReplayRow turned = cycle;
  turned.wrench = {R_WR._transformVector(cycle.wrench.force), R_WR._transformVector(cycle.wrench.torque)};
  return turned;
}

bool TelemetryColumns::has(std::string_view name) const {
  return std::find(names_.begin(), names_.end(), name) != names_.end();
}

void TelemetryColumns::add_if_there(std::string_view name, std::vector<std::size_t>& places) const {
  if (has(name)) places.push_back(place(name));
}

std::size_t TelemetryColumns::place(std::string_view name) const {
  if (!has(name))
    throw MalformedTelemetry(fmt::format("has no column {}; make it again with godobject-controller", name));
  return static_cast<std::size_t>(std::find(names_.begin(), names_.end(), name) - names_.begin());
}

bool is_telemetry(const std::filesystem::path& file) {
  CsvLines lines(file);
  std::string_view line;
  return lines.next(line) && line.starts_with(kTelemetryBegin);
}

TelemetryLog read_telemetry_log(const std::filesystem::path& file) {
  CsvLines lines(file);
  std::string_view line;
  if (!lines.next(line)) lines.refuse("is empty; make it again with godobject-controller --log");
  TelemetryLog log;
  try {
    const TelemetryColumns columns(line);
    while (lines.next(line)) {
      log.push_back(columns.row(line));
      if (log.size() > 1 && !(log.back().cycle.t > log[log.size() - 2].cycle.t)) lines.refuse("t_s does not increase");
    }
  } catch (const MalformedTelemetry& malformed) {
    lines.refuse(malformed.what());
  }
  if (log.empty()) lines.refuse("holds no cycle");
  return log;
}

ReplayLog rendered(const TelemetryLog& log) {
  ReplayLog cycles;
  for (const TelemetryRow& row : log) {
    if (row.share > 0.0) cycles.push_back(row.cycle_in_scene());
  }
  return cycles;
}

std::vector<HandWork> read_hand_log(const std::filesystem::path& file) {
  constexpr std::array<std::string_view, 2> kColumns = {"t_s", "hand_J"};
  const files::CsvTable table = files::read_csv(file, kColumns);
  std::vector<HandWork> log;
  for (std::size_t i = 0; i < table.rows(); ++i) log.push_back({table.row(i)[0], table.row(i)[1]});
  if (log.empty())
    throw command::Failure(command::ExitCode::kBadData,
                           fmt::format("{}: holds no row; make it again with godobject-controller", file.string()));
  return log;
}

}  // namespace godobject::figures
